// Building a simulator, and everything around a frame.

#include <algorithm>
#include <cassert>
#include <limits>

#include "core/sim/energy.hpp"
#include "core/sim/simulator_impl.hpp"
#include "core/stepping/effective_mass.hpp"

namespace substep {

namespace {

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

StageTimes no_times() {
  StageTimes times;
  times.joints = times.contact = times.friction = times.grab = kNotMeasured;
  times.mass = times.solve = times.stiffness = times.integrate = kNotMeasured;
  return times;
}

}  // namespace

Simulator::Impl::Impl(std::shared_ptr<const Scene> scene_in)
    : scene(std::move(scene_in)), settings(scene->settings), state(initial_state(*scene)) {
  const Effects& effects = scene->effects;
  if (effects.joints) joints = std::make_unique<JointStage>(*scene);
  if (effects.contact) contact = std::make_unique<ContactStage>(*scene);
  if (effects.friction) friction = std::make_unique<FrictionStage>(*scene);
  if (effects.restitution) restitution = std::make_unique<RestitutionStage>(*scene);
  solver = make_solver(settings.solver);

  // Room for the contacts to come, and a hand: a sub-step must not allocate when bodies touch.
  const std::size_t n = scene->bodies.size();
  const std::size_t n_blocks = (joints ? scene->joints.size() : 0) + (contact ? 4 * n + 16 : 0) + 1;
  blocks.reserve(n_blocks);
  solver->reserve(n, n_blocks);
  state.forces.reserve(n_blocks);
  state.k.reserve(n);
  R_WB.resize(n);
  inverse_mass.resize(n);
  u_start.resize(n);
  u_before.resize(n);
}

RowCounts Simulator::Impl::rows_by_kind() const {
  RowCounts rows;
  for (const Block& block : blocks.all()) {
    if (block.is_contact()) {
      ++rows.contact;
      rows.friction += block.rows - 1;
    } else {
      rows.joint += block.rows;
    }
  }
  if (grab && blocks.size() > 0) {  // the last block is the hand's
    const int held = blocks.all().back().rows;
    rows.joint -= held;
    rows.grab = held;
  }
  return rows;
}

bool Simulator::Impl::probe_due() const {
  const bool reads_stiffness = chooses_substeps(settings.mode) || changes_mass(settings.mode);
  // Mode stiffness reads more of K than other modes leave behind.
  const bool known =
      state.stiffness_known && (settings.mode != Mode::kStiffness || !state.K_resisting.empty());
  return settings.probe && reads_stiffness && !known;
}

// One solve of a whole frame with the errors zeroed: its forces, not its motion, are kept.
void Simulator::Impl::probe(FrameReport& report) {
  const double h = scene->frame;
  const Settings chosen = settings;
  settings.mode = Mode::kNone;               // Mt = M: there is no k to damp by yet
  settings.integrator = Integrator::kEuler;  // forces act for the whole of h
  begin_substep(report);
  const bool has_rows = append_rows(report);
  if (has_rows) {
    external_forces(h, report);
    solve(h, true, report);
  }
  settings = chosen;
  if (has_rows && finite(report) && evaluate_stiffness(report)) state.r = bound.r;
  std::copy(u_start.begin(), u_start.end(), state.u.begin());
  state.stiffness_known = true;
  report.status = StepStatus::kOk;  // what the probe cannot tell, the frame will
  report.failed_body = -1;
  report.n_substeps = 0;
  report.stages.probe = true;
}

void Simulator::Impl::begin_frame() {
  FrameReport report;
  if (!measures.stages) report.times = no_times();
  contacts_foreseen = false;
  if (probe_due()) probe(report);  // the first frame has no lambda yet
  open.emplace(OpenFrame{SubstepClock(settings, scene->frame, state.r), report});
}

FrameReport Simulator::Impl::end(StageClock& wall) {
  auto& [substeps, report] = *open;
  const bool done = report.status != StepStatus::kOk || !substeps.running();
  if (done) {
    close(substeps, report);
  } else {
    observe(measures, report);
  }
  wall.lap(report.times.total);
  const FrameReport result = report;
  if (done) open.reset();
  return result;
}

void Simulator::Impl::close(const SubstepClock& clock_of_frame, FrameReport& report) {
  report.n_wanted = clock_of_frame.n_wanted();
  report.capped = clock_of_frame.capped();
  if (report.status == StepStatus::kOk) {
    state.r = clock_of_frame.r();
    state.stiffness_known = report.stages.stiffness;
    if (!state.stiffness_known) {  // an old K must not be taken for this frame's
      state.k.clear();
      state.K_resisting.clear();
      state.r = 0.0;
    }
    ++state.frame;
    state.time = static_cast<double>(state.frame) * scene->frame;  // no sum of rounded sub-steps
  }
  report.stages.joints = joints != nullptr;
  report.stages.contact = contact != nullptr;
  report.stages.friction = friction != nullptr;
  report.stages.restitution = restitution != nullptr;
  report.work.residual =
      measures.errors ? lcp_residual({blocks.all(), inverse_mass, state.u}) : kNotMeasured;
  const RowCounts rows = rows_by_kind();
  report.joint_rows = static_cast<int>(rows.joint + rows.grab);
  report.contact_rows = static_cast<int>(rows.contact);
  report.friction_rows = static_cast<int>(rows.friction);
  observe(measures, report);
  if (report.status != StepStatus::kOk) stopped = report;
}

void Simulator::Impl::observe(const Measures& asked, FrameReport& report) {
  report.frame = state.frame;
  report.time = state.time;
  report.dt_stable = stable_step(settings.alpha, state.r);
  if (!state.k.empty()) {
    const StiffnessBound who = StiffnessStage::bound(*scene, state.k);
    report.leader = {who.body, who.dof, who.k, who.mass, who.r};
  }
  Energies energies{kNotMeasured, kNotMeasured};
  if (asked.energies) energies = energies_of(*scene, state);
  report.kinetic = energies.kinetic;
  report.potential = energies.potential;
  report.energy = energies.kinetic + energies.potential;
  if (!asked.errors) {
    report.constraint_error = report.joint_gap = report.penetration = kNotMeasured;
    return;
  }
  for (std::size_t i = 0; i < state.q.size(); ++i) R_WB[i] = state.q[i].toRotationMatrix();
  if (joints) {
    const JointErrors errors = joints->errors(*scene, state, R_WB);
    report.constraint_error = errors.sum;
    report.joint_gap = errors.gap;
    report.joint_gap_joint = errors.joint;
  }
  if (contact) report.penetration = contact->penetration(*scene, state, R_WB);
}

Simulator::Simulator(std::shared_ptr<const Scene> scene)
    : impl_(std::make_unique<Impl>(std::move(scene))) {}
Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;

FrameReport Simulator::observe() const {
  FrameReport report;
  report.status = impl_->stopped.status;
  report.failed_body = impl_->stopped.failed_body;
  impl_->observe(Measures{}, report);
  return report;
}

void Simulator::reset() { set_state(initial_state(*impl_->scene)); }

const Scene& Simulator::scene() const { return *impl_->scene; }
const State& Simulator::state() const { return impl_->state; }

void Simulator::set_state(State state) {
  assert(state.x.size() == impl_->scene->bodies.size() &&
         "a state goes on in the scene it is from");
  impl_->state = std::move(state);
  impl_->state.forces.reserve(impl_->blocks.capacity());
  impl_->grab.reset();
  impl_->blocks.clear();
  impl_->open.reset();
  impl_->stopped = FrameReport{};
}

void Simulator::set_grab(const std::optional<Grab>& grab) {
  assert((!grab || !impl_->scene->bodies[static_cast<std::size_t>(grab->body)].is_static) &&
         "what is held can move");
  impl_->grab = grab;
}
const std::optional<Grab>& Simulator::grab() const { return impl_->grab; }

ConstraintForces Simulator::constraint_forces() const {
  ConstraintForces out;
  const auto pulled = [](const Block& block) -> Eigen::Vector3f {
    return Vec3(block.lambda[0], block.lambda[1], block.lambda[2]).cast<float>();
  };
  for (const Block& block : impl_->blocks.all()) {
    if (block.is_contact()) {
      Vec3 force = block.lambda[0] * block.n;
      if (block.rows == 3) force += block.lambda[1] * block.t1 + block.lambda[2] * block.t2;
      out.contacts.push_back({block.body_a, block.body_b, block.r_a.cast<float>(),
                              block.n.cast<float>(), force.cast<float>(),
                              static_cast<float>(block.phi[0])});
    } else if (block.id < impl_->scene->joints.size()) {  // and not the hand
      JointForce& force = out.joints.emplace_back();
      force.force = pulled(block);
      if (block.kind == BlockKind::kHinge) {
        const Vec3 torque = block.lambda[3] * block.axis.cross(block.v1) +
                            block.lambda[4] * block.axis.cross(block.v2);
        force.torque = torque.cast<float>();
      }
    }
  }
  return out;
}

void Simulator::set_measures(const Measures& measures) { impl_->measures = measures; }

const Settings& Simulator::settings() const { return impl_->settings; }

void Simulator::set_settings(const Settings& settings) {
  const bool other_solver = settings.solver != impl_->settings.solver;
  impl_->settings = settings;
  if (!other_solver) return;
  impl_->solver = make_solver(settings.solver);
  impl_->solver->reserve(impl_->scene->bodies.size(), impl_->blocks.capacity());
}

}  // namespace substep
