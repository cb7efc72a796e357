// A text as the fragment of an address: the events of its run are written and read back to the same
// events. The api target opens whole links.

#include "app/text/event_text.hpp"
#include "app/text/link.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/fuzz/target.hpp"

namespace substep::fuzz {
namespace {

void read_and_write_events(const std::string& fragment) {
  static const Scene scene = scenes::pendulum();
  for (const LinkPart& part : parse_link(fragment)) {
    if (part.key != "events") continue;
    std::string problem;
    const auto events = read_events(part.value, scene, scene.settings, problem);
    require(problem.empty() || events.empty(), "either events or a problem");
    if (!problem.empty()) continue;
    const std::string text = events_text(events, scene.settings);
    require(text.size() <= 2 * kMostEventText,
            "the events that were read are written in little space");
    if (text.size() > kMostEventText) continue;
    const auto again = read_events(text, scene, scene.settings, problem);
    require(problem.empty(), "written events can be read");
    require(events_text(again, scene.settings) == text, "written events are the same events");
  }
}

}  // namespace
}  // namespace substep::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string fragment = substep::fuzz::text_of(data, size);
  substep::fuzz::read_and_write_events(fragment);
  return 0;
}
