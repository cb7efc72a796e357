#pragma once

#include <memory>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// Steps one scene. Scene is const, State is a value, Settings may change between any two frames.
class Simulator {
 public:
  explicit Simulator(std::shared_ptr<const Scene> scene);
  ~Simulator();
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;

  /// One displayed frame of length scene().frame: Algorithm 1 of the paper. Never throws. After a
  /// status other than kOk the state is that of the last finite sub-step and further calls do
  /// nothing.
  FrameReport step();

  /// Energies and errors of the current state, without stepping. Rows and work are a frame's: 0
  /// here.
  [[nodiscard]] FrameReport observe() const;

  /// Back to the scene's start. Settings stay.
  void reset();

  [[nodiscard]] const Scene& scene() const;
  [[nodiscard]] const State& state() const;
  /// Goes on from a snapshot of the same scene.
  void set_state(State state);
  [[nodiscard]] const Settings& settings() const;
  void set_settings(const Settings& settings);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace substep
