#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "app/cli/cancel.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/format_text.hpp"
#include "app/cli/length_flags.hpp"
#include "app/cli/output.hpp"
#include "app/cli/parallel_sweep.hpp"
#include "app/cli/progress_line.hpp"
#include "app/cli/scene_source.hpp"
#include "core/io/experiment.hpp"
#include "core/io/setting_fields.hpp"
#include "core/lab/alpha_choice.hpp"
#include "core/lab/recommendation.hpp"

namespace substep::cli {
namespace {

constexpr int kMostSubsteps = 10000;  // a frame, as many as settings allow

constexpr std::array<std::pair<std::string_view, ErrorAxis>, 4> kErrors{
    {{"path", ErrorAxis::kTrajectory},
     {"energy", ErrorAxis::kEnergy},
     {"gap", ErrorAxis::kGap},
     {"overlap", ErrorAxis::kPenetration}}};

struct Options {
  std::string scene;
  std::string of;
  std::optional<double> error;
  std::optional<double> ms;
  std::optional<double> operations;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  LengthFlags length;
};

/// What is given, and what is looked for.
struct Want {
  ErrorAxis error = ErrorAxis::kTrajectory;
  CostAxis cost = CostAxis::kOperations;
  bool error_is_given = true;
  double limit = 1e-3;

  [[nodiscard]] std::optional<RunPoint> best(std::span<const RunPoint> points) const {
    return error_is_given ? cheapest_within(points, limit) : most_exact_within(points, limit);
  }
};

/// Whether runs of the scene have such an error. @return why not, or empty
std::string why_without(ErrorAxis axis, const Scene& scene) {
  switch (axis) {
    case ErrorAxis::kTrajectory:
      return scene.criteria.track ? "" : "it tracks no body: --of energy";
    case ErrorAxis::kGap:
      return scene.effects.joints ? "" : "it has no joints: --of path, energy or overlap";
    case ErrorAxis::kPenetration:
      return scene.effects.contact ? "" : "it has no contacts: --of path, energy or gap";
    case ErrorAxis::kEnergy:
    case ErrorAxis::kCount:
      break;
  }
  return "";
}

Want want_of(const Options& options, const Scene& scene) {
  Want want;
  want.error = first_axis(scene);
  for (const auto& [name, axis] : kErrors) {
    if (name == options.of) want.error = axis;
  }
  want.limit = options.error.value_or(want.error == ErrorAxis::kEnergy ? 1.0 : 1e-3);
  if (options.ms || options.operations) {
    want.error_is_given = false;
    want.cost = options.ms ? CostAxis::kTime : CostAxis::kOperations;
    want.limit = options.ms ? *options.ms : *options.operations;
  }
  return want;
}

std::string limit_text(const Want& want) {
  if (want.error_is_given) return format_text("%.3g %s", want.limit, unit_of(want.error));
  return format_text(want.cost == CostAxis::kTime ? "%.3g ms a frame" : "%.3g operations a frame",
                     want.limit);
}

/// "0.000858 m for 8.69e+04 operations a frame, 0.0266 ms"
std::string figures(const Result& result, ErrorAxis axis) {
  return format_text("%.3g %s for %.3g operations a frame, %.3g ms",
                     error_of(result, axis).value_or(0.0), unit_of(axis),
                     cost_of(result, CostAxis::kOperations), cost_of(result, CostAxis::kTime));
}

void print_alpha(const Scene& scene, const Want& want, const Experiment& paper,
                 const Reference& reference, const std::atomic<bool>& cancelled) {
  const auto choice =
      want.error_is_given
          ? largest_alpha_within(scene, paper, reference, want.error, want.limit, cancelled)
          : smallest_alpha_within(scene, paper, reference, want.cost, want.limit, cancelled);
  const char* which = want.error_is_given ? "largest" : "smallest";
  if (cancelled) return;
  if (!choice) {
    std::printf("The paper's method: no alpha from %g to 1 keeps within it.\n", kLeastAlpha);
    return;
  }
  const Metrics& metrics = choice->result.metrics;
  std::printf(
      "The paper's method: the %s alpha that does is %.3g, %s\n", which, choice->alpha,
      metrics.holds ? figures(choice->result, want.error).c_str() : metrics.verdict.c_str());
}

int recommend(const Options& options) {
  const std::atomic<bool>& cancelled = cancel_on_signal();
  const auto scene = load_scene(options.scene);
  if (!scene) return kBadInput;
  const Want want = want_of(options, *scene);
  if (const std::string why = why_without(want.error, *scene); !why.empty()) {
    std::fprintf(stderr, "%s has no %s; %s\n", scene->name.c_str(), axis_name(want.error),
                 why.c_str());
    return kBadInput;
  }

  Experiment plain = experiment_of(*scene, scene->settings);
  plain.duration = static_cast<double>(options.length.count(*scene)) * scene->frame;
  ParallelSweep sweep{scene, {}, options.jobs, {}, {}, &cancelled};
  std::map<std::string, std::size_t> order;  // of the sweep: ties must not hang on threads
  for (const SweepPoint& point : default_sweep(*scene)) {
    if (point.load != 1.0) continue;
    Experiment& experiment = sweep.experiments.emplace_back(plain);
    experiment.settings = point.settings;
    order.emplace(experiment_id(experiment), order.size());
  }
  std::vector<Result> results(sweep.experiments.size());
  sweep.on_result = [&](const Result& result) {
    results[order.at(experiment_id(result.experiment))] = result;
    return true;
  };
  ProgressLine progress(stderr_is_terminal());
  sweep.on_progress = [&](double share) {
    if (progress.due()) progress.show(format_text("%3.0f %% of all methods", 100.0 * share));
  };
  const bool complete = run_sweep(sweep);
  progress.clear();
  if (!complete) return kCancelled;

  const std::vector<RunPoint> points = run_points(results, want.error, want.cost);
  std::printf("%s: %zu of %zu runs hold. Error: %s.\n", scene->name.c_str(), points.size(),
              results.size(), axis_name(want.error));
  if (points.empty()) return kUnexpectedVerdict;
  const auto best = want.best(points);
  if (best) {
    const Result& result = results[best->result];
    const SeriesParameter parameter = series_parameter(result.experiment.settings);
    std::printf("%s within %s: %s, %s = %g: %s\n",
                want.error_is_given ? "The cheapest" : "The most exact", limit_text(want).c_str(),
                series_name(result.experiment.settings).c_str(), parameter.name, parameter.value,
                figures(result, want.error).c_str());
    std::printf("  substep run %s%s\n", options.scene.c_str(),
                setting_flags(result.experiment.settings, scene->settings).c_str());
  } else {
    std::printf("No method keeps within %s.\n", limit_text(want).c_str());
  }
  Experiment paper = plain;
  paper.settings.solver = SolverKind::kBpp;
  paper.settings.mode = Mode::kAdaptive;
  paper.settings.policy = Policy::kFrame;
  paper.settings.integrator = Integrator::kEuler;
  paper.settings.n_max = kMostSubsteps;  // alpha alone is to decide
  print_alpha(*scene, want, paper, find_reference(scene, plain.duration), cancelled);
  if (cancelled) return kCancelled;
  return best ? kOk : kUnexpectedVerdict;
}

}  // namespace

void add_recommend(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "recommend",
      "Run all methods over a scene and tell the cheapest within an error, or the most "
      "exact within a cost");
  command->add_option("scene", options->scene, "name or file of a scene, - for standard input")
      ->required();
  const CLI::Range positive(1e-15, 1e15);
  CLI::Option* error =
      command->add_option("--error", options->error, "wanted at most [m, J]; 1 mm, 1 J left out")
          ->check(positive);
  command
      ->add_option("--of", options->of,
                   "error of: path (of the body that the scene tracks), energy, gap or overlap")
      ->check(CLI::IsMember({"path", "energy", "gap", "overlap"}));
  CLI::Option* ms =
      command->add_option("--ms", options->ms, "a frame may take at most, in the median [ms]")
          ->check(positive)
          ->excludes(error);
  command
      ->add_option("--operations", options->operations,
                   "of the solver that a frame may take at most: the same on every machine")
      ->check(positive)
      ->excludes(error)
      ->excludes(ms);
  command->add_option("--jobs", options->jobs, "threads")->check(CLI::Range(1, 1024));
  options->length.add_to(*command);
  command->footer(
      "The paper's method is told beside it: the largest alpha within the error, or the smallest\n"
      "that fits the cost, found by halving over whole runs. Ends with 1 where nothing does.\n"
      "Examples:\n"
      "  substep recommend swinging_box --error 1e-4\n"
      "  substep recommend bridge --of gap --error 1e-3\n"
      "  substep recommend swinging_box --ms 0.05");
  command->callback([options, &exit_code] { exit_code = recommend(*options); });
}

}  // namespace substep::cli
