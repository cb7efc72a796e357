#pragma once

#include "app/lab/lab.hpp"
#include "app/lab/run_loop.hpp"

namespace substep {

/// The first screen of a visit: the opening scene twice on one clock, with adaptive sub-steps and
/// with one step per frame, which tears. Both run live and restart together.
class Introduction {
 public:
  [[nodiscard]] bool open() const { return open_; }
  /// Shows it unless the user dismissed it on an earlier visit or nothing can be stored.
  void offer(Lab& lab);
  /// Shows it. Leaving it restarts the current run.
  void start(Lab& lab);
  /// Call before each drawn frame: slow motion while the chain tears, restart at the end.
  /// @param moves false (reduced motion): a still picture after the failure, until it is played,
  /// and then once
  void follow(Lab& lab, bool moves);
  /// Closes it and restarts the earlier run.
  void leave(Lab& lab);
  /// Closes it when another run has already begun.
  void close(Lab& lab);

  /// Verdict of the run with one step per frame; null if there is no such run.
  [[nodiscard]] static const Verdict* torn(const Lab& lab);

 private:
  bool open_ = false;
  bool begun_ = false;  // a frame was shown
  RunStart before_;
  RunLoop loop_;
};

}  // namespace substep
