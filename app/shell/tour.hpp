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

/// The guided tour: runs the experiment of a step in a loop, and gives back what was there before.
/// Desk::tour is the step that is shown.
class Tour {
 public:
  /// Goes to a step, or ends the tour. @param value "off" or the number of a step, from 1
  /// @return what is wrong with it, or ""
  std::string go(App& app, std::string_view value);
  /// Before each picture: slow motion where something breaks, and back to the start at the end.
  void follow(App& app);
  /// Ends it and starts what ran before, with the window as it was.
  void leave(App& app);
  /// The same where another run has begun already.
  void close(App& app);
  [[nodiscard]] const RunLoop& loop() const { return loop_; }

 private:
  /// What a step changes of the window.
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
  RunLoop loop_;
};

}  // namespace substep
