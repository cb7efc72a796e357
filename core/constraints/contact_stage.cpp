#include "core/constraints/contact_stage.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "core/constraints/moved_rows.hpp"

namespace substep {

namespace {

/// Cayley vector of a rotation.
Vec3 half_turn(const Quat& q_then, const Quat& q) {
  const Quat turn = q * q_then.conjugate();
  return turn.vec() / turn.w();
}

// Minimum tangential fraction of a direction. Standing bodies rock, and with a direction close to
// the normal rounding would rotate the friction axes.
constexpr double kAcross = 0.05;

/// The first direction not along the contact normal: a fixed preference, not a comparison subject
/// to rounding.
Vec3 first_across(const Vec3& n, std::initializer_list<Vec3> directions) {
  for (const Vec3& d : directions) {
    const double length = d.norm();
    if (length > 0.0 && n.cross(d).norm() > kAcross * length) return d;
  }
  return n.unitOrthogonal();
}

}  // namespace

void ContactStage::append(std::span<const ContactPoint> points, const Scene& scene,
                          const State& state, Blocks& blocks) const {
  for (const ContactPoint& point : points) {
    const auto a = index(point.a);
    const auto b = index(point.b);
    Block& block = blocks.append();
    block.a = scene.bodies[a].is_static ? -1 : point.a;
    block.b = scene.bodies[b].is_static ? -1 : point.b;
    contact_row(point, scene.contact, state.x[a], state.x[b], block);
  }
}

bool ContactStage::detect_and_append(const Scene& scene, const Part& part, const State& state,
                                     std::span<const Mat3> R_WB, Blocks& blocks) {
  const std::span<const ContactPoint> points = detector_.detect(scene, part, state, R_WB);
  if (detector_.too_many()) return false;
  append(points, scene, state, blocks);
  return true;
}

bool ContactStage::append_touching(const Scene& scene, const Part& part, const State& state,
                                   std::span<const Mat3> R_WB, double dt, Blocks& blocks) {
  const std::span<const ContactPoint> points =
      detector_.detect_touching(scene, part, state, R_WB, dt);
  if (detector_.too_many()) return false;
  append(points, scene, state, blocks);
  return true;
}

bool ContactStage::predict(const Scene& scene, const Part& part, const State& state,
                           std::span<const Mat3> R_WB, double ahead) {
  const std::span<const ContactPoint> points = detector_.predict(scene, part, state, R_WB, ahead);
  predicted_.clear();
  predicted_.reserve(8 * scene.bodies.size() + 32);  // once: new contacts must not allocate
  if (detector_.too_many()) return false;
  append(points, scene, state, predicted_);
  x_.assign(state.x.begin(), state.x.end());
  q_.assign(state.q.begin(), state.q.end());
  way_.assign(detector_.ways().begin(), detector_.ways().end());
  return true;
}

bool ContactStage::prediction_valid(const Scene& scene, const Part& part, const State& state,
                                    double dt) const {
  const double room = 0.5 * scene.contact.margin;  // per body of a pair
  return std::all_of(part.bodies.begin(), part.bodies.end(), [&](int body) {
    const auto i = index(body);
    if (scene.bodies[i].is_static) return true;
    const double turned =
        2.0 * radius_around(scene.bodies[i].shape) * half_turn(q_[i], state.q[i]).norm();
    return (state.x[i] - x_[i]).norm() + turned + way_in(dt, scene, scene.bodies[i], state.u[i]) <=
           way_[i] + room;
  });
}

bool ContactStage::append_predicted(const Scene& scene, const Part& part, const State& state,
                                    std::span<const Mat3> R_WB, double dt, Blocks& blocks) {
  const std::span<const ContactPoint> of_boxes =
      detector_.detect_listed(scene, part, state, R_WB, dt);
  if (detector_.too_many()) return false;
  const auto motion = [&](int body) {
    if (body < 0) return Motion{};
    const auto i = index(body);
    return Motion{state.x[i] - x_[i], turn_matrix(half_turn(q_[i], state.q[i]))};
  };
  for (const Block& row : predicted_.all()) {
    if (!part.holds(row.body_a) || !part.holds(row.body_b)) continue;
    Block& block = blocks.append();
    block = row;
    move_rows(row, motion(row.a), motion(row.b), block);
    block.phi[0] += row.phi[0];
    // b is convex and lies behind the tangent plane, whose distance is a lower bound of the gap.
    // The moved gap, of second order, is too large far from the start.
    const Vec3 travel = motion(row.b).R.transpose() * block.rho - row.rho;
    if (row.phi[0] + row.n.dot(travel) > detector_.margin(scene, row.body_a, row.body_b)) {
      blocks.keep(blocks.size() - 1);
      continue;
    }
    if (row.H.isZero(0.0)) continue;
    const Mat3 R = motion(row.b).R;
    block.H = R * row.H * R.transpose();
  }
  append(of_boxes, scene, state, blocks);
  return true;
}

Overlaps overlaps(Detector& detector, const Scene& scene, const Part& part, const State& state,
                  std::span<const Mat3> R_WB) {
  Overlaps found;
  for (const ContactPoint& point : detector.detect(scene, part, state, R_WB)) {
    if (!(point.gap < 0.0)) continue;
    found.squares += point.gap * point.gap;
    found.deepest = std::max(found.deepest, -point.gap);
    const double inside = -point.gap / (2.0 * detector.half_width(point.a, point.b));
    if (inside <= found.inside) continue;
    found.inside = inside;
    found.a = point.a;
    found.b = point.b;
  }
  return found;
}

FrictionStage::FrictionStage(const Scene& scene) {
  for (const Body& body : scene.bodies) sqrt_mu_.push_back(std::sqrt(body.friction));
}

// The friction box has axes, which must not depend on the order of bodies in a file, nor on the
// rotation of a shape about the normal. On a static body they point down the slope, or on level
// ground along one of its axes; between moving bodies along the line of centres, or if that is the
// normal, along the sum of both bodies' x or z axes. All rotate with the scene.
void FrictionStage::append(const Scene& scene, std::span<const Mat3> R_WB,
                           std::span<Block> blocks) const {
  const Vec3 slope = scene.effects.gravity ? scene.gravity : Vec3(Vec3::Zero());
  for (Block& block : blocks) {
    if (!block.is_contact()) continue;
    const auto a = index(block.body_a);
    const auto b = index(block.body_b);
    const double mu = sqrt_mu_[a] * sqrt_mu_[b];
    if (!(mu > 0.0)) continue;
    const Mat3 still = block.a < 0 ? R_WB[a] : block.b < 0 ? R_WB[b] : Mat3(Mat3::Zero());
    const Mat3 both = R_WB[a] + R_WB[b];
    const bool stands = block.a < 0 || block.b < 0;
    const Vec3 centres = block.r_b - block.r_a;  // from b's to a's
    friction_rows(scene.contact, mu,
                  first_across(block.n, {stands ? slope : Vec3(Vec3::Zero()), still.col(0),
                                         still.col(2), centres, both.col(0), both.col(2)}),
                  block);
  }
}

}  // namespace substep
