// Construction and queries of a simulator.

#include <algorithm>
#include <utility>

#include "core/math/disjoint_sets.hpp"
#include "core/model/validate.hpp"
#include "core/sim/simulator_impl.hpp"
#include "core/stepping/gyroscopic_stage.hpp"

namespace substep {
namespace {

bool joints_form_loops(const Scene& scene) {
  const auto world = static_cast<int>(scene.bodies.size());
  const auto number_of = [&](int body) { return is_fixed(scene, body) ? world : body; };
  DisjointSets joined;
  joined.reset(scene.bodies.size() + 1);
  return std::any_of(scene.joints.begin(), scene.joints.end(), [&](const Joint& joint) {
    return !joined.unite(number_of(base(joint).a), number_of(base(joint).b));
  });
}

}  // namespace

Simulator::Impl::Impl(std::shared_ptr<const Scene> scene_in)
    : scene(std::move(scene_in)), settings(scene->settings), current(*scene) {
  Start begun = start_of_run(*scene);
  state = std::move(begun.state);
  start = begun.report;
  const Effects& effects = scene->effects;
  if (effects.joints) {
    joints = std::make_unique<JointStage>(*scene);
    mark_springs(*scene, state, *joints);
  }
  if (effects.joints && acts_on_coordinates(effects))
    coordinates = std::make_unique<CoordinateStage>(*scene);
  if (effects.contact) contact = std::make_unique<ContactStage>(*scene);
  if (effects.friction) friction = std::make_unique<FrictionStage>(*scene);
  if (effects.restitution) restitution = std::make_unique<RestitutionStage>(*scene);
  if (effects.joints || effects.gyroscopic) rotation = std::make_unique<RotationCriterion>(*scene);
  solver = make_solver(settings.solver);
  integrator = make_integrator(*scene, joints.get(), settings);
  all = whole(*scene);
  for (const Body& body : scene->bodies) {
    if (!body.is_static) heaviest = std::max({heaviest, body.mass, body.inertia.maxCoeff()});
  }

  // Reserves memory for contacts and a grab: a sub-step must not allocate when bodies touch.
  const std::size_t n = scene->bodies.size();
  const std::size_t n_blocks = (joints ? scene->joints.size() : 0) +
                               (coordinates ? coordinates->size() : 0) +
                               (contact ? 4 * n + 16 : 0) + 1;
  end_axes.resize(n);
  blocks.reserve(n_blocks);
  has_loops = joints && joints_form_loops(*scene);
  solver->reserve(n, n_blocks, has_loops);
  if (restitution) restitution->reserve(n_blocks);
  state.forces.reserve(n_blocks);
  before_frame.forces.reserve(n_blocks);
  before_frame.k.reserve(n);
  before_frame.own.reserve(n);
  before_frame.held.reserve(n);
  forces.reserve(n_blocks);
  index_of_last_frame.reserve(n_blocks);
  index_of_part.reserve(n_blocks);
  state.k.reserve(n);
  u_star.resize(n);
  w.resize(n, Vec6::Zero());
  motions.resize(n);
  gaps.reserve(n_blocks);
  corrected.reserve(n_blocks);
  openings.reserve(n_blocks);
  if (effects.gyroscopic) resize_torques(state);
}

Simulator::Simulator(std::shared_ptr<const Scene> scene) {
  Problems problems = scene ? check_values(*scene) : Problems{{"", "there is no scene"}};
  if (!problems.empty()) scene = std::make_shared<const Scene>();
  impl_ = std::make_unique<Impl>(std::move(scene));
  impl_->refused.scene = std::move(problems);
}
Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&& other) noexcept : Simulator(nullptr) { impl_.swap(other.impl_); }
Simulator& Simulator::operator=(Simulator&& other) noexcept {
  Simulator moved(std::move(other));
  impl_.swap(moved.impl_);
  return *this;
}

FrameReport Simulator::observe() const {
  FrameReport report;
  report.status = impl_->stopped.status;
  report.failed_body = impl_->stopped.failed_body;
  report.overrun = impl_->stopped.overrun;
  if (impl_->refused.any()) report.status = StepStatus::kInvalid;
  // With its own scratch memory: concurrent const calls are safe.
  std::vector<Mat3> axes;
  for (const Quat& q : impl_->state.q) axes.push_back(q.toRotationMatrix());
  std::optional<Detector> detector;
  if (impl_->contact) {
    detector.emplace(*impl_->scene);
    detector->set_limit(impl_->budget.contacts);
  }
  impl_->observe(Measures{}, axes, detector ? &*detector : nullptr, report);
  return report;
}

void Simulator::reset() { set_state(start_of_run(*impl_->scene).state); }
const StartReport& Simulator::start() const { return impl_->start; }

const Scene& Simulator::scene() const { return *impl_->scene; }
const State& Simulator::state() const { return impl_->state; }

void Simulator::set_state(State state) {
  impl_->refused.state = validate(state, *impl_->scene);
  if (!impl_->refused.state.empty()) return;
  impl_->refused.grab.clear();
  impl_->state = std::move(state);
  impl_->state.forces.reserve(impl_->blocks.capacity());  // later frames must not allocate
  impl_->state.k.reserve(impl_->state.x.size());
  impl_->grab.reset();
  impl_->blocks.clear();
  impl_->first_block = impl_->first_force = 0;
  impl_->open.reset();
  impl_->stopped = FrameReport{};
}

void Simulator::set_grab(const std::optional<Grab>& grab) {
  impl_->refused.grab = grab ? validate(*grab, *impl_->scene) : Problems{};
  if (impl_->refused.grab.empty()) impl_->grab = grab;
}
const std::optional<Grab>& Simulator::grab() const { return impl_->grab; }

Problems Simulator::problems() const { return impl_->refused.all(); }

const Budget& Simulator::budget() const { return impl_->budget; }

void Simulator::set_budget(const Budget& budget) {
  impl_->refused.budget = validate(budget);
  if (!impl_->refused.budget.empty()) return;
  impl_->budget = budget;
  if (impl_->contact) impl_->contact->detector().set_limit(budget.contacts);
}

void Simulator::set_measures(const Measures& measures) { impl_->measures = measures; }

const Settings& Simulator::settings() const { return impl_->settings; }

void Simulator::set_settings(const Settings& settings) {
  impl_->refused.settings = validate(settings);
  if (!impl_->refused.settings.empty()) return;
  const bool other_solver = settings.solver != impl_->settings.solver;
  Settings only_watched = impl_->settings;
  only_watched.watch_stiffness = settings.watch_stiffness;
  if (settings != only_watched) impl_->state.rest.clear();  // may move under new settings
  const bool other_integrator = other_solver || settings.integrator != impl_->settings.integrator ||
                                settings.forces != impl_->settings.forces;
  impl_->settings = settings;
  if (other_integrator) {
    impl_->integrator = make_integrator(*impl_->scene, impl_->joints.get(), settings);
  }
  if (!other_solver) return;
  impl_->solver = make_solver(settings.solver);
  impl_->solver->reserve(impl_->scene->bodies.size(), impl_->blocks.capacity(), impl_->has_loops);
}

}  // namespace substep
