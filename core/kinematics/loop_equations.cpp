#include "core/kinematics/loop_equations.h"

#include <Eigen/Geometry>
#include <bit>

#include "core/kinematics/closure_jacobian.h"
#include "core/numerics/dense.h"
#include "core/numerics/rank.h"
#include "core/spatial/to_eigen.h"

namespace linkstudy {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Elements = Eigen::Matrix<double, kElements, 1>;
using Twist = Eigen::Matrix<double, 6, 1>;

// Rates of the elements of a frame's pose in the common body, which rests.
Elements element_rates(const Matrix3d& common, const Matrix3d& rotation, const Twist& twist,
                       double extent) {
  Elements rates;
  for (int c = 0; c < 3; ++c) {
    rates.segment<3>(3 * c) = common.transpose() * twist.head<3>().cross(rotation.col(c));
  }
  rates.tail<3>() = common.transpose() * twist.tail<3>() / extent;
  return rates;
}

Elements elements_of(const Matrix3d& common, const ClosureFrame& a, const ClosureFrame& b,
                     double extent) {
  Elements difference;
  const Matrix3d turned = common.transpose() * (a.rotation - b.rotation);
  for (int c = 0; c < 3; ++c) difference.segment<3>(3 * c) = turned.col(c);
  difference.tail<3>() = common.transpose() * (a.position - b.position) / extent;
  return difference;
}

std::vector<int> elements_in(unsigned choice) {
  std::vector<int> elements;
  for (int i = 0; i < kElements; ++i)
    if (choice >> i & 1u) elements.push_back(i);
  return elements;
}

MatrixXd rows_of(const MatrixXd& a, const std::vector<int>& rows) {
  MatrixXd b(static_cast<Eigen::Index>(rows.size()), a.cols());
  for (std::size_t i = 0; i < rows.size(); ++i)
    b.row(static_cast<Eigen::Index>(i)) = a.row(rows[i]);
  return b;
}

}  // namespace

const char* element_name(int element) {
  static constexpr std::array<const char*, kElements> names = {
      "a11", "a21", "a31", "a12", "a22", "a32", "a13", "a23", "a33", "a14", "a24", "a34"};
  return names[static_cast<std::size_t>(element)];
}

LoopEquations::LoopEquations(const Model& closed, const ClosureScale& scale, const BasicLoop& loop)
    : closed_(closed),
      scale_(scale),
      loop_(loop),
      joint_(cut_joint_of(closed.mechanism, loop.closure)) {}

LoopEquations::Frames LoopEquations::frames(const State<double>& s,
                                            const VectorXd* cut_position) const {
  const Mechanism& m = closed_.mechanism;
  Frames f{make_workspace<double>(m), {}, {}, {}, {}};
  update_kinematics(m, closed_.parameters, s.q.data(), s.v.data(), f.w);
  ClosureStructure c = m.closures[loop_.closure];
  c.needs_frames = true;
  ClosureState<double> x{};
  update_closure_pose(m, c, closed_.parameters.closures[loop_.closure], f.w.bodies, x);
  f.first = first_frame(x);
  f.second = second_frame(x);
  f.reached = cut_position ? moved_by(joint_, *cut_position, f.first) : f.second;
  f.common = to_eigen(f.w.bodies[loop_.common].R_WB);
  return f;
}

VectorXd LoopEquations::cut_position(const State<double>& s) const {
  const Frames f = frames(s, nullptr);
  return cut_joint_position(joint_, f.first, f.second);
}

Elements LoopEquations::residual(const State<double>& s, const VectorXd& cut_position) const {
  const Frames f = frames(s, &cut_position);
  return elements_of(f.common, f.reached, f.second, scale_.extent);
}

MatrixXd LoopEquations::jacobian(const State<double>& s, const VectorXd& cut_position) const {
  const Frames f = frames(s, &cut_position);
  const int nv = closed_.mechanism.nv;
  MatrixXd j = MatrixXd::Zero(kElements, nv + joint_.velocity_count());
  const auto rates = [&](const ClosureFrame& frame, const Twist& twist) {
    return element_rates(f.common, frame.rotation, twist, scale_.extent);
  };
  for (const VelocityIndex k : loop_.first) {
    j.col(k.value()) = scale_.velocity[k.value()] *
                       rates(f.reached, twist_of(closed_.mechanism, closed_.parameters, f.w, k,
                                                 f.reached.position));
  }
  for (const VelocityIndex k : loop_.second) {
    j.col(k.value()) =
        -scale_.velocity[k.value()] *
        rates(f.second, twist_of(closed_.mechanism, closed_.parameters, f.w, k, f.second.position));
  }
  const MatrixXd cut = cut_joint_twists(joint_, f.first, f.reached);
  for (int i = 0; i < joint_.velocity_count(); ++i) {
    const bool shifts = i < static_cast<int>(joint_.shifts.size());
    j.col(nv + i) = (shifts ? scale_.extent : 1.0) * rates(f.reached, cut.col(i));
  }
  return j;
}

ProperElements choose_proper_elements(const MatrixXd& jacobian) {
  const int rank = numerical_rank(jacobian, kMobilityTolerance, kLeastRowSize).rank;
  const MatrixXd gram = jacobian * jacobian.transpose();
  double best = -1.0;
  ProperElements proper;
  for (unsigned choice = 0; choice < 1u << kElements; ++choice) {
    if (std::popcount(choice) != rank) continue;
    const std::vector<int> elements = elements_in(choice);
    const double square = determinant(gram(elements, elements));
    // Of equal choices the first: a difference must be more than rounding.
    if (square <= best * (1.0 + 1e-9)) continue;
    best = square;
    proper.elements = elements;
  }
  proper.conditioning = conditioning_of(jacobian, proper.elements);
  return proper;
}

double conditioning_of(const MatrixXd& jacobian, const std::vector<int>& elements) {
  if (elements.empty()) return 1.0;
  const VectorXd sizes = singular_values(rows_of(jacobian, elements));
  return sizes.minCoeff() / sizes.maxCoeff();
}

}  // namespace linkstudy
