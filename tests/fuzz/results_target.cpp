// A text as a results file, and each of its lines as an experiment to repeat.

#include <memory>
#include <string>

#include "app/cli/results_text.hpp"
#include "core/io/experiment.hpp"
#include "core/io/json_text.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/fuzz/target.hpp"

namespace substep::fuzz {
namespace {

void read_file(const std::string& text) {
  cli::StoredResults results;
  if (!results.read("input", text)) return;
  // The results are written as `sweep` does and read again.
  cli::StoredResults again;
  require(again.read("output", results.text()), "a written file can be read");
  require(again == results, "a written file has the same results");
}

void read_experiments(const std::string& text) {
  static const auto pendulum = std::make_shared<const Scene>(scenes::pendulum());
  const auto find = [](const std::string& name) {
    return name == pendulum->name ? pendulum : nullptr;
  };
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    Problems problems;
    const auto json = parse_json(std::string_view(text).substr(at, end - at), problems);
    at = end + 1;
    if (!json) continue;
    problems.clear();
    const ExperimentInput read = read_experiment(*json, find, problems);
    require(read.experiment.has_value() == problems.empty(), "either an experiment or problems");
    if (!read.experiment) continue;
    const ExperimentInput again =
        read_experiment(experiment_json(*read.experiment), find, problems);
    require(again.experiment && experiment_id(*again.experiment) == experiment_id(*read.experiment),
            "an experiment that was written is the same");
    require(command_line(*read.experiment, *pendulum).starts_with("substep run pendulum"),
            "an experiment has a command line");
  }
}

}  // namespace
}  // namespace substep::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = substep::fuzz::text_of(data, size);
  substep::fuzz::read_file(text);
  substep::fuzz::read_experiments(text);
  return 0;
}
