#include <cstdio>
#include <memory>
#include <string>

#include "app/cli/commands.hpp"
#include "app/cli/flags.hpp"
#include "app/cli/message.hpp"
#include "app/cli/output.hpp"
#include "app/cli/run_report.hpp"
#include "app/cli/scene_source.hpp"
#include "app/cli/within.hpp"
#include "core/io/experiment.hpp"
#include "core/io/result.hpp"

namespace substep::cli {
namespace {

struct CostOptions {
  std::string scene;
  std::string json;
  LengthFlags length;
  SettingsFlags settings;
};

struct Stage {
  const char* name;
  double StageTimes::*seconds;
};
constexpr Stage kStages[] = {{"joint rows", &StageTimes::joints},
                             {"contact rows", &StageTimes::contact},
                             {"friction rows", &StageTimes::friction},
                             {"forces and mass", &StageTimes::mass},
                             {"solve", &StageTimes::solve},
                             {"criterion", &StageTimes::stiffness},
                             {"integrate", &StageTimes::integrate}};

void print_stages(const Metrics& run) {
  const StageTimes& times = run.timing.stages;
  if (run.work.frames == 0 || !(times.total > 0.0)) return;
  const auto line = [&](const char* name, double seconds) {
    say(stdout, "%-16s %9.4f %6.1f %%\n", name,
        1e3 * seconds / static_cast<double>(run.work.frames), 100.0 * seconds / times.total);
  };
  say(stdout, "\n%-16s %9s %8s\n", "stage", "ms/frame", "share");
  double known = 0.0;
  for (const auto& [name, seconds] : kStages) {
    if (times.*seconds > 0.0) line(name, times.*seconds);
    known += times.*seconds;
  }
  line("rest", times.total - known);  // errors and energies, per frame
}

void print_rows(const Work& work) {
  if (work.solves == 0) return;
  const RowCounts& rows = work.rows;
  const auto all = static_cast<double>(rows.joint + rows.contact + rows.friction);
  say(stdout, "\n%-16s %9s %12s\n", "rows", "per solve", "updates");
  const auto line = [&](const char* name, std::int64_t count) {
    if (count == 0) return;
    const auto n = static_cast<double>(count);
    say(stdout, "%-16s %9.1f %12.4g\n", name, n / static_cast<double>(work.solves),
        static_cast<double>(work.row_updates) * n / all);
  };
  line("joint", rows.joint);
  line("contact", rows.contact);
  line("friction", rows.friction);
  if (work.criterion.evaluations == 0) return;
  const auto criterion = static_cast<double>(work.criterion.flops);
  say(stdout,
      "\nThe criterion: %.4g operations in %lld evaluations, %.1f %% of the solver's %.4g.\n",
      criterion, static_cast<long long>(work.criterion.evaluations),
      100.0 * criterion / static_cast<double>(work.flops), static_cast<double>(work.flops));
}

void print_effects(const std::vector<EffectCost>& effects) {
  say(stdout, "\n%-16s %9s %12s %12s\n", "effect adds", "ms/frame", "operations", "updates");
  for (const EffectCost& cost : effects) {
    say(stdout, "%-16s %9.4f %12.4g %12.4g\n", std::string(cost.effect).c_str(), cost.ms,
        cost.flops, cost.row_updates);
  }
}

int cost(const CostOptions& options) {
  const auto scene = load_scene(options.scene);
  Output json;
  if (!scene || !json.open(options.json)) return kBadInput;
  Experiment experiment = experiment_of(*scene, options.settings.of_run(*scene));
  experiment.duration = static_cast<double>(options.length.count(*scene)) * scene->frame;
  const CostBreakdown costs = cost_of_effects(*scene, experiment);
  if (json.is_open()) {
    Json all = experiment_json(experiment);
    all.update(costs_json(costs));
    json.write(all.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
    if (!json.close()) return kBadInput;
    if (is_standard_output(options.json)) return kOk;
  }
  say(stdout, "%s: %s; %lld frames\n", scene->name.c_str(),
      settings_line(experiment.settings).c_str(), static_cast<long long>(costs.run.work.frames));
  print_stages(costs.run);
  print_rows(costs.run.work);
  print_effects(costs.effects);
  say(stdout, "\n%s\n", costs.run.verdict.c_str());
  return kOk;
}

}  // namespace

void add_cost(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CostOptions>();
  CLI::App* command = app.add_subcommand(
      "cost", "Print the cost of stages, rows, effects and the criterion in a scene");
  command
      ->add_option("scene", options->scene,
                   "name or file of a scene, or file of a model, - for standard input")
      ->required();
  command
      ->add_option("--json", options->json, "write the costs to this file, - for standard output")
      ->check(named());
  options->length.add_to(*command);
  options->settings.add_to(*command);
  command->footer(
      "Each frame is repeated from the same state, with the same number of sub-steps, without the\n"
      "effect; the difference is the cost of the effect. Operations and updates are counted and\n"
      "the same on every machine; times are measured on this machine.\n"
      "Examples:\n"
      "  substep cost bridge\n"
      "  substep cost bridge --solver pgs --seconds 2 --json costs.json");
  command->callback([options, &exit_code] {
    keep_apart({{"--json", options->json}}, {scene_path(options->scene)});
    exit_code = cost(*options);
  });
}

}  // namespace substep::cli
