#include "app/render/thumbnail.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "app/render/hull.hpp"

namespace substep {
namespace {

using Eigen::Vector3f;

constexpr std::size_t kMostBodies = 250;
constexpr float kFrameMargin = 0.1F;  // around the bodies, of the height
constexpr int kRim = 20;              // corners of a ball's outline

struct FlatFace {
  std::vector<ScreenPoint> points;  // unfitted
  Color color;
  float depth = 0.0F;
  bool outlined = false;
};

Eigen::Quaternionf turn_of(const Instance& i) {
  return {i.orientation[3], i.orientation[0], i.orientation[1], i.orientation[2]};
}

float size_of(const Instance& i) { return i.half_extents.norm(); }

Color blend(const Color& a, const Color& b, float t) {
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b), 1.0F};
}

// The light of the shaders, without shadows on bodies.
Color shaded(const Color& color, const Vector3f& normal, const Picture& picture) {
  const float facing = std::max(0.0F, normal.dot(picture.to_light));
  const float light = picture.ambient * (0.62F + 0.3F * normal.y()) + facing;
  const auto part = [light](float c) {
    return std::min(1.0F, c * std::sqrt(light / (1.0F + 0.12F * c * c * light)));
  };
  return {part(color.r), part(color.g), part(color.b), 1.0F};
}

// Collects the faces of bodies, and their shadows.
class FlatPainter {
 public:
  explicit FlatPainter(const Picture& picture) : picture_(picture) {}

  void add_box(const Instance& box) {
    std::array<Vector3f, 8> corners;
    const Eigen::Quaternionf q = turn_of(box);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector3f sign((i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1, (i & 4U) != 0 ? 1 : -1);
      corners[i] = box.position + q * box.half_extents.cwiseProduct(sign);
    }
    add_silhouette(corners, box);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const bool high : {false, true}) add_side(corners, axis, high, q, box.color);
    }
    add_shadow(corners);
  }

  // The rim as seen from the eye, and a lighter disc on the side of the light.
  void add_ball(const Instance& ball) {
    const Vector3f centre = ball.position;
    const Vector3f back = (picture_.eye - centre).normalized();
    const Vector3f light = picture_.to_light;
    const float r = ball.half_extents[0];
    const Vector3f to_side = (light - back.dot(light) * back) * (0.3F * r);
    add_face(circle(centre, back, r),
             blend(shaded(ball.color, -light, picture_), ball.color, 0.35F), centre, false);
    add_face(circle(centre + to_side, back, 0.68F * r), shaded(ball.color, light, picture_),
             centre + 0.1F * r * back, false);
    add_shadow(circle(centre, light, r));
  }

  [[nodiscard]] Thumbnail fitted();

 private:
  static std::vector<Vector3f> circle(const Vector3f& centre, const Vector3f& axis, float radius) {
    const Vector3f u = axis.unitOrthogonal();
    const Vector3f v = axis.cross(u);
    std::vector<Vector3f> rim;
    for (int i = 0; i < kRim; ++i) {
      const auto a = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / kRim;
      rim.emplace_back(centre + radius * (std::cos(a) * u + std::sin(a) * v));
    }
    return rim;
  }

  [[nodiscard]] float depth(const Vector3f& x) const {
    return picture_.view_projection.row(3).dot(x.homogeneous());
  }

  // Nothing if a point is behind the eye.
  [[nodiscard]] std::vector<ScreenPoint> seen(std::span<const Vector3f> points) const {
    std::vector<ScreenPoint> out;
    for (const Vector3f& x : points) {
      const Eigen::Vector4f p = picture_.view_projection * x.homogeneous();
      if (!(p.w() > 1e-4F)) return {};
      out.push_back({p.x() / p.w() * Thumbnail::kAspect, -p.y() / p.w()});
    }
    return out;
  }

  void add_face(std::span<const Vector3f> points, const Color& color, const Vector3f& at,
                bool outlined) {
    FlatFace face{seen(points), color, depth(at), outlined};
    if (outlined) face.points = convex_hull(std::move(face.points));
    if (face.points.size() >= 3) faces_.push_back(std::move(face));
  }

  // Below the sides, which have no outline: thin bodies stay visible, and no seams appear.
  void add_silhouette(const std::array<Vector3f, 8>& corners, const Instance& box) {
    const Vector3f centre = box.position;
    const Vector3f back = (picture_.eye - centre).normalized();
    add_face(corners, blend(shaded(box.color, back, picture_), box.color, 0.3F),
             centre - 0.02F * size_of(box) * back, true);
  }

  void add_side(const std::array<Vector3f, 8>& corners, std::size_t axis, bool high,
                const Eigen::Quaternionf& q, const Color& color) {
    const Vector3f normal = q * (Vector3f::Unit(static_cast<int>(axis)) * (high ? 1.0F : -1.0F));
    const std::size_t u = std::size_t{1} << (axis + 1) % 3;
    const std::size_t v = std::size_t{1} << (axis + 2) % 3;
    const std::size_t base = high ? std::size_t{1} << axis : 0;
    const std::array<Vector3f, 4> side{corners[base], corners[base | u], corners[base | u | v],
                                       corners[base | v]};
    const Vector3f middle = 0.5F * (side[0] + side[2]);
    if (normal.dot(picture_.eye - middle) <= 0.0F) return;
    add_face(side, shaded(color, normal, picture_), middle, false);
  }

  void add_shadow(std::span<const Vector3f> points) {
    const Ground& ground = picture_.ground;
    if (!ground.solid) return;
    const Vector3f normal = ground.normal;
    const Vector3f light = picture_.to_light;
    std::vector<Vector3f> on_floor;
    for (const Vector3f& x : points) {
      const float height = normal.dot(x - ground.origin);
      on_floor.emplace_back(x - std::max(0.0F, height) / normal.dot(light) * light);
    }
    std::vector<ScreenPoint> shadow = convex_hull(seen(on_floor));
    // Of one opaque colour, so that overlapping shadows do not get darker.
    const Color color = blend(picture_.floor, picture_.shade, 0.8F * picture_.shadow);
    if (shadow.size() >= 3) shadows_.push_back({std::move(shadow), color, 0.0F, false});
  }

  const Picture& picture_;
  std::vector<FlatFace> faces_;
  std::vector<FlatFace> shadows_;
};

// The bodies fill the frame; shadows may be cut.
Thumbnail FlatPainter::fitted() {
  std::stable_sort(faces_.begin(), faces_.end(),
                   [](const FlatFace& a, const FlatFace& b) { return a.depth > b.depth; });
  ScreenPoint low{1e9F, 1e9F};
  ScreenPoint high{-1e9F, -1e9F};
  for (const FlatFace& face : faces_) {
    for (const ScreenPoint& p : face.points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  const float width = std::max(1e-6F, high.x - low.x);
  const float height = std::max(1e-6F, high.y - low.y);
  const float scale = std::min((Thumbnail::kAspect - 2.0F * kFrameMargin) / width,
                               (1.0F - 2.0F * kFrameMargin) / height);
  Thumbnail out;
  const auto put = [&](const FlatFace& face) {
    out.polygons.push_back({out.points.size(), face.points.size(), face.color, face.outlined});
    for (const ScreenPoint& p : face.points) {
      out.points.push_back({0.5F * Thumbnail::kAspect + scale * (p.x - 0.5F * (low.x + high.x)),
                            0.5F + scale * (p.y - 0.5F * (low.y + high.y))});
    }
  };
  for (const FlatFace& face : shadows_) put(face);
  for (const FlatFace& face : faces_) put(face);
  return out;
}

}  // namespace

Thumbnail thumbnail_of(const Scene& scene, const ViewPalette& palette) {
  Poses poses;
  for (const Body& body : scene.bodies) {
    poses.x.push_back(body.position);
    poses.q.push_back(body.orientation);
  }
  SceneView view;
  view.place(scene, poses);
  ViewOptions options;
  options.joints = false;
  Picture picture;
  constexpr float kHeight = 100.0F;
  const ViewRect frame{0.0F, 0.0F, Thumbnail::kAspect * kHeight, kHeight};
  view.build({&scene, &poses, nullptr, nullptr}, options, palette, frame,
             static_cast<double>(frame.width), static_cast<double>(frame.height), picture);

  const auto keep_largest = [](std::vector<Instance>& bodies) {
    const auto larger = [](const Instance& a, const Instance& b) {
      return size_of(a) > size_of(b);
    };
    std::stable_sort(bodies.begin(), bodies.end(), larger);
    if (bodies.size() > kMostBodies) bodies.resize(kMostBodies);
  };
  keep_largest(picture.boxes);
  keep_largest(picture.balls);
  FlatPainter painter(picture);
  for (const Instance& box : picture.boxes) painter.add_box(box);
  for (const Instance& ball : picture.balls) painter.add_ball(ball);
  return painter.fitted();
}

}  // namespace substep
