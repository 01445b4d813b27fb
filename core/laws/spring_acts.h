// In which direction a spring acts (core/laws/spring_force.h).
#pragma once

#include <cstdint>

#include "core/base/words.h"

namespace linkstudy {

enum class SpringActs : std::uint8_t { both, tension, compression };

template <>
inline constexpr auto kWords<SpringActs> = make_words<SpringActs>(
    {{SpringActs::both, "both", "pulls and pushes"},
     {SpringActs::tension, "tension", "a rope: nothing where it is slack, and never a push"},
     {SpringActs::compression, "compression",
      "a buffer: nothing where it is apart, never a pull"}});

}  // namespace linkstudy
