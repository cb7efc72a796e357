#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "app/cli/bounded_text.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/message.hpp"
#include "app/cli/output.hpp"
#include "app/cli/report.hpp"
#include "app/cli/results_file.hpp"
#include "app/cli/scene_source.hpp"
#include "app/cli/within.hpp"
#include "core/io/experiment.hpp"
#include "core/io/result_reader.hpp"
#include "core/lab/sweep.hpp"

namespace substep::cli {
namespace {

namespace fs = std::filesystem;

struct MergeOptions {
  std::string folder;
  std::vector<std::string> files;
  std::string scene;
  bool quiet = false;
};

/// The parts in the folder: results.*.jsonl, and results.jsonl if it exists.
std::vector<fs::path> parts_of(const fs::path& folder) {
  std::vector<fs::path> parts;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("results") && name.ends_with(".jsonl") && name != "results.jsonl") {
      parts.push_back(entry.path());
    }
  }
  std::sort(parts.begin(), parts.end());
  return parts;
}

/// Reads a file of results without a truncated last line, which is reported. @return false, with a
/// message on stderr, if it cannot be read or is too large
bool read_part(const std::string& path, std::string& text) {
  constexpr std::size_t kMostLine = 1U << 20U;  // [bytes]
  std::ifstream stream(path, std::ios::binary);
  text.clear();
  std::string line;
  std::size_t number = 0;
  while (stream) {
    const Reading reading = read_line_bounded(stream, kMostLine, line);
    if (reading == Reading::kFailed) break;
    if (reading == Reading::kEnd) return true;
    ++number;
    if (reading == Reading::kCut && is_cut_line(line)) {
      complain("%s:%zu: the last line is cut short; it is left out", path.c_str(), number);
      return true;
    }
    if (reading == Reading::kTooLong || text.size() + line.size() >= kMostResults) {
      complain("%s: has a line of more than %zu bytes, or more than %zu in all", path.c_str(),
               kMostLine, kMostResults);
      return false;
    }
    text += line + '\n';
    if (reading == Reading::kCut) return true;
  }
  complain("%s: %s", path.c_str(), std::strerror(errno));
  return false;
}

/// Whether there is something to merge. A missing folder has no parts; it is only created for
/// results from other folders.
bool has_parts(const fs::path& folder, const std::vector<fs::path>& parts) {
  std::error_code error;
  if (!parts.empty() || fs::exists(folder / "results.jsonl", error)) return true;
  const char* what = fs::is_directory(folder, error) ? "there are no results to merge"
                     : fs::exists(folder, error)     ? "it is not a folder"
                                                     : "there is no such folder";
  complain("%s: %s", folder.string().c_str(), what);
  return false;
}

/// The scene of the results, and where it is known from.
struct MergedScene {
  std::shared_ptr<const Scene> scene;  // null: not known, the report does without
  std::string from;

  [[nodiscard]] ResultsScene key() const { return {scene->name, scene_hash(*scene), from}; }
};

/// The scene of --scene, or that which `sweep` saves beside its results. @return nothing, with a
/// message on stderr, if it cannot be read
std::optional<MergedScene> given_scene(const MergeOptions& options) {
  MergedScene given;
  const std::string kept = (fs::path(options.folder) / "scene.json").string();
  std::error_code error;
  if (!options.scene.empty()) {
    given = {load_scene(options.scene), "--scene " + options.scene};
  } else if (fs::exists(kept, error)) {
    given = {load_scene(kept), kept};
  } else {
    return given;
  }
  return given.scene ? std::optional(given) : std::nullopt;
}

/// The shipped scene of that name, if there is one; null otherwise. @return nothing, with a message
/// on stderr, if the results are of another scene of that name
std::optional<MergedScene> shipped_scene(const ResultsScene& results) {
  const std::vector<std::string> shipped = shipped_names();
  MergedScene found;
  if (std::count(shipped.begin(), shipped.end(), results.name) == 0) return found;
  found = {load_scene(results.name), "`substep scenes`"};
  if (!found.scene) return std::nullopt;
  if (scene_hash(*found.scene) == results.hash) return found;
  complain(
      "%s: /scene_hash: %s is not that of %s in `substep scenes`, %s; its file is given with "
      "--scene",
      results.from.c_str(), hex_text(results.hash).c_str(), results.name.c_str(),
      hex_text(scene_hash(*found.scene)).c_str());
  return std::nullopt;
}

/// The ids of results in the order of an unsharded sweep; those of other settings are left out.
std::vector<std::string> plan_of(const Scene& scene, const std::vector<Json>& results) {
  const auto settings_id = [](Experiment experiment) {
    experiment.duration = 0.0;
    experiment.seed = 0;
    return experiment_id(experiment);
  };
  std::map<std::string, std::size_t> position;  // in the sweep, by settings_id
  Experiment experiment = experiment_of(scene, scene.settings);
  for (const SweepPoint& point : default_sweep(scene)) {
    experiment.settings = point.settings;
    experiment.load = point.load;
    position.emplace(settings_id(experiment), position.size());
  }
  std::vector<std::tuple<double, int, std::size_t, std::string>> planned;
  for (const Json& result : results) {
    Problems none;  // it was read before
    const auto read = read_result(result, none);
    const auto found = read ? position.find(settings_id(*read)) : position.end();
    if (found == position.end()) continue;
    planned.emplace_back(read->duration, read->seed, found->second, experiment_id(*read));
  }
  std::sort(planned.begin(), planned.end());
  std::vector<std::string> plan;
  for (auto& [seconds, seed, at, id] : planned) plan.push_back(std::move(id));
  return plan;
}

int merge(const MergeOptions& options) {
  const fs::path folder = options.folder;
  std::vector<fs::path> parts = parts_of(folder);
  parts.insert(parts.end(), options.files.begin(), options.files.end());
  if (!has_parts(folder, parts)) return kBadInput;
  auto merged = given_scene(options);
  if (!merged) return kBadInput;

  StoredResults results;
  if (merged->scene) results.bind(merged->key());
  const std::string path = (folder / "results.jsonl").string();
  std::error_code error;
  // Read here too: nothing is written if the results are not of one scene.
  std::vector<fs::path> sources = parts;
  if (fs::exists(path, error)) sources.insert(sources.begin(), path);
  for (const fs::path& source : sources) {
    // Only a pipe that the command line names is waited for.
    const bool is_part = source.parent_path() == folder && !fs::is_directory(source, error);
    if (!is_part || fs::is_regular_file(source, error)) continue;
    complain("%s: not a regular file", source.string().c_str());
    return kBadInput;
  }
  for (const fs::path& source : sources) {
    std::string text;
    if (!read_part(source.string(), text)) return kBadInput;
    if (source != path) protect_input(source.string());
    if (!results.read(source.string(), text)) return kBadInput;
  }
  if (results.order().empty()) {
    complain("%s: there are no results to merge", folder.string().c_str());
    return kBadInput;
  }
  if (!merged->scene) merged = shipped_scene(*results.scene());
  if (!merged) return kBadInput;

  fs::create_directories(folder, error);
  ResultsFile file;
  if (!file.open(path, *results.scene())) return kBadInput;
  for (const std::string& id : results.order()) {
    if (!file.contains(id) && !file.append(id, Json::parse(results.line(id), nullptr, false))) {
      return kBadInput;
    }
  }
  const std::shared_ptr<const Scene>& scene = merged->scene;
  const std::vector<std::string> plan =
      scene ? plan_of(*scene, file.results()) : std::vector<std::string>();
  if (!file.finish(plan)) return kBadInput;
  if (!options.quiet) {
    say(stdout, "%zu runs from %zu parts\nresults  %s\n", file.size(), parts.size(),
        visible_text((folder / "results.jsonl").string()).c_str());
  }
  return write_sweep_report(folder, scene, file.results(), options.quiet) ? kOk : kBadInput;
}

}  // namespace

void add_merge(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<MergeOptions>();
  CLI::App* command = app.add_subcommand(
      "merge", "Merge the parts of a sweep into results.jsonl, and write their report");
  command->add_option("folder", options->folder, "folder of the parts and the results")->required();
  command->add_option("file", options->files, "further files of results, from `run --experiments`");
  command
      ->add_option("--scene", options->scene,
                   "file of the scene, if it is not one of `substep scenes`")
      ->check(named());
  command->add_flag("--quiet", options->quiet, "no summary");
  command->footer("Example:\n  substep merge bridge.sweep");
  command->callback([options, &exit_code] {
    std::vector<std::string> inputs = options->files;
    inputs.push_back(options->scene);
    const fs::path folder = options->folder;
    keep_apart({{"folder", (folder / "report.html").string()}}, inputs);
    keep_files_apart(folder, "results.jsonl");
    if (!options->scene.empty()) {
      keep_apart({{"folder", (folder / "results.jsonl").string()}}, {options->scene});
    }
    exit_code = merge(*options);
  });
}

}  // namespace substep::cli
