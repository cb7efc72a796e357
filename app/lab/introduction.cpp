#include "app/lab/introduction.hpp"

#include <utility>

namespace substep {
namespace {

constexpr std::string_view kIntroductionScene = "swinging_box";
constexpr const char* kIntroductionKey = "introduction";  // key of Host::remember
constexpr const char* kLeftOnce = "seen";

// The box has passed the lowest point, where N is largest; the failure is shown in slow motion.
constexpr double kStill = 1.0;  // of a still picture: the chain has come apart [s]
constexpr RunLoop::Plan kLoop{.end = 4.0, .slow_until = 0.5};

}  // namespace

void Introduction::offer(Lab& lab) {
  // Without storage it would be shown on every start.
  if (lab.host.recall && lab.host.recall(kIntroductionKey) != kLeftOnce) start(lab);
}

void Introduction::start(Lab& lab) {
  const auto scene = lab.library.find(kIntroductionScene);
  if (open_ || !scene) return;
  before_ = lab.run_start();
  lab.run(scene);
  lab.compare.start(lab.session, {{{"mode", "none"}}});
  loop_.begin(lab, kLoop);
  lab.session.play();
  open_ = true;
  begun_ = false;
}

void Introduction::follow(Lab& lab, bool moves) {
  if (open_ && !std::exchange(begun_, true) && !moves) {
    lab.session.pause();
    while (lab.session.state().time < kStill && !lab.session.stopped()) lab.session.step();
  }
  loop_.follow(lab, moves);
}

const Verdict* Introduction::torn(const Lab& lab) {
  return lab.compare.open() ? &*lab.compare.runs().front().verdict : nullptr;
}

void Introduction::close(Lab& lab) {
  if (!std::exchange(open_, false)) return;
  loop_.end(lab);
  if (lab.host.remember) lab.host.remember(kIntroductionKey, kLeftOnce);
}

void Introduction::leave(Lab& lab) {
  if (!open_) return;
  close(lab);
  lab.run(before_);
}

}  // namespace substep
