#include "core/stepping/restitution_stage.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/constraints/contact.hpp"
#include "core/constraints/coordinate_stage.hpp"
#include "core/stepping/armature.hpp"
#include "core/stepping/drift.hpp"

namespace substep {
namespace {

// The velocity u of a joint is half a sub-step old: an impact changes it along the joint.
void keep_speeds(Block& joint, std::span<const Vec6> u) {
  double speed[kMaxRows];
  row_speeds(joint, u, speed);
  for (int row = 0; row < joint.rows; ++row) joint.bias[row] = -speed[row];
}

}  // namespace

double RestitutionStage::restitution_of(const Block& contact) const {
  if (!contact.is_contact()) return contact.restitution;
  return std::max(scene_.bodies[index(contact.body_a)].restitution,
                  scene_.bodies[index(contact.body_b)].restitution);
}

// The velocity u is that of the middle of the last sub-step, which leapfrog's forces have acted on
// for the time t when this one is half over. A contact that closes at the time c of this sub-step
// is approached by J (u + g), g the gain, and J a = J g/t until the middle of the sub-step. The gap
// is phi + time J (u + g) if u has changed since the start, phi that of a motion at u throughout.
RestitutionStage::Impact RestitutionStage::impact(const Substep& sub, std::span<const Vec6> u,
                                                  const Block& block) const {
  if (!block.is_unilateral() || block.awaits || restitution_of(block) == 0.0) return {};
  if (block.is_coordinate() && block.was_closed) return {};  // it rests
  // What returns within the sub-step rests.
  const double least = block.is_contact() ? scene_.contact.restitution_speed
                                          : speed_by_forces(sub, block) / restitution_of(block);
  const double before = normal_speed(block, u);
  if (sub.gain.empty()) {
    const bool closes = block.phi[0] + before * sub.dt < 0.0;
    return closes && before <= -least ? Impact{.speed = -before} : Impact{};
  }
  const double gained = normal_speed(block, sub.gain);
  const double middle = before + gained;
  const double gap = block.phi[0] + sub.dt * normal_speed(block, sub.shift);
  if (!(middle < 0.0) || !(gap + middle * sub.dt < 0.0)) return {};
  // An impact that another one causes is not before it.
  const double time = std::max(gap / -middle, since_ * sub.dt);
  const double duration = impulse_time_of(sub, block);
  const double acceleration = gained / duration;
  const double force_time = time + duration - 0.5 * sub.dt;
  const double kick = acceleration * force_time;
  const double speed = -(before + kick);
  const bool returns = restitution_of(block) * speed <= -acceleration * sub.dt;
  return speed >= least && !returns ? Impact{speed, force_time, kick, time, acceleration}
                                    : Impact{};
}

void RestitutionStage::apply(const Substep& sub, std::span<const Vec6> u_before,
                             std::span<Block> blocks) const {
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    Block& block = blocks[i];
    if (sub.gain.empty()) {
      const Impact hit = impact(sub, u_before, block);
      if (hit.speed > 0.0) {
        block.bias[0] = std::min(block.bias[0], -restitution_of(block) * hit.speed + hit.kick);
      }
    }
    if (struck_.empty() || struck_[i] == 0) continue;
    const double gained = sub.gain.empty() ? 0.0 : normal_speed(block, sub.gain);
    const double separation = normal_speed(block, u_before) + gained;
    // It separates anyway: redundant rows must not share forces of rounding.
    const double least = sub.gain.empty() ? separation : (1.0 - 1e-6) * separation;
    block.bias[0] = std::min(block.bias[0], -least);
  }
}

bool RestitutionStage::spreads(const Substep& sub, std::span<const Vec6> u,
                               std::span<const Block> blocks) {
  struck_.clear();
  since_ = 0.0;
  std::fill(impact_.begin(), impact_.end(), 0.0);
  bool any = false;
  for (const Block& block : blocks) {
    const double speed = impact(sub, u, block).speed;
    if (speed == 0.0) continue;
    any = true;
    for (const int body : {block.a, block.b}) {
      if (body < 0) continue;
      double& most = impact_[index(body)];
      most = std::max(most, speed);
    }
  }
  if (!any) return false;
  const bool spread =
      !sub.gain.empty() || std::any_of(blocks.begin(), blocks.end(), [&](const Block& block) {
        if (!block.is_unilateral() || restitution_of(block) == 0.0) return false;
        if (impact(sub, u, block).speed > 0.0) return false;
        double change = 0.0;  // each body's speed changes by at most twice its fastest impact
        for (const int body : {block.a, block.b}) {
          if (body >= 0) change += 2.0 * impact_[index(body)];
        }
        return change > 0.0 && block.phi[0] + (normal_speed(block, u) - change) * sub.dt < 0.0;
      });
  if (spread) struck_.assign(blocks.size(), 0);
  return spread;
}

bool RestitutionStage::set_impacts(const Substep& sub, std::span<const Vec6> u, double share,
                                   std::span<Block> blocks) {
  hits_.assign(blocks.size(), {});
  double first = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    hits_[i] = impact(sub, u, blocks[i]);
    if (hits_[i].speed > 0.0) first = std::min(first, hits_[i].time);
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    Block& block = blocks[i];
    Impact& hit = hits_[i];
    std::fill(std::begin(block.bias), std::end(block.bias), 0.0);
    std::fill(std::begin(block.impulse), std::end(block.impulse), 0.0);
    if (!block.is_unilateral()) {
      if (is_armature(block)) {
        set_armature_at_rate(normal_speed(block, u), scene_.regularisation, block);
      } else if (block.is_motor()) {
        block.lo = block.hi = 0.0;
      } else if (!sub.gain.empty()) {
        keep_speeds(block, u);
      }
      continue;
    }
    std::fill(std::begin(block.active_set), std::end(block.active_set), kUnknownSet);
    if (!(hit.speed > 0.0) || hit.time > first + kSimultaneous * sub.dt) {
      block.bias[0] = kStaysOpen;
      hit = {};
      continue;
    }
    struck_[i] = 1;
    const double e = share * restitution_of(block);
    block.bias[0] = -e * hit.speed + hit.kick;
    if (hit.time > first) continue;
    since_ = first / sub.dt;
    const double change = (1.0 + e) * hit.speed;
    late_ = since_ - 0.5 * since_ * (1.0 - since_) * sub.dt * hit.acceleration / change;
  }
  return std::isfinite(first);
}

}  // namespace substep
