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
  if (!why.empty()) return "general (" + why + ")";
  const bool is_wide = simd_level().lanes == native_lanes(InstructionSet::avx512);
  return fmt::format("written for each linkage ({})", is_wide ? "AVX-512" : "AVX2");
}

std::string written_text() {
  return written_text(written_report());
}

std::string written_text(const WrittenReport& report) {
  std::string text;
  if (report.kernels > 0) {
    text = fmt::format("{} written in {:.1f} ms", counted(report.kernels, "step kernel"),
                       1e3 * report.seconds);
  }
  if (report.distrusted > 0) {
    text += fmt::format(", {} served by AVX2: AVX-512 gave other bits", report.distrusted);
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
