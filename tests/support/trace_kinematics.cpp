#include "tests/support/trace_kinematics.h"

namespace linkstudy::testing {
namespace {

// T~ with its derivatives by the joint's own coordinates.
LinkTransform joint_transform(const TraceLink& link, const Vector& q) {
  const int n = static_cast<int>(link.motions.size());
  std::vector<Transform> A(n);
  for (int k = 0; k < n; ++k) A[k] = motion_matrix(link.motions[k], q[link.first_coordinate + k]);

  const auto product = [&](int i, int j) {
    Transform P = link.before;
    for (int k = 0; k < n; ++k) {
      if (k == i) P *= link.operators[k];
      if (k == j) P *= link.operators[k];
      P *= A[k];
    }
    if (!link.child_frame_is_identity) P *= link.after;
    return P;
  };

  LinkTransform local;
  local.T = product(-1, -1);
  local.T_ij.resize(n);
  for (int i = 0; i < n; ++i) {
    local.T_i.push_back(product(i, -1));
    for (int j = 0; j < n; ++j) local.T_ij[i].push_back(j < i ? local.T_ij[j][i] : product(i, j));
  }
  return local;
}

LinkTransform chained(const LinkTransform& parent, const LinkTransform& local) {
  const std::size_t m = parent.T_i.size();
  const std::size_t n = m + local.T_i.size();
  LinkTransform link;
  link.T = parent.T * local.T;
  link.T_i.resize(n);
  link.T_ij.assign(n, std::vector<Transform>(n));
  for (std::size_t i = 0; i < n; ++i) {
    link.T_i[i] =
        i < m ? Transform(parent.T_i[i] * local.T) : Transform(parent.T * local.T_i[i - m]);
    for (std::size_t j = 0; j < n; ++j) {
      if (j < i) {
        link.T_ij[i][j] = link.T_ij[j][i];
      } else if (j < m) {
        link.T_ij[i][j] = parent.T_ij[i][j] * local.T;
      } else if (i < m) {
        link.T_ij[i][j] = parent.T_i[i] * local.T_i[j - m];
      } else {
        link.T_ij[i][j] = parent.T * local.T_ij[i - m][j - m];
      }
    }
  }
  return link;
}

Vector homogeneous(const Eigen::Vector3d& point) {
  Vector r(4);
  r << point, 1.0;
  return r;
}

}  // namespace

std::vector<LinkTransform> link_transforms(const TraceModel& model, const Vector& q) {
  std::vector<LinkTransform> transforms;
  transforms.reserve(model.links.size());
  for (const TraceLink& link : model.links) {
    LinkTransform local = joint_transform(link, q);
    if (link.parent == kGroundIndex) {
      transforms.push_back(std::move(local));
    } else {
      transforms.push_back(chained(transforms[link.parent], local));
    }
  }
  return transforms;
}

CarriedFrame carried_frame(const TraceModel& model, const std::vector<LinkTransform>& transforms,
                           int link, const Transform& frame, const Vector& v) {
  CarriedFrame carried;
  carried.T = frame;
  carried.T_i.assign(model.dof, Transform::Zero(4, 4));
  carried.T_dot = carried.T_vv = Transform::Zero(4, 4);
  if (link == kGroundIndex) return carried;

  const std::vector<int>& path = model.links[link].path;
  const LinkTransform& moving = transforms[link];
  carried.T = moving.T * frame;
  for (std::size_t i = 0; i < path.size(); ++i) {
    carried.T_i[path[i]] = moving.T_i[i] * frame;
    carried.T_dot += carried.T_i[path[i]] * v[path[i]];
    for (std::size_t j = 0; j < path.size(); ++j) {
      carried.T_vv += moving.T_ij[i][j] * (v[path[i]] * v[path[j]]);
    }
  }
  carried.T_vv = carried.T_vv * frame;
  return carried;
}

Eigen::Vector3d point_position(const TraceModel&, const std::vector<LinkTransform>& transforms,
                               int link, const Eigen::Vector3d& point) {
  if (link == kGroundIndex) return point;
  return (transforms[link].T * homogeneous(point)).head(3);
}

Matrix point_jacobian(const TraceModel& model, const std::vector<LinkTransform>& transforms,
                      int link, const Eigen::Vector3d& point) {
  Matrix J = Matrix::Zero(3, model.dof);
  if (link == kGroundIndex) return J;
  const std::vector<int>& path = model.links[link].path;
  for (std::size_t i = 0; i < path.size(); ++i) {
    J.col(path[i]) = (transforms[link].T_i[i] * homogeneous(point)).head(3);
  }
  return J;
}

Matrix rotation_jacobian(const TraceModel& model, const std::vector<LinkTransform>& transforms,
                         int link) {
  Matrix J = Matrix::Zero(3, model.dof);
  if (link == kGroundIndex) return J;
  const std::vector<int>& path = model.links[link].path;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Eigen::Matrix3d spin = transforms[link].T_i[i].topLeftCorner(3, 3) *
                                 transforms[link].T.topLeftCorner(3, 3).transpose();
    J.col(path[i]) << spin(2, 1), spin(0, 2), spin(1, 0);
  }
  return J;
}

}  // namespace linkstudy::testing
