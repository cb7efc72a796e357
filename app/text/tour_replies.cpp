#include <cmath>
#include <string>

#include "app/text/format.hpp"
#include "app/text/tour.hpp"
#include "app/text/tour_words.hpp"

namespace substep {
namespace {

std::string seconds(double time) { return plain_number(time) + " s"; }

std::string mass(const Lab& lab) { return tour_number(lab, "load").text; }

/// Share of the exchangeable energy lost in a pass, < 0 if energy was gained [-].
double lost_share(const Lab& lab, const RunLoop::Pass& pass) {
  const auto scale = lab.session.scene().criteria.energy_scale;
  return scale ? -pass.drift / *scale : 0.0;
}

std::string lost(const Lab& lab, const RunLoop::Pass& pass) {
  const double share = lost_share(lab, pass);
  return coarse_number(100.0 * std::abs(share)) + " % of its energy " +
         (share < 0.0 ? "gained" : "lost");
}

/// "the chain tears at 0.35 s", from the verdict. @param torn what has the joints
std::string failure(const RunLoop::Pass& pass, const std::string& torn = "the chain") {
  std::string what = "the run fails at ";
  using What = Exceeded::What;
  if (pass.exceeded && pass.exceeded->what == What::kJointGap) what = torn + " tears at ";
  if (pass.exceeded && pass.exceeded->what == What::kEnergyGain) {
    what = "the run gains energy and fails at ";
  }
  return what + fixed(pass.failed_at, 2) + " s";
}

/// "With 10 kg it holds for 4 s."
std::string how_it_went(const std::string& with, const RunLoop::Outcome& outcome) {
  return "With " + with + " " +
         (outcome.failed() ? failure(outcome.run) : "it holds for " + seconds(outcome.time)) + ".";
}

TourReply failed(const RunLoop::Outcome& outcome) {
  std::string text = failure(outcome.run) + ".";
  text[0] = 'T';
  return {text, false};
}

std::string count(std::int64_t substeps) { return grouped(static_cast<double>(substeps)); }

}  // namespace

TourReply reply_lighter_box(const Lab& lab, const RunLoop::Outcome& outcome) {
  if (outcome.open()) return {};
  return {how_it_went(mass(lab), outcome), lab.load < 1.0};
}

TourReply reply_break_it(const Lab& lab, const RunLoop::Outcome& outcome) {
  if (outcome.open()) return {};
  return {how_it_went(tour_number(lab, "n").text, outcome), outcome.failed()};
}

TourReply reply_lose_less(const Lab& lab, const RunLoop::Outcome& outcome) {
  if (outcome.failed()) return failed(outcome);
  if (outcome.open() || outcome.beside.empty()) return {};
  return {"After " + seconds(outcome.time) + ": " + lost(lab, outcome.run) + ", by the ghost " +
              coarse_number(100.0 * lost_share(lab, outcome.beside[0])) + " %.",
          lost_share(lab, outcome.run) < 0.1};
}

TourReply reply_range_of_n(const Lab& lab, const RunLoop::Outcome& outcome) {
  if (outcome.failed()) return failed(outcome);
  if (outcome.open()) return {};
  return {"After " + seconds(outcome.time) + ": N from " + std::to_string(outcome.run.least_n) +
              " to " + std::to_string(outcome.run.most_n) + ", " + lost(lab, outcome.run) + ".",
          outcome.run.most_n <= 10};
}

TourReply reply_double_n(const Lab& lab, const RunLoop::Outcome& outcome) {
  if (outcome.failed()) return failed(outcome);
  if (outcome.open() || outcome.beside.empty()) return {};
  const RunLoop::Pass& run = outcome.run;
  const RunLoop::Pass& ghost = outcome.beside[0];
  const double ratio = static_cast<double>(run.substeps) / static_cast<double>(ghost.substeps);
  return {"After " + seconds(outcome.time) + ": " + count(run.substeps) + " sub-steps, " +
              coarse_number(ratio) + " times the ghost's; " + lost(lab, run) + ", by the ghost " +
              coarse_number(100.0 * lost_share(lab, ghost)) + " %.",
          ratio > 1.9};
}

TourReply reply_heavier_box(const Lab& lab, const RunLoop::Outcome& outcome) {
  if (outcome.failed()) return failed(outcome);
  if (outcome.open() || outcome.beside.empty()) return {};
  const RunLoop::Pass& ghost = outcome.beside[0];
  const std::string n = std::to_string(ghost.most_n);
  const std::string beside = ghost.stable
                                 ? n + " constant sub-steps hold as well."
                                 : "With " + n + " constant sub-steps " + failure(ghost) + ".";
  return {"With " + mass(lab) + " N is up to " + std::to_string(outcome.run.most_n) +
              " and the chain holds. " + beside,
          !ghost.stable};
}

TourReply reply_changing_load(const Lab&, const RunLoop::Outcome& outcome) {
  if (outcome.failed()) return failed(outcome);
  if (outcome.open() || outcome.beside.empty()) return {};
  const RunLoop::Pass& run = outcome.run;
  const RunLoop::Pass& ghost = outcome.beside[0];
  const std::string own = "N from " + std::to_string(run.least_n) + " to " +
                          std::to_string(run.most_n) + ", " + count(run.substeps) +
                          " sub-steps in all. With " + std::to_string(ghost.most_n) +
                          " constant sub-steps ";
  if (!ghost.stable) return {own + failure(ghost, "the bridge") + ".", true};
  const double ratio = static_cast<double>(ghost.substeps) / static_cast<double>(run.substeps);
  return {
      own + "it takes " + count(ghost.substeps) + ", " + coarse_number(ratio) + " times as many.",
      false};
}

TourReply reply_half_the_substeps(const Lab& lab, const RunLoop::Outcome& outcome) {
  if (outcome.failed()) return failed(outcome);
  if (outcome.open() || outcome.beside.empty()) return {};
  const RunLoop::Pass& run = outcome.run;
  const RunLoop::Pass& ghost = outcome.beside[0];
  const double ratio = static_cast<double>(run.substeps) / static_cast<double>(ghost.substeps);
  const bool better = std::abs(lost_share(lab, run)) < std::abs(lost_share(lab, ghost));
  return {count(run.substeps) + " sub-steps, " + lost(lab, run) +
              "; Euler, the ghost: " + count(ghost.substeps) + " and " +
              coarse_number(100.0 * lost_share(lab, ghost)) + " %.",
          ratio < 0.6 && better};
}

}  // namespace substep
