#include "app/cli/experiments_input.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <utility>

#include "app/cli/commands.hpp"
#include "app/cli/scene_source.hpp"
#include "core/io/experiment.hpp"
#include "core/io/json_text.hpp"
#include "core/io/result.hpp"
#include "core/lab/experiment_run.hpp"

namespace substep::cli {
namespace {

class Runner {
 public:
  explicit Runner(std::shared_ptr<const Scene> given) : given_(std::move(given)) {}

  /// @return whether the result could be printed
  bool run(const Experiment& experiment, const std::shared_ptr<const Scene>& scene) {
    ExperimentRun run(*scene, experiment, reference(scene, experiment.duration));
    while (run.advance()) {
    }
    const std::string line =
        result_json(run.result()).dump(-1, ' ', false, Json::error_handler_t::replace);
    return std::printf("%s\n", line.c_str()) >= 0 && std::fflush(stdout) == 0;
  }

  std::shared_ptr<const Scene> find(const std::string& name) {
    if (given_) return given_->name == name ? given_ : nullptr;
    const std::vector<std::string> shipped = shipped_names();
    if (std::find(shipped.begin(), shipped.end(), name) == shipped.end()) return nullptr;
    auto& scene = scenes_[name];
    if (!scene) scene = load_scene(name);
    return scene;
  }

 private:
  const Reference& reference(const std::shared_ptr<const Scene>& scene, double duration) {
    auto& reference = references_[{scene->name, duration}];
    if (!reference) reference = std::make_unique<Reference>(find_reference(scene, duration));
    return *reference;
  }

  std::shared_ptr<const Scene> given_;
  std::map<std::string, std::shared_ptr<const Scene>> scenes_;
  std::map<std::pair<std::string, double>, std::unique_ptr<Reference>> references_;
};

}  // namespace

int run_experiments(const std::string& path, const std::string& scene) {
  std::shared_ptr<const Scene> given;
  if (!scene.empty() && !(given = load_scene(scene))) return kBadInput;
  std::ifstream file;
  if (path != "-") {
    file.open(path);
    if (!file) {
      std::fprintf(stderr, "%s: %s\n", path.c_str(), std::strerror(errno));
      return kBadInput;
    }
  }
  std::istream& input = path == "-" ? std::cin : file;
  const std::string place = path == "-" ? "standard input" : path;

  Runner runner(given);
  int exit_code = kOk;
  std::size_t number = 0;
  for (std::string line; std::getline(input, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    Problems problems;
    const auto json = parse_json(line, problems);
    ExperimentInput experiment;
    if (json) {
      experiment = read_experiment(
          *json, [&](const std::string& name) { return runner.find(name); }, problems);
    }
    for (const Problem& problem : problems) {
      std::fprintf(stderr, "%s:%zu: %s\n", place.c_str(), number, to_string(problem).c_str());
    }
    if (!problems.empty() || !experiment.experiment) {
      exit_code = kBadInput;
    } else if (!runner.run(*experiment.experiment, experiment.scene)) {
      std::fprintf(stderr, "standard output: could not be written to its end\n");
      return kBadInput;
    }
  }
  return exit_code;
}

}  // namespace substep::cli
