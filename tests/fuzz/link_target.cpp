// A text as the fragment of an address: the experiment that is read is written as a link that is
// read to the same experiment.

#include <memory>

#include "app/text/link.hpp"
#include "core/io/experiment.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/fuzz/target.hpp"

namespace substep::fuzz {
namespace {

std::shared_ptr<const Scene> find(const std::string& name) {
  static const auto pendulum = std::make_shared<const Scene>(scenes::pendulum());
  static const auto slope = std::make_shared<const Scene>(scenes::sliding_box());
  if (name == pendulum->name) return pendulum;
  return name == slope->name ? slope : nullptr;
}

void read_and_write_experiment(const std::string& fragment) {
  Problems problems;
  const ExperimentInput read = read_experiment_link(fragment, find, problems);
  require(read.experiment.has_value() == problems.empty(), "either an experiment or problems");
  if (!read.experiment) return;
  const std::string link = make_link(*read.scene, *read.experiment);
  const ExperimentInput again = read_experiment_link(link, find, problems);
  require(again.experiment.has_value(), "a link that was made can be read");
  require(experiment_id(*again.experiment) == experiment_id(*read.experiment),
          "a link that was made is the same experiment");
}

}  // namespace
}  // namespace substep::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  substep::fuzz::read_and_write_experiment(substep::fuzz::text_of(data, size));
  return 0;
}
