#include "core/constraints/coordinate_stage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/constraints/contact.hpp"
#include "core/constraints/joint_rows.hpp"
#include "core/constraints/moved_rows.hpp"
#include "core/model/joint_fields.hpp"

namespace substep {
namespace {

// Parts of the width.
constexpr double kClosed = 1e-2;             // limits that are closer than this have rows
constexpr double kMargin = 1.0;              // or, with rows for open limits, besides the motion
constexpr double kRoundingOfTravel = 1e-11;  // of the coordinate where a limit closes

using Acts = CoordinateStage::Acts;

/// Largest change of a coordinate in a motion [rad or m].
double largest_change(const Block& block, std::span<const Vec6> w, double dt) {
  double speed = 0.0;
  for (const bool of_a : {true, false}) {
    const int body = of_a ? block.a : block.b;
    if (body < 0) continue;
    const Vec6& u = w[index(body)];
    const double turning = u.tail<3>().norm();
    speed += block.position_rows == 0
                 ? turning
                 : u.head<3>().norm() + turning * (of_a ? block.r_a : block.r_b).norm();
  }
  return dt * speed;
}

/// When the gap closes: false position between a gap that is open and one that is not.
double closing_time(const auto& gap_at, double open, double open_at, double closed,
                    double closed_at, double tolerance) {
  constexpr int kMostSteps = 60;
  for (int i = 0; i < kMostSteps && closed < -tolerance; ++i) {
    double at = open_at + (closed_at - open_at) * open / (open - closed);
    if (i % 3 == 2) at = 0.5 * (open_at + closed_at);
    const double gap = gap_at(at);
    if (gap > 0.0) {
      open = gap;
      open_at = at;
    } else {
      closed = gap;
      closed_at = at;
    }
  }
  return closed_at;
}

}  // namespace

CoordinateStage::CoordinateStage(const Scene& scene) : scene_(scene) {
  for (std::size_t joint = 0; joint < scene.joints.size(); ++joint) {
    first_.push_back(placed_.size());
    const Body& a = scene.bodies[index(base(scene.joints[joint]).a)];
    for_each_coordinate([&]<class Rows>(Rows) {
      const auto* own = std::get_if<typename Rows::Owner>(&scene.joints[joint]);
      if (own == nullptr) return;
      const double armature = scene.effects.armature ? armature_of(scene.joints[joint]) : 0.0;
      const auto add = [&](Acts part, const JointGeometry& geometry) {
        placed_.push_back({id_of(joint, part), static_cast<int>(joint), part,
                           kind_of_coordinate<Rows>(), geometry, Rows::width(a), armature});
      };
      if (own->limit && scene.effects.limits) {
        if constexpr (!std::is_same_v<Rows, RopeLength>) {
          add(Acts::kLower, Rows::geometry(*own, *own->limit, false));
        }
        add(Acts::kUpper, Rows::geometry(*own, *own->limit, true));
        has_limits_ = true;
      }
      if constexpr (requires { own->motor; }) {
        if (own->motor && scene.effects.motors) add(Acts::kMotor, Rows::geometry(*own));
        if (own->drive && scene.effects.drives) {
          add(Acts::kDrive, Rows::geometry(*own, *own->drive));
        }
        if (own->friction && scene.effects.joint_friction) {
          add(Acts::kFriction, Rows::geometry(*own));
        }
        if (armature > 0.0) add(Acts::kArmature, Rows::geometry(*own));
        if (own->spring && scene.effects.springs) {
          add(Acts::kSpring, Rows::geometry(*own, *own->spring));
          has_springs_ = true;
        }
      }
    });
  }
  first_.push_back(placed_.size());
}

double coordinate_of(const Block& row) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  if (!row.seeded || row.position_rows > 0) return row.phi[0];
  return row.phi[0] + kTurn * std::round((row.elastic[0] - row.phi[0]) / kTurn);
}

// Distinct from the ids of joints, contacts and grabs: bit 62, the joint from bit 2 on, and the
// part of it in bits 61, 1 and 0.
std::uint64_t CoordinateStage::id_of(std::size_t joint, Acts part) {
  const auto number = static_cast<std::uint64_t>(part);
  return (1ULL << 62U) | ((number >> 2U) << 61U) | (static_cast<std::uint64_t>(joint) << 2U) |
         (number & 3U);
}

int CoordinateStage::joint_of(std::uint64_t id) {
  return static_cast<int>((id & ~(7ULL << 61U)) >> 2U);
}

Acts CoordinateStage::acts(std::uint64_t id) {
  return static_cast<Acts>(((id >> 61U) & 1U) << 2U | (id & 3U));
}

const Motor& CoordinateStage::motor(const Block& row) const {
  return *motor_of(scene_.joints[index(joint_of(row.id))]);
}

Drive CoordinateStage::drive(const Block& row) const {
  const Joint& joint = scene_.joints[index(joint_of(row.id))];
  if (!is_joint_spring(row)) return *drive_of(joint);
  const Spring& spring = *spring_of(joint);
  return {.target = spring.rest, .stiffness = spring.stiffness, .damping = spring.damping};
}

double CoordinateStage::friction(const Block& row) const {
  return *friction_of(scene_.joints[index(joint_of(row.id))]);
}

double CoordinateStage::width_of(const Block& row) const {
  return placed_[first_[index(joint_of(row.id))]].width;
}

template <class Visit>
void CoordinateStage::for_each(const Part& part, Visit&& visit) {
  for (const int joint : part.joints) {
    for (std::size_t i = first_[index(joint)]; i < first_[index(joint) + 1]; ++i) visit(placed_[i]);
  }
}

Block& CoordinateStage::place(const Placed& placed, const State& state, std::span<const Mat3> R_WB,
                              Block& block) const {
  const JointBase& joint = base(scene_.joints[index(placed.joint)]);
  const auto moving = [&](int body) {
    return body == kWorld || scene_.bodies[index(body)].is_static ? -1 : body;
  };
  const auto side = [&](int body) {
    return body == kWorld ? Side{} : Side{state.x[index(body)], R_WB[index(body)]};
  };
  block.kind = placed.kind;
  block.id = placed.id;
  block.body_a = joint.a;
  block.body_b = joint.b;
  block.a = moving(joint.a);
  block.b = moving(joint.b);
  block.awaits = block.soft = block.was_closed = block.seeded = false;
  block.curved = block.spring_ahead[0] = 0.0;
  block.mu = 0.0;
  block.armature = placed.armature;
  for_each_coordinate([&]<class Rows>(Rows) {
    if (placed.kind != kind_of_coordinate<Rows>()) return;
    Rows::constants(block);
    Rows::rows(placed.geometry, side(joint.a), side(joint.b), block);
  });
  const bool has_position =
      placed.is_limit() || placed.acts == Acts::kDrive || placed.acts == Acts::kSpring;
  if (!has_position) block.phi[0] = 0.0;  // it has a speed only
  if (placed.is_limit()) {
    block.lo = 0.0;
    block.hi = kUnbounded;
    block.restitution = limit_of(scene_.joints[index(placed.joint)])->restitution;
  } else {
    block.lo = block.hi = 0.0;
  }
  return block;
}

void CoordinateStage::append(const Part& part, const State& state, std::span<const Mat3> R_WB,
                             double dt, bool touching, Blocks& blocks) {
  for_each(part, [&](Placed& placed) {
    placed.row = blocks.size();
    const Block& block = place(placed, state, R_WB, blocks.append());
    if (!placed.is_limit()) return;
    const double near = touching
                            ? kClosed * placed.width
                            : kMargin * placed.width + 2.0 * largest_change(block, state.u, dt);
    if (block.phi[0] > near) blocks.keep(placed.row);
  });
}

double CoordinateStage::elastic(const State& state, std::span<const Mat3> R_WB) const {
  double energy = 0.0;
  if (!has_springs_) return energy;
  Block row;
  std::size_t next = 0;  // forces are mostly in the order of the rows
  for (const Placed& placed : placed_) {
    if (placed.acts != Acts::kSpring) continue;
    place(placed, state, R_WB, row);
    for (std::size_t i = 0; i < state.forces.size(); ++i, ++next) {
      if (next >= state.forces.size()) next = 0;
      if (state.forces[next].id != placed.id) continue;
      row.seeded = true;  // its full turns are known
      row.elastic[0] = state.forces[next].elastic[0];
      break;
    }
    const Spring& spring = *spring_of(scene_.joints[index(placed.joint)]);
    const double stretch = coordinate_of(row) - spring.rest;
    energy += 0.5 * spring.stiffness * stretch * stretch;
  }
  return energy;
}

SweptContacts::Found CoordinateStage::sweep(const SweptContacts::Sweep& sweep, std::size_t first,
                                            Blocks& blocks) {
  using Found = SweptContacts::Found;
  earliest_ = sweep.dt;
  Found all = Found::kNothing;
  for_each(sweep.part, [&](Placed& placed) {
    if (!placed.is_limit()) return;
    const Block& start = place(placed, sweep.state, sweep.R_WB, scratch_);
    if (start.phi[0] > largest_change(start, sweep.w, sweep.until)) return;
    const auto motion_of = [&](int body, double time) {
      return body < 0 ? Motion{} : motion(sweep.w[index(body)], time);
    };
    const auto gap_at = [&](double time) {
      double gained[kMaxRows];
      moved_errors(start, motion_of(start.a, time), motion_of(start.b, time), gained);
      return start.phi[0] + gained[0];
    };
    const bool has_row = placed.row >= first && placed.row < blocks.size() &&
                         blocks.all()[placed.row].id == placed.id;
    const double gap = gap_at(has_row ? sweep.dt : sweep.until);
    if (has_row) {
      Block& row = blocks.all()[placed.row];
      const double floor =
          std::min(start.phi[0], 0.0) - SweptContacts::kAllowedOverlap * placed.width;
      if (gap > floor) return;
      const auto above_floor = [&](double time) { return gap_at(time) - floor; };
      earliest_ =
          std::min(earliest_, closing_time(above_floor, start.phi[0] - floor, 0.0, gap - floor,
                                           sweep.dt, kRoundingOfTravel * placed.width));
      row.curved = gap - (row.phi[0] + sweep.dt * normal_speed(row, sweep.w));
      all = std::max(all, Found::kOverlaps);
      return;
    }
    if (gap >= 0.0 || start.phi[0] <= 0.0) return;
    const double time =
        closing_time(gap_at, start.phi[0], 0.0, gap, sweep.until, kRoundingOfTravel * placed.width);
    placed.row = blocks.size();
    Block& row = blocks.append();
    row = start;
    move_rows(start, motion_of(start.a, time), motion_of(start.b, time), row);
    row.phi[0] = -time * normal_speed(row, sweep.w);
    all = Found::kContacts;
    earliest_ = std::min(earliest_, time);
  });
  return all;
}

}  // namespace substep
