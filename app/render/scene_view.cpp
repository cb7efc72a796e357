#include "app/render/scene_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "app/lab/stiffness.hpp"
#include "app/render/contact_shadows.hpp"
#include "core/math/turn.hpp"
#include "core/model/joint_fields.hpp"

namespace substep {
namespace {

constexpr double kAway = 1e6;  // bodies farther away, after an explosion, are not drawn [m]

Color mix(const Color& a, const Color& b, double t) {
  const auto f = static_cast<float>(t);
  return {a.r + f * (b.r - a.r), a.g + f * (b.g - a.g), a.b + f * (b.b - a.b), 1.0F};
}

/// @param rgb 0xRRGGBB
Color from_rgb(std::uint32_t rgb) {
  const auto part = [&](int shift) { return static_cast<float>((rgb >> shift) & 255U) / 255.0F; };
  return {part(16), part(8), part(0), 1.0F};
}

bool is_plane(const Body& body) { return std::holds_alternative<Plane>(body.shape); }

Instance instance(const Vec3& x, const Quat& q, const Color& color) {
  Instance i;
  i.position = x.cast<float>();
  i.orientation = {static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z()),
                   static_cast<float>(q.w())};
  i.color = color;
  return i;
}

void add_box(std::vector<Instance>& out, const Vec3& x, const Quat& q, const Vec3& half,
             double rounding, const Color& color) {
  Instance i = instance(x, q, color);
  i.half_extents = half.cast<float>();
  i.rounding = static_cast<float>(rounding);
  out.push_back(i);
}

// With an edge radius suitable for its size.
void add_box(std::vector<Instance>& out, const Vec3& x, const Quat& q, const Vec3& half,
             const Color& color) {
  add_box(out, x, q, half, std::min(0.3 * half.minCoeff(), 0.01 + 0.05 * half.maxCoeff()), color);
}

void add_ball(std::vector<Instance>& out, const Vec3& x, const Quat& q, double r, bool pattern,
              const Color& color) {
  Instance i = instance(x, q, color);
  i.half_extents = Vec3::Constant(r).cast<float>();
  i.rounding = static_cast<float>(r);
  i.pattern = pattern ? 1.0F : 0.0F;
  out.push_back(i);
}

// A plane is the ground of the picture.
void add_body(std::vector<Instance>& boxes, std::vector<Instance>& balls, const Shape& shape,
              const Vec3& x, const Quat& q, const Color& color) {
  const auto solid = outline(shape);
  if (!solid) return;
  if (solid->is_ball()) {
    add_ball(balls, x, q, solid->rounding, true, color);
  } else if (solid->rounding > 0.0) {
    add_box(boxes, x, q, solid->half_extents, solid->rounding, color);
  } else {
    add_box(boxes, x, q, solid->half_extents, color);
  }
}

// Whether a point of the body frame is so far outside the shape that nothing would seem to hold it.
bool is_off_surface(const Shape& shape, const Vec3& point) {
  constexpr double kOutside = 1.05;  // of the extent
  const auto solid = outline(shape);
  if (!solid) return false;
  if (solid->is_ball()) return point.norm() > kOutside * solid->rounding;
  const Vec3 half = kOutside * solid->half_extents;
  return (point.array().abs() > half.array()).any();
}

// The support of a body at a point off its surface. @param half its half thickness [m]
void add_rod(std::vector<Instance>& out, const Vec3& from, const Vec3& to, double half,
             const Color& color) {
  const Vec3 along = to - from;
  add_box(out, 0.5 * (from + to), turn_between(Vec3::UnitY(), along),
          Vec3(half, 0.5 * along.norm(), half), color);
}

// A sphere around the centres of the moving bodies and their fixtures.
Bounds ball_around(const Scene& scene, const Poses& poses, const Bounds* limit) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (is_plane(body)) continue;
    // Bodies thrown far away by an explosion are ignored.
    if (limit != nullptr && (poses.x[i] - limit->centre).norm() > 3.0 * limit->radius) continue;
    const Vec3 r = Vec3::Constant(radius_around(body.shape));
    low = low.cwiseMin(poses.x[i] - r);
    high = high.cwiseMax(poses.x[i] + r);
  }
  for (const Joint& joint : scene.joints) {
    if (base(joint).b != kWorld) continue;
    low = low.cwiseMin(base(joint).anchor_b);
    high = high.cwiseMax(base(joint).anchor_b);
  }
  if (!(low.x() <= high.x())) return limit != nullptr ? *limit : Bounds{};
  return {0.5 * (low + high), std::max(0.05, 0.5 * (high - low).norm())};
}

// Half of the width that the scene states, or of the bodies around the camera's initial target,
// projected to its distance. Bodies may swing to the other side, nearer or farther.
double width_to_show(const Scene& scene, const Poses& poses) {
  if (scene.camera.width) return 0.5 * *scene.camera.width;
  const Vec3 right = OrbitCamera::right_of(scene.camera);
  const Vec3 back = scene.camera.eye - scene.camera.target;
  const double distance = std::max(1e-3, back.norm());
  double reach = 0.0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (is_plane(scene.bodies[i])) continue;
    const Vec3 offset = poses.x[i] - scene.camera.target;
    const double nearer = std::min(0.8, std::abs(back.dot(offset)) / (distance * distance));
    const double aside = std::abs(right.dot(offset)) + radius_around(scene.bodies[i].shape);
    reach = std::max(reach, aside / (1.0 - nearer));
  }
  return 1.02 * reach;
}

// What a camera follows: the tracked body, or the centre of mass of the moving ones.
std::optional<Vec3> subject_of(const Scene& scene, const Poses& poses) {
  if (scene.criteria.track) return poses.x[index(*scene.criteria.track)];
  Vec3 sum = Vec3::Zero();
  double mass = 0.0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].is_static) continue;
    sum += scene.bodies[i].mass * poses.x[i];
    mass += scene.bodies[i].mass;
  }
  if (!(mass > 0.0)) return std::nullopt;
  return Vec3(sum / mass);
}

/// The range of a hinge: an arc between two stops, and a pointer at its angle. @param at the hinge
/// @param r the size of its marker [m]
void add_range(std::vector<Instance>& boxes, const AngleLimit& limit, const Vec3& axis_b,
               const Vec3& at, const Quat& q_b, const Quat& q_a, double r, const Color& color) {
  constexpr int kPieces = 12;
  const double thin = 0.15 * r;
  const auto on_arc = [&](int i) -> Vec3 {
    const double angle = limit.lower + (limit.upper - limit.lower) * i / kPieces;
    return at + 5.0 * r * (q_b * (Eigen::AngleAxisd(angle, axis_b) * limit.across_b));
  };
  for (int i = 0; i < kPieces; ++i) add_rod(boxes, on_arc(i), on_arc(i + 1), thin, color);
  for (const int end : {0, kPieces}) add_rod(boxes, at, on_arc(end), thin, color);
  add_rod(boxes, at, at + 5.0 * r * (q_a * limit.across_a), 2.0 * thin, color);
}

}  // namespace

void SceneView::follow(const Session& session, bool keep) {
  if (session.generation() != generation_) {
    generation_ = session.generation();
    if (keep) {
      note_start(session.scene(), session.poses());
    } else {
      place(session.scene(), session.poses());
    }
  }
  follow_motion(session);
}

void SceneView::place(const Scene& scene, const Poses& poses) {
  note_start(scene, poses);
  camera.place(scene.camera, half_width_);
}

// What the camera follows and shows, without moving it.
void SceneView::note_start(const Scene& scene, const Poses& poses) {
  half_width_ = width_to_show(scene, poses);
  start_ = subject_of(scene, poses).value_or(scene.camera.target) - scene.camera.target;
  carried_.setZero();
  home_ = ball_around(scene, poses, nullptr);
  lowest_ = home_.centre.y() - home_.radius;
}

// In a region around the target of the scene's camera, which includes the start, the motion does
// not move the picture; beyond it the camera moves along. After a failure bodies fly apart: the
// camera stays.
void SceneView::follow_motion(const Session& session) {
  if (!session.verdict().holds()) return;
  const Scene& scene = session.loaded();
  const std::optional<Vec3> subject = subject_of(scene, session.poses());
  if (!subject || !((*subject - home_.centre).norm() < kAway)) return;
  const Vec3 back = (scene.camera.eye - scene.camera.target).normalized();
  const Vec3 right = OrbitCamera::right_of(scene.camera);
  const Vec3 up = back.cross(right);
  const double high =
      (scene.camera.eye - scene.camera.target).norm() * std::tan(0.5 * OrbitCamera::kFieldOfView);
  constexpr double kRoom = 0.85;  // of the way to the edge
  constexpr double kMost = 0.9;
  const Vec3 away = *subject - scene.camera.target;
  const auto beyond = [&](const Vec3& axis, double half) {
    const double along = axis.dot(away);
    const double room = std::clamp(std::abs(axis.dot(start_)), kRoom * half, kMost * half);
    return (along - std::clamp(along, -room, room)) * axis;
  };
  carried_ = beyond(right, std::max(high, half_width_)) + beyond(up, high) +
             beyond(back, std::max(high, half_width_));
  camera.carry(carried_);
}

Bounds SceneView::bounds(const Scene& scene, const Poses& poses) const {
  Bounds limit = home_;
  limit.centre += carried_;
  return ball_around(scene, poses, &limit);
}

Bounds SceneView::bounds_around(const Vec3& centre, double radius) const {
  return {centre, std::max(0.5 * home_.radius, 1.5 * radius)};
}

void SceneView::frame_all(const Session& session) {
  camera.frame(bounds(session.scene(), session.poses()));
}

void SceneView::build(const Seen& seen, const ViewOptions& options, const ViewPalette& palette,
                      const ViewRect& view, double window_width, double window_height,
                      Picture& out) const {
  out.boxes.clear();
  out.balls.clear();
  out.ghost_boxes.clear();
  out.ghost_balls.clear();
  out.ribbons.clear();
  out.view_projection = camera.view_projection(view, window_width, window_height).cast<float>();
  out.eye = camera.eye(view).cast<float>();
  static_cast<Surroundings&>(out) = static_cast<const Surroundings&>(palette);
  const Vec3 light = Vec3(0.42, 0.74, 0.52).normalized();
  out.to_light = light.cast<float>();

  add_bodies(seen, options, palette, out);
  add_joints(seen, options, palette, out);
  if (options.trail && seen.trail != nullptr) {
    const double pixel = 2.0 * std::tan(0.5 * OrbitCamera::kFieldOfView) /
                         std::max(1.0, static_cast<double>(view.height));
    add_trail(*seen.trail, palette.trail, camera.eye(view), pixel, out);
  }
  place_ground(*seen.scene, out);
  out.contacts.clear();
  if (out.ground.solid) out.contacts = contact_shadows(*seen.scene, *seen.poses, out.ground);

  // Shadows fall from the bodies down to the floor: both must be within the light's view.
  const Bounds around = bounds(*seen.scene, *seen.poses);
  const double floor = static_cast<double>(out.ground.origin[1]);
  const double bottom = std::min(floor, around.centre.y() - around.radius);
  const double drop = std::max(0.0, around.centre.y() - bottom);
  Vec3 focus = around.centre;
  focus.y() -= 0.5 * drop;
  focus -= Vec3(light.x(), 0.0, light.z()) * 0.5 * drop / light.y();
  // In steps, so that the light is constant between frames: if it followed the bodies, the shadow
  // edges would crawl and the whole picture would change.
  const double lit = std::max(0.1, around.radius + 0.35 * drop);  // radius of the shadow casters
  const double radius = std::exp2(std::ceil(4.0 * std::log2(lit)) / 4.0);
  const double step = radius / 8.0;
  out.focus = ((focus / step).array().round() * step).matrix().cast<float>();
  out.focus_radius = static_cast<float>(radius + 0.5 * std::sqrt(3.0) * step);
}

void SceneView::add_bodies(const Seen& seen, const ViewOptions& options, const ViewPalette& palette,
                           Picture& out) {
  const Scene& scene = *seen.scene;
  const Poses& poses = *seen.poses;
  std::vector<double> shares;
  if (options.tint && seen.state != nullptr) shares = stiffness_shares(scene, *seen.state);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (!(poses.x[i].norm() < kAway)) continue;
    Color color = body.is_static ? palette.fixture : palette.body;
    if (body.color) color = from_rgb(*body.color);
    if (!shares.empty() && !body.is_static) {
      const double t = shares[i];
      const Color low = body.color ? color : palette.stiff_low;
      color = t < 0.5 ? mix(low, palette.stiff_mid, 2.0 * t)
                      : mix(palette.stiff_mid, palette.stiff_high, 2.0 * t - 1.0);
    }
    add_body(out.boxes, out.balls, body.shape, poses.x[i], poses.q[i], color);
  }
}

void SceneView::add_ghost(const Scene& scene, const Poses& poses, const Color& color,
                          Picture& out) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.is_static) continue;  // identical to the session's own
    if (!(poses.x[i].norm() < kAway)) continue;
    add_body(out.ghost_boxes, out.ghost_balls, body.shape, poses.x[i], poses.q[i], color);
  }
}

void SceneView::add_joints(const Seen& seen, const ViewOptions& options, const ViewPalette& palette,
                           Picture& out) const {
  const Scene& scene = *seen.scene;
  const Poses& poses = *seen.poses;
  const double bracket = std::clamp(0.018 * home_.radius, 0.04 * std::min(home_.radius, 1.0), 0.4);
  for (const Joint& joint : scene.joints) {
    const JointBase& j = base(joint);
    const auto a = static_cast<std::size_t>(j.a);
    double thin = half_width(scene.bodies[a].shape);
    if (j.b == kWorld) {
      add_box(out.boxes, j.anchor_b + Vec3(0.0, 0.6 * bracket, 0.0), Quat::Identity(),
              bracket * Vec3(2.2, 0.6, 2.2), 0.2 * bracket, palette.fixture);
    } else {
      thin = std::min(thin, half_width(scene.bodies[static_cast<std::size_t>(j.b)].shape));
    }
    const Vec3 x = poses.x[a] + poses.q[a] * j.anchor_a;
    if (is_off_surface(scene.bodies[a].shape, j.anchor_a)) {
      thin = std::max(0.15 * bracket, 0.02 * j.anchor_a.norm());
      add_rod(out.boxes, poses.x[a], x, thin, mix(palette.joint, palette.body, 0.6));
    }
    const auto b = static_cast<std::size_t>(j.b);
    const Vec3 from = j.b == kWorld ? j.anchor_b : poses.x[b] + poses.q[b] * j.anchor_b;
    if (length_of(joint) && from != x) add_rod(out.boxes, from, x, 0.15 * bracket, palette.joint);
    if (rope_length_of(joint) && from != x) {
      add_rod(out.boxes, from, x, 0.07 * bracket, palette.joint);
    }
    if (!options.joints) continue;
    const double r = 1.25 * std::min(thin, 0.25 * home_.radius);
    if (is_weld(joint)) {
      add_box(out.boxes, x, poses.q[a], Vec3::Constant(r), 0.2 * r, palette.joint);
    } else if (const auto pins = crossing_axes_of(joint)) {
      const Quat q_b = j.b == kWorld ? Quat(Quat::Identity()) : poses.q[b];
      for (const Vec3& pin : {Vec3(poses.q[a] * pins->a), Vec3(q_b * pins->b)}) {
        add_box(out.boxes, x, turn_between(Vec3::UnitZ(), pin), r * Vec3(0.5, 0.5, 1.5), 0.45 * r,
                palette.joint);
      }
    } else if (const auto axes = axes_of(joint)) {
      // The path from the anchor on b.
      if (axes->slides && from != x) add_rod(out.boxes, from, x, 0.3 * r, palette.joint);
      const Quat along = turn_between(Vec3::UnitZ(), poses.q[a] * axes->a);
      add_box(out.boxes, x, along, r * Vec3(0.8, 0.8, 1.3), 0.75 * r, palette.joint);
      const AngleLimit* limit = angle_limit_of(joint);
      if (limit != nullptr && scene.effects.limits) {
        const Quat q_b = j.b == kWorld ? Quat(Quat::Identity()) : poses.q[b];
        add_range(out.boxes, *limit, axes->b, x, q_b, poses.q[a], r,
                  mix(palette.joint, palette.body, 0.6));
      }
    } else {
      // A fully rounded box: there are many of them, and they are small.
      add_box(out.boxes, x, poses.q[a], Vec3::Constant(r), r, palette.joint);
    }
  }
}

void SceneView::add_trail(const std::deque<Vec3>& trail, const Color& color, const Vec3& eye,
                          double pixel, Picture& out) {
  if (trail.size() < 2) return;
  const auto corner = [&](std::size_t i, double side) {
    const Vec3 ahead = trail[std::min(i + 1, trail.size() - 1)] - trail[i > 0 ? i - 1 : 0];
    const Vec3 to_eye = eye - trail[i];
    Vec3 across = ahead.cross(to_eye);
    if (across.norm() > 1e-12) across *= pixel * to_eye.norm() / across.norm();
    RibbonVertex v;
    v.position = (trail[i] + side * across).cast<float>();
    v.color = color;
    v.color.a *= static_cast<float>(i) / static_cast<float>(trail.size() - 1);
    return v;
  };
  for (std::size_t i = 0; i + 1 < trail.size(); ++i) {
    const RibbonVertex a = corner(i, -1.0);
    const RibbonVertex b = corner(i, 1.0);
    const RibbonVertex c = corner(i + 1, -1.0);
    const RibbonVertex d = corner(i + 1, 1.0);
    out.ribbons.insert(out.ribbons.end(), {a, b, c, c, b, d});
  }
}

void SceneView::place_ground(const Scene& scene, Picture& out) const {
  out.ground = {};
  // Most scenes are above y = 0; without a given floor it is placed below them.
  const double floor = lowest_ > -0.6 * home_.radius ? 0.0 : lowest_ - 0.3 * home_.radius;
  out.ground.origin = {0.0F, static_cast<float>(floor), 0.0F};
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!is_plane(scene.bodies[i])) continue;
    out.ground.origin = scene.bodies[i].position.cast<float>();
    out.ground.normal = (scene.bodies[i].orientation * Vec3::UnitY()).cast<float>();
    out.ground.along = (scene.bodies[i].orientation * Vec3::UnitX()).cast<float>();
    out.ground.solid = true;
    break;
  }
  // That of the scene at its start, or of the camera that follows: it must not move with bodies.
  out.ground.centre = (home_.centre + carried_).cast<float>();
  out.ground.fade = static_cast<float>(std::clamp(5.0 * home_.radius, 12.0, 400.0));
  out.ground.cell = home_.radius > 40.0 ? 10.0F : 1.0F;
  out.ground.reach = static_cast<float>(std::clamp(0.2 * home_.radius, 0.15, 4.0));
}

}  // namespace substep
