#include "core/base/isa.h"

#include <cstdlib>
#include <string>

namespace linkstudy {
namespace {

InstructionSet widest() {
  if (machine_has(InstructionSet::avx512)) return InstructionSet::avx512;
  return machine_has(InstructionSet::avx2) ? InstructionSet::avx2 : InstructionSet::baseline;
}

InstructionSet wanted(const std::string& name) {
  const std::optional<InstructionSet> isa = find_word<InstructionSet>(name);
  if (!isa) throw SimdError("LINKSTUDY_SIMD=" + name + ": must be baseline, avx2 or avx512");
  if (!machine_has(*isa)) throw SimdError("LINKSTUDY_SIMD=" + name + ": not on this machine");
  return *isa;
}

Kernels wanted_kernels(const std::string& name) {
  const std::optional<Kernels> kernels = find_word<Kernels>(name);
  if (!kernels || *kernels == Kernels::automatic) {
    throw SimdError("LINKSTUDY_KERNELS=" + name + ": must be written or general");
  }
  return *kernels;
}

}  // namespace

bool machine_has(InstructionSet isa) {
#if defined(__x86_64__)
  if (isa == InstructionSet::avx512) return __builtin_cpu_supports("x86-64-v4") > 0;
  if (isa == InstructionSet::avx2) return __builtin_cpu_supports("x86-64-v3") > 0;
  return true;
#else
  return isa == InstructionSet::baseline;
#endif
}

SimdLevel choose_simd_level(const char* simd, const char* lanes, const char* kernels) {
  SimdLevel level;
  level.isa = simd && *simd ? wanted(simd) : widest();
  level.lanes = native_lanes(level.isa);
  if (lanes && *lanes && std::string(lanes) != std::to_string(level.lanes)) {
    if (std::string(lanes) != "1") {
      throw SimdError("LINKSTUDY_LANES=" + std::string(lanes) + ": must be 1 or " +
                      std::to_string(level.lanes));
    }
    level.lanes = 1;
  }
  if (kernels && *kernels) level.kernels = wanted_kernels(kernels);
  return level;
}

SimdLevel simd_level() {
  static const SimdLevel level =
      choose_simd_level(std::getenv("LINKSTUDY_SIMD"), std::getenv("LINKSTUDY_LANES"),
                        std::getenv("LINKSTUDY_KERNELS"));
  return level;
}

}  // namespace linkstudy
