// User actions on a run: applying, recording and replaying them.

#include <utility>

#include "app/lab/session.hpp"

namespace substep {

void Session::grab(int body, const Vec3& anchor, const Vec3& target) {
  const std::optional<Vec3> reached = hand_target(target);
  if (!reached) return;
  forget_future();
  log_.take_over();
  hand_ = Grab{body, anchor, *reached, joined_mass(*scene_, body)};
  verdict_->disturb(state().time);
}

void Session::pull_to(const Vec3& target) {
  if (!hand_) return;
  if (const std::optional<Vec3> reached = hand_target(target)) hand_->target = *reached;
}

void Session::throw_ball(const Ball& ball) {
  finish_partial_frame();
  if (stopped()) return;
  log_.take_over();
  put_ball(ball);
}

void Session::set_effects(const Effects& effects) {
  finish_partial_frame();
  if (stopped() || effects == scene_->effects) return;
  log_.take_over();
  put_effects(effects);
}

// Replaces the oldest ball once the maximum is reached.
void Session::put_ball(const Ball& ball) {
  const std::size_t slot = loaded_->bodies.size() + log_.balls() % Ball::kMost;
  continue_in(with_ball(*scene_, ball, slot),
              [ball, slot](State state) { return with_ball(std::move(state), ball, slot); });
  log_.add(state().frame, ball);
}

void Session::put_effects(const Effects& effects) {
  Scene scene = *scene_;
  scene.effects = effects;
  continue_in(std::move(scene), [](State state) {
    state.rest.clear();  // sleeping bodies may fall without them
    return state;
  });
  log_.add(state().frame, effects);
}

void Session::follow(std::vector<RunEvent> script) { log_.follow(std::move(script), settings()); }

void Session::use_settings(const Settings& settings) {
  Settings s = settings;
  s.watch_stiffness = this->settings().watch_stiffness;  // a display setting
  simulator_->set_settings(s);
}

void Session::hold_body(const std::optional<Pull>& pull) {
  if (!pull) {
    hand_.reset();
    return;
  }
  hand_ = Grab{pull->body, pull->anchor, pull->target, joined_mass(*scene_, pull->body)};
}

void Session::act(const RunEvent& event) {
  if (const auto* ball = std::get_if<Ball>(&event.what)) put_ball(*ball);
  if (const auto* effects = std::get_if<Effects>(&event.what)) put_effects(*effects);
  if (const auto* settings = std::get_if<Settings>(&event.what)) use_settings(*settings);
  if (std::holds_alternative<LetGo>(event.what)) hold_body(std::nullopt);
  if (const auto* pull = std::get_if<Pull>(&event.what)) {
    hold_body(*pull);
    verdict_->disturb(state().time);
  }
}

void Session::begin_frame() {
  forget_future();
  if (substeps_left() == 0) {
    log_.note(state().frame, settings());
    const double accumulated = accumulator_;
    while (const RunEvent* event = log_.next(state().frame)) act(*event);
    accumulator_ = accumulated;
    log_.note(state().frame, hand_ ? std::optional(Pull{hand_->body, hand_->anchor, hand_->target})
                                   : std::nullopt);
  }
  hand_in_frame_ = hand_.has_value() || (hand_in_frame_ && substeps_left() > 0);
  simulator_->set_grab(hand_);
}

}  // namespace substep
