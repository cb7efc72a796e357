// Hinges 1, 3 and 5 rotate by alpha, hinges 2, 4 and 6 by beta: the mechanism keeps the three-fold
// symmetry of its start. The loop closes where
//   (1 + sin alpha)(1 + sin beta) = 1.
// Released at rest at alpha = 0, it swings to alpha = pi and back, beta between 0 and -30 degrees.

#include "scenes/generator/bricard.hpp"

#include <algorithm>
#include <cmath>

namespace substep::scenes {
namespace {

constexpr double kRodMass = 1.0;         // of a rod [kg]
constexpr double kGravityAlongY = 9.81;  // along -y [m/s^2]
constexpr double kRodWidth = 0.1;        // of a rod [m]

struct Frame {
  Mat3 R = Mat3::Identity();
  Vec3 t = Vec3::Zero();
};

/// Frames of the rods, by products of rotations about the hinges' places at the start. The last is
/// that of the ground, reached through all six hinges: the identity where the loop closes.
struct RodChain {
  std::array<Frame, Bricard::kHinges> frames;
  std::array<Vec3, Bricard::kHinges> axes;    // of the hinges, world
  std::array<Vec3, Bricard::kHinges> points;  // of the hinges, world [m]
};

double beta_of(double alpha) { return std::asin(1.0 / (1.0 + std::sin(alpha)) - 1.0); }

RodChain chain_at(double alpha) {
  const double beta = beta_of(alpha);
  RodChain chain;
  Frame frame;
  for (int i = 0; i < Bricard::kHinges; ++i) {
    const Vec3 P = Bricard::point(i);
    chain.axes[index(i)] = frame.R * Bricard::axis(i);
    chain.points[index(i)] = frame.R * P + frame.t;
    const Mat3 turn =
        Eigen::AngleAxisd(i % 2 == 0 ? alpha : beta, Bricard::axis(i)).toRotationMatrix();
    frame.t += frame.R * (P - turn * P);
    frame.R = frame.R * turn;
    chain.frames[index(i)] = frame;
  }
  return chain;
}

Vec3 centre_of(const RodChain& chain, int rod) {
  const Vec3 start = 0.5 * (Bricard::point(rod) + Bricard::point(rod + 1));
  return chain.frames[index(rod)].R * start + chain.frames[index(rod)].t;
}

/// Energy of the mechanism by its coordinate: T = mass alpha'^2/2.
struct Reduced {
  double mass = 0.0;       // [kg m^2]
  double potential = 0.0;  // [J]
};

Reduced reduced_at(double alpha) {
  const RodChain chain = chain_at(alpha);
  // d/d alpha of (1 + sin alpha)(1 + sin beta) = 1.
  const double s = 1.0 + std::sin(alpha);
  const double beta_rate = -std::cos(alpha) / (s * s * std::cos(beta_of(alpha)));
  Reduced reduced;
  for (int rod = 0; rod < Bricard::kRods; ++rod) {
    const Vec3 centre = centre_of(chain, rod);
    Vec3 v = Vec3::Zero();
    Vec3 w = Vec3::Zero();
    for (int i = 0; i <= rod; ++i) {
      const Vec3 turn = chain.axes[index(i)] * (i % 2 == 0 ? 1.0 : beta_rate);
      w += turn;
      v += turn.cross(centre - chain.points[index(i)]);
    }
    // A square rod: one moment along it, one across.
    const Vec3 along = (Bricard::point(rod + 1) - Bricard::point(rod)).normalized();
    const double lengthwise = w.dot(chain.frames[index(rod)].R * along);
    const double across = kRodMass * (1.0 + kRodWidth * kRodWidth) / 12.0;
    const double about = kRodMass * kRodWidth * kRodWidth / 6.0;
    reduced.mass += kRodMass * v.squaredNorm() + across * w.squaredNorm() +
                    (about - across) * lengthwise * lengthwise;
    reduced.potential += kRodMass * kGravityAlongY * centre.y();
  }
  return reduced;
}

/// alpha'' = -(V' + mass' alpha'^2/2)/mass, derivatives by central differences of sixth order:
/// truncation and rounding leave some 1e-12 of them.
double acceleration(double alpha, double speed) {
  constexpr double kStep = 2e-3;
  constexpr double kWeight[] = {0.75, -0.15, 1.0 / 60.0};
  double mass_slope = 0.0;
  double potential_slope = 0.0;
  for (int i = 1; i <= 3; ++i) {
    const Reduced after = reduced_at(alpha + i * kStep);
    const Reduced before = reduced_at(alpha - i * kStep);
    mass_slope += kWeight[i - 1] * (after.mass - before.mass) / kStep;
    potential_slope += kWeight[i - 1] * (after.potential - before.potential) / kStep;
  }
  return -(potential_slope + 0.5 * mass_slope * speed * speed) / reduced_at(alpha).mass;
}

}  // namespace

Vec3 Bricard::point(int hinge) {
  static const std::array<Vec3, kHinges> points{Vec3(0, 0, 0),  Vec3(1, 0, 0),  Vec3(1, -1, 0),
                                                Vec3(1, -1, 1), Vec3(0, -1, 1), Vec3(0, 0, 1)};
  return points[index(hinge)];
}

Vec3 Bricard::axis(int hinge) { return Vec3::Unit((hinge + 1) % 3); }  // y, z, x, y, z, x

void Bricard::advance(double t) {
  constexpr double kLongest = 2e-3;  // [s]
  const int steps = static_cast<int>(std::ceil((t - t_) / kLongest - 1e-9));
  const double h = steps > 0 ? (t - t_) / steps : 0.0;
  for (int i = 0; i < steps; ++i) {
    // Runge and Kutta's classical step.
    const double a1 = acceleration(angle_, speed_);
    const double v2 = speed_ + 0.5 * h * a1;
    const double a2 = acceleration(angle_ + 0.5 * h * speed_, v2);
    const double v3 = speed_ + 0.5 * h * a2;
    const double a3 = acceleration(angle_ + 0.5 * h * v2, v3);
    const double v4 = speed_ + h * a3;
    const double a4 = acceleration(angle_ + h * v3, v4);
    angle_ += h / 6.0 * (speed_ + 2.0 * v2 + 2.0 * v3 + v4);
    speed_ += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
  }
  t_ = std::max(t, t_);
}

double Bricard::energy() const {
  const Reduced reduced = reduced_at(angle_);
  return 0.5 * reduced.mass * speed_ * speed_ + reduced.potential - reduced_at(0.0).potential;
}

Vec3 Bricard::centre(int rod) const { return centre_of(chain_at(angle_), rod); }

Quat Bricard::orientation(int rod) const { return Quat(chain_at(angle_).frames[index(rod)].R); }

double Bricard::closure_error(double angle) {
  const Frame ground = chain_at(angle).frames.back();
  return (ground.R - Mat3::Identity()).cwiseAbs().maxCoeff() + ground.t.norm();
}

}  // namespace substep::scenes
