#pragma once

#include "app/lab/lab.hpp"
#include "app/lab/run_loop.hpp"

namespace substep {

/// The first screen of a visit: the opening scene twice on one clock, with adaptive sub-steps and,
/// beside it, with one step per frame, which tears. Both run live and start again together.
class Introduction {
 public:
  [[nodiscard]] bool open() const { return open_; }
  /// Shows it unless the person has left it at an earlier visit, or nothing is remembered.
  void offer(Lab& lab);
  /// Shows it. What runs now is started again when it is left.
  void start(Lab& lab);
  /// Before each picture: slow motion while the chain tears, and back to the start at the end.
  /// @param repeats otherwise it stops at the end
  void follow(Lab& lab, bool repeats) { loop_.follow(lab, repeats); }
  /// Starts what ran before.
  void leave(Lab& lab);
  /// The same where another run has begun already.
  void close(Lab& lab);

  /// How the run with one step per frame is judged; null where it is not there.
  [[nodiscard]] static const Verdict* torn(const Lab& lab);

 private:
  bool open_ = false;
  RunStart before_;
  RunLoop loop_;
};

}  // namespace substep
