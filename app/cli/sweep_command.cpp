#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/cli/all_methods.hpp"
#include "app/cli/cancel.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/flags.hpp"
#include "app/cli/message.hpp"
#include "app/cli/output.hpp"
#include "app/cli/parallel_sweep.hpp"
#include "app/cli/progress_line.hpp"
#include "app/cli/report.hpp"
#include "app/cli/results_file.hpp"
#include "app/cli/scene_source.hpp"
#include "app/cli/within.hpp"
#include "core/io/experiment.hpp"
#include "core/io/result.hpp"
#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/io/stored_sweep.hpp"
#include "core/model/format_text.hpp"
#include "core/model/number_text.hpp"

namespace substep::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kMostSeeds = 1000;

/// "2/5": the second of five parts.
struct Shard {
  int index = 1;
  int count = 1;
};

std::optional<Shard> parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return std::nullopt;
  const auto index = parse_integer(text.substr(0, slash));
  const auto count = parse_integer(text.substr(slash + 1));
  if (!index || !count || *count < 1 || *count > 100000 || *index < 1 || *index > *count) {
    return std::nullopt;
  }
  return Shard{static_cast<int>(*index), static_cast<int>(*count)};
}

struct SweepOptions {
  std::string scene;
  std::string out;
  std::string shard;
  std::string ship;
  int seeds = 1;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  bool list = false;
  bool quiet = false;
  LengthFlags length;
  SettingsFlags settings;
};

std::vector<Experiment> experiments_of(const SweepOptions& options, const Scene& scene,
                                       const Shard& shard) {
  Scene own = scene;
  own.settings = own_settings(scene);
  own.settings = options.settings.applied_to(own);
  Experiment plain = experiment_of(scene, own.settings);
  plain.duration = options.length.frames ? static_cast<double>(*options.length.frames) * scene.frame
                                         : options.length.seconds.value_or(scene.criteria.duration);
  std::vector<Experiment> all;
  for (int seed = 0; seed < options.seeds; ++seed) {
    for (const SweepPoint& point : default_sweep(own)) {
      Experiment& experiment = all.emplace_back(plain);
      experiment.settings = point.settings;
      experiment.load = point.load;
      experiment.seed = seed;
    }
  }
  std::vector<Experiment> own_part;  // every count-th: each part has cheap and expensive ones
  for (std::size_t i = static_cast<std::size_t>(shard.index - 1); i < all.size();
       i += static_cast<std::size_t>(shard.count)) {
    own_part.push_back(std::move(all[i]));
  }
  return own_part;
}

/// "[######----]  61 %  80 of 133 runs, 22 failed, 1:05 left"
std::string progress_text(double share, std::size_t runs, std::size_t all, std::size_t failed,
                          double seconds) {
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(share * kWidth);
  std::string bar(static_cast<std::size_t>(filled), '#');
  bar.resize(kWidth, '-');
  std::string text = format_text("[%s] %3.0f %%  %zu of %zu runs, %zu failed", bar.c_str(),
                                 100.0 * share, runs, all, failed);
  if (share > 0.02) {
    const auto left = static_cast<int>(seconds * (1.0 - share) / share + 0.5);
    text += format_text(", %d:%02d left", left / 60, left % 60);
  }
  return text;
}

/// Runs the sweep that is shipped with a scene (scenes/sweeps) and writes its file.
int ship(const SweepOptions& options) {
  const auto scene = load_scene(options.scene);
  if (!scene || !spares_inputs(options.ship)) return kBadInput;
  const auto results = run_experiments(scene, quick_sweep(*scene), options.jobs);
  if (!results) return kCancelled;
  const std::string text = sweep_text(*results, results->front().reference);
  return write_file(options.ship, text) ? kOk : kBadInput;
}

/// Saves the scene of a sweep beside its results, as scene.json, so that results of different
/// scenes with one name do not mix. @return false, with a message on stderr, if another scene is
/// there, or it cannot be written
bool keep_scene(const fs::path& folder, const Scene& scene) {
  const std::string path = (folder / "scene.json").string();
  std::error_code error;
  if (!fs::exists(path, error)) return write_file(path, write_scene(scene));
  if (!fs::is_regular_file(path, error)) {
    complain("%s: not a regular file", path.c_str());
    return false;
  }
  const SceneResult kept = read_scene_file(path);
  for (const Problem& problem : kept.problems) {
    complain("%s: %s", path.c_str(), to_string(problem).c_str());
  }
  if (!kept.scene) {
    complain(
        "%s: damaged: the scene of the results in this folder is not known; choose another "
        "--out",
        path.c_str());
    return false;
  }
  if (kept.scene->name == scene.name && scene_hash(*kept.scene) == scene_hash(scene)) return true;
  const char* which =
      kept.scene->name == scene.name ? "another scene of this name" : "another scene";
  complain("%s: the results in this folder are of %s; choose another --out", path.c_str(), which);
  return false;
}

int sweep(const SweepOptions& options, const Shard& shard) {
  const auto scene = load_scene(options.scene);
  if (!scene) return kBadInput;
  const std::vector<Experiment> all = experiments_of(options, *scene, shard);
  if (options.list) {
    for (const Experiment& experiment : all) {
      std::printf("%s\n", experiment_json(experiment).dump().c_str());
    }
    return kOk;
  }

  const fs::path folder =
      options.out.empty() ? fs::path(scene->name + ".sweep") : fs::path(options.out);
  keep_apart({{"--out", (folder / "report.html").string()}}, {scene_path(options.scene)});
  const std::string name = shard.count == 1 ? "results.jsonl"
                                            : "results." + std::to_string(shard.index) + "-of-" +
                                                  std::to_string(shard.count) + ".jsonl";
  keep_files_apart(folder, name);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    complain("%s: %s", folder.string().c_str(), error.message().c_str());
    return kBadInput;
  }
  ResultsFile file;
  const ResultsScene key{scene->name, scene_hash(*scene), "the scene of this sweep"};
  if (!keep_scene(folder, *scene) || !file.open((folder / name).string(), key)) return kBadInput;

  ParallelSweep parallel;
  parallel.scene = scene;
  parallel.jobs = options.jobs;
  std::vector<std::string> order;
  for (const Experiment& experiment : all) {
    order.push_back(experiment_id(experiment));
    if (!file.contains(order.back())) parallel.experiments.push_back(experiment);
  }
  const std::size_t known = all.size() - parallel.experiments.size();
  if (known > 0 && !options.quiet) {
    complain("%zu of %zu runs are already present", known, all.size());
  }

  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  std::atomic<std::size_t> runs{0};
  std::atomic<std::size_t> failed{0};
  std::atomic<bool> written{true};
  parallel.on_result = [&](std::size_t, const Result& result) {
    ++runs;
    if (!result.metrics.holds) ++failed;
    if (!file.append(experiment_id(result.experiment), result_json(result))) written = false;
    return written.load();
  };
  ProgressLine progress(!options.quiet && stderr_is_terminal());
  parallel.on_progress = [&](double share) {
    if (!progress.due()) return;
    progress.show(progress_text(share, runs, parallel.experiments.size(), failed, seconds()));
  };
  const bool complete = run_sweep(parallel);
  progress.clear();
  if (!written) return kBadInput;
  if (!complete) {
    say_cancelled(format_text(": %zu of %zu runs are in %s; the same command continues from there",
                              known + runs, all.size(), (folder / name).string().c_str()));
    return kCancelled;
  }
  if (!file.finish(order)) return kBadInput;
  if (!options.quiet) {
    say(stdout, "%s: %zu runs, %zu of the new ones failed, %.1f s\n", scene->name.c_str(),
        file.size(), failed.load(), seconds());
    say(stdout, "results  %s\n", visible_text((folder / name).string()).c_str());
  }
  if (shard.count > 1) return kOk;  // `merge` writes the report for all parts
  return write_sweep_report(folder, scene, file.results(), options.quiet) ? kOk : kBadInput;
}

}  // namespace

void add_sweep(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<SweepOptions>();
  CLI::App* command = app.add_subcommand("sweep", "Run all methods on a scene: error against cost");
  command
      ->add_option("scene", options->scene,
                   "name or file of a scene, or file of a model, - for standard input")
      ->required();
  command->add_option("--out", options->out, "folder for results.jsonl and report.html")
      ->check(named());
  command->add_option("--jobs", options->jobs, "threads")->check(whole(1, 1024));
  command
      ->add_option("--seeds", options->seeds,
                   "runs of each experiment, from starts that differ by 1e-9 m/s")
      ->check(whole(1, kMostSeeds));
  command
      ->add_option("--shard", options->shard, "i/n: only the i-th of n parts; `merge` merges them")
      ->check([](const std::string& text) -> std::string {
        return parse_shard(text) ? "" : must_be("i/n with 1 <= i <= n", text);
      });
  command->add_flag("--list", options->list,
                    "print the experiments, one JSON object per line, and run none");
  command
      ->add_option("--ship", options->ship,
                   "write the shipped sweep, which the application shows before it runs anything: "
                   "scenes/sweeps/SCENE.txt")
      ->check(named());
  command->add_flag("--quiet", options->quiet, "no progress, no summary");
  options->length.add_to(*command);
  options->settings.add_to(*command, swept_settings(),
                           "is no flag of sweep, which runs every method along its parameters");
  command->footer(
      "Completed runs are not repeated: a stopped sweep continues.\n"
      "Examples:\n"
      "  substep sweep swinging_box\n"
      "  substep sweep bridge --seconds 2 --iterations 50 --out bridge_50\n"
      "  parallel substep sweep bridge --out b --jobs 1 --shard {}/4 ::: 1 2 3 4; substep merge b");
  command->callback([options, command, &exit_code] {
    if (!options->ship.empty()) {
      refuse_beside(*command, "--ship", {"scene", "--jobs"});
      keep_apart({{"--ship", options->ship}}, {scene_path(options->scene)});
      exit_code = ship(*options);
      return;
    }
    for (const char* flag : {"--out", "--jobs"}) {
      if (options->list && command->count(flag) > 0) throw CLI::ExcludesError(flag, "--list");
    }
    exit_code = sweep(*options, parse_shard(options->shard).value_or(Shard{}));
  });
}

}  // namespace substep::cli
