#include "core/lab/verdict_table.hpp"

#include <algorithm>
#include <set>

#include "core/model/names.hpp"

namespace substep {
namespace {

bool selects(const Expectation& rule, const Settings& s) {
  return (!rule.solver || *rule.solver == s.solver) && (!rule.mode || *rule.mode == s.mode) &&
         (!rule.n || *rule.n == s.n) && (!rule.integrator || *rule.integrator == s.integrator);
}

/// The scene's own settings, with one N for all islands, in every mode of the table for a solver.
std::vector<Settings> modes_of(const Scene& scene, SolverKind solver) {
  std::set<int> numbers{4, 16};
  for (const Expectation& rule : scene.verdicts) {
    if (rule.n && rule.solver.value_or(solver) == solver) numbers.insert(*rule.n);
  }
  std::vector<Settings> all;
  const auto add = [&](Mode mode) -> Settings& {
    Settings& settings = all.emplace_back(own_settings(scene));
    settings.solver = solver;
    settings.mode = mode;
    settings.islands = false;  // the table is for the paper's single N
    return settings;
  };
  add(Mode::kNone);
  for (const int n : numbers) add(Mode::kConst).n = n;
  if (entry_of(solver).at_end) return all;  // their papers define no other modes
  for (const ModeEntry& mode : kModes) {
    if (mode.value != Mode::kNone && mode.value != Mode::kConst) add(mode.value);
  }
  return all;
}

}  // namespace

std::vector<VerdictCell> verdict_table(const Scene& scene) {
  if (scene.verdicts.empty()) {
    const Expected own = scene.criteria.holds ? Expected::kHolds : Expected::kFails;
    return {{scene.settings, {.verdict = own}}};
  }
  std::vector<VerdictCell> table;
  for (const SolverKind solver : listed_solvers()) {
    for (const Integrator integrator : {Integrator::kEuler, Integrator::kLeapfrog}) {
      if (entry_of(solver).at_end && integrator != Integrator::kEuler) continue;
      for (Settings settings : modes_of(scene, solver)) {
        settings.integrator = integrator;
        const auto rule = std::find_if(scene.verdicts.rbegin(), scene.verdicts.rend(),
                                       [&](const Expectation& r) { return selects(r, settings); });
        if (rule != scene.verdicts.rend()) table.push_back({settings, *rule});
      }
    }
  }
  return table;
}

std::string cell_name(const Settings& settings) {
  std::string name(name_of(settings.solver));
  name += ' ';
  name += name_of(settings.mode);
  if (settings.mode == Mode::kConst) name += ' ' + std::to_string(settings.n);
  name += ' ';
  name += name_of(settings.integrator);
  return name;
}

Judgement judge(const Scene& scene, const Expectation& expected, const ExperimentRun& run) {
  const Verdict& verdict = run.verdict();
  Judgement judgement;
  const double latest = expected.before.value_or(scene.criteria.duration);
  judgement.margin = verdict.holds() ? 1.0 - verdict.utilisation()
                                     : std::max(0.0, 1.0 - verdict.failed_at() / latest);
  switch (expected.verdict) {
    case Expected::kHolds:
      judgement.as_expected = verdict.holds();
      break;
    case Expected::kFails:
      judgement.as_expected = !verdict.holds() && verdict.failed_at() <= latest;
      break;
    case Expected::kDepends:
      judgement.as_expected = true;
      break;
  }
  return judgement;
}

}  // namespace substep
