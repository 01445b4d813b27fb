// How Boost.Math treats what is out of range of a number here.
#pragma once

#include <boost/math/policies/policy.hpp>

namespace linkstudy {

// Boost fills its tables when the program begins, with numbers that are 0 to valgrind, whose long
// double has 64 bits: no reason to end there. Nothing overflows afterwards: probabilities lie
// inside (0, 1).
using IgnoreOverflow = boost::math::policies::policy<
    boost::math::policies::overflow_error<boost::math::policies::ignore_error>>;

}  // namespace linkstudy
