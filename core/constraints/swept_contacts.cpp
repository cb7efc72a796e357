#include "core/constraints/swept_contacts.hpp"

#include <algorithm>

#include "core/collision/time_of_impact.hpp"
#include "core/constraints/contact.hpp"

namespace substep {
namespace {

// Parts of the half width of the narrower shape.
constexpr double kTouching = 1e-6;     // shapes that are closer touch
constexpr double kSamePlace = 0.1;     // of two rows
constexpr double kAlike = 0.9;         // cosine of the angle of their normals
constexpr double kDeep = 0.02;         // overlaps on the way are looked for from here on
constexpr double kExtrapolated = 4.0;  // a curvature is extrapolated by no more than this
constexpr double kManifold = 0.1;      // further points of a pair where it meets

std::uint64_t id_of_pair(int i, int j) { return contact_id(std::min(i, j), std::max(i, j), 0); }

Travel travel_of(const SweptContacts::Sweep& sweep, int body) {
  const auto i = index(body);
  return {body, sweep.scene.bodies[i].shape, sweep.state.x[i], sweep.R_WB[i], sweep.w[i]};
}

}  // namespace

void SweptContacts::reserve(std::size_t rows) {
  rows_.reserve(rows);
  pairs_.reserve(rows);
  points_.reserve(32);
}

void SweptContacts::list_rows(std::span<const Block> rows) {
  rows_.clear();
  pairs_.clear();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].is_contact()) continue;
    rows_.emplace_back(rows[i].id, i);
    pairs_.push_back({id_of_pair(rows[i].body_a, rows[i].body_b), std::min(rows[i].phi[0], 0.0)});
  }
  std::sort(rows_.begin(), rows_.end());
  std::sort(pairs_.begin(), pairs_.end());
  std::size_t kept = 0;
  for (const Pair& pair : pairs_) {
    if (kept > 0 && pairs_[kept - 1].bodies == pair.bodies)
      pairs_[kept - 1].floor = std::min(pairs_[kept - 1].floor, pair.floor);
    else
      pairs_[kept++] = pair;
  }
  pairs_.resize(kept);
}

const SweptContacts::Pair* SweptContacts::pair_with_rows(int i, int j) const {
  const Pair key{id_of_pair(i, j), 0.0};
  const auto found = std::lower_bound(pairs_.begin(), pairs_.end(), key);
  return found != pairs_.end() && found->bodies == key.bodies ? &*found : nullptr;
}

void SweptContacts::append_row(const Sweep& sweep, const ContactPoint& point, const Vec3& x_a,
                               const Vec3& x_b, double time, Blocks& blocks) const {
  Block& block = blocks.append();
  block.a = sweep.scene.bodies[index(point.a)].is_static ? -1 : point.a;
  block.b = sweep.scene.bodies[index(point.b)].is_static ? -1 : point.b;
  contact_row(point, sweep.scene.contact, x_a, x_b, block);
  block.phi[0] -= time * normal_speed(block, sweep.w);
}

// The row of a point, or one of other features of the pair that acts in the same place.
Block* SweptContacts::row_of(const Sweep& sweep, const ContactPoint& point, const Mat3& R_a,
                             double half_width, std::span<Block> blocks) const {
  const auto same = std::lower_bound(rows_.begin(), rows_.end(), std::pair(point.id, 0UL));
  if (same != rows_.end() && same->first == point.id) return &blocks[same->second];
  const Mat3 turn = R_a * sweep.R_WB[index(point.a)].transpose();  // since the start
  const auto acts_there = [&](const Block& block) {
    if (!block.is_contact()) return false;
    const bool in_order = block.body_a == point.a;
    if ((in_order ? block.body_b : block.body_a) != point.b) return false;
    if (!in_order && block.body_b != point.a) return false;
    const Vec3 n = in_order ? block.n : Vec3(-block.n);
    const Vec3 apart = turn * (in_order ? block.r_a : block.r_b) - point.point_a;
    return n.dot(point.n) > kAlike && apart.norm() < kSamePlace * half_width;
  };
  const auto other = std::find_if(blocks.begin(), blocks.end(), acts_there);
  return other == blocks.end() ? nullptr : &*other;
}

// A curved motion can overlap shapes at its end, or on its way if it rotates far.
SweptContacts::Found SweptContacts::correct(const Sweep& sweep, const BroadPhase::Pair& pair,
                                            double floor, double half_width, std::size_t first,
                                            Blocks& blocks) {
  const Travel a = travel_of(sweep, pair.i);
  const Travel b = travel_of(sweep, pair.j);
  const double deep = kDeep * half_width;
  const double time =
      time_of_impact(a, b, sweep.dt, floor - deep, 0.5 * deep, points_, visits_).value_or(sweep.dt);
  const Waypoint on_a = after(a, time);
  const Waypoint on_b = after(b, time);
  points_.clear();
  touch_shapes(on_a.placed(), a.shape, on_b.placed(), b.shape, 0.0, points_);
  Found found = Found::kNothing;
  for (const ContactPoint& point : points_) {
    if (point.gap > floor - kAllowedOverlap * half_width) continue;
    const bool in_order = point.a == pair.i;
    Block* row = row_of(sweep, point, (in_order ? on_a : on_b).R, half_width, blocks.from(first));
    if (row == nullptr) {
      append_row(sweep, point, (in_order ? on_a : on_b).x, (in_order ? on_b : on_a).x, time,
                 blocks);
      found = Found::kContacts;
    } else {  // quadratic in time, as far as it may be extrapolated
      const double curved = point.gap - (row->phi[0] + time * normal_speed(*row, sweep.w));
      const double longer = sweep.dt / time;
      row->curved = curved * std::min(longer * longer, kExtrapolated);
      found = std::max(found, Found::kOverlaps);
    }
  }
  if (found != Found::kNothing) earliest_ = std::min(earliest_, time);
  return found;
}

SweptContacts::Found SweptContacts::meet(const Sweep& sweep, const BroadPhase::Pair& pair,
                                         double half_width, Blocks& blocks) {
  const Travel a = travel_of(sweep, pair.i);
  const Travel b = travel_of(sweep, pair.j);
  const std::optional<double> time =
      time_of_impact(a, b, sweep.until, 0.0, kTouching * half_width, points_, visits_);
  if (!time) return Found::kNothing;
  earliest_ = std::min(earliest_, *time);
  // Two corners can meet without a point within either face; a little later there is one.
  for (const double share : {0.0, 1.0 / 256.0, 1.0 / 64.0, 1.0 / 16.0, 1.0 / 4.0, 1.0}) {
    const double at = *time + share * (sweep.until - *time);
    const Waypoint on_a = after(a, at);
    const Waypoint on_b = after(b, at);
    points_.clear();
    touch_shapes(on_a.placed(), a.shape, on_b.placed(), b.shape, kManifold * half_width, points_);
    if (std::none_of(points_.begin(), points_.end(), [&](const ContactPoint& point) {
          return point.gap <= kTouching * half_width;
        })) {
      continue;
    }
    for (const ContactPoint& point : points_) {
      const bool in_order = point.a == pair.i;
      append_row(sweep, point, (in_order ? on_a : on_b).x, (in_order ? on_b : on_a).x, at, blocks);
    }
    return Found::kContacts;
  }
  return Found::kNothing;
}

SweptContacts::Found SweptContacts::append(const Sweep& sweep, Detector& detector,
                                           std::size_t first, Blocks& blocks) {
  list_rows(blocks.from(first));
  visits_ += std::ssize(rows_);
  earliest_ = sweep.dt;
  Found all = Found::kNothing;
  for (const BroadPhase::Pair& pair :
       detector.may_meet(sweep.scene, sweep.part, sweep.state, sweep.R_WB, sweep.w, sweep.until)) {
    const double half_width = detector.half_width(pair.i, pair.j);
    const Pair* known = pair_with_rows(pair.i, pair.j);
    const Found found = known != nullptr
                            ? correct(sweep, pair, known->floor, half_width, first, blocks)
                            : meet(sweep, pair, half_width, blocks);
    all = std::max(all, found);
  }
  return all;
}

}  // namespace substep
