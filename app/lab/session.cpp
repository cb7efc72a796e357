#include "app/lab/session.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/lab/library.hpp"
#include "core/io/saved_scene.hpp"

namespace substep {
namespace {

// The run as a scene for a file: parts that act only through a disabled effect are omitted.
Scene edition_of(const Scene& scene, const State& state, const Settings& settings) {
  Scene out = saved_scene(scene, state, settings);
  out.group = kOwnGroup;
  Effects& effects = out.effects;
  disable_dependents(effects);
  if (!effects.joints) out.joints.clear();
  for (Joint& joint : out.joints) {
    std::visit(
        [&](auto& own) {
          if constexpr (requires { own.motor; }) {
            if (!effects.limits) own.limit.reset();
            if (!effects.motors) own.motor.reset();
            if (!effects.drives) own.drive.reset();
            if (!effects.springs) own.spring.reset();
            if (!effects.joint_friction) own.friction.reset();
            if (!effects.armature) own.armature.reset();
          } else if constexpr (requires { own.limit; }) {  // a rope is nothing but a limit
            if (!effects.limits) own.limit->upper = kSizeRange.most;
          }
          if constexpr (requires { own.limit; }) {
            if (own.limit && !effects.restitution) own.limit->restitution = 0.0;
          }
        },
        joint);
  }
  effects.limits = effects.limits || needs_limits(out);  // of ropes
  for (Body& body : out.bodies) {
    if (!effects.friction) body.friction = 0.0;
    if (!effects.restitution) body.restitution = 0.0;
  }
  return out;
}

}  // namespace

Session::Session(std::shared_ptr<const Scene> scene, std::size_t past_bytes)
    : timeline_(past_bytes) {
  load(std::move(scene));
}

void Session::load(std::shared_ptr<const Scene> scene) {
  loaded_ = std::move(scene);
  scene_ = loaded_;
  log_.forget();
  make_simulator();
  ++generation_;
  restart();
  if (resumes_) play();
}

void Session::make_simulator() {
  simulator_ = std::make_unique<Simulator>(scene_);
  simulator_->set_budget(kWindowBudget);
  slices_.forget();
}

void Session::reset() {
  slices_.drop(*simulator_);
  const bool failed = !verdict_->holds();
  use_scene(loaded_);
  simulator_->reset();
  restart();
  if (failed && resumes_) play();
}

void Session::restart() {
  hand_.reset();
  if (const Settings* scripted = log_.restart(settings())) use_settings(*scripted);
  one_frame_ = just_failed_ = false;
  report_ = simulator_->observe();
  forces_ = {};
  verdict_ = std::make_unique<Verdict>(*scene_, state(), report_);
  account_.start(report_);
  history_.start(report_, scene_->frame, scene_->criteria.energy_scale.value_or(0.0));
  timeline_.start(moment());
  editions_.clear();
  trail_.clear();
  extend_trail();
  times_ = {};
  asked_ = achieved_ = 0.0;
  show_present();
}

void Session::use_scene(std::shared_ptr<const Scene> scene) {
  if (scene == scene_) return;
  const Settings settings = simulator_->settings();
  scene_ = std::move(scene);
  make_simulator();
  simulator_->set_settings(settings);
}

Moment Session::moment() const {
  return {scene_, settings(), state(), report_, *verdict_, forces_, account_};
}

// No interpolation between two frames remains.
void Session::show_present() {
  accumulator_ = 0.0;
  previous_ = {state().x, state().q};
  poses_ = previous_;
}

void Session::play() {
  playing_ = !stopped();
  resumes_ = false;
}

void Session::pause() {
  hold();
  resumes_ = false;
}

void Session::hold() {
  resumes_ = resumes_ || (playing_ && !one_frame_);
  playing_ = one_frame_ = false;
  slices_.drop(*simulator_);
}

void Session::set_settings(const Settings& settings) {
  slices_.drop(*simulator_);
  if (settings != this->settings()) slices_.forget();
  log_.choose(settings);
  simulator_->set_settings(settings);
}

// Continues in another scene from the current frame; the run no longer belongs to the loaded one.
void Session::continue_in(Scene scene, std::function<State(State)> carry) {
  forget_future();
  const std::shared_ptr<const Scene> from = scene_;
  State carried = carry(state());
  use_scene(std::make_shared<const Scene>(std::move(scene)));
  simulator_->set_state(std::move(carried));
  account_.edited(simulator_->observe());
  verdict_->disturb(state().time);
  // To keep links short, the run begins without the last forces.
  Scene edition = as_scene();
  edition.carried.reset();
  editions_.push_back({scene_, std::make_shared<const Scene>(std::move(edition)), state().frame});
  show_present();
  if (scene_edited) scene_edited({from, scene_, state().frame, std::move(carry)});
}

Scene Session::as_scene() const {
  Scene out = edition_of(*scene_, state(), settings());
  // The recommendation was found for the scene as loaded.
  if (scene_ != loaded_) out.recommended.reset();
  return out;
}

const Session::Edition* Session::edition() const {
  for (const Edition& edition : editions_) {
    if (edition.of == scene_) return &edition;
  }
  return nullptr;
}

void Session::extend_trail() {
  if (!scene_->criteria.track) return;
  trail_.push_back(state().x[static_cast<std::size_t>(*scene_->criteria.track)]);
  if (trail_.size() > kTrail) trail_.pop_front();
}

void Session::smooth_times() {
  const double weight = times_.total == 0.0 ? 1.0 : 0.03;
  for (double StageTimes::*stage :
       {&StageTimes::joints, &StageTimes::contact, &StageTimes::friction, &StageTimes::mass,
        &StageTimes::solve, &StageTimes::stiffness, &StageTimes::integrate, &StageTimes::total}) {
    times_.*stage += weight * (report_.times.*stage - times_.*stage);
  }
}

// Call before an action that happens between frames: completes a frame of single sub-steps if that
// is quick.
void Session::finish_partial_frame() {
  slices_.drop(*simulator_);
  if (substeps_left() == 0) return;
  if (slices_.quick()) {
    take_frame();
  } else {
    simulator_->set_state(substeps_from_);
  }
}

void Session::take_frame() {
  begin_frame();
  previous_ = {state().x, state().q};
  report_ = *slices_.advance(*simulator_, FrameSlices::Clock::time_point::max());
  end_frame();
}

// @return whether the runs compared with it have completed the frame
bool Session::end_frame() {
  forces_ = simulator_->constraint_forces();
  const bool held_so_far = verdict_->holds();
  verdict_->add(*scene_, state(), report_);
  just_failed_ = held_so_far && !verdict_->holds();
  if (stopped()) {
    hold();
  } else {
    account_.add(report_, hand_in_frame_);
    history_.add(report_, account_.put_in());
    extend_trail();
    smooth_times();
    timeline_.add(moment());
  }
  return !frame_taken || frame_taken();
}

// @return whether further frames may follow: a frame has ended, and no other run lags behind
bool Session::run_slice(FrameSlices::Clock::time_point until) {
  if (!slices_.open()) {
    begin_frame();
    previous_ = {state().x, state().q};
  }
  const std::optional<FrameReport> ended = slices_.advance(*simulator_, until);
  if (!ended) return false;
  report_ = *ended;
  const bool together = end_frame();
  accumulator_ -= scene_->frame;
  if (one_frame_) {
    pause();
    show_present();
  }
  return together;
}

void Session::step() {
  if (stopped() || step_in_past()) return;
  take_frame();
  show_present();
}

void Session::request_step() {
  pause();
  if (stopped() || step_in_past()) return;
  if (slices_.quick()) return step();
  if (substeps_left() > 0) simulator_->set_state(substeps_from_);
  playing_ = one_frame_ = true;
  run_slice(end_of_slice(kSlice));
}

void Session::substep() {
  if (stopped()) return;
  pause();
  const bool first = substeps_left() == 0;
  begin_frame();
  if (first) substeps_from_ = state();
  report_ = simulator_->substep();
  if (substeps_left() == 0) {
    end_frame();
  } else {
    forces_ = simulator_->constraint_forces();
  }
  show_present();
}

int Session::advance(double wall_dt, double budget) {
  if (!playing_) {
    accumulator_ = 0.0;
    update_poses();
    return 0;
  }
  constexpr double kLongestGap = 0.1;  // [s] of wall time
  const double gap = std::clamp(wall_dt, 0.0, kLongestGap);
  accumulator_ += gap * speed_;

  const auto until = end_of_slice(budget);
  const std::int64_t before = report_.frame;
  while (playing_ && (slices_.open() || one_frame_ || accumulator_ >= scene_->frame)) {
    if (!run_slice(until) || FrameSlices::Clock::now() >= until) break;
  }
  const double dropped = std::max(0.0, accumulator_ - scene_->frame);
  accumulator_ -= dropped;
  note_pace(wall_dt, gap * speed_ - dropped);
  update_poses();
  return static_cast<int>(report_.frame - before);
}

// Sums of the last seconds: the ratio is exact from the first call on, however rare calls are.
void Session::note_pace(double wall_dt, double achieved) {
  constexpr double kMemory = 2.0;     // [s]
  constexpr double kSuspended = 1.0;  // a longer gap is a suspended tab [s]
  const double wall = std::clamp(wall_dt, 0.0, kSuspended);
  const double kept = std::exp(-wall / kMemory);
  asked_ = kept * asked_ + wall * speed_;
  achieved_ = kept * achieved_ + achieved;
}

double Session::between() const {
  return playing_ ? std::clamp(accumulator_ / scene_->frame, 0.0, 1.0) : 1.0;
}

void Session::update_poses() {
  const State& now = state();
  if (!playing_) {
    poses_.x = now.x;
    poses_.q = now.q;
    return;
  }
  const double t = between();
  for (std::size_t i = 0; i < now.x.size(); ++i) {
    poses_.x[i] = previous_.x[i] + t * (now.x[i] - previous_.x[i]);
    poses_.q[i] = previous_.q[i].slerp(t, now.q[i]);
  }
}

}  // namespace substep
