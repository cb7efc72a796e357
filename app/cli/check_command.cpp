#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/commands.hpp"
#include "app/cli/length_flags.hpp"
#include "app/cli/scene_source.hpp"
#include "core/io/json.hpp"
#include "core/lab/verdict.hpp"
#include "core/sim/simulator.hpp"

namespace substep::cli {
namespace {

struct Options {
  std::vector<std::string> scenes;
  bool all = false;
  bool json = false;
};

struct Outcome {
  bool as_expected = false;
  std::string verdict;
  double seconds = 0.0;  // simulated [s]
};

/// Runs a scene with its own settings to its end, or to its failure.
Outcome check(const std::shared_ptr<const Scene>& scene) {
  Simulator simulator(scene);
  Verdict verdict(*scene, simulator.state(), simulator.observe());
  const std::int64_t frames = LengthFlags{}.count(*scene);
  for (std::int64_t i = 0; i < frames && verdict.holds(); ++i) {
    const FrameReport report = simulator.step();
    verdict.add(*scene, simulator.state(), report);
  }
  return {verdict.holds() == scene->criteria.holds, verdict.text(), simulator.state().time};
}

int check_all(const Options& options) {
  const std::vector<std::string> names = options.all ? shipped_names() : options.scenes;
  int exit_code = kOk;
  Json results = Json::array();
  for (const std::string& name : names) {
    const auto scene = load_scene(name);
    if (!scene) {
      exit_code = kBadInput;
      continue;
    }
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = check(scene);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    if (!outcome.as_expected && exit_code == kOk) exit_code = kUnexpectedVerdict;
    const char* expected = scene->criteria.holds ? "holds" : "fails";
    if (options.json) {
      Json result;
      result["scene"] = scene->name;
      result["ok"] = outcome.as_expected;
      result["expected"] = expected;
      result["verdict"] = outcome.verdict;
      result["seconds"] = outcome.seconds;
      result["computing_seconds"] = elapsed.count();
      results.push_back(result);
    } else {
      std::printf("%-6s %-24s %6.2f s in %7.3f s   %s%s%s\n", outcome.as_expected ? "ok" : "FAILED",
                  scene->name.c_str(), outcome.seconds, elapsed.count(), outcome.verdict.c_str(),
                  outcome.as_expected ? "" : ", expected: ", outcome.as_expected ? "" : expected);
      std::fflush(stdout);
    }
  }
  if (options.json) {
    std::printf("%s\n", results.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
  }
  return exit_code;
}

}  // namespace

void add_check(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "check",
      "Run scenes with their own settings and compare the verdicts with the expected ones");
  auto* scenes = command->add_option("scene", options->scenes, "names or files of scenes");
  auto* all = command->add_flag("--all", options->all, "all shipped scenes");
  scenes->excludes(all);
  command->add_flag("--json", options->json, "print JSON");
  command->footer("Example:\n  substep check swinging_box bridge");
  command->callback([options, &exit_code] {
    if (options->scenes.empty() && !options->all) {
      throw CLI::RequiredError("scene or --all");
    }
    exit_code = check_all(*options);
  });
}

}  // namespace substep::cli
