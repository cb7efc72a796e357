// A text as the fragment of an address: the experiment is written as a link and read back to the
// same experiment, and so are the events of its run.

#include <memory>

#include "app/text/event_text.hpp"
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
  require(again.experiment.has_value(), "a written link can be read");
  require(experiment_id(*again.experiment) == experiment_id(*read.experiment),
          "a written link is the same experiment");
}

void read_and_write_events(const std::string& fragment) {
  const auto scene = find("pendulum");
  for (const LinkPart& part : parse_link(fragment)) {
    if (part.key != "events") continue;
    std::string problem;
    const auto events = read_events(part.value, *scene, scene->settings, problem);
    require(problem.empty() || events.empty(), "either events or a problem");
    if (!problem.empty()) continue;
    const std::string text = events_text(events, scene->settings);
    require(text.size() <= 2 * kMostEventText,
            "the events that were read are written in little space");
    if (text.size() > kMostEventText) continue;
    const auto again = read_events(text, *scene, scene->settings, problem);
    require(problem.empty(), "written events can be read");
    require(events_text(again, scene->settings) == text, "written events are the same events");
  }
}

}  // namespace
}  // namespace substep::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string fragment = substep::fuzz::text_of(data, size);
  substep::fuzz::read_and_write_experiment(fragment);
  substep::fuzz::read_and_write_events(fragment);
  return 0;
}
