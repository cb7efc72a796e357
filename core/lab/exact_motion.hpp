#pragma once
// Motions in closed form, and one in minimal coordinates: references for the exam and tests.

#include "core/math/types.hpp"

namespace substep {

/// A pendulum in a plane, theta'' = -rate^2 sin theta, theta from straight down [rad].
class ExactPendulum {
 public:
  struct Motion {
    double angle = 0.0;         // [rad], continuous
    double speed = 0.0;         // [rad/s]
    double acceleration = 0.0;  // [rad/s^2]
  };

  /// Released at rest. @param rate sqrt(m g a/I) of small swings [rad/s]
  /// @param angle at the start, in (0, pi) [rad]
  static ExactPendulum released(double rate, double angle);
  /// Rotates over the top, starting there.
  /// @param top_speed angular velocity there, > 0 [rad/s]
  static ExactPendulum over_the_top(double rate, double top_speed);

  [[nodiscard]] Motion at(double t) const;  ///< @param t [s]

 private:
  ExactPendulum(double rate, double m, bool turns);
  double rate_;         // [rad/s]
  double m_;            // parameter of the elliptic functions [-]
  double quarter_;      // K(m)
  bool turns_ = false;  // over the top
};

/// Attitude and angular velocity of a body.
struct Attitude {
  Quat q_WB = Quat::Identity();  // unit [-]
  Vec3 w = Vec3::Zero();         // angular velocity, world [rad/s]
};

/// A free body with two equal moments of inertia about its centre.
/// @param transverse, axial moments of inertia about x, y and about z [kg m^2]
/// @param start attitude and angular velocity at t = 0  @param t [s]
Attitude free_symmetric_body(double transverse, double axial, const Attitude& start, double t);

/// A free body with three different moments of inertia, starting with rotation almost about the
/// middle axis, which tumbles (Dzhanibekov effect): Jacobi's functions, and one quadrature for the
/// angle about the angular momentum.
class ExactTumbling {
 public:
  /// @param inertia moments about x, y, z, ascending [kg m^2]
  /// @param middle, largest body components of the angular velocity at the start about y and z,
  /// both > 0; about x it is zero [rad/s]. The body's axes start along the world's.
  ExactTumbling(const Vec3& inertia, double middle, double largest);

  /// Advances in time. @param t no less than at the last call [s]
  const Attitude& at(double t);
  /// Time from one tumble to the next [s].
  [[nodiscard]] double half_period() const;

 private:
  [[nodiscard]] Vec3 rate_in_body(double t) const;  // angular velocity, body [rad/s]
  [[nodiscard]] double turn_rate(double t) const;   // of the body about L [rad/s]
  [[nodiscard]] Quat to_momentum_frame(double t,
                                       double phi) const;  // body to a frame with z along L

  Vec3 inertia_;
  double L_ = 0.0;        // angular momentum [kg m^2/s]
  Vec3 amplitude_{};      // of the body components of w [rad/s]
  double rate_ = 0.0;     // of the elliptic functions' argument [1/s]
  double m_ = 0.0;        // their parameter [-]
  double quarter_ = 0.0;  // K(m)
  Quat q_WL_;             // from the frame with z along L to the world
  double t_ = 0.0;        // of attitude_ [s]
  double phi_ = 0.0;      // angle about L at t_ [rad]
  Attitude attitude_;
};

/// A rigid body rotating about a fixed point under gravity.
struct PivotedBody {
  double mass = 1.0;            // [kg]
  Vec3 inertia = Vec3::Ones();  // principal moments about the fixed point [kg m^2]
  Vec3 centre = Vec3::Zero();   // of mass from the fixed point, body [m]
  Vec3 gravity = Vec3::Zero();  // world [m/s^2]
};
/// Its attitude after t by the classical Runge-Kutta method on quaternion and body rates.
/// @param steps of equal length; the error falls with their fourth power
Attitude pivoted_body_after(const PivotedBody& body, const Attitude& start, double t, int steps);

}  // namespace substep
