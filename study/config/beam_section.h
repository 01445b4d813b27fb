// Moments of the cross-section of a beam. y and z are the axes across the beam, in m; moments in
// m^4.
//   circle     J_y = J_z = pi d^4 / 64,             J_t = J_y + J_z
//   tube       J_y = J_z = pi (D^4 - d^4) / 64,     J_t = J_y + J_z
//   rectangle  J_y = b h^3 / 12, J_z = h b^3 / 12 for the sides b along y and h along z; with the
//              longer side l and the shorter one s (Timoshenko and Goodier, Theory of Elasticity,
//              sec. 109: torsion of rectangular bars)
//              J_t = l s^3 (1/3 - 64 s / (pi^5 l) sum over odd k of tanh(k pi l / (2 s)) / k^5)
// J_t is the torsion constant in torque = G J_t twist; it is J_y + J_z for circles only.
#pragma once

#include "core/base/words.h"

namespace linkstudy {

// How a section is written; given: by its moments.
enum class SectionShape { circle, tube, rectangle, given };

template <>
inline constexpr auto kWords<SectionShape> =
    make_words<SectionShape>({{SectionShape::circle, "circle"},
                              {SectionShape::tube, "tube"},
                              {SectionShape::rectangle, "rectangle"},
                              {SectionShape::given, "given"}});

struct BeamSection {
  double second_moment_y = 0.0;   // integral z^2 dA: bending about y
  double second_moment_z = 0.0;   // integral y^2 dA: bending about z
  double torsion_constant = 0.0;  // J_t
};

BeamSection circle_section(double diameter);
BeamSection tube_section(double outer_diameter, double inner_diameter);
BeamSection rectangle_section(double along_y, double along_z);

}  // namespace linkstudy
