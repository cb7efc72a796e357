// Compliant ground: a ball on a lossless spring, and clutter, as the authors of an
// error-controlled convex integrator test it.

#include "scenes/generator/exam.hpp"
#include "scenes/generator/exam_contact.hpp"
#include "scenes/generator/exam_parts.hpp"

namespace substep::scenes {

std::vector<ExamMethod> contact_methods(const Settings& base, const std::vector<double>& n) {
  std::vector<ExamMethod> methods = exam_methods(base, n);
  for (ExamMethod& method : methods) {
    method.order.reset();
    if (method.settings.mode == Mode::kAdaptive) method.parameters = {0.1, 0.01};
    method.settings.n_max = 64;  // an impact requests thousands
  }
  Settings settings = base;
  settings.mode = Mode::kConst;
  settings.solver = SolverKind::kPgs;
  settings.iterations = 100;
  methods.push_back({"pgs", settings, n, std::nullopt});
  return methods;
}

// ---- on the ground, with y the gap and omega^2 = k/m:
//        y'' = -g - omega^2 y,  y(0) = 0,  y'(0) = -v
//        y = -(g/omega^2)(1 - cos omega t) - (v/omega) sin omega t.
// It leaves the ground at omega t = 2 (pi - atan(v omega/g)).

double SpringBounce::flight() const { return 2.0 * std::sqrt(2.0 * height / gravity); }

double SpringBounce::contact() const {
  const double omega = std::sqrt(stiffness / mass);
  const double v = std::sqrt(2.0 * gravity * height);
  return 2.0 * (std::numbers::pi - std::atan(v * omega / gravity)) / omega;
}

double SpringBounce::gap_after(double t) const {
  const double fall = 0.5 * flight();
  if (t < fall) return height - 0.5 * gravity * t * t;
  const double omega = std::sqrt(stiffness / mass);
  const double v = std::sqrt(2.0 * gravity * height);
  const double s = std::fmod(t - fall, contact() + flight());
  if (s < contact()) {
    return -gravity / (omega * omega) * (1.0 - std::cos(omega * s)) -
           v / omega * std::sin(omega * s);
  }
  const double up = s - contact();
  return v * up - 0.5 * gravity * up * up;
}

int SpringBounce::bounces_within(double t) const {
  const double first = 0.5 * (flight() + contact());
  return t < first ? 0 : 1 + static_cast<int>((t - first) / (contact() + flight()));
}

namespace {

constexpr SpringBounce kBounce{.mass = 0.1, .stiffness = 1e3, .height = 1.0, .gravity = 9.81};
constexpr double kMarbleRadius = 0.1;  // [m]

ExamMeasure measure_bounce() {
  int bounces = 0;
  bool falling = false;
  return [=](const ExamView& view, std::span<double> errors) mutable {
    const State& state = view.state;
    const double gap = state.x[1].y() - kMarbleRadius;
    raise(errors[0], std::abs(gap - kBounce.gap_after(state.time)));
    const double v = velocity_of(state, 1).y();
    if (gap > 0.0) {
      const double at_start = kBounce.mass * kBounce.gravity * kBounce.height;
      const double energy = 0.5 * kBounce.mass * v * v + kBounce.mass * kBounce.gravity * gap;
      const double change = energy / at_start - 1.0;
      raise(errors[1], change);
      raise(errors[2], std::abs(change));
    }
    if (falling && v > 0.0) ++bounces;
    falling = v < 0.0;
    errors[3] = std::abs(bounces - kBounce.bounces_within(state.time));
  };
}

// ---- clutter: spheres and cubes, tilted, fall into a box without a lid.

constexpr int kClutterLayers = 3;       // of 2 x 2 bodies
constexpr double kEdge = 0.2;           // of a cube, and the diameter of a sphere [m]
constexpr double kClutterPitch = 0.28;  // of the grid that they start on: nothing overlaps [m]

void add_box_without_lid(Scene& scene) {
  constexpr double kInside = 0.7;
  constexpr double kThick = 0.2;
  constexpr double kHigh = 0.5;
  scene.bodies.push_back(floor_plane());
  const double at = 0.5 * (kInside + kThick);
  for (const double side : {-1.0, 1.0}) {
    const std::string which = side < 0.0 ? "_low" : "_high";
    Body wall = solid("wall_x" + which, box(kThick, kHigh, kInside + 2.0 * kThick), 1.0,
                      {side * at, 0.5 * kHigh, 0.0});
    wall.is_static = true;
    scene.bodies.push_back(wall);
    wall = solid("wall_z" + which, box(kInside, kHigh, kThick), 1.0, {0.0, 0.5 * kHigh, side * at});
    wall.is_static = true;
    scene.bodies.push_back(wall);
  }
}

/// Energy of the contacts' springs [J]: C f^2/2 for a force f and compliance C.
double elastic_energy(const Scene& scene, const ConstraintForces& forces) {
  double energy = 0.0;
  for (const ContactForce& contact : forces.contacts) {
    const Vec3 force = contact.force.cast<double>();
    const double along = force.dot(contact.normal.cast<double>());
    const double across = force.squaredNorm() - along * along;
    energy += 0.5 * scene.contact.compliance * along * along +
              0.5 * scene.contact.friction_compliance * across;
  }
  return energy;
}

ExamMeasure measure_clutter() {
  double at_start = 0.0;
  double least = 0.0;
  return [=](const ExamView& view, std::span<double> errors) mutable {
    // The report counts contacts that are springs, at other forces.
    const double energy =
        view.report.energy - view.report.elastic + elastic_energy(view.scene, view.forces);
    if (view.state.frame == 0) at_start = least = energy;
    least = std::min(least, energy);
    raise(errors[0], (energy - least) / at_start);
    raise(errors[1], view.report.penetration);
  };
}

ExamCase clutter(const std::string& name, const std::string& title, double compliance,
                 double overlap, const std::string& why) {
  ExamCase exam =
      exam_case(name, title, "Twelve spheres and cubes of 1 kg fall into a box and come to rest.",
                "the claim of an error-controlled convex integrator's authors: "
                "clutter gains no energy",
                2.0, 1.0 / 60.0);
  Scene& scene = exam.scene;
  scene.effects = {.gravity = true, .gyroscopic = true, .contact = true, .friction = true};
  scene.contact.compliance = compliance;
  scene.contact.friction_compliance = compliance;
  scene.camera.eye = {1.6, 1.8, 2.2};
  scene.camera.target = {0.0, 0.3, 0.0};
  add_box_without_lid(scene);
  for (int i = 0; i < 4 * kClutterLayers; ++i) {
    const int across = i % 2;
    const int deep = i / 2 % 2;
    const int layer = i / 4;
    const Vec3 at{(across - 0.5) * kClutterPitch, 0.3 + layer * kClutterPitch,
                  (deep - 0.5) * kClutterPitch};
    const bool is_cube = (across + deep + layer) % 2 == 0;  // never beside another cube
    const Shape shape = is_cube ? Shape(box(kEdge, kEdge, kEdge)) : Shape(Sphere{0.5 * kEdge});
    Body body = solid((is_cube ? "cube_" : "sphere_") + std::to_string(i + 1), shape, 1.0, at);
    // Different fixed tilts, so that edges and corners touch first.
    body.orientation = Quat(4.0, 0.3 * i, 1.0 - 0.2 * i, 0.5).normalized();
    scene.bodies.push_back(body);
  }
  for (Body& body : scene.bodies) body.friction = 0.5;
  scene.criteria.track = 5;
  exam.quantities = {
      {"energy gained", "-", 0.01,
       "a claim in words, and a plot that resolves a hundredth of the initial energy", true},
      {"overlap", "m", overlap, why}};
  exam.needs_forces = true;
  exam.measure = measure_clutter;
  exam.methods = contact_methods(scene.settings, {8, 32});
  return exam;
}

}  // namespace

ExamCase exam_compliant_ball() {
  ExamCase exam =
      exam_case("compliant_ball", "Ball on a lossless ground",
                "A ball of 0.1 kg falls 1 m onto an elastic ground with a compliance of 1 mm/N.",
                "the claim of an error-controlled convex integrator's authors: constant energy, 11 "
                "bounces in 10 s; and the closed form",
                10.0, 0.02);
  Scene& scene = exam.scene;
  scene.effects = {.gravity = true, .contact = true};
  scene.gravity = {0.0, -kBounce.gravity, 0.0};
  scene.contact.compliance = 1.0 / kBounce.stiffness;
  scene.camera.eye = {0.0, 0.8, 3.4};
  scene.camera.target = {0.0, 0.6, 0.0};
  scene.bodies.push_back(floor_plane());
  scene.bodies.push_back(solid("ball", Sphere{kMarbleRadius}, kBounce.mass,
                               {0.0, kMarbleRadius + kBounce.height, 0.0}));
  scene.criteria.track = 1;
  exam.quantities = {{"height", "m", 1e-3, "the accuracy setting of their integrator"},
                     {"energy gained", "-", 1e-3,
                      "the same, relative to the initial energy; in flight, because on the spring "
                      "it oscillates with the order of the velocity",
                      true},
                     {"energy changed", "-", 1e-2, "the resolution of their plot; in flight"},
                     {"bounces missed", "-", 0.5, "they count eleven"}};
  exam.measure = measure_bounce;
  exam.motion = [] {
    return [](double t, std::vector<Vec3>& x, std::vector<Quat>&) {
      x[1].y() = kMarbleRadius + kBounce.gap_after(t);
    };
  };
  exam.methods = contact_methods(scene.settings, {16, 64, 256, 1024});
  return exam;
}

ExamCase exam_soft_clutter() {
  return clutter(
      "soft_clutter", "Soft clutter", 1e-4, 0.1,
      "a fall of 1 m compresses a spring of 10 kN/m by 40 mm, several bodies compress it more");
}

ExamCase exam_hard_clutter() {
  return clutter("hard_clutter", "Hard clutter", 1e-8, 1e-3,
                 "a fall of 1 m compresses a spring of 100 MN/m by 0.4 mm");
}

}  // namespace substep::scenes
