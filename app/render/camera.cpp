#include "app/render/camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/model/number_text.hpp"

namespace substep {
namespace {

constexpr double kNear = 0.02;     // relative to the distance
constexpr double kFar = 60.0;      // relative to the distance
constexpr double kLowest = -0.05;  // pitch by hand [rad]
constexpr double kHighest = 1.5;
constexpr double kUpright = 1.5708;

}  // namespace

Vec3 OrbitCamera::backward(const Pose& pose) {
  return {std::cos(pose.pitch) * std::sin(pose.yaw), std::sin(pose.pitch),
          std::cos(pose.pitch) * std::cos(pose.yaw)};
}

double OrbitCamera::fit(const ViewRect& view) const {
  const double width = std::max(1.0, static_cast<double>(view.width));
  return std::max(1.0, aspect_ * static_cast<double>(view.height) / width);
}

double OrbitCamera::magnification(const ViewRect& view) const {
  return static_cast<double>(view.height) / fit(view);
}

Vec3 OrbitCamera::right_of(const Camera& camera) {
  const Vec3 right = Vec3::UnitY().cross(camera.eye - camera.target);
  return right.norm() > 1e-9 ? right.normalized() : Vec3::UnitX();
}

void OrbitCamera::place(const Camera& camera, double half_width) {
  const Vec3 back = camera.eye - camera.target;
  const double distance = std::max(1e-3, back.norm());
  goal_.target = camera.target;
  goal_.distance = distance;
  goal_.pitch = std::asin(std::clamp(back.y() / distance, -1.0, 1.0));
  goal_.yaw = std::atan2(back.x(), back.z());
  aspect_ = half_width / (distance * std::tan(0.5 * kFieldOfView));
  now_ = goal_;
  carried_.setZero();
  by_hand_ = false;
  ++placed_;
}

void OrbitCamera::frame(const Bounds& bounds) {
  turn_to(bounds);
  aspect_ = 1.0;
}

void OrbitCamera::turn_to(const Bounds& bounds) {
  goal_.target = bounds.centre - carried_;
  goal_.distance = 1.1 * bounds.radius / std::sin(0.5 * kFieldOfView);
}

std::string OrbitCamera::text() const {
  std::string list;
  for (const double value : {goal_.yaw, goal_.pitch, goal_.distance, goal_.target.x(),
                             goal_.target.y(), goal_.target.z()}) {
    if (!list.empty()) list += ',';
    list += number_text(std::round(1e4 * value) / 1e4);
  }
  return list;
}

bool OrbitCamera::set(std::string_view text) {
  constexpr double kFarthest = 1e5;  // [m]
  std::array<double, 6> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t end = text.find(',');
    if ((end == std::string_view::npos) != (i + 1 == values.size())) return false;
    const auto value = parse_number(text.substr(0, end));
    if (!value || !(std::abs(*value) <= kFarthest)) return false;
    values.at(i) = *value;
    text.remove_prefix(
        std::min(text.size(), end == std::string_view::npos ? text.size() : end + 1));
  }
  if (!(std::abs(values[1]) <= kUpright) || !(values[2] > 0.0)) return false;
  goal_ = {{values[3], values[4], values[5]}, values[0], values[1], std::max(values[2], 1e-3)};
  now_ = goal_;
  by_hand_ = true;
  return true;
}

bool OrbitCamera::at_rest() const {
  constexpr double kClose = 2e-3;  // of the distance, and of a radian: about a pixel
  return (goal_.target - now_.target).norm() < kClose * goal_.distance &&
         std::abs(goal_.distance / now_.distance - 1.0) < kClose &&
         std::abs(goal_.yaw - now_.yaw) < kClose && std::abs(goal_.pitch - now_.pitch) < kClose;
}

void OrbitCamera::orbit(double yaw, double pitch) {
  by_hand_ = by_hand_ || yaw != 0.0 || pitch != 0.0;
  goal_.yaw += yaw;
  goal_.pitch = std::clamp(goal_.pitch + pitch, kLowest, kHighest);
}

void OrbitCamera::pan(double right, double up, const ViewRect& view) {
  by_hand_ = by_hand_ || right != 0.0 || up != 0.0;
  const Vec3 back = backward(goal_);
  const Vec3 x = Vec3::UnitY().cross(back).normalized();
  const Vec3 y = back.cross(x);
  const double per_pixel = 2.0 * goal_.distance * fit(view) * std::tan(0.5 * kFieldOfView) /
                           std::max(1.0, static_cast<double>(view.height));
  goal_.target += per_pixel * (-right * x + up * y);
}

void OrbitCamera::zoom(double factor) {
  by_hand_ = true;
  goal_.distance = std::clamp(goal_.distance / factor, 0.2, 2000.0);
}

void OrbitCamera::update(double dt, bool jump) {
  const double t = jump ? 1.0 : 1.0 - std::exp(-std::clamp(dt, 0.0, 0.1) / 0.06);
  now_.target += t * (goal_.target - now_.target);
  now_.yaw += t * (goal_.yaw - now_.yaw);
  now_.pitch += t * (goal_.pitch - now_.pitch);
  now_.distance *= std::pow(goal_.distance / now_.distance, t);
}

Vec3 OrbitCamera::eye(const ViewRect& view) const {
  return target() + now_.distance * fit(view) * backward(now_);
}

Eigen::Matrix4d OrbitCamera::view_projection(const ViewRect& view, double window_width,
                                             double window_height) const {
  const double distance = now_.distance * fit(view);
  const Vec3 back = backward(now_);
  const Vec3 x = Vec3::UnitY().cross(back).normalized();
  const Vec3 y = back.cross(x);
  const Vec3 from = eye(view);
  Eigen::Matrix4d to_camera = Eigen::Matrix4d::Identity();
  to_camera.block<1, 3>(0, 0) = x.transpose();
  to_camera.block<1, 3>(1, 0) = y.transpose();
  to_camera.block<1, 3>(2, 0) = back.transpose();
  to_camera(0, 3) = -x.dot(from);
  to_camera(1, 3) = -y.dot(from);
  to_camera(2, 3) = -back.dot(from);

  // The field of view is that of the view rectangle; that of the window is larger by the ratio of
  // heights.
  const double height = std::max(1.0, static_cast<double>(view.height));
  const double focal = height / window_height / std::tan(0.5 * kFieldOfView);
  const double near = kNear * distance;
  const double far = kFar * distance;
  const double centre_x = static_cast<double>(view.x + 0.5F * view.width);
  const double centre_y = static_cast<double>(view.y + 0.5F * view.height);
  Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
  projection(0, 0) = focal * window_height / window_width;
  projection(1, 1) = focal;
  projection(0, 2) = -(2.0 * centre_x / window_width - 1.0);
  projection(1, 2) = -(1.0 - 2.0 * centre_y / window_height);
  projection(2, 2) = -(far + near) / (far - near);
  projection(2, 3) = -2.0 * far * near / (far - near);
  projection(3, 2) = -1.0;
  return projection * to_camera;
}

}  // namespace substep
