// Names of the laws of normal contact and of the speed they divide by
// (core/laws/normal_contact.h).
#pragma once

#include <cstdint>

#include "core/base/words.h"

namespace linkstudy {

enum class ContactLaw : std::uint8_t { lankarani_nikravesh, flores, hunt_crossley };

template <>
inline constexpr auto kWords<ContactLaw> =
    make_words<ContactLaw>({{ContactLaw::lankarani_nikravesh, "lankarani_nikravesh"},
                            {ContactLaw::flores, "flores"},
                            {ContactLaw::hunt_crossley, "hunt_crossley"}});

// begin: the speed at which this contact began, [AugUrb18] eq. (13); greatest: that, and more if
// the contact is driven faster later.
enum class ApproachSpeed : std::uint8_t { begin, greatest };

template <>
inline constexpr auto kWords<ApproachSpeed> = make_words<ApproachSpeed>(
    {{ApproachSpeed::begin, "begin", "that at which this contact began, as printed"},
     {ApproachSpeed::greatest, "greatest", "the greatest speed of the contact so far"}});

}  // namespace linkstudy
