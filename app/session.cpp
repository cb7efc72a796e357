#include "app/session.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace substep {
namespace {

constexpr std::size_t kTrailFrames = 150;

}  // namespace

Session::Session(std::shared_ptr<const Scene> scene) { load(std::move(scene)); }

void Session::load(std::shared_ptr<const Scene> scene) {
  scene_ = std::move(scene);
  simulator_ = std::make_unique<Simulator>(scene_);
  ++generation_;
  restart();
}

void Session::reset() {
  simulator_->reset();
  restart();
}

void Session::restart() {
  report_ = simulator_->observe();
  verdict_ = std::make_unique<Verdict>(*scene_, state(), report_);
  history_.start(report_, scene_->frame);
  previous_ = {state().x, state().q};
  poses_ = previous_;
  trail_.clear();
  extend_trail();
  times_ = {};
  accumulator_ = 0.0;
  pace_ = 1.0;
}

void Session::extend_trail() {
  if (!scene_->criteria.track) return;
  trail_.push_back(state().x[static_cast<std::size_t>(*scene_->criteria.track)]);
  if (trail_.size() > kTrailFrames) trail_.pop_front();
}

void Session::smooth_times() {
  const auto settle = [first = times_.total == 0.0](double& mean, double now) {
    mean += (first ? 1.0 : 0.03) * (now - mean);
  };
  settle(times_.joints, report_.times.joints);
  settle(times_.contact, report_.times.contact);
  settle(times_.friction, report_.times.friction);
  settle(times_.mass, report_.times.mass);
  settle(times_.solve, report_.times.solve);
  settle(times_.stiffness, report_.times.stiffness);
  settle(times_.integrate, report_.times.integrate);
  settle(times_.total, report_.times.total);
}

void Session::take_frame() {
  previous_ = {state().x, state().q};
  report_ = simulator_->step();
  verdict_->add(*scene_, state(), report_);
  if (stopped()) {
    pause();
  } else {
    history_.add(report_);
    extend_trail();
    smooth_times();
  }
  if (frame_taken) frame_taken();
}

void Session::step() {
  if (stopped()) return;
  take_frame();
  accumulator_ = 0.0;
  previous_ = {state().x, state().q};
  update_poses();
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

  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  int frames = 0;
  while (playing_ && accumulator_ >= scene_->frame) {
    take_frame();
    accumulator_ -= scene_->frame;
    ++frames;
    if (std::chrono::duration<double>(Clock::now() - begin).count() > budget) break;
  }
  const double asked = std::max(gap * speed_, 1e-9);
  const double dropped = std::max(0.0, accumulator_ - scene_->frame);
  accumulator_ -= dropped;
  pace_ += 0.05 * (std::max(0.0, 1.0 - dropped / asked) - pace_);
  update_poses();
  return frames;
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
