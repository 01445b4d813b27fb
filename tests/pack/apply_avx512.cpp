// Plain functions: nothing that a linker could share with code for other instruction sets.
#include "tests/pack/pack_probe_impl.h"

namespace linkstudy::testing {

#if defined(__AVX512F__)
void apply_avx512_one(const PackOperands* in, PackResults* out, unsigned* bits) {
  apply_pack<Avx512, 1>(in, out, bits);
}
void apply_avx512_all(const PackOperands* in, PackResults* out, unsigned* bits) {
  apply_pack<Avx512, Avx512::lanes>(in, out, bits);
}
void laws_avx512_one(const PackOperands* in, LawResults* out) {
  apply_laws<Avx512, 1>(in, out);
}
void laws_avx512_all(const PackOperands* in, LawResults* out) {
  apply_laws<Avx512, Avx512::lanes>(in, out);
}
#else
void apply_avx512_one(const PackOperands*, PackResults*, unsigned*) {}
void apply_avx512_all(const PackOperands*, PackResults*, unsigned*) {}
void laws_avx512_one(const PackOperands*, LawResults*) {}
void laws_avx512_all(const PackOperands*, LawResults*) {}
#endif

}  // namespace linkstudy::testing
