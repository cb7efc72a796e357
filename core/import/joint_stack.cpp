#include "core/import/joint_stack.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace substep {
namespace {

// Axes count as independent above this sine, or volume of three unit vectors [-].
constexpr double kIndependent = 0.02;
// Axes that pass each other at less than this, relative to the size of the body, cross [-].
constexpr double kCrossing = 1e-6;
// Four rods hold a body badly if the axes pass each other at less than this [-].
constexpr double kSkew = 1e-2;

/// The feet of the common normal of two axes that are not parallel.
struct Feet {
  Vec3 on_first;
  Vec3 on_second;
};

Feet feet_of(const PlacedJoint& first, const PlacedJoint& second) {
  const double cosine = first.axis.dot(second.axis);
  const double sine2 = 1.0 - cosine * cosine;
  const Vec3 apart = second.anchor - first.anchor;
  const double on_first = (apart.dot(first.axis) - cosine * apart.dot(second.axis)) / sine2;
  const double on_second = (cosine * apart.dot(first.axis) - apart.dot(second.axis)) / sine2;
  return {first.anchor + on_first * first.axis, second.anchor + on_second * second.axis};
}

std::string add_two_hinges(SceneBuilder& builder, const StackBodies& bodies,
                           const PlacedJoint& first, const PlacedJoint& second) {
  if (first.axis.cross(second.axis).norm() < kIndependent) return "";
  const Feet feet = feet_of(first, second);
  const Vec3 on_first = feet.on_first;
  const Vec3 on_second = feet.on_second;
  const double apart = (on_first - on_second).norm();
  // The first axis is fixed in b and the second in a: the distance between a point of one and a
  // point of the other is constant.
  const double arm = bodies.size;
  const auto add_rod = [&](double along_second, double along_first) {
    builder.add_distance(bodies.a, bodies.b, on_second + along_second * second.axis,
                         on_first + along_first * first.axis);
  };
  if (apart <= kCrossing * bodies.size) {
    builder.add_ball_joint(bodies.a, bodies.b, on_second);
    add_rod(arm, first.axis.dot(second.axis) > 0.0 ? -arm : arm);
    return "a universal joint";
  }
  if (apart < kSkew * bodies.size) return "";
  for (const double along_second : {arm, -arm}) {
    for (const double along_first : {arm, -arm}) add_rod(along_second, along_first);
  }
  return "a joint with two skew axes";
}

/// The point of three hinges with independent axes.
std::optional<Vec3> common_point(std::span<const PlacedJoint> hinges, double size) {
  const double volume = hinges[0].axis.dot(hinges[1].axis.cross(hinges[2].axis));
  if (std::abs(volume) < kIndependent) return std::nullopt;
  const Feet feet = feet_of(hinges[0], hinges[1]);
  const Vec3 point = feet.on_second;
  const double apart = (feet.on_first - point).norm();
  const double from_third = (point - hinges[2].anchor).cross(hinges[2].axis).norm();
  if (std::max(apart, from_third) > kCrossing * size) return std::nullopt;
  return point;
}

}  // namespace

std::string add_stack(SceneBuilder& builder, const StackBodies& bodies,
                      std::span<const PlacedJoint> joints) {
  using Kind = LinkJoint::Kind;
  std::vector<PlacedJoint> hinges;
  std::vector<PlacedJoint> slides;
  std::size_t balls = 0;
  for (const PlacedJoint& placed : joints) {
    if (placed.joint->kind == Kind::kHinge) hinges.push_back(placed);
    if (placed.joint->kind == Kind::kSlide) slides.push_back(placed);
    if (placed.joint->kind == Kind::kBall) ++balls;
  }
  if (slides.empty() && balls == 0 && hinges.size() == 2) {
    return add_two_hinges(builder, bodies, hinges[0], hinges[1]);
  }
  std::optional<Vec3> turning_point;  // about which a turns in any direction
  if (balls == 1 && hinges.empty()) turning_point = joints.back().anchor;
  if (balls == 0 && hinges.size() == 3) turning_point = common_point(hinges, bodies.size);
  if (!turning_point) return "";
  if (slides.empty()) {
    builder.add_ball_joint(bodies.a, bodies.b, *turning_point);
    return "a ball joint";
  }
  if (slides.size() == 3) {
    const double volume = slides[0].axis.dot(slides[1].axis.cross(slides[2].axis));
    if (std::abs(volume) >= kIndependent) return "a free body";
  }
  return "";
}

}  // namespace substep
