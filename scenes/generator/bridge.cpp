#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "scenes/generator/parts.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::scenes {
namespace {

constexpr int kBridgePlanks = 20;
constexpr double kPlankPitch = 0.5;        // distance of a plank's two pivots [m]
constexpr double kPlankLength = 0.48;      // of a plank along the bridge [m]
constexpr double kPlankThickness = 0.06;   // [m]
constexpr double kLeftHeight = 5.5;        // of the left end [m]
constexpr double kSpan = 9.9;              // of the convoy's bridge [m]
constexpr double kDrop = -1.0;             // of the right end against the left one [m]
constexpr double kBridgeBallRadius = 0.5;  // of the ball [m]
constexpr double kBridgeMu = 0.8;          // Coulomb coefficient of every pair [-]

/// A ball on the road of the convoy.
struct Load {
  const char* name;
  double mass;          // [kg]
  double radius;        // [m]
  double arrives;       // time at the bridge [s]
  std::uint32_t color;  // 0xrrggbb
};
constexpr std::array kConvoy{Load{"light", 10.0, 0.25, 0.4, kTeal},
                             Load{"middle", 100.0, 0.35, 2.9, kBlue},
                             Load{"heavy", 1000.0, 0.5, 5.4, kIron}};
constexpr double kConvoySpeed = 3.0;  // [m/s]

/// Slopes of the planks of the hanging bridge.
///
/// A rigid plank is in equilibrium when the forces T = (H, V) of its two pivots and its weight W
/// balance. Forces: H is the same at every pivot, V grows by W from one to the next. Moments about
/// its centre, with both arms +-r along the plank: r x (T_left + T_right) = 0. So the plank points
/// along T_left + T_right, and its slope is (V_left + V_right)/(2 H): linear in the plank's index,
///   t_i = middle + growth (i - (n - 1)/2),   growth = W/H.
/// The two unknowns represent the force of one end. They follow from the position of the other end:
///   sum pitch / sqrt(1 + t_i^2) = span,   sum pitch t_i / sqrt(1 + t_i^2) = drop,
/// two equations that Newton's method solves, starting from the solution of the shallow chain.
std::array<double, kBridgePlanks> hanging_slopes(double span) {
  const double length = kBridgePlanks * kPlankPitch;
  const auto place = [](int i) { return i - 0.5 * (kBridgePlanks - 1); };
  // Shallow: cos = 1 - t^2/2, so the mean of t^2 is 2 (1 - span/length), and the mean of t is
  // drop/span. The mean of place^2 is (n^2 - 1)/12.
  double middle = kDrop / span;
  double growth = std::sqrt((2.0 * (1.0 - span / length) - middle * middle) * 12.0 /
                            (kBridgePlanks * kBridgePlanks - 1));
  for (int step = 0; step < 20; ++step) {
    double f_x = -span, f_y = -kDrop;                   // error of the right end [m]
    double x_m = 0.0, x_g = 0.0, y_m = 0.0, y_g = 0.0;  // derivatives by middle and growth
    for (int i = 0; i < kBridgePlanks; ++i) {
      const double t = middle + growth * place(i);
      const double c = 1.0 / std::sqrt(1.0 + t * t);
      f_x += kPlankPitch * c;
      f_y += kPlankPitch * t * c;
      x_m -= kPlankPitch * t * c * c * c;
      x_g -= kPlankPitch * t * c * c * c * place(i);
      y_m += kPlankPitch * c * c * c;
      y_g += kPlankPitch * c * c * c * place(i);
    }
    const double determinant = x_m * y_g - x_g * y_m;
    middle -= (f_x * y_g - x_g * f_y) / determinant;
    growth -= (x_m * f_y - f_x * y_m) / determinant;
  }
  std::array<double, kBridgePlanks> slopes{};
  for (int i = 0; i < kBridgePlanks; ++i) {
    slopes[static_cast<std::size_t>(i)] = middle + growth * place(i);
  }
  return slopes;
}

/// The lowest height at which a ball with its centre at x still touches the plank from above, and
/// the normal there; a height of -infinity where the plank is out of its reach.
struct Rest {
  double y = -std::numeric_limits<double>::infinity();  // of the ball's centre [m]
  Vec3 normal = Vec3::UnitY();                          // from the plank to the ball
};

Rest rest_on(const Body& plank, double x) {
  const Vec3 along = plank.orientation * Vec3::UnitX();
  const Vec3 up = plank.orientation * Vec3::UnitY();
  // On the top face: the centre is half a thickness and a radius above the plank's middle plane.
  const Vec3 middle = plank.position + up * (0.5 * kPlankThickness + kBridgeBallRadius);
  const double u = (x - middle.x()) / along.x();
  if (std::abs(u) <= 0.5 * kPlankLength) return {middle.y() + u * along.y(), up};
  // On the edge of the top face that is nearer.
  const Vec3 edge = world_point(
      plank, {u < 0.0 ? -0.5 * kPlankLength : 0.5 * kPlankLength, 0.5 * kPlankThickness, 0.0});
  const double dx = x - edge.x();
  if (std::abs(dx) >= kBridgeBallRadius) return {};
  const double dy = std::sqrt(kBridgeBallRadius * kBridgeBallRadius - dx * dx);
  return {edge.y() + dy, Vec3{dx / kBridgeBallRadius, dy / kBridgeBallRadius, 0.0}};
}

void add_planks(double span, Scene& scene) {
  const Vec3 left{-0.5 * span, kLeftHeight, 0.0};
  const Vec3 right{0.5 * span, kLeftHeight + kDrop, 0.0};
  Vec3 pivot = left;
  for (const double slope : hanging_slopes(span)) {
    const double c = 1.0 / std::sqrt(1.0 + slope * slope);
    const Vec3 along{c, slope * c, 0.0};
    Body plank =
        solid("plank_" + std::to_string(scene.bodies.size() - 1),
              box(kPlankLength, kPlankThickness, 2.0), 1.0, pivot + along * (0.5 * kPlankPitch));
    plank.orientation = turn_about_z(along.x(), along.y());
    plank.friction = kBridgeMu;
    plank.collision_group = 0;
    scene.bodies.push_back(plank);
    pivot += along * kPlankPitch;
  }

  join_planks(kBridgePlanks, kPlankPitch, 0.9, left, right, scene);
}

/// The static road that ends where the bridge begins, and the balls that roll along it.
void add_convoy(Scene& scene) {
  const double top = kLeftHeight + 0.5 * kPlankThickness;
  const double length = kConvoySpeed * kConvoy.back().arrives + 2.0;
  constexpr double kRoad = 0.3;  // thickness [m]
  Body road;
  road.name = "road";
  road.is_static = true;
  road.shape = box(length, kRoad, 2.0);
  road.position = {-0.5 * kSpan - 0.5 * length, top - 0.5 * kRoad, 0.0};
  road.friction = kBridgeMu;
  scene.bodies.push_back(std::move(road));
  for (const Load& load : kConvoy) {
    Body ball = solid(load.name, Sphere{load.radius}, load.mass,
                      {-0.5 * kSpan - kConvoySpeed * load.arrives, top + load.radius, 0.0});
    ball.velocity = {kConvoySpeed, 0.0, 0.0};
    ball.angular_velocity = {0.0, 0.0, -kConvoySpeed / load.radius};  // rolling
    ball.friction = kBridgeMu;
    ball.color = load.color;
    scene.bodies.push_back(std::move(ball));
  }
  scene.criteria.track = static_cast<int>(scene.bodies.size()) - 1;
}

void add_ball(const BridgeOptions& options, Scene& scene) {
  Rest rest;
  for (const Body& plank : scene.bodies) {
    if (plank.is_static) continue;
    const Rest here = rest_on(plank, options.ball_x);
    if (here.y > rest.y) rest = here;
  }
  Body ball = solid("ball", Sphere{kBridgeBallRadius}, 1000.0, {options.ball_x, rest.y, 0.0});
  ball.velocity = options.ball_speed * Vec3{rest.normal.y(), -rest.normal.x(), 0.0};
  // Rolling: the contact point is at rest, v + omega x (-radius n) = 0. Along +x that is about
  // -z.
  ball.angular_velocity = {0.0, 0.0, -options.ball_speed / kBridgeBallRadius};
  ball.friction = kBridgeMu;
  scene.criteria.track = static_cast<int>(scene.bodies.size());
  scene.bodies.push_back(ball);
}

Scene hanging_bridge(double span) {
  Scene scene = paper_scene();
  scene.effects = {.gravity = true, .joints = true, .contact = true, .friction = true};
  scene.contact.compliance = 1e-7;
  scene.contact.friction_compliance = 1e-10;
  scene.bodies.push_back(floor_plane());
  scene.bodies.back().friction = kBridgeMu;
  add_planks(span, scene);
  return scene;
}

}  // namespace

Scene bridge(const BridgeOptions& options) {
  Scene scene = hanging_bridge(options.span);
  scene.name = "bridge";
  scene.title = "Bridge";
  scene.group = "paper";
  scene.description = "A ball of 1000 kg rolls over a hanging bridge of 20 planks of 1 kg each.";
  scene.look_for =
      "Sub-steps rise while the ball loads the planks and fall once it has left, a little after "
      "2 s. Without them the bridge tears in half a second.";
  scene.criteria.duration = 6.0;
  scene.camera.eye = {0.0, 6.5, 14.5};
  scene.camera.target = {0.0, 3.2, 0.0};
  add_ball(options, scene);
  return scene;
}

Scene convoy() {
  Scene scene = hanging_bridge(kSpan);
  scene.name = "convoy";
  scene.title = "Convoy";
  scene.group = "playground";
  scene.description =
      "Balls of 10, 100 and 1000 kg roll one after another over a hanging bridge of 20 planks of "
      "1 kg each.";
  scene.look_for =
      "The load changes, and the number of sub-steps follows it: about 4 on the empty bridge, 10 "
      "under 100 kg, 25 under 1,000 kg. A constant number must be chosen for the heaviest ball.";
  // Per sub-step, because the load changes within a few frames.
  scene.settings.policy = Policy::kSubstep;
  scene.settings.alpha = 0.25;
  scene.criteria.duration = kConvoy.back().arrives + 3.0;
  scene.criteria.window = scene.criteria.duration;
  scene.camera.eye = {-1.5, 6.5, 16.0};
  scene.camera.target = {-1.0, 3.4, 0.0};
  scene.camera.width = 15.0;  // without the far end of the road
  add_convoy(scene);
  return scene;
}

std::vector<BridgeOptions> bridge_starts() {
  std::vector<BridgeOptions> starts;
  for (const double span : {9.9, 9.85}) {
    starts.push_back({-4.3, 2.5, span});
    starts.push_back({-4.2, 3.0, span});
    starts.push_back({-4.1, 3.5, span});
    starts.push_back({-4.0, 4.0, span});
  }
  return starts;
}

}  // namespace substep::scenes
