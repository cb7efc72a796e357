#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "app/cli/cancel.hpp"
#include "app/cli/checks.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/message.hpp"
#include "core/lab/presets.hpp"
#include "scenes/generator/hard_set.hpp"

namespace substep::cli {
namespace {

struct Candidate {
  std::string name;
  Settings settings;
};

std::vector<Candidate> candidates() {
  std::vector<Candidate> all;
  for (const Preset& preset : presets()) all.push_back({std::string(preset.name), preset.settings});
  const auto add = [&](const char* name, Settings settings) { all.push_back({name, settings}); };
  const Integrator leapfrog = Integrator::kLeapfrog;
  const Drift soft = Drift::kSoft;
  add("adaptive 0.1, soft", PaperSettings{.drift = soft});
  add("adaptive 0.3, leapfrog, soft",
      PaperSettings{.alpha = 0.3, .integrator = leapfrog, .drift = soft});
  add("capped 16 + damping, 0.3, soft",
      PaperSettings{.mode = Mode::kCapped, .alpha = 0.3, .n_cap = 16, .drift = soft});
  add("inertia from 8, 0.3, leapfrog, soft",
      PaperSettings{
          .mode = Mode::kInertia, .alpha = 0.3, .n_cap = 8, .integrator = leapfrog, .drift = soft});
  add("damping", PaperSettings{.mode = Mode::kDamping});
  add("newton, one step", PaperSettings{.solver = SolverKind::kNewton, .mode = Mode::kNone});
  add("const 16", PaperSettings{.mode = Mode::kConst, .n = 16});
  add("const 32", PaperSettings{.mode = Mode::kConst, .n = 32});
  return all;
}

class HardTable {
 public:
  explicit HardTable(int jobs) : set_(scenes::hard_set()), candidates_(candidates()) {
    for (const scenes::HardCase& hard : set_) {
      const auto scene = std::make_shared<const Scene>(hard.scene);
      for (const Candidate& candidate : candidates_) {
        checks_.push_back({.scene = scene, .cell = {candidate.settings, {}}});
      }
    }
    complete_ = run_checks(
        checks_, jobs,
        [&](const Check& check) {
          const auto i = static_cast<std::size_t>(&check - checks_.data());
          complain("%4zu of %zu  %-26s %-38s %6.1f s  %s", i + 1, checks_.size(),
                   check.scene->name.c_str(), candidates_[i % candidates_.size()].name.c_str(),
                   check.seconds, check.metrics.verdict.c_str());
        },
        cancel_on_signal());
  }

  void print_settings() const {
    std::printf(
        "| setting | holds | sub-steps per frame | work relative to const 32 | does not hold |\n"
        "|---|---|---|---|---|\n");
    const std::size_t reference = candidates_.size() - 1;
    for (std::size_t j = 0; j < candidates_.size(); ++j) {
      std::size_t holds = 0;
      double substeps = 0.0;
      double frames = 0.0;
      double ratios = 0.0;  // sum of the logarithms of the work relative to the reference
      int compared = 0;
      std::string fallen;
      for (std::size_t i = 0; i < set_.size(); ++i) {
        const Metrics& m = at(i, j).metrics;
        if (!m.holds) {
          fallen += (fallen.empty() ? "" : ", ") + set_[i].scene.name;
          continue;
        }
        ++holds;
        substeps += static_cast<double>(m.work.substeps);
        frames += static_cast<double>(m.work.frames);
        if (!at(i, reference).metrics.holds) continue;
        ratios +=
            std::log(flops_per_frame(m.work) / flops_per_frame(at(i, reference).metrics.work));
        ++compared;
      }
      std::printf("| %s | %zu of %zu | %.1f | %.0f %% | %s |\n", candidates_[j].name.c_str(), holds,
                  set_.size(), frames > 0.0 ? substeps / frames : 0.0,
                  compared > 0 ? 100.0 * std::exp(ratios / compared) : 0.0, fallen.c_str());
    }
  }

  /// A line per scene: the stable setting with the least work, and for every setting the sub-steps
  /// per frame or the time of failure.
  void print_scenes() const {
    std::printf("\n| family | scene | cheapest setting that holds | kflop per frame |");
    for (const Candidate& candidate : candidates_) std::printf(" %s |", candidate.name.c_str());
    std::printf("\n|---|---|---|---|");
    for (std::size_t j = 0; j < candidates_.size(); ++j) std::printf("---|");
    for (std::size_t i = 0; i < set_.size(); ++i) {
      std::printf("\n| %s | %s |", set_[i].family.c_str(), set_[i].scene.name.c_str());
      const auto least = least_work(i);
      if (least < candidates_.size()) {
        std::printf(" %s | %.0f |", candidates_[least].name.c_str(),
                    flops_per_frame(at(i, least).metrics.work) / 1000.0);
      } else {
        std::printf(" none | |");
      }
      for (std::size_t j = 0; j < candidates_.size(); ++j) {
        const Metrics& m = at(i, j).metrics;
        if (m.holds) {
          std::printf(" %.1f |",
                      static_cast<double>(m.work.substeps) / static_cast<double>(m.work.frames));
        } else {
          std::printf(" *%.2f s* |", m.failed_at);
        }
      }
    }
    std::printf("\n");
  }

  [[nodiscard]] bool complete() const { return complete_; }

 private:
  [[nodiscard]] const Check& at(std::size_t scene, std::size_t candidate) const {
    return checks_[scene * candidates_.size() + candidate];
  }

  static double flops_per_frame(const Work& work) {
    return static_cast<double>(work.flops) / static_cast<double>(work.frames);
  }

  /// The stable setting with the least work for a scene; the number of settings if none is stable.
  [[nodiscard]] std::size_t least_work(std::size_t scene) const {
    std::size_t least = candidates_.size();
    for (std::size_t j = 0; j < candidates_.size(); ++j) {
      const Metrics& m = at(scene, j).metrics;
      if (!m.holds) continue;
      if (least == candidates_.size() || m.work.flops < at(scene, least).metrics.work.flops) {
        least = j;
      }
    }
    return least;
  }

  std::vector<scenes::HardCase> set_;
  std::vector<Candidate> candidates_;
  std::vector<Check> checks_;
  bool complete_ = false;
};

}  // namespace

bool print_hard_table(int jobs) {
  const HardTable table(jobs);
  if (!table.complete()) return false;
  std::printf(
      "# The hard set, scene by scene\n\n"
      "`substep check --hard` prints this file; README.md describes it. Work relative to\n"
      "const 32 is the geometric mean of the solver's operations per frame over the scenes that\n"
      "both settings hold. In the second table plain numbers are sub-steps per frame, and\n"
      "*italic* ones are times of failure.\n\n");
  table.print_settings();
  table.print_scenes();
  return true;
}

}  // namespace substep::cli
