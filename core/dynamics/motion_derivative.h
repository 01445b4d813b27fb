// The equations of motion of a linkage, differentiated exactly: with x = (q, v, z)
//   x' = (q', qdd, z')(t, x),   matrix() = d(x', P)/dx,   n = nq + nv + nz,
// P the two powers that the energy ledger integrates: supplied and dissipated.
// They are traced once for a structure (core/codegen/traced.h), and once more where cut rows depend
// on each other, whose multipliers are then those of least norm for the rank and the pivots that
// they have there; numbers of all parameters serve. Joints, closures, loads, springs, contacts and
// friction are in, each on its side of a bend. Driven coordinates count as given: q and v of the
// state.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/model/compile.h"
#include "core/model/workspace.h"

namespace linkstudy {

class MotionDerivative {
 public:
  // Keeps no reference.
  MotionDerivative(const Mechanism& m, const Parameters<double>& p);
  ~MotionDerivative();
  MotionDerivative(const MotionDerivative&) = delete;
  MotionDerivative& operator=(const MotionDerivative&) = delete;

  bool has_structure_of(const Model& model) const;
  // Others of the same structure.
  void set_parameters(const Parameters<double>& p);

  // At (t, q, v, z), contacts as they remember. False where nothing is known: friction in joints
  // that does not settle in a few passes, a jump.
  bool update(double t, const double* q, const double* v, const double* z,
              const std::vector<ContactMemory<double>>& memory);

  // (n + 2, n)
  const Eigen::MatrixXd& matrix() const { return matrix_; }

 private:
  struct Code;
  // Null where the equations cannot be traced.
  static std::unique_ptr<Code> trace(const Mechanism& m, const Parameters<double>& p,
                                     bool rows_may_depend);
  bool update(Code& code, double t, const double* q, const double* v, const double* z,
              const std::vector<ContactMemory<double>>& memory);

  Mechanism mechanism_;
  Parameters<double> parameters_;
  std::unique_ptr<Code> code_, dependent_;  // the latter when it is asked for
  bool was_dependent_asked_ = false;
  Eigen::MatrixXd matrix_;
};

// That of the structure of a model, with its parameters: kept for the next model of this structure
// in this thread, until another call.
MotionDerivative& derivative_of(const Model& model);

}  // namespace linkstudy
