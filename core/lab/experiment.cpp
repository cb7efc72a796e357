#include "core/lab/experiment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/random.hpp"
#include "core/model/names.hpp"
#include "core/model/scene_limits.hpp"
#include "core/model/validate.hpp"
#include "core/stepping/substep_clock.hpp"

namespace substep {
namespace {

constexpr double kNudge = 1e-9;  // [m/s]

Body& heaviest(std::vector<Body>& bodies) {
  return *std::max_element(bodies.begin(), bodies.end(), [](const Body& a, const Body& b) {
    return (a.is_static ? 0.0 : a.mass) < (b.is_static ? 0.0 : b.mass);
  });
}

/// The number clamped to the range.
double kept(double value, const Range& range) {
  const double least = range.open_below ? std::numeric_limits<double>::min() : range.least;
  return std::clamp(value, least, range.most);
}

void apply_load(double load, Scene& scene) {
  if (scene.bodies.empty()) return;
  Body& body = heaviest(scene.bodies);
  if (body.is_static) return;
  const double most =
      std::min(kMassRange.most / body.mass, kInertiaRange.most / body.inertia.maxCoeff());
  load = std::min(load, most);  // keeps the scene valid
  body.mass = kept(body.mass * load, kMassRange);
  for (double& moment : body.inertia) moment = kept(moment * load, kInertiaRange);
  for (auto* energy : {&scene.criteria.energy_gain, &scene.criteria.energy_scale}) {
    if (*energy) **energy = kept(**energy * load, kEnergyRange);
  }
}

void nudge(int seed, Scene& scene) {
  Random random(static_cast<std::uint64_t>(seed));
  for (Body& body : scene.bodies) {
    if (body.is_static) continue;
    for (double& speed : body.velocity) {
      speed = kept(speed + kNudge * random.next(), kVelocityRange);
    }
  }
}

}  // namespace

Scene start_of(const Scene& scene, double load, int seed) {
  Scene start = scene;
  if (!is_runnable(scene)) return start;
  if (load != 1.0 || seed != 0) start.carried.reset();  // it was of other masses and velocities
  if (load != 1.0) apply_load(load, start);
  if (seed != 0) nudge(seed, start);
  return start;
}

double mass_ratio(const Scene& scene) {
  double most = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (const Body& body : scene.bodies) {
    if (body.is_static) continue;
    most = std::max(most, body.mass);
    least = std::min(least, body.mass);
  }
  return most > 0.0 && least > 0.0 ? most / least : 1.0;
}

std::int64_t frames_of(const Scene& scene, double duration) {
  constexpr double kMost = 1e15;
  if (!(scene.frame > 0.0)) return 0;
  const double frames = duration / scene.frame;
  if (!std::isfinite(frames)) return 0;
  return std::llround(std::clamp(frames, 0.0, kMost));
}

std::string solver_text(const Settings& s) {
  std::string text(name_of(s.solver));
  const bool sweeps = entry_of(s.solver).sweeps;
  if (reads(s, "iterations") && (sweeps || s.iterations != Settings{}.iterations)) {
    text += " " + std::to_string(s.iterations);
  }
  if (reads(s, "share_iterations") && s.share_iterations) text += " per frame";
  if (reads(s, "forces") && s.forces != Forces::kEnd) text += " " + std::string(name_of(s.forces));
  if (reads(s, "refinements") && s.refinements > 0) {
    text += " refined " + std::to_string(s.refinements);
  }
  return text;
}

std::string series_name(const Settings& s) {
  std::string name = solver_text(s);
  name += ", ";
  // One sub-step is the first point of the curve of constant N.
  name += s.mode == Mode::kNone ? "const" : name_of(s.mode);
  if (s.mode == Mode::kAdaptive)
    name += s.policy == Policy::kFrame ? " per frame" : " per sub-step";
  if (has_islands(s)) name += " by island";
  name += ", ";
  name += name_of(s.integrator);
  if (s.drift != Drift::kAuto) name += ", drift " + std::string(name_of(s.drift));
  if (s.drift_order == 2) name += ", drift order 2";
  if (s.detection == Detection::kFrame) name += ", contacts once per frame";
  if (s.contact_stiffness == ContactStiffness::kExact) name += ", exact contact block";
  if (!s.rotation_criterion) name += ", without the rotation criterion";
  if (s.friction_cone == FrictionCone::kCone) name += ", friction cone";
  if (s.gyroscopic == Gyroscopic::kExplicit) name += ", explicit gyroscopic torque";
  return name;
}

SeriesParameter series_parameter(const Settings& s) {
  switch (entry_of(s.mode).count) {
    case SubstepCount::kOne:
      if (reads(s, "alpha")) break;
      return {"n", 1.0};
    case SubstepCount::kGiven:
      return {"n", static_cast<double>(s.n)};
    case SubstepCount::kStableCapped:
      return {"n_cap", static_cast<double>(s.n_cap)};
    case SubstepCount::kStable:
      break;
  }
  return {"alpha", s.alpha};
}

}  // namespace substep
