#pragma once

#include <array>

#include "core/math/types.hpp"

namespace substep::scenes {

/// Bricard's mechanism of IFToMM A04 in its one coordinate: five rods of 1 kg and 1 m along edges
/// of the unit cube, hinges at the six corners that they join, released under 9.81 m/s^2 along -y.
class Bricard {
 public:
  static constexpr int kRods = 5;
  static constexpr int kHinges = 6;

  static Vec3 point(int hinge);  ///< of a hinge at the start, world [m]
  static Vec3 axis(int hinge);   ///< of a hinge at the start, world [-]

  /// Integrates to time t in steps of at most 2 ms. @param t no less than at the last call [s]
  void advance(double t);
  [[nodiscard]] double angle() const { return angle_; }  ///< of hinges 1, 3 and 5 [rad]
  [[nodiscard]] double energy() const;                   ///< zero at the start [J]
  [[nodiscard]] Vec3 centre(int rod) const;              ///< world [m]
  [[nodiscard]] Quat orientation(int rod) const;         ///< from that at the start
  /// Closure error of the chain of six hinges, for tests [m, -].
  [[nodiscard]] static double closure_error(double angle);

 private:
  double t_ = 0.0;      // [s]
  double angle_ = 0.0;  // [rad]
  double speed_ = 0.0;  // [rad/s]
};

}  // namespace substep::scenes
