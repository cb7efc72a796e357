#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "core/lab/passage.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// Smallest width of the smaller of two bodies [m].
inline double smaller_width(const Scene& scene, int a, int b) {
  return 2.0 * std::min(half_width(scene.bodies[index(a)].shape),
                        half_width(scene.bodies[index(b)].shape));
}

/// A limit and the value that exceeds it.
struct Exceeded {
  enum class What { kJointGap, kEnergyGain, kMoved, kOverlap, kPassage };
  What what = What::kJointGap;
  double value = 0.0;  // [m], of an energy [J]; of a passage Passage::depth
  double limit = 0.0;  // in the same unit
  std::string name;    // of the joint, body or bodies, empty for an energy
  int body = -1;       // index of the body, of two the one that moves; -1 for a joint or an energy
};

/// The energy of a run against its own scale, the energy that the motion has exchanged so far: the
/// largest kinetic energy, or the range of the potential or of the elastic energy.
/// Over its lowest value the energy may rise by at most 10 % of that scale, and by at most 1 % for
/// half a second: every integrator makes the energy oscillate, and what counts is a gain that
/// stays. In the first half second, while the scale is still small, it may rise by 25 %. Work
/// of parting the overlaps of the start is no gain, until these are parted, and up to that of
/// lifting every body by the deepest of them times their number. Joints too stiff to be springs
/// store energy that is not in the sum: a rise by as much is allowed besides, and for noise at rest
/// 1e-4 of the weight times the size of the bodies. One scale for all: a heavy body that falls can
/// hide a gain of light ones.
class EnergyWatch {
 public:
  EnergyWatch(const Scene& scene, const FrameReport& start);
  void add(const FrameReport& report);
  /// A rise and its limit [J].
  struct Rise {
    double rise = 0.0;
    double limit = 0.0;
  };
  /// Of the two, that which is closer to its limit or further beyond it.
  [[nodiscard]] Rise worst() const;

 private:
  /// The values of an energy so far [J].
  struct Span {
    double least = 0.0;
    double most = 0.0;

    void add(double value);
    [[nodiscard]] double width() const { return most - least; }
  };

  double lowest_;         // before this period of half a second [J]
  double period_lowest_;  // in it [J]
  std::int64_t period_ = 0;
  double rise_ = 0.0;       // now [J]
  double sustained_ = 0.0;  // largest rise of the lowest energy of a period [J]
  double kinetic_ = 0.0;    // largest so far [J]
  Span potential_;
  Span elastic_;
  bool parts_ = false;    // overlaps of the start are left
  double parting_ = 0.0;  // sum of FrameReport::parting while there were [J]
  double most_parting_ = 0.0;
  double stiff_ = 0.0;    // largest energy of stiff joints so far [J]
  double besides_ = 0.0;  // noise [J]
};

/// Checks a run: the single implementation for browser, command line and tests. The limits are the
/// scene's criteria. Where the scene states none, they follow from its sizes and energies:
///
/// - a joint that is no spring is torn at a gap of a tenth of its size, largest_gap();
/// - the energy may rise as EnergyWatch says, unless a constant torque does work;
/// - bodies without a spring between them may overlap by a quarter of the width of the smaller, or
///   by as much as they did at the start.
///
/// Bodies that collide must not pass through each other in any scene, PassageWatch.
class Verdict {
 public:
  /// @param start report of the initial state of the run (Simulator::observe)
  Verdict(const Scene& scene, const State& state, const FrameReport& start);

  /// Whether the scene can run; if not, the first frame fails.
  [[nodiscard]] bool refused() const { return refused_; }
  /// Checks one more frame. The first failure is final.
  void add(const Scene& scene, const State& state, const FrameReport& report);

  /// The user has interfered: from now on energy and displacement are not checked; torn joints and
  /// non-finite numbers still are. @param time [s]
  void disturb(double time);

  [[nodiscard]] bool holds() const { return !failed_; }
  [[nodiscard]] bool disturbed() const { return disturbed_; }
  [[nodiscard]] double failed_at() const { return failed_at_; }  ///< [s], for a failed run
  /// True if the simulator cannot continue: StepStatus.
  [[nodiscard]] bool stopped() const { return stopped_; }
  /// The largest ratio of a criterion's value to its limit so far [-].
  [[nodiscard]] double utilisation() const { return utilisation_; }
  /// The criterion that failed the run; empty if it holds or cannot continue.
  [[nodiscard]] const std::optional<Exceeded>& exceeded() const { return exceeded_; }
  /// "holds", "disturbed at 1.20 s", or "fails at 0.352 s: joint gap 0.13 m > 0.1 m (link_3)".
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  bool refused_;  // a scene that cannot run, or a state of another scene
  bool failed_ = false;
  bool disturbed_ = false;
  bool stopped_ = false;
  double failed_at_ = 0.0;
  double utilisation_ = 0.0;
  double energy_at_start_ = 0.0;
  std::optional<EnergyWatch> energy_;     // if the scene states no limit
  std::optional<PassageWatch> passages_;  // if there are contacts
  bool judges_overlaps_ = false;
  double inside_at_start_ = 0.0;  // worst FrameReport::inside at the start, less as it is parted
  Vec3 watched_start_ = Vec3::Zero();
  std::optional<Exceeded> exceeded_;
  std::string text_ = "holds";
};

}  // namespace substep
