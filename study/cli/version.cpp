#include "study/cli/version.h"

#include <fmt/format.h>

#include "core/base/isa.h"
#include "study/schedule/mpi_session.h"

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

std::string version_text() {
  const std::string revision = git_revision().empty() ? "" : " (" + git_revision() + ")";
  return fmt::format("linkstudy {}{}\nbuild   {}, {}\nMPI     {}\nHDF5    {}\nSIMD    {}\n",
                     program_version(), revision, LINKSTUDY_BUILD_TYPE, LINKSTUDY_COMPILER,
                     mpi_library_version(), LINKSTUDY_HDF5_VERSION, simd_text());
}

}  // namespace linkstudy
