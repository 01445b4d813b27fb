// Plain functions: nothing that a linker could share with code for other instruction sets.
#include "tests/pack/pack_probe_impl.h"

namespace linkstudy::testing {

#if 1
void apply_baseline_one(const PackOperands* in, PackResults* out, unsigned* bits) {
  apply_pack<Baseline, 1>(in, out, bits);
}
void apply_baseline_all(const PackOperands* in, PackResults* out, unsigned* bits) {
  apply_pack<Baseline, Baseline::lanes>(in, out, bits);
}
#else
void apply_baseline_one(const PackOperands*, PackResults*, unsigned*) {}
void apply_baseline_all(const PackOperands*, PackResults*, unsigned*) {}
#endif

}  // namespace linkstudy::testing
