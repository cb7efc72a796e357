#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "app/lab/energy_account.hpp"
#include "core/lab/verdict.hpp"
#include "core/model/scene.hpp"
#include "core/sim/constraint_forces.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// A run at the end of a frame: enough to draw it and to continue it bit for bit.
struct Moment {
  std::shared_ptr<const Scene> scene;  // edits change the scene
  Settings settings;                   // of its frame
  State state;
  FrameReport report;
  Verdict verdict;
  ConstraintForces forces;
  EnergyAccount account;
};

/// The moments of a run, oldest first, and the index of the current one. When the memory limit is
/// reached, every second moment of the older half is removed: recent frames are complete, distant
/// ones increasingly sparse. The start is always kept.
class Timeline {
 public:
  static constexpr std::size_t kBytes = std::size_t{64} << 20U;
  explicit Timeline(std::size_t bytes = kBytes) : most_bytes_(bytes) {}

  /// Clears everything; the moment is the start of a run.
  void start(Moment moment);
  /// Discards later moments and appends this one as the current one.
  void add(Moment moment);
  void cut();
  void go_to(std::size_t index);

  [[nodiscard]] std::size_t size() const { return moments_.size(); }
  [[nodiscard]] std::size_t index() const { return index_; }
  [[nodiscard]] bool at_end() const { return index_ + 1 == moments_.size(); }
  [[nodiscard]] const Moment& operator[](std::size_t i) const { return moments_[i]; }
  [[nodiscard]] const Moment& now() const { return moments_[index_]; }
  [[nodiscard]] const Moment& last() const { return moments_.back(); }
  /// Index of the moment closest to a time. @param time [s]
  [[nodiscard]] std::size_t at_time(double time) const;
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  void thin();

  std::vector<Moment> moments_;
  std::size_t index_ = 0;
  std::size_t bytes_ = 0;
  std::size_t most_bytes_;
};

}  // namespace substep
