#include "app/render/picture_changes.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cstddef>

namespace substep {
namespace {

using Eigen::Vector3f;
using Eigen::Vector4f;

Vector3f vector(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }

// What is alike in both but bodies and ribbons.
bool same_stage(const Picture& a, const Picture& b) {
  return a.part == b.part && a.view_projection == b.view_projection && a.eye == b.eye &&
         a.focus == b.focus && a.focus_radius == b.focus_radius && a.to_light == b.to_light &&
         a.background_top == b.background_top && a.background_bottom == b.background_bottom &&
         a.grid == b.grid && a.ambient == b.ambient && a.shadow == b.shadow &&
         a.ground == b.ground && a.boxes.size() == b.boxes.size() &&
         a.balls.size() == b.balls.size() && a.ghost_boxes.size() == b.ghost_boxes.size() &&
         a.ghost_balls.size() == b.ghost_balls.size();
}

// Gathers points of the world as they are seen.
class ChangedArea {
 public:
  explicit ChangedArea(const Picture& picture) : picture_(picture) {
    const Vector3f normal = vector(picture.ground.normal).normalized();
    const Vector3f light = vector(picture.to_light).normalized();
    rise_ = picture.ground.visible ? normal.dot(light) : 0.0F;
  }

  void add(const Vector3f& point) {
    const Vector4f p = picture_.view_projection * point.homogeneous();
    if (!(p.w() > 1e-3F)) {
      anywhere_ = true;  // beside or behind the eye
      return;
    }
    const float x = 0.5F + 0.5F * p.x() / p.w();
    const float y = 0.5F - 0.5F * p.y() / p.w();
    left_ = std::min(left_, x);
    right_ = std::max(right_, x);
    top_ = std::min(top_, y);
    bottom_ = std::max(bottom_, y);
  }

  void add_body(const Instance& body) { add_around(vector(body.position), radius(body)); }

  // What lies between a body and the ground may be in its shadow, to where light ends.
  void add_with_shadow(const Instance& body) {
    add_body(body);
    // Below it, or where there is no ground, nobody can tell where shadows end.
    constexpr float kSteep = 0.05F;
    if (rise_ < kSteep) {
      anywhere_ = true;
      return;
    }
    const Vector3f light = vector(picture_.to_light).normalized();
    const Vector3f normal = vector(picture_.ground.normal).normalized();
    const Vector3f centre = vector(body.position);
    const float height = (centre - vector(picture_.ground.origin)).dot(normal);
    // Softened over a few texels of the coarsest shadow map, and longer where light comes low.
    const float soft = picture_.focus_radius * 8.0F / 384.0F;
    const float size = radius(body) + soft;
    add_around(centre - std::max(0.0F, height / rise_) * light, size / rise_);
    add_around(centre, size);
  }

  [[nodiscard]] Part part() const {
    const Part& whole = picture_.part;
    if (anywhere_) return whole;
    if (left_ > right_) return {whole.x, whole.y, 0.0F, 0.0F};
    constexpr float kEdge = 0.005F;  // of the window: two pixels of the smallest canvas
    const float left = std::clamp(left_ - kEdge, whole.x, whole.x + whole.width);
    const float right = std::clamp(right_ + kEdge, left, whole.x + whole.width);
    const float top = std::clamp(top_ - kEdge, whole.y, whole.y + whole.height);
    const float bottom = std::clamp(bottom_ + kEdge, top, whole.y + whole.height);
    return {left, top, right - left, bottom - top};
  }

 private:
  static float radius(const Instance& body) { return vector(body.half_extents).norm(); }

  void add_around(const Vector3f& centre, float radius) {
    for (int corner = 0; corner < 8; ++corner) {
      add(centre + radius * Vector3f{(corner & 1) != 0 ? 1.0F : -1.0F,
                                     (corner & 2) != 0 ? 1.0F : -1.0F,
                                     (corner & 4) != 0 ? 1.0F : -1.0F});
    }
  }

  const Picture& picture_;
  float rise_;  // of the light over the ground, sine
  bool anywhere_ = false;
  float left_ = 1e9F;
  float right_ = -1e9F;
  float top_ = 1e9F;
  float bottom_ = -1e9F;
};

Part changed_part(const Picture& before, const Picture& now) {
  if (!same_stage(before, now)) return now.part;
  ChangedArea bounds(now);
  const auto bodies = [&bounds](const std::vector<Instance>& a, const std::vector<Instance>& b,
                                void (ChangedArea::*add)(const Instance&)) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a[i] == b[i]) continue;
      (bounds.*add)(a[i]);
      (bounds.*add)(b[i]);
    }
  };
  bodies(before.boxes, now.boxes, &ChangedArea::add_with_shadow);
  bodies(before.balls, now.balls, &ChangedArea::add_with_shadow);
  bodies(before.ghost_boxes, now.ghost_boxes, &ChangedArea::add_body);
  bodies(before.ghost_balls, now.ghost_balls, &ChangedArea::add_body);
  if (before.ribbons != now.ribbons) {
    for (const Picture* picture : {&before, &now}) {
      for (const RibbonVertex& v : picture->ribbons) bounds.add(vector(v.position));
    }
  }
  return bounds.part();
}

bool empty(const Part& p) { return !(p.width > 0.0F && p.height > 0.0F); }

Part between(float left, float top, float right, float bottom) {
  return {left, top, std::max(0.0F, right - left), std::max(0.0F, bottom - top)};
}

Part common(const Part& a, const Part& b) {
  return between(std::max(a.x, b.x), std::max(a.y, b.y), std::min(a.x + a.width, b.x + b.width),
                 std::min(a.y + a.height, b.y + b.height));
}

Part around(const Part& a, const Part& b) {
  if (empty(a)) return b;
  if (empty(b)) return a;
  return between(std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x + a.width, b.x + b.width),
                 std::max(a.y + a.height, b.y + b.height));
}

}  // namespace

std::vector<Part> changed_parts(std::span<const Picture> before, std::span<const Picture> now) {
  std::vector<Part> parts;
  for (std::size_t i = 0; i < now.size(); ++i) {
    Part part = changed_part(before[i], now[i]);
    for (const Part& below : parts) part = around(part, common(below, now[i].part));
    parts.push_back(part);
  }
  return parts;
}

}  // namespace substep
