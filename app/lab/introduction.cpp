#include "app/lab/introduction.hpp"

#include <utility>

namespace substep {
namespace {

constexpr std::string_view kIntroductionScene = "swinging_box";
constexpr const char* kIntroductionKey = "introduction";  // what Host::remember calls it
constexpr const char* kLeftOnce = "seen";

constexpr double kSlowMotion = 0.25;  // speed while the chain tears [-]
constexpr double kAftermath = 0.9;    // that is still seen in slow motion [s]
constexpr double kRewindTime = 4.0;   // the box has passed the lowest point, where N is largest [s]

}  // namespace

void Introduction::offer(Lab& lab) {
  // A shell that remembers nothing would show it at every start.
  if (lab.host.recall && lab.host.recall(kIntroductionKey) != kLeftOnce) start(lab);
}

void Introduction::start(Lab& lab) {
  const auto scene = lab.library.find(kIntroductionScene);
  if (open_ || !scene) return;
  before_ = lab.run_start();
  speed_before_ = lab.session.speed();
  lab.run(scene);
  lab.compare.start(lab.session, {{{"mode", "none"}}});
  lab.session.set_speed(kSlowMotion);
  lab.session.play();
  open_ = true;
}

const Verdict* Introduction::torn(const Lab& lab) {
  return lab.compare.open() ? &*lab.compare.runs().front().verdict : nullptr;
}

void Introduction::follow(Lab& lab, bool repeats) const {
  if (!open_ || !lab.session.playing()) return;
  const double time = lab.session.state().time;
  if (time >= kRewindTime && !repeats) return lab.session.pause();
  if (time >= kRewindTime) lab.reset();
  const Verdict* verdict = torn(lab);
  const bool over = verdict != nullptr && !verdict->holds() &&
                    lab.session.state().time > verdict->failed_at() + kAftermath;
  lab.session.set_speed(over ? 1.0 : kSlowMotion);
}

void Introduction::close(Lab& lab) {
  if (!std::exchange(open_, false)) return;
  lab.session.set_speed(speed_before_);
  if (lab.host.remember) lab.host.remember(kIntroductionKey, kLeftOnce);
}

void Introduction::leave(Lab& lab) {
  if (!open_) return;
  close(lab);
  lab.run(before_);
}

}  // namespace substep
