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
void laws_baseline_one(const PackOperands* in, LawResults* out) {
  apply_laws<Baseline, 1>(in, out);
}
void laws_baseline_all(const PackOperands* in, LawResults* out) {
  apply_laws<Baseline, Baseline::lanes>(in, out);
}
#else
void apply_baseline_one(const PackOperands*, PackResults*, unsigned*) {}
void apply_baseline_all(const PackOperands*, PackResults*, unsigned*) {}
void laws_baseline_one(const PackOperands*, LawResults*) {}
void laws_baseline_all(const PackOperands*, LawResults*) {}
#endif

}  // namespace linkstudy::testing
