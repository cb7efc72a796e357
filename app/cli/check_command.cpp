#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/cancel.hpp"
#include "app/cli/checks.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/flags.hpp"
#include "app/cli/message.hpp"
#include "app/cli/scene_source.hpp"
#include "app/cli/within.hpp"
#include "core/io/experiment.hpp"
#include "core/io/json.hpp"
#include "core/model/names.hpp"
#include "core/model/number_text.hpp"

namespace substep::cli {
namespace {

struct CheckOptions {
  std::vector<std::string> scenes;
  bool all = false;
  bool own = false;
  bool hard = false;
  bool json = false;
  int seed = 0;
  int jobs = 0;  // 0: one per processor
};

/// "holds", "fails before 4 s", "depends"
std::string expected_text(const Expectation& expected) {
  std::string text(name_of(expected.verdict));
  if (expected.before) text += " before " + number_text(*expected.before) + " s";
  return text;
}

void print(const Check& c) {
  std::printf("%-6s %-24s %-24s %-18s %-58s %4.0f %%  %7lld sub-steps  %7.2f s\n",
              c.judgement.as_expected ? "ok" : "FAILED", c.scene->name.c_str(),
              cell_name(c.cell.settings).c_str(), expected_text(c.cell.expected).c_str(),
              c.metrics.verdict.c_str(), 100.0 * c.judgement.margin,
              static_cast<long long>(c.metrics.work.substeps), c.seconds);
  std::fflush(stdout);
}

Json json_of(const Check& c) {
  const Expectation& expected = c.cell.expected;
  Json json;
  json["scene"] = c.scene->name;
  json["run"] = cell_name(c.cell.settings);
  json["ok"] = c.judgement.as_expected;
  json["expected"] = name_of(expected.verdict);
  if (expected.before) json["before"] = *expected.before;
  if (!expected.why.empty()) json["why"] = expected.why;
  json["verdict"] = c.metrics.verdict;
  json["holds"] = c.metrics.holds;
  json["margin"] = c.judgement.margin;
  json["seconds"] = c.time;
  json["substeps"] = c.metrics.work.substeps;
  json["flops"] = c.metrics.work.flops;
  json["computing_seconds"] = c.seconds;
  return json;
}

int check_all(const CheckOptions& options) {
  int exit_code = kOk;
  std::vector<Check> checks;
  for (const std::string& name : options.all ? shipped_names() : options.scenes) {
    const auto loaded = load_scene(name);
    if (!loaded) {
      exit_code = kBadInput;
      continue;
    }
    auto scene = std::make_shared<Scene>(*loaded);
    if (options.own) scene->verdicts.clear();
    for (VerdictCell& cell : verdict_table(*scene)) {
      checks.push_back({.scene = scene, .cell = std::move(cell), .seed = options.seed});
    }
  }
  Json results = Json::array();
  std::size_t unexpected = 0;
  std::size_t depends = 0;
  const bool complete = run_checks(
      checks, options.jobs,
      [&](const Check& check) {
        if (!check.judgement.as_expected) ++unexpected;
        if (check.cell.expected.verdict == Expected::kDepends) ++depends;
        options.json ? results.push_back(json_of(check)) : print(check);
      },
      cancel_on_signal());
  if (options.json) {
    std::printf("%s\n", results.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
  } else if (complete && checks.size() > 1) {
    std::printf("%zu runs: %zu not as expected, %zu depend on rounding\n", checks.size(),
                unexpected, depends);
  }
  if (!complete) {
    say_cancelled("; the completed runs are printed");
    return kCancelled;
  }
  return exit_code == kOk && unexpected > 0 ? kUnexpectedVerdict : exit_code;
}

}  // namespace

void add_check(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command = app.add_subcommand(
      "check", "Run the verdict tables of scenes and compare the verdicts with the expected ones");
  auto* scenes = command->add_option("scene", options->scenes, "names or files of scenes");
  auto* all = command->add_flag("--all", options->all, "all shipped scenes");
  scenes->excludes(all);
  command->add_flag("--hard", options->hard,
                    "the hard set with all candidate settings, as Markdown (minutes)");
  command->add_flag("--own", options->own, "only the scenes' own settings");
  command
      ->add_option("--seed", options->seed,
                   "seed of a perturbation of the start by up to 1e-9 m/s; 0: none")
      ->check(whole(0, kMostSeed));
  command->add_option("--jobs", options->jobs, "parallel runs; 0: one per processor")
      ->check(whole(0, 1000));
  command->add_flag("--json", options->json, "print JSON");
  command->footer(
      "Columns: as expected or not; scene; run; expected; observed; margin, the unused\n"
      "share of the criterion (or, for a failure, of the time); sub-steps; wall time.\n"
      "Example:\n  substep check swinging_box bridge");
  command->callback([options, command, &exit_code] {
    if (options->hard) {
      refuse_beside(*command, "--hard", {"--jobs"});
      exit_code = print_hard_table(options->jobs) ? kOk : kCancelled;
      return;
    }
    if (options->scenes.empty() && !options->all) {
      throw CLI::RequiredError("scene or --all");
    }
    exit_code = check_all(*options);
  });
}

}  // namespace substep::cli
