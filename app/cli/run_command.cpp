#include <atomic>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "app/cli/cancel.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/flags.hpp"
#include "app/cli/message.hpp"
#include "app/cli/output.hpp"
#include "app/cli/progress_line.hpp"
#include "app/cli/run_outputs.hpp"
#include "app/cli/run_report.hpp"
#include "app/cli/scene_source.hpp"
#include "app/cli/within.hpp"
#include "core/io/experiment.hpp"
#include "core/lab/experiment.hpp"
#include "core/lab/forecast.hpp"
#include "core/lab/metrics.hpp"
#include "core/lab/remedy.hpp"
#include "core/lab/start_text.hpp"
#include "core/model/format_text.hpp"
#include "core/model/number_text.hpp"
#include "core/sim/simulator.hpp"

namespace substep::cli {
namespace {

struct RunOptions {
  std::string scene;
  RunFiles files;
  std::string experiments;
  double load = 1.0;
  int seed = 0;
  bool quiet = false;
  LengthFlags length;
  SettingsFlags settings;
  BudgetFlags budget;
};

/// The forecast of N before the scene moves, and the scene's mass ratio.
std::string forecast_line(const Scene& scene, const Settings& settings) {
  const Forecast predicted = forecast(scene, settings);
  std::string text =
      "forecast     " + std::to_string(predicted.at_start) + " sub-steps at the start";
  if (predicted.body >= 0) text += ", " + std::to_string(predicted.hanging) + " at rest";
  text += "; masses 1 to " + number_text(std::round(predicted.mass_ratio)) + "\n";
  return text;
}

/// "remedies     adaptive sub-steps (--mode adaptive): holds for 10 s", one line per remedy.
std::string remedy_lines(const Simulator& failing, const Verdict& verdict,
                         const FrameReport& failed, std::int64_t frames) {
  const auto scene = std::make_shared<const Scene>(failing.scene());
  const Settings& settings = failing.settings();
  const std::atomic<bool>& cancelled = cancel_on_signal();
  RemedyTrials tried(scene, remedies(settings, failed, verdict.exceeded()),
                     {.frames = frames, .budget = failing.budget()});
  while (!cancelled && tried.advance()) {
  }
  const std::string duration = number_text(static_cast<double>(frames) * scene->frame) + " s";
  std::string text;
  for (const Remedy& remedy : tried.hold()) {
    const std::string flags = remedy.settings == Settings{}
                                  ? "--preset steady"
                                  : setting_flags(remedy.settings, settings).substr(1);
    text += (text.empty() ? "remedies     " : "             ") + remedy.text +
            (remedy.why.empty() ? "" : "; " + remedy.why) + " (" + flags + "): holds for " +
            duration + "\n";
  }
  if (tried.failed() > 0 && tried.hold().empty()) {
    text = "remedies     none of the " + std::to_string(tried.failed()) +
           " that were tried holds for " + duration + "\n";
  }
  return text;
}

int run(const RunOptions& options) {
  auto scene = load_scene(options.scene);
  RunOutputs outputs;
  if (!scene || !outputs.open(options.files)) return kBadInput;
  if (options.load != 1.0 || options.seed != 0) {
    scene = std::make_shared<const Scene>(start_of(*scene, options.load, options.seed));
  }

  Simulator simulator(scene);
  simulator.set_settings(options.settings.of_run(*scene));
  simulator.set_budget(options.budget.budget());
  if (const Problems problems = simulator.problems(); !problems.empty()) {  // --load, for example
    for (const Problem& problem : problems) {
      complain("%s: %s", scene->name.c_str(), to_string(problem).c_str());
    }
    return kBadInput;
  }
  const FrameReport start = simulator.observe();
  Measure measure(*scene, simulator.state(), start, no_reference());
  const Verdict& verdict = measure.verdict();
  RunReport report(*scene, start);
  ProgressLine progress(!options.quiet && stderr_is_terminal());
  outputs.begin(simulator, start);

  // If a result goes to standard output, messages go to stderr.
  std::FILE* words = options.files.take_standard_output() ? stderr : stdout;
  if (!options.quiet) {
    say(words, "%s: %s\n%s", scene->name.c_str(), settings_line(simulator.settings()).c_str(),
        forecast_line(*scene, simulator.settings()).c_str());
    for (const std::string& note : {start_text(*scene, simulator.start()),
                                    overlap_text(*scene, simulator.settings(), start)}) {
      if (!note.empty()) say(words, "%s\n", note.c_str());
    }
    std::fflush(words);
  }
  const std::int64_t frames = options.length.count(*scene);
  std::optional<FrameReport> failed;  // the frame in which it failed
  const std::atomic<bool>& cancelled = cancel_on_signal();
  const auto running = [&] { return !verdict.stopped() && !outputs.failed() && !cancelled; };
  for (std::int64_t i = 0; i < frames && running(); ++i) {
    const FrameReport frame = simulator.step();
    measure.add(*scene, simulator.state(), frame, frame.times.total);
    report.add(frame);
    if (!failed && !verdict.holds()) failed = frame;
    if (progress.due()) progress.show(report.progress(frames));
    outputs.add(simulator, frame);
  }
  progress.clear();
  if (!outputs.end(simulator, measure)) return kBadInput;
  if (cancelled) {
    say_cancelled(format_text(" at %.3f s; the completed frames are kept", simulator.state().time));
    return kCancelled;
  }

  if (!options.quiet) {
    say(words, "%s", report.summary(measure.metrics(simulator.scene(), simulator.state())).c_str());
    std::fflush(words);
    const std::string lines = failed ? remedy_lines(simulator, verdict, *failed, frames) : "";
    if (!cancelled) say(words, "%s", lines.c_str());
  }
  say(words, "%s\n", verdict.text().c_str());
  return verdict.stopped() ? kNotFinite : kOk;
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("run", "Run a scene and print whether it holds");
  command->add_option("scene", options->scene,
                      "name or file of a scene, or file of a model, - for standard input");
  options->length.add_to(*command);
  options->files.add_to(*command);
  command->add_option("--load", options->load, "factor on the mass of the heaviest body")
      ->check(within(kLoadRange.least, kLoadRange.most));
  command
      ->add_option("--seed", options->seed, "seed of a perturbation of the start by up to 1e-9 m/s")
      ->check(whole(0, kMostSeed));
  command
      ->add_option("--experiments", options->experiments,
                   "run the experiments of this file, one JSON object per line, - for standard "
                   "input; print one result per line")
      ->check(named());
  command->add_flag("--quiet", options->quiet, "print the verdict only");
  options->settings.add_to(*command);
  options->budget.add_to(*command);
  command->footer(
      "The last line is the verdict by the scene's own criteria: `holds`, or `fails at 0.352 s: "
      "...`,\n"
      "which is a result, not an error.\n"
      "Examples:\n"
      "  substep run swinging_box --mode const --n 6\n"
      "  substep run bridge --solver pgs --iterations 50 --seconds 3 --csv -\n"
      "  substep run pendulum --states states.csv --joints joints.csv\n"
      "  substep sweep bridge --list | parallel --pipe -N4 substep run --experiments - > "
      "bridge.jsonl");
  command->callback([options, command, &exit_code] {
    if (!options->experiments.empty()) {
      refuse_beside(*command, "--experiments", {"scene"});  // each has its own settings
      if (options->scene == "-" && options->experiments == "-") {
        throw CLI::ValidationError("--experiments", "standard input is already used by the scene");
      }
      exit_code = run_experiments(options->experiments, options->scene);
      return;
    }
    if (options->scene.empty()) throw CLI::RequiredError("scene or --experiments");
    options->files.check(options->scene);
    exit_code = run(*options);
  });
}

}  // namespace substep::cli
