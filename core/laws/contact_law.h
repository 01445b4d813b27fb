// Names of the laws of normal contact and of the speed they divide by
// (core/laws/normal_contact.h).
#pragma once

#include <cstdint>

namespace linkstudy {

enum class ContactLaw : std::uint8_t { lankarani_nikravesh, flores, hunt_crossley };

// begin: the speed at which this contact began, [AugUrb18] eq. (13); greatest: that, and more if
// the contact is driven faster later.
enum class ApproachSpeed : std::uint8_t { begin, greatest };

}  // namespace linkstudy
