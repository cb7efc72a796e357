#include "core/lab/doctor.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/lab/experiment.hpp"
#include "core/lab/shadow_energy.hpp"
#include "core/lab/velocity_forces.hpp"
#include "core/lab/verdict.hpp"
#include "core/math/dense.hpp"
#include "core/math/random.hpp"
#include "core/model/format_text.hpp"
#include "core/model/joint_fields.hpp"
#include "core/model/validate.hpp"
#include "core/sim/simulator.hpp"

namespace substep {
namespace {

constexpr double kManyTimes = 100.0;  // a mass ratio across a joint that is worth a warning
constexpr double kThin = 1e-6;        // of a moment of inertia, of m r^2
constexpr double kOverlaps = 0.01;    // of the width of the smaller body
constexpr double kAnalyses = 16.0;    // in a run, besides that at the largest r

double step_of_criterion(double r) { return r > 0.0 ? 2.0 / std::sqrt(r) : kNoLimit; }

const std::string& named_joint(const Scene& scene, int joint) {
  return base(scene.joints[index(joint)]).name;
}
const std::string& named_body(const Scene& scene, int body) {
  return scene.bodies[index(body)].name;
}

/// A step, or none if what resists is rounding [s].
double known(double step) {
  constexpr double kLongest = 1e3;
  return step < kLongest ? step : kNoLimit;
}

/// What of a drive or a spring is explicit.
struct Explicit {
  bool stiffness = false;
  bool damping = false;
};

/// A law outside the engine is held, and so explicit; springs are in the engine.
Explicit explicit_of(const LinearModel::DriveTerm& drive, const DoctorQuestion& question) {
  const Engine& engine = *question.engine;
  if (question.held > 0 && !drive.passive) return {true, true};
  return {engine.stiffness == Treated::kExplicit,
          engine.damping == Treated::kExplicit && !(drive.passive && engine.damps_springs)};
}

/// A system of a group, with drives and springs as the question has them.
LinearSystem system_of(const LinearModel& model, const DoctorQuestion& question) {
  LinearSystem system{model.mass(), model.geometric() - model.springs(), {}};
  for (const LinearModel::DriveTerm& drive : model.drives()) {
    const Explicit is = explicit_of(drive, question);
    add_square(system.stiffness, is.stiffness ? drive.stiffness : -drive.stiffness,
               drive.coordinate);
    if (system.damping.size() == 0) system.damping = AnyMatrix::Zero(model.size(), model.size());
    add_square(system.damping, is.damping ? -drive.damping : drive.damping, drive.coordinate);
  }
  return system;
}

GroupLimit limit_of(const LinearModel& model, std::size_t group, double time,
                    const DoctorQuestion& question) {
  GroupLimit limit;
  limit.group = group;
  limit.time = time;
  limit.criterion = step_of_criterion(model.r());
  const StepLimit geometric =
      largest_step(LinearSystem{model.mass(), model.geometric() - model.springs(), {}});
  limit.geometric = known(geometric.step);
  const StepLimit all = largest_step(system_of(model, question));
  limit.step = known(all.step);
  const AnyVector& mode = all.mode.size() > 0 ? all.mode : geometric.mode;
  if (mode.size() == 0) return limit;
  const double h = all.mode.size() > 0 ? all.step : geometric.step;
  limit.bodies = model.bodies_of(mode);
  limit.joints = model.joints_of(mode);
  double sum = h * h * mode.dot(product(model.geometric(), mode));
  for (const LinearModel::DriveTerm& drive : model.drives()) {
    const double moved = std::pow(drive.coordinate.dot(mode), 2);
    double by = 0.0;
    const Explicit is = explicit_of(drive, question);
    if (is.stiffness) by += h * h * drive.stiffness * moved;
    if (is.damping) by += 2.0 * h * drive.damping * moved;
    if (!limit.drives.empty() && limit.drives.back().index == drive.joint) {
      limit.drives.back().share += by;
    } else {
      limit.drives.push_back({drive.joint, by});
    }
    sum += by;
  }
  for (auto& share : limit.drives) share.share /= sum;
  std::stable_sort(limit.drives.begin(), limit.drives.end(),
                   [](const auto& a, const auto& b) { return a.share > b.share; });
  return limit;
}

std::vector<GroupLimit> limits_of(const std::vector<LinearModel>& models, double time,
                                  const DoctorQuestion& question) {
  std::vector<GroupLimit> limits;
  for (std::size_t i = 0; i < models.size(); ++i) {
    limits.push_back(limit_of(models[i], i, time, question));
  }
  return limits;
}

/// @param terms of one joint: its drive, its spring or both
DriveLimit drive_limit(std::span<const LinearModel::DriveTerm> terms,
                       const DoctorQuestion& question) {
  const double inertia = terms[0].inertia;
  DriveLimit limit{terms[0].joint, inertia};
  OneCoordinate asked{inertia};
  const LinearModel::DriveTerm* drive = nullptr;
  for (const LinearModel::DriveTerm& term : terms) {
    limit.stiffness += term.stiffness;
    limit.damping += term.damping;
    const Explicit is = explicit_of(term, question);
    if (is.stiffness) asked.stiffness += term.stiffness;
    (is.damping ? asked.explicit_damping : asked.implicit_damping) += term.damping;
    if (!term.passive) drive = &term;
  }
  if (!std::isfinite(inertia)) return limit;  // its joint cannot move
  limit.explicit_step = largest_step({inertia, limit.stiffness, limit.damping, 0.0});
  limit.damped_step = largest_step({inertia, limit.stiffness, 0.0, limit.damping});
  limit.step = largest_step(asked);
  if (drive != nullptr) {
    const int held = std::max(question.held, 1);
    const HeldDrive law{inertia, drive->stiffness, drive->damping, held};
    limit.held_step = largest_step_of_effort(law);
    limit.delay_step = largest_step_of_delay(law);
    if (question.held > 0) {
      limit.step = std::min(limit.held_step, limit.delay_step);
      asked = {inertia, held * drive->stiffness, held * drive->damping, 0.0};
    }
  }
  limit.armature = armature_for(asked, kSafeMargin * question.step);
  return limit;
}

/// The scene with additional velocities of a standard size: of bodies up to 3 % of that of a fall
/// over the size of the scene. They are the same in every run, and its start is projected.
Scene shaken(const Scene& scene) {
  Scene out = scene;
  Vec3 low = Vec3::Constant(kNoLimit);
  Vec3 high = -low;
  for (const Body& body : scene.bodies) {
    if (body.is_static) continue;
    low = low.cwiseMin(body.position);
    high = high.cwiseMax(body.position);
  }
  const double size = std::max((high - low).norm(), 1e-3);
  const double gravity = scene.effects.gravity ? scene.gravity.norm() : 9.81;
  const double speed = 0.03 * std::sqrt(gravity * size);
  Random random(1);
  const auto some = [&](double most) {
    Vec3 v;
    for (int i = 0; i < 3; ++i) v[i] = most * random.next();
    return v;
  };
  for (Body& body : out.bodies) {
    if (body.is_static) continue;
    body.velocity += some(speed);
    body.angular_velocity += some(speed / size);
  }
  out.carried.reset();
  out.start = StartPolicy::kProject;
  return out;
}

/// Judges a run of one step per frame below its limit by the energy that the scheme keeps, and by
/// by its excess: the true energy oscillates, the more the closer the step is to the limit.
class ShadowVerdict {
 public:
  /// @param share of the limit [-]
  ShadowVerdict(const Scene& scene, const Simulator& simulator, double share)
      : energy_(scene, simulator.state(), simulator.observe()), share_(share) {}

  void add(const Scene& scene, const State& state, const FrameReport& report,
           std::optional<Verdict>& verdict) {
    if (report.status != StepStatus::kOk) {
      verdict->add(scene, state, report);
      return;
    }
    const FrameReport before = energy_.add(scene, state, report);
    if (is_first_) {
      verdict.emplace(scene, state, before);
    } else {
      verdict->add(scene, state, before);
    }
    is_first_ = false;
    constexpr double kAtFirst = 0.5;  // [s] while the motion's energy is still small
    if (report.time >= kAtFirst) judge(report.time);
  }
  /// At the end of the run, or during it.
  void judge(double time) {
    if (why_.empty() && energy_.exceeds_stable(share_)) {
      why_ = format_text("fails at %.3f s: oscillations grow, by %.4g J", time, energy_.excess());
    }
  }
  /// Why it fails; empty if it does not.
  [[nodiscard]] const std::string& why() const { return why_; }

 private:
  ShadowEnergy energy_;
  double share_;
  bool is_first_ = true;
  std::string why_;
};

/// A run frame by frame. @param share of the limit that its step is, if it takes one per frame and
/// is below [-]; else 0 @param each called after every frame
template <class Each>
DoctorRun followed(const std::shared_ptr<const Scene>& scene, const Settings& settings,
                   double seconds, const Budget& budget, double share, Each&& each) {
  DoctorRun run;
  run.seconds = seconds;
  Simulator simulator(scene);
  simulator.set_settings(settings);
  simulator.set_budget(budget);
  simulator.set_measures({.stages = false});
  const FrameReport start = simulator.observe();
  std::optional<Verdict> verdict(std::in_place, *scene, simulator.state(), start);
  std::optional<ShadowVerdict> shadow;
  const bool has_criteria = scene->criteria.energy_gain || scene->criteria.displacement;
  if (share > 0.0 && share < 1.0 && !has_criteria && ShadowEnergy::applies(*scene)) {
    shadow.emplace(*scene, simulator, share);
  }
  run.by_shadow = shadow.has_value();
  const std::int64_t frames = std::max<std::int64_t>(1, frames_of(*scene, seconds));
  double flops = 0.0;
  double smallest = kNoLimit;
  for (std::int64_t i = 0; i < frames; ++i) {
    const FrameReport report = simulator.step();
    if (shadow) {
      shadow->add(*scene, simulator.state(), report, verdict);
    } else {
      verdict->add(*scene, simulator.state(), report);
    }
    run.gain = std::max(run.gain, report.energy - start.energy);
    flops += static_cast<double>(report.work.flops);
    const double step = step_of_criterion(report.r_stiffness);
    run.criterion.push_back(step);
    if (step < smallest) {
      smallest = step;
      run.leader = report.leader.body;
      run.leader_time = report.time;
    }
    if (report.status != StepStatus::kOk || !verdict->holds()) break;
    if (shadow && !shadow->why().empty()) break;
    each(simulator, step == smallest);
  }
  run.holds = verdict->holds();
  run.verdict = verdict->text();
  if (shadow && run.holds) {
    shadow->judge(simulator.state().time);
    run.holds = shadow->why().empty();
    if (!run.holds) run.verdict = shadow->why();
  }
  run.operations = flops / std::max(simulator.state().time, scene->frame);
  return run;
}

/// A state whose velocities are those at the time of its poses.
State synchronised(const State& state) {
  State out = state;
  out.u = state.u_synchronised;
  return out;
}

/// The state of the smallest step so far.
struct Narrowest {
  double step = kNoLimit;
  std::size_t group = 0;
  std::optional<State> state;

  void add(const std::vector<GroupLimit>& limits, const State& of) {
    for (const GroupLimit& limit : limits) {
      if (state && !(limit.step < step)) continue;
      step = limit.step;
      group = limit.group;
      state = of;
    }
  }
};

DoctorRun analysed_run(const char* what, const std::shared_ptr<const Scene>& scene,
                       const DoctorQuestion& question, Narrowest& narrowest) {
  Settings settings;  // N decided by the criterion
  settings.watch_stiffness = true;
  const auto frames = static_cast<double>(frames_of(*scene, question.seconds));
  const auto each_nth = static_cast<std::int64_t>(std::max(1.0, std::ceil(frames / kAnalyses)));
  std::vector<GroupLimit> worst;
  std::optional<State> at_peak;
  const auto analyse = [&](const State& state) {
    const auto limits = limits_of(LinearModel::of(*scene, state), state.time, question);
    narrowest.add(limits, state);
    if (worst.empty()) worst = limits;
    for (std::size_t i = 0; i < limits.size(); ++i) {
      if (limits[i].step < worst[i].step) worst[i] = limits[i];
    }
  };
  analyse(start_of_run(*scene).state);
  DoctorRun run = followed(scene, settings, question.seconds, question.budget, 0.0,
                           [&](const Simulator& simulator, bool peak) {
                             if (peak) at_peak = synchronised(simulator.state());
                             if (simulator.state().frame % each_nth == 0) {
                               analyse(synchronised(simulator.state()));
                             }
                           });
  if (at_peak) analyse(*at_peak);
  run.what = what;
  run.worst = std::move(worst);
  return run;
}

/// The scene with frames of the asked step, each taken at once by the paper's scheme: the joints
/// are solved exactly, their geometric stiffness is explicit.
std::shared_ptr<const Scene> at_step(Scene scene, double step) {
  scene.frame = step;
  scene.carried.reset();
  return std::make_shared<const Scene>(std::move(scene));
}

// Joints close exactly, as in engines with joint coordinates: the paper's drift law feeds gaps back
// into velocities, and drives chains of ball joints at a third of their largest step.
Settings explicit_settings() {
  Settings settings = kPaperSettings;
  settings.mode = Mode::kConst;
  settings.n = 1;
  settings.drift = Drift::kExact;
  return settings;
}

constexpr double kCompared = 1.0;  // time in which paths are compared [s]

/// Positions of a run at multiples of a time, interpolated. @param every [s] @param share that of
/// followed()
std::vector<std::vector<Vec3>> path_of(const std::shared_ptr<const Scene>& scene,
                                       const Settings& settings, double every, const Budget& budget,
                                       DoctorRun* run, double seconds, double share) {
  std::vector<std::vector<Vec3>> path;
  double next = every;
  double before = 0.0;
  std::vector<Vec3> x_before = initial_state(*scene).x;
  DoctorRun done =
      followed(scene, settings, seconds, budget, share, [&](const Simulator& simulator, bool) {
        const State& state = simulator.state();
        for (; next <= state.time + 1e-9 * every && next <= kCompared; next += every) {
          const double passed = (next - before) / (state.time - before);
          std::vector<Vec3>& x = path.emplace_back(state.x);
          for (std::size_t i = 0; i < x.size(); ++i) {
            x[i] = passed * state.x[i] + (1.0 - passed) * x_before[i];
          }
        }
        before = state.time;
        x_before = state.x;
      });
  if (run != nullptr) *run = std::move(done);
  return path;
}

double largest_distance(const std::vector<std::vector<Vec3>>& a,
                        const std::vector<std::vector<Vec3>>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    for (std::size_t body = 0; body < a[i].size(); ++body) {
      most = std::max(most, (a[i][body] - b[i][body]).norm());
    }
  }
  return most;
}

double smallest_step(const std::vector<GroupLimit>& limits) {
  double step = kNoLimit;
  for (const GroupLimit& limit : limits) step = std::min(step, limit.step);
  return step;
}

/// Adds to the armature of a joint. @return false if it has no coordinate
bool add_armature(Scene& scene, int joint, double armature) {
  const bool added = std::visit(
      [&](auto& of) {
        if constexpr (requires { of.armature; }) {
          of.armature = of.armature.value_or(0.0) + armature;
          return true;
        } else {
          return false;
        }
      },
      scene.joints[index(joint)]);
  scene.effects.armature = scene.effects.armature || added;
  return added;
}

/// What is wrong with a question, or nothing.
std::optional<std::string> fault_of(const DoctorQuestion& question) {
  const auto outside = [](double x, const Range& range) { return x != 0.0 && !range.contains(x); };
  if (!question.engine) return "there is no engine";
  if (outside(question.step, kStepRange)) {
    return "the step " + must_be(kStepRange.text(), number_text(question.step));
  }
  if (outside(question.seconds, kRunRange)) {
    return "the duration of a run " + must_be(kRunRange.text(), number_text(question.seconds));
  }
  if (question.held < 0 || question.held > kMostHeld) {
    return "the number of held steps " +
           must_be("from 0 to " + std::to_string(kMostHeld), std::to_string(question.held));
  }
  return std::nullopt;
}

class Doctor {
 public:
  Doctor(std::shared_ptr<const Scene> scene, DoctorQuestion question)
      : scene_(std::move(scene)), question_(question) {}

  Diagnosis answer() {
    Diagnosis& d = diagnosis_;
    if (auto refused = refusal_of(scene_.get())) {
      d.problem = *refused;
      return d;
    }
    if (auto fault = fault_of(question_)) {
      d.problem = *fault;
      return d;
    }
    if (question_.step == 0.0) question_.step = scene_->frame;
    if (question_.seconds == 0.0) {
      question_.seconds = std::min(scene_->criteria.duration, kMostSeconds);
    }
    d.question = question_;
    const State start = start_of_run(*scene_).state;
    models_ = LinearModel::of(*scene_, start);
    set_groups();
    d.start = limits_of(models_, 0.0, question_);
    narrowest_.add(d.start, start);
    for (const LinearModel& model : models_) {
      const std::span<const LinearModel::DriveTerm> terms(model.drives());
      for (std::size_t i = 0; i < terms.size();) {
        std::size_t of_joint = 1;
        while (i + of_joint < terms.size() && terms[i + of_joint].joint == terms[i].joint) {
          ++of_joint;
        }
        d.drives.push_back(drive_limit(terms.subspan(i, of_joint), question_));
        i += of_joint;
      }
    }
    d.findings = static_findings(*scene_, start);
    if (!question_.runs && !models_.empty()) {
      d.findings.push_back({false, "only the start was analysed: its motion may need less"});
    }
    if (question_.runs) {
      d.runs.push_back(analysed_run("from its start", scene_, question_, narrowest_));
      shaken_ = std::make_shared<const Scene>(shaken(*scene_));
      d.runs.push_back(analysed_run("after a shake", shaken_, question_, narrowest_));
    }
    set_limit();
    if (question_.runs) try_at_step();
    judge();
    if (question_.runs && d.verdict != Diagnosis::Verdict::kHolds) try_remedies();
    return d;
  }

 private:
  void set_groups() {
    Diagnosis& d = diagnosis_;
    std::size_t analysed = 0;
    for (const LinearModel& model : models_) {
      d.groups.push_back({model.bodies(), static_cast<int>(model.size()), model.redundant()});
      analysed += model.bodies().size();
    }
    std::size_t joined = 0;
    std::vector<std::uint8_t> seen(scene_->bodies.size());
    for (const Joint& joint : scene_->joints) {
      for (const int body : {base(joint).a, base(joint).b}) {
        if (is_fixed(*scene_, body) || std::exchange(seen[index(body)], 1) != 0) continue;
        ++joined;
      }
    }
    d.too_large = static_cast<int>(joined - analysed);
  }

  void consider(const GroupLimit& limit, const std::string& when) {
    Diagnosis& d = diagnosis_;
    if (!(limit.step < d.step)) return;
    d.step = limit.step;
    double by_drives = 0.0;
    for (const LinearModel::Share& drive : limit.drives) by_drives += drive.share;
    d.by_drive = by_drives > 0.5;
    if (d.by_drive) {
      d.joints = leading(limit.drives);
      d.limited_by = drives_text(d.joints) + when;
    } else if (!limit.joints.empty()) {
      d.joints = {limit.joints[0].index};
      d.limited_by = "the geometric stiffness of " + named_joint(*scene_, d.joints[0]) + when;
    }
  }

  /// The joints whose drives and springs make up half of the stiffness in a mode.
  /// @param drives largest first
  static std::vector<int> leading(const std::vector<LinearModel::Share>& drives) {
    std::vector<int> joints;
    double sum = 0.0;
    for (const LinearModel::Share& drive : drives) {
      if (sum > 0.5) break;
      joints.push_back(drive.index);
      sum += drive.share;
    }
    return joints;
  }

  [[nodiscard]] std::string drives_text(const std::vector<int>& joints) const {
    std::vector<std::string> names;
    bool are_drives = false;
    bool are_springs = false;
    for (const int joint : joints) {
      names.push_back(named_joint(*scene_, joint));
      are_drives = are_drives || drive_of(scene_->joints[index(joint)]) != nullptr;
      are_springs = are_springs || spring_of(scene_->joints[index(joint)]) != nullptr;
    }
    const bool are_many = names.size() > 1;
    std::string text = "the ";
    if (are_drives) text += are_many ? "drives" : "drive";
    if (are_drives && are_springs) text += " and ";
    if (are_springs) text += are_many ? "springs" : "spring";
    text += " of " + names[0];
    for (std::size_t i = 1; i < names.size(); ++i) {
      text += (i + 1 < names.size() ? ", " : " and ") + names[i];
    }
    return are_many ? text + " together" : text;
  }

  void set_limit() {
    Diagnosis& d = diagnosis_;
    for (const GroupLimit& limit : d.start) consider(limit, " at the start");
    for (const DoctorRun& run : d.runs) {
      for (const GroupLimit& limit : run.worst) {
        consider(limit, format_text(" at %.3g s of the run ", limit.time) + run.what);
      }
    }
    for (const DriveLimit& drive : d.drives) {
      if (!(drive.step < d.step)) continue;
      d.step = drive.step;
      d.by_drive = true;
      const bool late = drive.delay_step < drive.held_step && question_.held > 1;
      d.joints = {drive.joint};
      d.limited_by =
          drives_text(d.joints) + (late ? ", held over several steps with too little damping" : "");
    }
  }

  void try_at_step() {
    const auto scene = at_step(*shaken_, question_.step);
    Diagnosis& d = diagnosis_;
    d.at_step.emplace();
    path_ = path_of(scene, explicit_settings(), scene_->frame, question_.budget, &*d.at_step,
                    question_.seconds, question_.step / d.step);
    d.at_step->what = "after a shake, with this step";
    if (const auto rise = rise_of(*shaken_, question_.step)) {
      d.findings.push_back({true, rise_text(*rise)});
    }
    Settings fine;
    fine.mode = Mode::kConst;
    const double short_step = std::min(question_.step, d.step) / 16.0;
    fine.n = static_cast<int>(std::clamp(std::ceil(scene_->frame / short_step), 16.0, 512.0));
    fine_ = path_of(shaken_, fine, scene_->frame, question_.budget, nullptr,
                    std::min(kCompared, question_.seconds), 0.0);
  }

  /// The gain of energy by what the engine treats explicitly besides; nothing if it is small or is
  /// not known.
  [[nodiscard]] std::optional<EnergyRise> rise_of(const Scene& scene, double step) const {
    if (!question_.engine->explicit_velocities) return std::nullopt;
    return rise_by_velocity_forces(scene, step, question_.seconds);
  }
  static std::string rise_text(const EnergyRise& rise) {
    return format_text(
        "gyroscopic and Coriolis forces, which MuJoCo treats explicitly, raise the energy by "
        "%.3g J > %.3g J within %.3g s",
        rise.rise, rise.limit, rise.time);
  }

  void judge() {
    Diagnosis& d = diagnosis_;
    const double margin = d.step / question_.step;
    const bool fails =
        std::any_of(d.findings.begin(), d.findings.end(), [](const Finding& f) { return f.fails; });
    using Verdict = Diagnosis::Verdict;
    const bool run_fails = d.at_step && !d.at_step->holds;
    if (fails || run_fails || (margin < 1.0 && !d.at_step)) {
      d.verdict = Verdict::kFails;
    } else if (margin < 1.0) {
      d.verdict = d.by_drive ? Verdict::kFails : Verdict::kHoldsNarrowly;
    } else {
      d.verdict = margin < kSafeMargin ? Verdict::kHoldsNarrowly : Verdict::kHolds;
    }
  }

  void try_remedy(const std::string& text, const std::shared_ptr<const Scene>& scene,
                  const Settings& settings, double foretold) {
    TriedRemedy tried;
    tried.text = text;
    tried.step = foretold;
    DoctorRun run;
    const auto path = path_of(scene, settings, scene_->frame, question_.budget, &run,
                              question_.seconds, scene->frame / foretold);
    tried.holds = run.holds;
    tried.verdict = run.verdict;
    if (run.holds && run.by_shadow) tried.gain = run.gain;
    const bool is_engines = std::isfinite(foretold);  // not a method of substep
    if (const auto rise = is_engines ? rise_of(*scene, scene->frame) : std::nullopt) {
      tried.holds = false;
      tried.verdict = "fails: " + rise_text(*rise);
    }
    tried.operations = run.operations;
    const double unchanged = diagnosis_.at_step->operations;
    tried.cost = unchanged > 0.0 ? run.operations / unchanged : 1.0;
    tried.moved = largest_distance(path, fine_);
    diagnosis_.remedies.push_back(std::move(tried));
  }

  void try_remedies() {
    try_shorter_steps();
    try_remedy("substep's adaptive sub-steps", shaken_, Settings{}, kNoLimit);
    if (step_of_drives() >= kSafeMargin * question_.step) try_other_methods();
    try_armature();
    try_inertia();
  }

  /// The largest step that drives and springs alone allow, without geometric stiffness, as the
  /// engine treats them [s].
  [[nodiscard]] double step_of_drives() const {
    double step = kNoLimit;
    for (const DriveLimit& drive : diagnosis_.drives) step = std::min(step, drive.step);
    const auto consider_drives = [&](const std::vector<LinearModel>& models) {
      for (const LinearModel& model : models) {
        LinearSystem system = system_of(model, question_);
        system.stiffness -= model.geometric();
        step = std::min(step, known(largest_step(system).step));
      }
    };
    consider_drives(models_);
    if (narrowest_.state) consider_drives(LinearModel::of(*scene_, *narrowest_.state));
    return step;
  }

  /// They stabilise the geometric stiffness. What the engine treats explicitly in a drive is not in
  /// their runs.
  void try_other_methods() {
    const auto as_asked = at_step(*shaken_, question_.step);
    Settings damping = kPaperSettings;
    damping.mode = Mode::kDamping;
    try_remedy("the paper's damping at this step", as_asked, damping, kNoLimit);
    Settings newton = explicit_settings();
    newton.solver = SolverKind::kNewton;
    try_remedy("Newton's method at this step", as_asked, newton, kNoLimit);
  }

  /// From that with a margin on, halved until one holds.
  void try_shorter_steps() {
    constexpr int kMost = 4;
    constexpr double kShortest = 1e-5;  // of a frame [s]
    double step = std::min(diagnosis_.step / kSafeMargin, 0.5 * question_.step);
    for (int i = 0; i < kMost && step > kShortest; ++i, step *= 0.5) {
      try_remedy(format_text("a step of %.3g s", step), at_step(*shaken_, step),
                 explicit_settings(), diagnosis_.step);
      diagnosis_.remedies.back().shorter = step;
      if (diagnosis_.remedies.back().holds) return;
    }
  }

  /// The smallest foretold step of a changed model, at the start and at the narrowest state.
  [[nodiscard]] double foretold(const Scene& changed) const {
    double step = kNoLimit;
    for (const State& state :
         {start_of_run(changed).state, start_of_run(shaken(changed)).state, *narrowest_.state}) {
      step =
          std::min(step, smallest_step(limits_of(LinearModel::of(changed, state), 0.0, question_)));
    }
    return step;
  }

  /// The smallest power of two times `least` with which the step is foretold to hold.
  template <class Change>
  std::optional<double> enough(double least, Change&& change) const {
    constexpr int kMostDoublings = 24;
    double amount = least;
    for (int i = 0; i < kMostDoublings; ++i, amount *= 2.0) {
      if (foretold(change(amount)) >= kSafeMargin * question_.step) return amount;
    }
    return std::nullopt;
  }

  /// True if the model limits the step, not drives that are held.
  [[nodiscard]] bool is_narrow() const {
    return narrowest_.state && narrowest_.step < kSafeMargin * question_.step;
  }

  void try_armature() {
    if (!is_narrow()) return;
    const LinearModel model = LinearModel::of(*scene_, *narrowest_.state)[narrowest_.group];
    const StepLimit at = largest_step(system_of(model, question_));
    const auto coordinates = model.coordinates_of(at.mode);
    if (coordinates.empty() || !(coordinates[0].share > 0.0)) return;
    const double least = 0.01 / coordinates[0].share;
    const auto on_one = [&](double amount) {
      Scene changed = *scene_;
      add_armature(changed, coordinates[0].index, amount);
      return changed;
    };
    const auto on_all = [&](double amount) {
      Scene changed = *scene_;
      for (const auto& of : coordinates) add_armature(changed, of.index, amount);
      return changed;
    };
    std::string where = named_joint(*scene_, coordinates[0].index);
    std::optional<double> amount = enough(least, on_one);
    const bool one = amount.has_value();
    if (!one) {
      amount = enough(least, on_all);
      where = "every hinge and slide of the group";
    }
    if (!amount) return;
    const bool slides = axes_of(scene_->joints[index(coordinates[0].index)])->slides;
    const std::string text =
        format_text("an armature of %.3g %s on ", *amount, slides ? "kg" : "kg m^2") + where;
    const Scene changed = one ? on_one(*amount) : on_all(*amount);
    try_remedy(text, at_step(shaken(changed), question_.step), explicit_settings(),
               foretold(changed));
    diagnosis_.remedies.back().changed = std::make_shared<const Scene>(changed);
  }

  void try_inertia() {
    if (!is_narrow()) return;
    const LinearModel model = LinearModel::of(*scene_, *narrowest_.state)[narrowest_.group];
    const StepLimit at = largest_step(system_of(model, question_));
    const int body = model.bodies_of(at.mode)[0].index;
    const auto with = [&](double factor) {
      Scene changed = *scene_;
      changed.bodies[index(body)].inertia *= factor;
      return changed;
    };
    const std::optional<double> factor = enough(2.0, with);
    if (!factor) return;
    const Scene changed = with(*factor);
    try_remedy(
        format_text("%g times the moments of inertia of ", *factor) + named_body(*scene_, body),
        at_step(shaken(changed), question_.step), explicit_settings(), foretold(changed));
    diagnosis_.remedies.back().changed = std::make_shared<const Scene>(changed);
  }

  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const Scene> shaken_;
  DoctorQuestion question_;
  std::vector<LinearModel> models_;
  Narrowest narrowest_;
  Diagnosis diagnosis_;
  std::vector<std::vector<Vec3>> path_;
  std::vector<std::vector<Vec3>> fine_;
};

}  // namespace

std::vector<Finding> static_findings(const Scene& scene, const State& state) {
  std::vector<Finding> findings;
  if (!is_runnable(scene)) return findings;
  const auto warn = [&](std::string text) { findings.push_back({false, std::move(text)}); };
  std::vector<double> farthest(scene.bodies.size(), 0.0);  // joint from the centre of mass [m]
  for (const Joint& joint : scene.joints) {
    const JointBase& of = base(joint);
    farthest[index(of.a)] = std::max(farthest[index(of.a)], of.anchor_a.norm());
    if (of.b != kWorld) {
      farthest[index(of.b)] = std::max(farthest[index(of.b)], of.anchor_b.norm());
    }
    if (!is_fixed(scene, of.a) && !is_fixed(scene, of.b)) {
      const double a = scene.bodies[index(of.a)].mass;
      const double b = scene.bodies[index(of.b)].mass;
      const double ratio = std::max(a / b, b / a);
      if (ratio > kManyTimes) {
        warn(format_text("masses differ by a factor of %.3g across ", ratio) + of.name +
             ": iterative solvers converge slowly");
      }
    }
    const Drive* drive = drive_of(joint);
    const Spring* spring = spring_of(joint);
    if (drive != nullptr && drive->stiffness > 0.0 && drive->damping == 0.0 &&
        (spring == nullptr || spring->damping == 0.0) && armature_of(joint) == 0.0) {
      warn("the drive of " + of.name + " has a stiffness and neither damping nor armature");
    }
  }
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.is_static || farthest[i] == 0.0) continue;
    const double of = body.inertia.minCoeff() / (body.mass * farthest[i] * farthest[i]);
    if (of < kThin) {
      warn(
          format_text("the smallest moment of inertia of %s is %.2g of m r^2, r its farthest joint",
                      body.name.c_str(), of));
    }
  }
  Simulator simulator(std::make_shared<const Scene>(scene));
  const StartReport& start = simulator.start();
  if (start.failed) {
    warn("no consistent start was found: joints are open, or velocities do not fit them");
  } else if (start.projected) {
    warn("the start does not fit the joints: poses or velocities were corrected");
  }
  const FrameReport report = simulator.observe();
  if (report.inside > kOverlaps) {
    warn(format_text("%s and %s overlap at the start, by %.2g of the width of the smaller",
                     named_body(scene, report.inside_a).c_str(),
                     named_body(scene, report.inside_b).c_str(), report.inside));
  }
  for (const LinearModel& model : LinearModel::of(scene, state)) {
    if (model.redundant() == 0) continue;
    warn(format_text(
        "redundant joint rows in the group of %s: %d; its joint forces are not unique, and "
        "those of least norm are used",
        named_body(scene, model.bodies()[0]).c_str(), model.redundant()));
  }
  return findings;
}

Scene scene_at_step(const Scene& scene, double step, double gain) {
  Scene out = shaken(scene);
  out.frame = step;
  if (gain > 0.0) out.criteria.energy_gain = gain;
  out.settings = explicit_settings();
  out.recommended.reset();
  return out;
}

double gain_of(const Diagnosis& diagnosis, double step) {
  constexpr double kSlack = 1e-9;
  double gain = 0.0;
  const auto& run = diagnosis.at_step;
  if (run && run->holds && run->by_shadow && step == diagnosis.question.step) gain = run->gain;
  for (const TriedRemedy& tried : diagnosis.remedies) {
    if (tried.shorter == step) gain = tried.gain;
  }
  return gain * (1.0 + kSlack);
}

Diagnosis diagnose(std::shared_ptr<const Scene> scene, const DoctorQuestion& question) {
  return Doctor(std::move(scene), question).answer();
}

}  // namespace substep
