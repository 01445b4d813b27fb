// The operations of packs, each compiled for its instruction set, behind plain numbers.
#pragma once

namespace linkstudy::testing {

struct PackOperands {
  double a, b, c;
};

// Results of one lane: what each operation gave for its a, b, c.
struct PackResults {
  double sum, difference, product, quotient, negated, root, absolute, least, greatest, madd, msub,
      nmadd, chosen, sine, cosine, broadcast, exponential, exponent, fraction, logarithm, power;
  bool below, equal, finite;
};

// Of a contact at depth a, with rate b and exponent 1.7; of a bristle bent by a, sliding at c; of a
// body at -|a|, |b| and then c, b.
struct LawResults {
  double normal, mu, z_rate, crossing;
};

// As many operands and results as there are lanes; bits: of a < b.
using ApplyPack = void (*)(const PackOperands* in, PackResults* out, unsigned* bits);

void apply_baseline_one(const PackOperands* in, PackResults* out, unsigned* bits);
void apply_baseline_all(const PackOperands* in, PackResults* out, unsigned* bits);
void apply_avx2_one(const PackOperands* in, PackResults* out, unsigned* bits);
void apply_avx2_all(const PackOperands* in, PackResults* out, unsigned* bits);
void apply_avx512_one(const PackOperands* in, PackResults* out, unsigned* bits);
void apply_avx512_all(const PackOperands* in, PackResults* out, unsigned* bits);

using ApplyLaws = void (*)(const PackOperands* in, LawResults* out);

void laws_baseline_one(const PackOperands* in, LawResults* out);
void laws_baseline_all(const PackOperands* in, LawResults* out);
void laws_avx2_one(const PackOperands* in, LawResults* out);
void laws_avx2_all(const PackOperands* in, LawResults* out);
void laws_avx512_one(const PackOperands* in, LawResults* out);
void laws_avx512_all(const PackOperands* in, LawResults* out);

}  // namespace linkstudy::testing
