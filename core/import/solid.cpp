#include "core/import/solid.hpp"

#include <numbers>

namespace substep {
namespace {

using std::numbers::pi;

/// About the centre, axes of the solid, for mass 1 [m^2].
Vec3 moments_of_unit_mass(const Solid& solid) {
  const Vec3 squares = solid.half.cwiseProduct(solid.half);
  const double r2 = squares.x();
  const double h = solid.half.z();
  const Vec3 of_box{squares.y() + squares.z(), squares.x() + squares.z(),
                    squares.x() + squares.y()};
  switch (solid.kind) {
    case Solid::Kind::kSphere:
      return Vec3::Constant(0.4 * r2);
    case Solid::Kind::kCylinder: {
      const double across = 0.25 * r2 + h * h / 3.0;
      return {across, across, 0.5 * r2};
    }
    case Solid::Kind::kCapsule: {
      // A cylinder and two half balls, whose centres of mass are 3/8 r beyond its ends.
      const double r = solid.half.x();
      const double cylinder = 2.0 * h / (2.0 * h + 4.0 / 3.0 * r);  // share of the mass
      const double balls = 1.0 - cylinder;
      const double across =
          cylinder * (0.25 * r2 + h * h / 3.0) + balls * (0.4 * r2 + h * h + 0.75 * h * r);
      return {across, across, cylinder * 0.5 * r2 + balls * 0.4 * r2};
    }
    case Solid::Kind::kEllipsoid:
      return of_box / 5.0;
    case Solid::Kind::kBox:
      break;
  }
  return of_box / 3.0;
}

}  // namespace

double volume(const Solid& solid) {
  const Vec3& e = solid.half;
  const double disc = pi * e.x() * e.x();
  switch (solid.kind) {
    case Solid::Kind::kSphere:
      return 4.0 / 3.0 * disc * e.x();
    case Solid::Kind::kCylinder:
      return 2.0 * disc * e.z();
    case Solid::Kind::kCapsule:
      return disc * (2.0 * e.z() + 4.0 / 3.0 * e.x());
    case Solid::Kind::kEllipsoid:
      return 4.0 / 3.0 * pi * e.prod();
    case Solid::Kind::kBox:
      break;
  }
  return 8.0 * e.prod();
}

MassProperties mass_properties(const Solid& solid, double mass) {
  return {mass, Vec3::Zero(), Mat3((mass * moments_of_unit_mass(solid)).asDiagonal())};
}

}  // namespace substep
