#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/lab/lab.hpp"
#include "app/lab/run_loop.hpp"
#include "app/ui/desk.hpp"

namespace substep {

struct App;

/// The guided tour: runs the experiment of a step in a loop, and restores the earlier run at the
/// end. Desk::tour is the current step.
class Tour {
 public:
  /// Goes to a step, or ends the tour. @param value "off" or a step number, from 1
  /// @return error message, or ""
  std::string go(App& app, std::string_view value);
  /// Call before each drawn frame: slow motion around failures, restart at the end.
  void follow(App& app);
  /// Ends it, restores the window and restarts the earlier run.
  void leave(App& app);
  /// Whether the run is of the scene of the current step.
  [[nodiscard]] bool runs(const App& app) const;
  /// Ends it when another run has already begun.
  void close(App& app);
  [[nodiscard]] const RunLoop& loop() const { return loop_; }

 private:
  /// The parts of the window that a step changes.
  struct Arrangement {
    Tab tab = Tab::kControls;
    DeskLevel level = DeskLevel::kLab;
    bool left_open = true;
    bool split = false;
    double span = 0.0;  // of the plots [s]
    std::array<bool, static_cast<std::size_t>(Plot::kCount)> shown{};
  };
  struct Before {
    RunStart run;
    std::vector<Overrides> compared;
    Arrangement arrangement;
  };
  static Arrangement arrangement_of(Desk& desk);
  static void arrange(Desk& desk, const Arrangement& arrangement);

  std::optional<Before> before_;
  bool opening_ = false;  // the link of a step
  RunLoop loop_;
};

}  // namespace substep
