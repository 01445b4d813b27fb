#include "study/session/version_text.h"

#include <fmt/format.h>

#include "study/record/version.h"
#include "study/schedule/mpi_session.h"

namespace linkstudy {

std::string version_text() {
  const std::string revision = git_revision().empty() ? "" : " (" + git_revision() + ")";
  return fmt::format("linkstudy {}{}\nbuild   {}\nMPI     {}\nHDF5    {}\nSIMD    {}\nkernels {}\n",
                     program_version(), revision, build_text(), mpi_library_version(),
                     hdf5_version(), simd_text(), kernels_text());
}

}  // namespace linkstudy
