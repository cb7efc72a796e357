#include <cstdio>
#include <memory>
#include <string>

#include "app/cli/commands.hpp"
#include "app/cli/flags.hpp"
#include "app/cli/message.hpp"
#include "app/cli/scene_source.hpp"
#include "core/io/experiment.hpp"
#include "core/lab/stop_text.hpp"
#include "core/sim/simulator.hpp"

namespace substep::cli {
namespace {

struct HashOptions {
  std::string scene;
  LengthFlags length;
  SettingsFlags settings;
  BudgetFlags budget;
};

int hash(const HashOptions& options) {
  const auto scene = load_scene(options.scene);
  if (!scene) return kBadInput;
  Simulator simulator(scene);
  simulator.set_settings(options.settings.of_run(*scene));
  simulator.set_budget(options.budget.budget());
  const std::int64_t frames = options.length.count(*scene);
  for (std::int64_t i = 0; i < frames; ++i) {
    const FrameReport report = simulator.step();
    if (report.status == StepStatus::kOk) continue;
    complain("stopped at %.3f s: %s", report.time, stop_text(*scene, report).c_str());
    return kNotFinite;
  }
  std::printf("%s\n", hex_text(state_hash(simulator.state())).c_str());
  return kOk;
}

}  // namespace

void add_hash(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<HashOptions>();
  CLI::App* command = app.add_subcommand(
      "hash", "Print the hash of a scene's state after a run: the same on every platform");
  command
      ->add_option("scene", options->scene,
                   "name or file of a scene, or file of a model, - for standard input")
      ->required();
  options->length.add_to(*command);
  options->settings.add_to(*command);
  options->budget.add_to(*command);
  command->footer("Example:\n  substep hash bridge --frames 600 --mode const --n 16");
  command->callback([options, &exit_code] { exit_code = hash(*options); });
}

}  // namespace substep::cli
