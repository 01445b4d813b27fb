#include "study/cli/version.h"

#include <fmt/format.h>

#include "study/schedule/mpi_session.h"

namespace linkstudy {
namespace {

const char* simd_level() {
#if defined(__AVX512F__)
  return "AVX-512";
#elif defined(__AVX2__)
  return "AVX2";
#elif defined(__SSE2__)
  return "SSE2";
#else
  return "none";
#endif
}

}  // namespace

std::string program_version() {
  return LINKSTUDY_VERSION;
}

std::string git_revision() {
  return LINKSTUDY_REVISION;
}

std::string version_text() {
  const std::string revision = git_revision().empty() ? "" : " (" + git_revision() + ")";
  return fmt::format("linkstudy {}{}\nbuild   {}, {}\nMPI     {}\nHDF5    {}\nSIMD    {}\n",
                     program_version(), revision, LINKSTUDY_BUILD_TYPE, LINKSTUDY_COMPILER,
                     mpi_library_version(), LINKSTUDY_HDF5_VERSION, simd_level());
}

}  // namespace linkstudy
