// Plain functions: nothing that a linker could share with code for other instruction sets.
#include "tests/pack/pack_probe_impl.h"

namespace linkstudy::testing {

#if defined(__AVX2__)
void apply_avx2_one(const PackOperands* in, PackResults* out, unsigned* bits) {
  apply_pack<Avx2, 1>(in, out, bits);
}
void apply_avx2_all(const PackOperands* in, PackResults* out, unsigned* bits) {
  apply_pack<Avx2, Avx2::lanes>(in, out, bits);
}
void laws_avx2_one(const PackOperands* in, LawResults* out) {
  apply_laws<Avx2, 1>(in, out);
}
void laws_avx2_all(const PackOperands* in, LawResults* out) {
  apply_laws<Avx2, Avx2::lanes>(in, out);
}
#else
void apply_avx2_one(const PackOperands*, PackResults*, unsigned*) {}
void apply_avx2_all(const PackOperands*, PackResults*, unsigned*) {}
void laws_avx2_one(const PackOperands*, LawResults*) {}
void laws_avx2_all(const PackOperands*, LawResults*) {}
#endif

}  // namespace linkstudy::testing
