#pragma once
// Vector types of the whole core. SI units, Y up, right-handed, double precision.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <span>
#include <vector>

#include "core/math/pair.hpp"

namespace substep {

// DontAlign: Eigen aligns types by the compiler's flags, and a program that uses the library may
// have flags of its own. (Vec3 and Mat3 are of sizes that Eigen never aligns.)
using Vec2 = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;
using Vec3 = Eigen::Vector3d;
using Vec6 = Eigen::Matrix<double, 6, 1, Eigen::DontAlign>;  ///< linear part first, then angular
using VecX = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::DontAlign>;
using Mat3 = Eigen::Matrix3d;
using Mat6 = Eigen::Matrix<double, 6, 6, Eigen::DontAlign>;
using Quat = Eigen::Quaternion<double, Eigen::DontAlign>;
static_assert(alignof(Vec3) == alignof(double) && alignof(Mat3) == alignof(double));

/// Container index. Elsewhere -1 means none.
inline std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// Copies velocities two numbers at a time. memcpy would call out of WebAssembly, which is slower
/// than the copy.
inline void copy(std::span<const Vec6> from, std::span<Vec6> to) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    for (int j = 0; j < 6; j += 2) store_pair(load_pair(from[i].data() + j), to[i].data() + j);
  }
}

/// Copies the velocities of some bodies.
inline void copy_of(std::span<const int> bodies, std::span<const Vec6> from, std::span<Vec6> to) {
  for (const int body : bodies) {
    const std::size_t i = index(body);
    copy(from.subspan(i, 1), to.subspan(i, 1));
  }
}

/// [x]: the matrix with [x] y = x cross y.
inline Mat3 skew(const Vec3& x) {
  Mat3 m;
  m << 0.0, -x.z(), x.y(), x.z(), 0.0, -x.x(), -x.y(), x.x(), 0.0;
  return m;
}

/// [a][b] = b a^T - (a . b) E, the product of two skew matrices.
inline Mat3 skew_product(const Vec3& a, const Vec3& b) {
  const double xx = a.x() * b.x();
  const double yy = a.y() * b.y();
  const double zz = a.z() * b.z();
  Mat3 m;
  m << -(zz + yy), b.x() * a.y(), b.x() * a.z(),  //
      b.y() * a.x(), -(zz + xx), b.y() * a.z(),   //
      b.z() * a.x(), b.z() * a.y(), -(yy + xx);
  return m;
}

}  // namespace substep
