#include "core/import/mass_properties.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace substep {
namespace {

/// Of a point mass about the origin [kg m^2].
Mat3 point_inertia(double mass, const Vec3& at) {
  return mass * (at.squaredNorm() * Mat3::Identity() - at * at.transpose());
}

}  // namespace

MassProperties MassProperties::moved(const Pose& pose) const {
  const Mat3 R = pose.orientation.toRotationMatrix();
  return {mass, pose * centre, R * inertia * R.transpose()};
}

MassProperties MassProperties::scaled(double factor) const {
  return {factor * mass, centre, factor * inertia};
}

MassProperties& MassProperties::operator+=(const MassProperties& other) {
  if (other.mass == 0.0) return *this;
  const double sum = mass + other.mass;
  const Vec3 common = (mass * centre + other.mass * other.centre) / sum;
  inertia += other.inertia + point_inertia(mass, centre - common) +
             point_inertia(other.mass, other.centre - common);
  mass = sum;
  centre = common;
  return *this;
}

PrincipalAxes principal_axes(const Mat3& inertia) {
  constexpr double kDiagonal = 1e-14;  // off-diagonal elements, relative to the trace
  const double off =
      std::max({std::abs(inertia(0, 1)), std::abs(inertia(0, 2)), std::abs(inertia(1, 2))});
  if (off <= kDiagonal * inertia.trace()) return {Quat::Identity(), inertia.diagonal()};
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia);
  Mat3 axes = solver.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(2) = -axes.col(2);
  return {Quat(axes).normalized(), solver.eigenvalues()};
}

Vec3 equivalent_box(double mass, const Vec3& moments) {
  // With half extents e, I_x = m/3 (e_y^2 + e_z^2).
  const double sum = moments.sum();
  Vec3 box = (1.5 / mass * (Vec3::Constant(sum) - 2.0 * moments)).cwiseMax(0.0).cwiseSqrt();
  const double least = 0.01 * box.maxCoeff();
  return box.cwiseMax(least);
}

}  // namespace substep
