#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/cli/bounded_text.hpp"
#include "app/cli/cancel.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/message.hpp"
#include "app/cli/output.hpp"
#include "app/cli/scene_source.hpp"
#include "core/io/experiment.hpp"
#include "core/io/json_text.hpp"
#include "core/io/result.hpp"
#include "core/lab/experiment_run.hpp"

namespace substep::cli {
namespace {

/// Runs a list of experiments, one per line.
class Experiments {
 public:
  explicit Experiments(std::shared_ptr<const Scene> given) : given_(std::move(given)) {}

  /// @return exit code
  int run(std::istream& input, const std::string& place) {
    std::string line;
    for (number_ = 1;; ++number_) {
      const Reading reading = read_line_bounded(input, kMostLine, line);
      if (reading == Reading::kEnd) return bad_ > 0 ? kBadInput : kOk;
      if (reading == Reading::kFailed) {
        complain("%s: %s", place.c_str(), std::strerror(errno));
        return kBadInput;
      }
      if (reading == Reading::kTooLong) {
        complain("%s:%zu: the line is longer than %zu bytes; the rest is not read", place.c_str(),
                 number_, kMostLine);
        return kBadInput;
      }
      if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
      const auto end = run_line(line, place);
      if (end) return *end;
    }
  }

 private:
  /// @return exit code if the list ends with this line
  std::optional<int> run_line(const std::string& line, const std::string& place) {
    Problems problems;
    const auto json = parse_json(line, problems);
    ExperimentInput experiment;
    if (json) {
      experiment = read_experiment(
          *json, [&](const std::string& name) { return find(name); }, problems);
    }
    for (const Problem& problem : problems) {
      complain("%s:%zu: %s", place.c_str(), number_, to_string(problem).c_str());
    }
    if (!problems.empty() || !experiment.experiment) {
      if (++bad_ < kMostBad) return std::nullopt;
      complain("%s: %zu lines are wrong; the rest is not read", place.c_str(), bad_);
      return kBadInput;
    }
    if (!run_one(*experiment.experiment, experiment.scene)) return kBadInput;
    if (!cancel_on_signal()) return std::nullopt;
    say_cancelled(" at line " + std::to_string(number_) + "; the completed results are printed");
    return kCancelled;
  }

  /// @return whether the result could be printed
  bool run_one(const Experiment& experiment, const std::shared_ptr<const Scene>& scene) {
    ExperimentRun run(*scene, experiment, reference(scene, experiment.duration));
    while (!cancel_on_signal() && run.advance()) {
    }
    if (cancel_on_signal()) return true;
    const std::string line =
        result_json(run.result()).dump(-1, ' ', false, Json::error_handler_t::replace);
    return std::printf("%s\n", line.c_str()) >= 0 && flush_standard_output();
  }

  std::shared_ptr<const Scene> find(const std::string& name) {
    if (given_) return given_->name == name ? given_ : nullptr;
    const std::vector<std::string> shipped = shipped_names();
    if (std::find(shipped.begin(), shipped.end(), name) == shipped.end()) return nullptr;
    auto& scene = scenes_[name];
    if (!scene) scene = load_scene(name);
    return scene;
  }

  /// Lists are usually in order of the scene: the last references suffice, and take little memory.
  const Reference& reference(const std::shared_ptr<const Scene>& scene, double duration) {
    const auto is_wanted = [&](const KnownReference& known) {
      return known.scene == scene && known.duration == duration;
    };
    auto at = std::find_if(references_.begin(), references_.end(), is_wanted);
    if (at == references_.end()) {
      if (references_.size() == kMostReferences) references_.pop_back();
      references_.push_front({scene, duration, find_reference(scene, duration)});
    } else {
      references_.splice(references_.begin(), references_, at);
    }
    return references_.front().reference;
  }

  struct KnownReference {
    std::shared_ptr<const Scene> scene;
    double duration = 0.0;  // [s]
    Reference reference;
  };

  static constexpr std::size_t kMostLine = 1U << 20U;  // [bytes]
  static constexpr std::size_t kMostBad = 100;         // lines
  static constexpr std::size_t kMostReferences = 4;

  std::shared_ptr<const Scene> given_;
  std::map<std::string, std::shared_ptr<const Scene>> scenes_;
  std::list<KnownReference> references_;  // the last used first
  std::size_t number_ = 0;                // current line
  std::size_t bad_ = 0;                   // number of invalid lines
};

}  // namespace

int run_experiments(const std::string& path, const std::string& scene) {
  std::shared_ptr<const Scene> given;
  if (!scene.empty() && !(given = load_scene(scene))) return kBadInput;
  std::ifstream file;
  if (path != "-") {
    file.open(path);
    if (!file) {
      complain("%s: %s", path.c_str(), std::strerror(errno));
      return kBadInput;
    }
  }
  std::istream& input = path == "-" ? std::cin : file;
  return Experiments(given).run(input, path == "-" ? "standard input" : path);
}

}  // namespace substep::cli
