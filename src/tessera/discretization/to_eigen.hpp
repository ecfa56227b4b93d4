#pragma once

#include <Eigen/Core>

#include "tessera/base/symmetric.hpp"

namespace tessera {

inline Eigen::Vector3d to_eigen(const Vec3& v) { return {v.x, v.y, v.z}; }

inline Eigen::Matrix3d to_eigen(const Symmetric3& m) {
  Eigen::Matrix3d e;
  e << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
  return e;
}

}  // namespace tessera
