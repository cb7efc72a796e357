#include "core/lab/reference.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "core/lab/closed_form.hpp"
#include "core/lab/energy_scale.hpp"
#include "core/lab/experiment.hpp"
#include "core/lab/joint_tree.hpp"
#include "core/lab/planar_chain.hpp"
#include "core/lab/slice.hpp"
#include "core/lab/verdict.hpp"
#include "core/model/validate.hpp"
#include "core/sim/simulator.hpp"

namespace substep {
namespace {

constexpr double kChaoticWindow = 2.0;  // [s]
constexpr double kUncertainty = 1e-10;  // of the integrator and of rounding over 10 s, of lengths
constexpr int kFinest = 256;            // sub-steps per frame
// A chain is exact for rigid hinges. With a larger stretch by compliance, the finest run is closer
// to the simulated motion.
constexpr double kMostStretch = 1e-5;  // of the length

struct Sample {
  Vec3 x = Vec3::Zero();  // of the tracked body [m]
  double kinetic = 0.0;   // [J]
};

}  // namespace

class ReferenceRun::Source {
 public:
  Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  virtual ~Source() = default;
  [[nodiscard]] virtual std::string name() const = 0;
  /// The next frame, or nothing if it needs more calls: each call is short, to keep a page
  /// responsive. @param t at its end [s]
  virtual std::optional<Sample> next(double t) = 0;
  /// Uncertainty of the positions until t [m].
  [[nodiscard]] virtual double uncertainty(double t) const = 0;
  /// Verdict of the run if it fails, else "".
  [[nodiscard]] virtual std::string failure() const { return ""; }
  /// Returns to the start, for a more certain run. @param path of the completed run, by frame [m]
  /// @return false if there is none, or it would exceed a limit
  virtual bool refine(const std::vector<Vec3>& path) {
    static_cast<void>(path);
    return false;
  }
};

namespace {

class ClosedForm final : public ReferenceRun::Source {
 public:
  ClosedForm(const Scene& scene, const UniformAcceleration& motion)
      : scene_(scene), motion_(motion) {}
  [[nodiscard]] std::string name() const override { return "exact: closed form"; }
  std::optional<Sample> next(double t) override {
    const Body& body = scene_.bodies[index(*scene_.criteria.track)];
    const Vec3 v = motion_.velocity + motion_.acceleration * t;
    // Free rotation conserves its kinetic energy.
    const Vec3 omega = body.orientation.conjugate() * body.angular_velocity;
    return Sample{motion_.at(t), 0.5 * body.mass * v.squaredNorm() +
                                     0.5 * omega.dot(body.inertia.cwiseProduct(omega))};
  }
  [[nodiscard]] double uncertainty(double) const override { return 0.0; }

 private:
  const Scene& scene_;
  UniformAcceleration motion_;
};

class MinimalCoordinates final : public ReferenceRun::Source {
 public:
  MinimalCoordinates(const Scene& scene, PlanarChain chain, double stretch)
      : scene_(scene), chain_(std::move(chain)), stretch_(stretch) {}
  [[nodiscard]] std::string name() const override {
    return "exact: minimal coordinates, " + std::to_string(chain_.size()) +
           (chain_.size() == 1 ? " angle" : " angles");
  }
  std::optional<Sample> next(double) override {
    chain_.advance(scene_.frame);
    return Sample{chain_.centre(*scene_.criteria.track), chain_.kinetic()};
  }
  // The stretch lengthens the period, so the delay grows with every swing.
  [[nodiscard]] double uncertainty(double t) const override {
    const double swung = t * std::sqrt(scene_.gravity.norm() / chain_.length());
    return kUncertainty * chain_.length() + stretch_ * (1.0 + swung);
  }

 private:
  const Scene& scene_;
  PlanarChain chain_;
  double stretch_;  // of all hinges by their compliance [m]
};

/// Trees in 3D can be chaotic: the integrator's error is estimated by a second tree with a larger
/// tolerance.
class TreeCoordinates final : public ReferenceRun::Source {
 public:
  TreeCoordinates(const Scene& scene, const JointTree& tree)
      : scene_(scene), fine_(tree), coarse_(tree), stretch_(tree.stretch()), left_(scene.frame) {
    coarse_.set_tolerance(100.0 * JointTree::kTolerance);
  }
  [[nodiscard]] std::string name() const override {
    return "exact: minimal coordinates, " + std::to_string(fine_.size()) +
           (fine_.size() == 1 ? " degree of freedom" : " degrees of freedom");
  }
  std::optional<Sample> next(double) override {
    for (int i = 0; i < std::max(1, kSlice / fine_.bodies()); ++i) {
      if (left_ > kNothingLeft * scene_.frame) {
        left_ -= (fine_done_ ? coarse_ : fine_).attempt(left_);
        continue;
      }
      left_ = scene_.frame;
      fine_done_ = !fine_done_;
      if (!fine_done_) return sample();
    }
    return std::nullopt;
  }
  [[nodiscard]] double uncertainty(double t) const override {
    const double reach = fine_.reach();  // a tree may have no arms
    const double swung = reach > 0.0 ? t * std::sqrt(scene_.gravity.norm() / reach) : 0.0;
    return kUncertainty * reach + apart_ + stretch_ * (1.0 + swung);
  }

 private:
  static constexpr int kSlice = 64;  // steps of single bodies in a call
  static constexpr double kNothingLeft = Extrapolation::kRounding;

  Sample sample() {
    const int body = *scene_.criteria.track;
    apart_ = std::max(apart_, (fine_.centre(body) - coarse_.centre(body)).norm());
    stretch_ = std::max(stretch_, fine_.stretch());
    return {fine_.centre(body), fine_.kinetic()};
  }

  const Scene& scene_;
  JointTree fine_;
  JointTree coarse_;
  double stretch_;          // of all joints by their compliance [m]
  double left_;             // of the frame [s]
  double apart_ = 0.0;      // [m]
  bool fine_done_ = false;  // with the frame that the coarse one is at
};

/// The scene itself, twice; refined, once more with twice the sub-steps.
class FinestRun final : public ReferenceRun::Source {
 public:
  FinestRun(const std::shared_ptr<const Scene>& scene, const Budget& budget)
      : scene_(scene), budget_(budget) {
    start();
    coarse_ = run_of(n_ / 2);
  }
  [[nodiscard]] std::string name() const override {
    return "finest run: bpp, leapfrog, " + std::to_string(n_) + " sub-steps per frame";
  }
  std::optional<Sample> next(double) override {
    Simulator& simulator = fine_done_ ? *coarse_ : *fine_;
    const FrameReport report = simulator.step_some(kPartWork);
    if (simulator.substeps_left() > 0) return std::nullopt;
    work_ += static_cast<double>(report.work.flops);
    if (!fine_done_) {
      fine_work_ += static_cast<double>(report.work.flops);
      kinetic_ = report.kinetic;
      verdict_->add(*scene_, fine_->state(), report);
    }
    if (coarse_) {
      fine_done_ = !fine_done_;
      if (fine_done_) return std::nullopt;
    }
    return sample();
  }
  [[nodiscard]] double uncertainty(double) const override { return apart_; }
  [[nodiscard]] std::string failure() const override {
    return verdict_->holds() ? "" : verdict_->text();
  }
  bool refine(const std::vector<Vec3>& path) override {
    if (2 * n_ > ReferenceRun::kMostSubsteps) return false;
    if (work_ + 2.0 * fine_work_ > ReferenceRun::kMostWork) return false;
    n_ *= 2;
    coarse_.reset();
    coarse_path_ = path;
    start();
    return true;
  }

 private:
  [[nodiscard]] std::unique_ptr<Simulator> run_of(int n) const {
    auto run = std::make_unique<Simulator>(scene_);
    run->set_budget(budget_);
    run->set_settings(reference_settings(*scene_, n));
    return run;
  }

  void start() {
    fine_ = run_of(n_);
    verdict_.emplace(*scene_, fine_->state(), fine_->observe());
    fine_work_ = 0.0;
    apart_ = 0.0;
    frame_ = 0;
  }

  Sample sample() {
    ++frame_;
    if (!scene_->criteria.track) return {Vec3::Zero(), kinetic_};
    const auto body = index(*scene_->criteria.track);
    const Vec3 x = fine_->state().x[body];
    const Vec3 coarse = coarse_ ? coarse_->state().x[body] : coarse_path_[frame_];
    apart_ = std::max(apart_, (x - coarse).norm());
    return {x, kinetic_};
  }

  std::shared_ptr<const Scene> scene_;
  Budget budget_;
  int n_ = kFinest;  // sub-steps per frame of the fine one
  std::unique_ptr<Simulator> fine_;
  std::unique_ptr<Simulator> coarse_;  // null once refined: then its path is known
  std::vector<Vec3> coarse_path_;      // by frame [m]
  std::optional<Verdict> verdict_;     // on the fine one
  std::size_t frame_ = 0;              // of the last sample
  bool fine_done_ = false;             // with the frame that the coarse one is at
  double kinetic_ = 0.0;               // of the fine one [J]
  double apart_ = 0.0;                 // [m]
  double work_ = 0.0;                  // of all runs [operations of the solver]
  double fine_work_ = 0.0;             // of the fine one [operations of the solver]
};

std::unique_ptr<ReferenceRun::Source> source_of(const std::shared_ptr<const Scene>& scene,
                                                const Budget& budget) {
  if (const auto motion = closed_form(*scene)) return std::make_unique<ClosedForm>(*scene, *motion);
  if (scene->criteria.track) {
    if (auto chain = PlanarChain::of(*scene)) {
      double compliance = 0.0;
      for (const Joint& joint : scene->joints) compliance += base(joint).compliance;
      const double stretch = compliance * chain->weight();
      if (stretch < kMostStretch * chain->length()) {
        return std::make_unique<MinimalCoordinates>(*scene, std::move(*chain), stretch);
      }
    }
    if (const auto tree = JointTree::of(*scene)) {
      return std::make_unique<TreeCoordinates>(*scene, *tree);
    }
  }
  return std::make_unique<FinestRun>(scene, budget);
}

}  // namespace

Settings reference_settings(const Scene& scene, int n) {
  Settings settings = own_settings(scene);
  settings.solver = SolverKind::kBpp;
  settings.mode = Mode::kConst;
  settings.integrator = Integrator::kLeapfrog;
  settings.drift = Drift::kAuto;
  settings.n = n;
  return settings;
}

double predictable_window(const Scene& scene, double duration) {
  if (scene.criteria.window) return std::min(duration, *scene.criteria.window);
  const bool chaotic = scene.effects.contact && !closed_form(scene);
  return chaotic ? std::min(duration, kChaoticWindow) : duration;
}

// References read the start from the scene's bodies, so these must hold the initial state of the
// runs.
ReferenceRun::ReferenceRun(std::shared_ptr<const Scene> scene, double duration,
                           const Budget& budget, double required)
    : required_(required) {
  if (auto refusal = refusal_of(scene.get())) {
    best_.emplace().failure = std::move(*refusal);
    done_ = true;
    return;
  }
  scene_ = with_start_of_run(std::move(scene));
  source_ = source_of(scene_, budget);
  frames_ = frames_of(*scene_, predictable_window(*scene_, duration));
  reference_.window = predictable_window(*scene_, duration);
  start();
}
ReferenceRun::~ReferenceRun() = default;
ReferenceRun::ReferenceRun(ReferenceRun&&) noexcept = default;
ReferenceRun& ReferenceRun::operator=(ReferenceRun&&) noexcept = default;

double ReferenceRun::time_of(std::int64_t frame) const {
  return static_cast<double>(frame) * scene_->frame;
}

void ReferenceRun::start() {
  frame_ = 0;
  kinetic_ = 0.0;
  reference_.track.clear();
  if (scene_->criteria.track) {
    reference_.track.push_back(scene_->bodies[index(*scene_->criteria.track)].position);
  }
}

bool ReferenceRun::advance() {
  if (done_ || !source_) return false;  // without a source it was moved
  if (frame_ < frames_) {
    const std::optional<Sample> sample = source_->next(time_of(frame_ + 1));
    if (!sample) return true;
    if (scene_->criteria.track) reference_.track.push_back(sample->x);
    kinetic_ = std::max(kinetic_, sample->kinetic);
    if (++frame_ < frames_) return true;
  }
  complete();
  const bool enough = best_->failure.empty() && best_->uncertainty <= required_;
  const bool refines = !enough && std::isfinite(required_) && in_vain_ < kMostInVain &&
                       source_->refine(reference_.track);
  if (refines) start();
  done_ = !refines;
  return refines;
}

void ReferenceRun::complete() {
  reference_.source = source_->name();
  reference_.uncertainty = source_->uncertainty(time_of(frame_));
  reference_.failure = source_->failure();
  if (scene_->criteria.energy_scale) {
    reference_.energy_scale = *scene_->criteria.energy_scale;
    reference_.energy_scale_source = "stated by the scene";
  } else if (kinetic_ > kLeastEnergyScale) {
    reference_.energy_scale = kinetic_;
    reference_.energy_scale_source = "largest kinetic energy of the reference";
  }
  const auto rank = [](const Reference& r) { return std::pair(!r.failure.empty(), r.uncertainty); };
  ++in_vain_;
  if (best_ && !(rank(reference_) < rank(*best_))) return;
  best_ = reference_;
  in_vain_ = 0;
}

double ReferenceRun::progress() const {
  return frames_ > 0 ? static_cast<double>(frame_) / static_cast<double>(frames_) : 1.0;
}

std::string ReferenceRun::source() const { return source_ ? source_->name() : ""; }

const Reference& ReferenceRun::reference() const {
  assert(done_ && "advance() until it returns false");
  return best_ ? *best_ : no_reference();
}

const Reference& no_reference() {
  static const Reference none;
  return none;
}

Reference find_reference(const std::shared_ptr<const Scene>& scene, double duration) {
  ReferenceRun run(scene, duration);
  while (run.advance()) {
  }
  return run.reference();
}

}  // namespace substep
