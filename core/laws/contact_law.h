// Names of the laws of normal contact (core/laws/normal_contact.h).
#pragma once

#include <cstdint>

namespace linkstudy {

enum class ContactLaw : std::uint8_t { lankarani_nikravesh, flores, hunt_crossley };

}  // namespace linkstudy
