#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/cli/all_methods.hpp"
#include "app/cli/cancel.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/flags.hpp"
#include "app/cli/message.hpp"
#include "app/cli/output.hpp"
#include "app/cli/recommending.hpp"
#include "app/cli/scene_source.hpp"
#include "app/cli/within.hpp"
#include "core/io/experiment.hpp"
#include "core/io/json.hpp"
#include "core/io/recommended_json.hpp"
#include "core/io/scene_writer.hpp"
#include "core/lab/alpha_search.hpp"
#include "core/lab/recommendation.hpp"
#include "core/lab/sweep.hpp"
#include "core/model/format_text.hpp"
#include "core/model/names.hpp"
#include "core/model/setting_fields.hpp"
#include "scenes/generator/recommended.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::cli {
namespace {

constexpr int kMostSubsteps = 10000;  // per frame, the limit of the settings

struct RecommendOptions {
  std::string scene;
  std::string of;
  std::string out;
  bool all = false;
  std::optional<double> error;
  std::optional<double> ms;
  std::optional<double> operations;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  LengthFlags length;
};

/// @return the reason why runs of the scene do not have this error; empty if they do
std::string why_without(ErrorAxis axis, const Scene& scene) {
  switch (axis) {
    case ErrorAxis::kTrajectory:
      return scene.criteria.track ? "" : "no body leaves its place: --of energy, gap or overlap";
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

Want want_of(const RecommendOptions& options) {
  Want want;
  want.error = value_of<ErrorAxis>(options.of).value_or(ErrorAxis::kTrajectory);
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
  return format_text(
      want.cost == CostAxis::kTime ? "%.3g ms per frame" : "%.3g operations per frame", want.limit);
}

/// "bpp, const, leapfrog, n = 7"
std::string method_text(const Result& result) {
  const SeriesParameter parameter = series_parameter(result.experiment.settings);
  return format_text("%s, %s = %g", series_name(result.experiment.settings).c_str(), parameter.name,
                     parameter.value);
}

/// "0.000858 m for 8.69e+04 operations per frame, 0.0266 ms"
std::string figures(const Result& result, ErrorAxis axis) {
  return format_text("%.3g %s for %.3g operations per frame, %.3g ms",
                     error_of(result, axis).value_or(0.0), unit_of(axis),
                     cost_of(result, CostAxis::kOperations), cost_of(result, CostAxis::kTime));
}

/// Why a run that was tried for longer does not serve: "fails at 5.5 s: ...", or "misses the limit
/// over 10 s: ...".
std::string why_not(const Result& result, ErrorAxis axis) {
  if (!result.metrics.holds) return result.metrics.verdict;
  return format_text("misses the limit over %g s: ", result.experiment.duration) +
         figures(result, axis);
}

void print_failed(std::FILE* words, const Question& question, const Answer& answer) {
  constexpr std::size_t kShown = 3;
  const std::size_t failed = answer.failed.size();
  const char* which = question.want.error_is_given ? "Cheaper" : "More accurate";
  for (std::size_t i = 0; i < std::min(failed, kShown); ++i) {
    const Result& result = answer.failed[i];
    say(words, "%s, but no recommendation: %s %s\n", which, method_text(result).c_str(),
        why_not(result, question.want.error).c_str());
  }
  if (failed > kShown) {
    say(words, "%zu more do not hold for %g s.\n", failed - kShown, question.whole);
  }
}

void print_best(std::FILE* words, const Question& question, const Answer& answer,
                const std::string& scene) {
  const Want& want = question.want;
  const auto held = std::count_if(answer.results.begin(), answer.results.end(),
                                  [](const Result& r) { return r.metrics.holds; });
  say(words, "%s: %td of %zu runs hold for %g s. Error: %s.\n", question.scene->name.c_str(), held,
      answer.results.size(), question.compared, axis_name(want.error));
  print_failed(words, question, answer);
  const Result* best = answer.best();
  if (best == nullptr) {
    if (answer.candidates.empty()) {
      say(words, "No method meets %s.", limit_text(want).c_str());
      if (answer.nearest) {
        say(words, " The nearest: %s: %s", method_text(*answer.nearest).c_str(),
            figures(*answer.nearest, want.error).c_str());
      }
      std::fputc('\n', words);
    } else {
      say(words, "None of the %zu runs tried within %s (of %zu) holds for %g s.\n",
          answer.failed.size(), limit_text(want).c_str(), answer.candidates.size(), question.whole);
    }
    return;
  }
  say(words, "%s within %s: %s: %s\n", want.error_is_given ? "The cheapest" : "The most accurate",
      limit_text(want).c_str(), method_text(*best).c_str(), figures(*best, want.error).c_str());
  say(words, "  It holds for %g s.", question.whole);
  if (question.compared < question.whole) {
    say(words, " Errors and costs are those of the first %g s.", question.compared);
  }
  const double least = kTimesAsCertain * answer.reference.uncertainty;
  if (want.of_path() && !want.error_is_given && error_of(*best, want.error) < least) {
    say(words, " Errors below %.3g m are not promised: the reference is uncertain.", least);
  }
  say(words, "\n  substep run %s%s\n", scene.c_str(),
      setting_flags(best->experiment.settings, question.scene->settings).c_str());
}

/// @return false if cancelled
bool print_alpha(std::FILE* words, const Question& question, const Reference& reference) {
  const Want& want = question.want;
  const Scene& scene = *question.scene;
  Experiment paper = experiment_of(scene, paper_settings(scene));
  paper.duration = question.compared;
  paper.settings.n_max = kMostSubsteps;  // so that alpha alone determines N
  AlphaSearch search =
      want.error_is_given
          ? AlphaSearch::largest_within(question.scene, paper, reference, want.error, want.limit)
          : AlphaSearch::smallest_within(question.scene, paper, reference, want.cost, want.limit);
  while (search.advance(0.1)) {
    if (cancel_on_signal()) return false;
  }
  const std::optional<AlphaChoice>& choice = search.choice();
  if (!choice) {
    say(words, "The paper's method: no alpha from %g to 1 meets the limit.\n", AlphaSearch::kLeast);
    return true;
  }
  const auto whole = searched(question, {choice->result}, reference);
  if (!whole) return false;
  say(words, "The paper's method: the %s alpha that meets the limit is %.3g, %s\n",
      want.error_is_given ? "largest" : "smallest", choice->alpha,
      figures(choice->result, want.error).c_str());
  for (const Result& result : whole->failed()) {
    say(words, "  It %s\n", why_not(result, want.error).c_str());
  }
  return true;
}

/// The scene with the body whose path is compared, if it tracks none, and words on what the wanted
/// error is worth in it. @return null if cancelled
std::shared_ptr<const Scene> with_comparable(std::shared_ptr<const Scene> scene, const Want& want,
                                             double seconds, std::FILE* words) {
  const bool chooses = want.of_path() && !scene->criteria.track;
  if (!chooses && want.error != ErrorAxis::kEnergy) return scene;
  Survey survey(scene, predictable_window(*scene, seconds));
  if (!complete(survey, *scene)) return nullptr;
  if (chooses && survey.farthest()) {
    Scene tracking = *scene;
    tracking.criteria.track = survey.farthest();
    scene = std::make_shared<const Scene>(std::move(tracking));
    say(words, "No body is tracked: the path of '%s' is compared.\n",
        scene->bodies[index(*survey.farthest())].name.c_str());
  }
  const std::string changes = energy_changes_by(*scene, survey.touches());
  if (want.error == ErrorAxis::kEnergy && !changes.empty()) {
    say(words,
        "The true motion does not keep its energy (%s): less drift is not less error. "
        "--of path compares motions.\n",
        changes.c_str());
  }
  return scene;
}

/// @param promised instead of the wanted error [m]
void print_uncertain(std::FILE* words, const Reference& reference, double promised) {
  const std::string source = "The reference (" + reference.source + ")";
  if (!reference.failure.empty()) {
    say(words, "%s %s. ", source.c_str(), reference.failure.c_str());
  } else {
    say(words, "%s is uncertain by %.3g m", source.c_str(), reference.uncertainty);
    std::fputs(std::isfinite(promised) ? ", so " : ". ", words);
  }
  if (std::isfinite(promised)) {
    say(words, "errors below %.3g m are not promised.\n", promised);
  } else {
    std::fputs("No error of the path can be promised: --of gap or overlap.\n", words);
  }
}

int recommend(const RecommendOptions& options) {
  std::shared_ptr<const Scene> scene = load_scene(options.scene);
  if (!scene) return kBadInput;
  // If the scene goes to standard output, messages go to stderr.
  if (!options.out.empty() && !spares_inputs(options.out, true)) return kBadInput;
  std::FILE* words = is_standard_output(options.out) ? stderr : stdout;
  const double seconds = static_cast<double>(options.length.count(*scene)) * scene->frame;
  Question question;
  question.want = want_of(options);
  question.jobs = options.jobs;
  Want& want = question.want;
  scene = with_comparable(scene, want, seconds, words);
  if (!scene) return kCancelled;
  if (const std::string why = why_without(want.error, *scene); !why.empty()) {
    complain("%s has no %s; %s", scene->name.c_str(), axis_name(want.error), why.c_str());
    return kBadInput;
  }
  question.scene = scene;
  question.compared = want.of_path() ? predictable_window(*scene, seconds) : seconds;
  question.whole = std::max(seconds, scene->criteria.duration);

  auto reference = reference_for(question);
  if (!reference) return kCancelled;
  const double wanted = want.limit;
  const bool judged = want.of_path() && (want.error_is_given || !reference->failure.empty());
  if (judged) want.limit = promise(*reference, wanted);
  const bool promised = want.limit == wanted;
  if (!promised) print_uncertain(words, *reference, want.limit);
  if (!std::isfinite(want.limit)) return kUnexpectedVerdict;
  const auto answer = answer_to(question, std::move(*reference));
  if (!answer) return kCancelled;
  print_best(words, question, *answer, options.scene);
  if (answer->found && promised && !options.out.empty()) {
    const auto recommended = recommended_of(answer->results, want.error, want.limit,
                                            {question.whole, answer->failed.size()});
    // The output may be the file that the scene was read from.
    const Scene with = with_recommended(*scene, *recommended);
    if (!write_file(options.out, write_scene(with), true)) return kBadInput;
  }
  if (answer->found && !promised && !options.out.empty()) {
    say(words, "%s is not written: --error %.3g stores this one.\n",
        visible_text(options.out).c_str(), want.limit);
  }
  if (!print_alpha(words, question, answer->reference)) return kCancelled;
  return answer->found && promised ? kOk : kUnexpectedVerdict;
}

/// Sweeps the shipped scenes and writes the recommended settings for each, within its required
/// error: scenes/generator/recommended.json. @param only the scene's name; empty: all
/// @return exit code
int recommend_shipped(const std::string& only, const std::string& out, int jobs) {
  int exit_code = kOk;
  Json all = Json::object();
  for (const Scene& scene : scenes::shipped()) {
    const scenes::Wanted* wanted = scenes::wanted_of(scene.name);
    if (wanted == nullptr || (!only.empty() && only != scene.name)) continue;
    Question question{.scene = std::make_shared<const Scene>(scene),
                      .want = {.error = wanted->of, .limit = wanted->within},
                      .compared = wanted->seconds,
                      .whole = wanted->seconds,
                      .jobs = jobs,
                      .defaults = false};  // they are not in the stored sweeps
    // Some scenes show a failure.
    if (scene.criteria.holds) question.whole = std::max(question.whole, scene.criteria.duration);
    auto reference = reference_for(question);
    if (!reference) return kCancelled;
    if (promise(*reference, wanted->within) > wanted->within) {
      complain("%s: the reference is uncertain by %.3g m: %g m is not promised", wanted->scene,
               reference->uncertainty, wanted->within);
      exit_code = kUnexpectedVerdict;
      continue;
    }
    const auto answer = answer_to(question, std::move(*reference));
    if (!answer) return kCancelled;
    const auto recommended = answer->found
                                 ? recommended_of(answer->results, wanted->of, wanted->within,
                                                  {question.whole, answer->failed.size()})
                                 : std::nullopt;
    if (!recommended) {
      complain("%s: no method meets %g %s for %g s", wanted->scene, wanted->within,
               unit_of(wanted->of), question.whole);
      exit_code = kUnexpectedVerdict;
      continue;
    }
    complain("%s: %s", wanted->scene, method_text(*answer->best()).c_str());
    all[wanted->scene] = recommended_json(*recommended);
  }
  return write_file(out, json_file(all)) ? exit_code : kBadInput;
}

}  // namespace

void add_recommend(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<RecommendOptions>();
  CLI::App* command = app.add_subcommand("recommend",
                                         "Run all methods on a scene and print the cheapest within "
                                         "an error, or the most accurate within a cost");
  command->add_option("scene", options->scene,
                      "name or file of a scene, or file of a model, - for standard input");
  const CLI::Validator positive = within(1e-15, 1e15);
  CLI::Option* error = command
                           ->add_option("--error", options->error,
                                        "largest permitted error [m, J]; default 1 mm, 1 J")
                           ->check(positive);
  CLI::Option* of =
      command
          ->add_option(
              "--of", options->of,
              "error of: path (of the tracked body, or the one that gets farthest), energy, "
              "gap or overlap; default path")
          ->check(among({"path", "energy", "gap", "overlap"}));
  CLI::Option* ms =
      command->add_option("--ms", options->ms, "maximum of the median time per frame [ms]")
          ->check(positive)
          ->excludes(error);
  CLI::Option* operations =
      command
          ->add_option("--operations", options->operations,
                       "maximum of solver operations per frame: the same on every machine")
          ->check(positive)
          ->excludes(error)
          ->excludes(ms);
  CLI::Option* out =
      command
          ->add_option("--out", options->out,
                       "write the scene with the recommended settings to this file, - for stdout; "
                       "it starts with them unless it has its own settings")
          ->check(named());
  out->excludes(ms)->excludes(operations);
  command
      ->add_flag("--all", options->all,
                 "the recommended settings of all shipped scenes, or of the named one, as JSON to "
                 "--out or stdout (minutes)")
      ->excludes(error)
      ->excludes(of)
      ->excludes(ms)
      ->excludes(operations);
  command->add_option("--jobs", options->jobs, "threads")->check(whole(1, 1024));
  options->length.add_to(*command);
  command->footer(
      "A path is compared while it is predictable, other errors for the whole run. The best "
      "method\n"
      "is then run for the scene's duration, or --seconds if longer; if it fails, the next one is\n"
      "tried, up to 20.\n"
      "For an error of the path the reference is refined until it is ten times as certain.\n"
      "For comparison, it prints the paper's method with the largest alpha within the error, or\n"
      "the smallest within the cost, found by bisection over whole runs. Exit code 1 if no\n"
      "method meets the limit for the whole duration, or the reference cannot promise it.\n"
      "Examples:\n"
      "  substep recommend swinging_box --error 1e-4\n"
      "  substep recommend bridge --of gap --error 1e-3\n"
      "  substep recommend swinging_box --ms 0.05\n"
      "  substep recommend my_scene.json --error 1e-3 --out my_scene.json");
  command->callback([options, &exit_code] {
    if (options->all) {
      if (options->length.seconds || options->length.frames) {
        throw CLI::ValidationError("--all", "each shipped scene has its own duration");
      }
      exit_code = recommend_shipped(options->scene, options->out.empty() ? "-" : options->out,
                                    options->jobs);
      return;
    }
    if (options->scene.empty()) throw CLI::RequiredError("scene or --all");
    exit_code = recommend(*options);
  });
}

}  // namespace substep::cli
