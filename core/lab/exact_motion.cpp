#include "core/lab/exact_motion.hpp"

#include <algorithm>
#include <cmath>

#include "core/lab/elliptic.hpp"

namespace substep {

// ---- pendulum: with k = sin(theta_max/2),  sin(theta/2) = k sn(rate t + K),
//      theta' = 2 k rate cn(rate t + K).
// Over the top, with 1/k^2 = 1 + (top speed/(2 rate))^2:  theta = 2 am(rate t/k + K),
//      theta' = 2 (rate/k) dn(rate t/k + K).

ExactPendulum::ExactPendulum(double rate, double m, bool turns)
    : rate_(rate), m_(m), quarter_(complete_elliptic(m)), turns_(turns) {}

ExactPendulum ExactPendulum::released(double rate, double angle) {
  const double k = std::sin(0.5 * angle);
  return {rate, k * k, false};
}

ExactPendulum ExactPendulum::over_the_top(double rate, double top_speed) {
  const double ratio = 0.5 * top_speed / rate;
  return {rate, 1.0 / (1.0 + ratio * ratio), true};
}

ExactPendulum::Motion ExactPendulum::at(double t) const {
  const double k = std::sqrt(m_);
  Motion motion;
  if (turns_) {
    const Jacobi j = jacobi(rate_ * t / k + quarter_, m_);
    motion.angle = 2.0 * j.am;
    motion.speed = 2.0 * rate_ / k * j.dn;
  } else {
    const Jacobi j = jacobi(rate_ * t + quarter_, m_);
    motion.angle = 2.0 * std::asin(k * j.sn);
    motion.speed = 2.0 * k * rate_ * j.cn;
  }
  motion.acceleration = -rate_ * rate_ * std::sin(motion.angle);
  return motion;
}

// ---- free symmetric body: with angular momentum L and the body's axis e,
//      w = L/I + (1 - I_e/I) (w . e) e,
// both parts rotate at a constant rate: the first about L in the world, the second about e in the
// body.

Attitude free_symmetric_body(double transverse, double axial, const Attitude& start, double t) {
  const auto turned = [](const Vec3& by) -> Quat {
    const double angle = by.norm();
    return angle > 0.0 ? Quat(Eigen::AngleAxisd(angle, by / angle)) : Quat(Quat::Identity());
  };
  const Vec3 axis = start.q_WB * Vec3::UnitZ();
  const double spin = start.w.dot(axis);
  const Vec3 L_over_I = start.w + (axial / transverse - 1.0) * spin * axis;
  const double own = (1.0 - axial / transverse) * spin;
  Attitude result;
  result.q_WB = turned(L_over_I * t) * start.q_WB * turned(Vec3(0.0, 0.0, own * t));
  result.w = L_over_I + own * (result.q_WB * Vec3::UnitZ());
  return result;
}

// ---- tumbling (Landau and Lifshitz, Mechanics, section 37): for I1 < I2 < I3 and L^2 > 2 E I2
//      w1 = A1 cn, w2 = A2 sn, w3 = A3 dn,  tau = rate t
//      rate^2 = (I3 - I2)(L^2 - 2 E I1)/(I1 I2 I3)
//      k^2 = (I2 - I1)(2 E I3 - L^2) / ((I3 - I2)(L^2 - 2 E I1)).
// The start, w = (0, middle, largest), is at tau = K. With z along L, Euler angles z-x-z:
//      cos theta = I3 w3/L,  tan psi = I1 w1/(I2 w2),
//      phi' = L (I1 w1^2 + I2 w2^2)/(I1^2 w1^2 + I2^2 w2^2).

ExactTumbling::ExactTumbling(const Vec3& inertia, double middle, double largest)
    : inertia_(inertia) {
  const double I1 = inertia.x();
  const double I2 = inertia.y();
  const double I3 = inertia.z();
  const double from_largest = I2 * middle * middle * (I3 - I2);  // 2 E I3 - L^2
  const double from_least =
      I2 * middle * middle * (I2 - I1) + I3 * largest * largest * (I3 - I1);  // L^2 - 2 E I1
  L_ = std::sqrt(I2 * I2 * middle * middle + I3 * I3 * largest * largest);
  amplitude_ = {std::sqrt(from_largest / (I1 * (I3 - I1))), middle,
                std::sqrt(from_least / (I3 * (I3 - I1)))};
  rate_ = std::sqrt((I3 - I2) * from_least / (I1 * I2 * I3));
  m_ = (I2 - I1) * from_largest / ((I3 - I2) * from_least);
  quarter_ = complete_elliptic(m_);
  q_WL_ = to_momentum_frame(0.0, 0.0).conjugate();
  attitude_ = {Quat::Identity(), rate_in_body(0.0)};
}

double ExactTumbling::half_period() const { return 2.0 * quarter_ / rate_; }

Vec3 ExactTumbling::rate_in_body(double t) const {
  const Jacobi j = jacobi(quarter_ + rate_ * t, m_);
  return amplitude_.cwiseProduct(Vec3(j.cn, j.sn, j.dn));
}

double ExactTumbling::turn_rate(double t) const {
  const Vec3 w = rate_in_body(t);
  const Vec3 L = inertia_.cwiseProduct(w);
  return L_ * (L.x() * w.x() + L.y() * w.y()) / (L.x() * L.x() + L.y() * L.y());
}

Quat ExactTumbling::to_momentum_frame(double t, double phi) const {
  const Vec3 L = inertia_.cwiseProduct(rate_in_body(t));
  const double theta = std::atan2(std::hypot(L.x(), L.y()), L.z());
  const double psi = std::atan2(L.x(), L.y());
  return Quat(Eigen::AngleAxisd(phi, Vec3::UnitZ())) *
         Quat(Eigen::AngleAxisd(theta, Vec3::UnitX())) *
         Quat(Eigen::AngleAxisd(psi, Vec3::UnitZ()));
}

const Attitude& ExactTumbling::at(double t) {
  // Five-point Gauss quadrature; the error is negligible with panels of a thirtieth of a tumble.
  constexpr double kPoint[] = {0.0, 0.53846931010568309, 0.90617984593866399};
  constexpr double kWeight[] = {0.56888888888888889, 0.47862867049936647, 0.23692688505618909};
  const double longest = half_period() / 30.0;
  while (t_ < t) {
    const double half = 0.5 * std::min(longest, t - t_);
    const double middle = t_ + half;
    double sum = kWeight[0] * turn_rate(middle);
    for (int i = 1; i < 3; ++i) {
      sum += kWeight[i] *
             (turn_rate(middle - half * kPoint[i]) + turn_rate(middle + half * kPoint[i]));
    }
    phi_ += half * sum;
    t_ = t - t_ <= longest ? t : t_ + 2.0 * half;
  }
  attitude_.q_WB = q_WL_ * to_momentum_frame(t, phi_);
  attitude_.w = attitude_.q_WB * rate_in_body(t);
  return attitude_;
}

// ---- body on a fixed point:  q' = q (0, w)/2,  I w' = m c x R^T g - w x I w  in the body.

Attitude pivoted_body_after(const PivotedBody& body, const Attitude& start, double t, int steps) {
  struct Rates {
    Eigen::Vector4d q;
    Vec3 w;
  };
  const auto rates = [&](const Eigen::Vector4d& coefficients, const Vec3& w) -> Rates {
    const Quat q(coefficients);
    const Quat turn = q * Quat(0.0, 0.5 * w.x(), 0.5 * w.y(), 0.5 * w.z());
    const Vec3 torque = body.mass * body.centre.cross(q.conjugate() * body.gravity);
    const Vec3 change = torque - w.cross(body.inertia.cwiseProduct(w));
    return {turn.coeffs(), change.cwiseQuotient(body.inertia)};
  };
  Eigen::Vector4d q = start.q_WB.coeffs();
  Vec3 w = start.q_WB.conjugate() * start.w;
  const double h = t / steps;
  for (int i = 0; i < steps; ++i) {
    const Rates a = rates(q, w);
    const Rates b = rates(q + 0.5 * h * a.q, w + 0.5 * h * a.w);
    const Rates c = rates(q + 0.5 * h * b.q, w + 0.5 * h * b.w);
    const Rates d = rates(q + h * c.q, w + h * c.w);
    q += h / 6.0 * (a.q + 2.0 * b.q + 2.0 * c.q + d.q);
    w += h / 6.0 * (a.w + 2.0 * b.w + 2.0 * c.w + d.w);
    q.normalize();  // its length drifts at fifth order, and R would stretch with it
  }
  const Quat q_WB(q);
  return {q_WB, q_WB * w};
}

}  // namespace substep
