#include "study/record/version.h"

#include <fmt/format.h>

#include "core/base/isa.h"

namespace linkstudy {

std::string program_version() {
  return LINKSTUDY_VERSION;
}

std::string git_revision() {
  return LINKSTUDY_REVISION;
}

std::string simd_text() {
  const SimdLevel level = simd_level();
  return fmt::format("{}, {} lane{}", name_of(level.isa), level.lanes, level.lanes == 1 ? "" : "s");
}

std::string build_text() {
  return fmt::format("{}, {}", LINKSTUDY_BUILD_TYPE, LINKSTUDY_COMPILER);
}

std::string hdf5_version() {
  return LINKSTUDY_HDF5_VERSION;
}

}  // namespace linkstudy
