#include "study/record/version.h"

#include <fmt/format.h>

#include "core/base/isa.h"
#include "core/simulation/written_steps.h"
#include "study/record/counted.h"

namespace linkstudy {

std::string program_version() {
  return LINKSTUDY_VERSION;
}

std::string git_revision() {
  return LINKSTUDY_REVISION;
}

std::string simd_text() {
  const SimdLevel level = simd_level();
  return fmt::format("{}, {}", name_of(level.isa), counted(level.lanes, "lane"));
}

std::string kernels_text() {
  const std::string why = why_not_written(simd_level());
  return why.empty() ? "written for each linkage (AVX2)" : "general (" + why + ")";
}

std::string written_text() {
  const WrittenReport report = written_report();
  std::string text;
  if (report.kernels > 0) {
    text = fmt::format("{} written in {:.1f} ms", counted(report.kernels, "step kernel"),
                       1e3 * report.seconds);
  }
  if (report.untraceable > 0) {
    text += fmt::format("{}{} by the general loop alone ({})", text.empty() ? "" : ", ",
                        counted(report.untraceable, "structure"), report.why);
  }
  return text;
}

std::string build_text() {
  return fmt::format("{}, {}", LINKSTUDY_BUILD_TYPE, LINKSTUDY_COMPILER);
}

std::string hdf5_version() {
  return LINKSTUDY_HDF5_VERSION;
}

}  // namespace linkstudy
