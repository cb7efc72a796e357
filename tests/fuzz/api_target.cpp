// Lines of text as calls of the page's API, one per line: the name of the call, a space, its
// argument. After any of them the application still works and has a readable report, settings, link
// and saved scene.

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>

#include "app/app.hpp"
#include "app/imgui/complaints.hpp"
#include "core/io/json_text.hpp"
#include "core/io/scene_reader.hpp"
#include "tests/app/ui/null_renderer.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/frame_laws.hpp"
#include "web/api.hpp"
#include "web/instance.hpp"

namespace substep::web {
std::unique_ptr<Instance> instance;
}  // namespace substep::web

namespace substep::fuzz {
namespace {

constexpr int kCalls = 24;               // of one input
constexpr int kFrames = 3;               // of one call
constexpr int kSubsteps = 4;             // of a frame
constexpr std::size_t kMostBodies = 32;  // of scenes that are run

App& app() { return *web::instance->app; }

Library shipped() { return Library(SUBSTEP_SOURCE_DIR "/scenes"); }

/// A newly opened page. Fonts take most of a second, so those of the first page are reused.
void open_page() {
  static const Library library = shipped();
  if (!web::instance) {
    web::instance = std::make_unique<web::Instance>();
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {1280.0F, 720.0F};
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  }
  auto fresh = std::make_unique<App>(library, std::make_unique<NullRenderer>());
  if (web::instance->app) {
    fresh->look = web::instance->app->look;
    fresh->pixel_ratio = web::instance->app->pixel_ratio;
  }
  web::instance->app = std::move(fresh);
}

bool small() { return app().session.scene().bodies.size() <= kMostBodies; }

/// Keeps runs short; the method does not change.
void limit_work() { app().change(test::shortened(app().session.settings(), kSubsteps)); }

void draw() {
  if (!small()) substep_play(0);
  limit_work();
  ImGui::GetIO().DeltaTime = 1.0F / 60.0F;
  frame(app(), 1.0 / 60.0);
}

bool is_json(const char* text) {
  Problems problems;
  return parse_json(text, problems).has_value() && problems.empty();
}

void call(const std::string& line) {
  const std::size_t space = std::min(line.find(' '), line.size());
  const std::string name = line.substr(0, space);
  const std::string text = space < line.size() ? line.substr(space + 1) : "";
  if (name == "open") {
    require(is_json(substep_open(text.c_str())), "open answers in JSON");
  } else if (name == "load") {
    require(is_json(substep_open_text(text.c_str(), "input")), "load answers in JSON");
  } else if (name == "read") {
    substep_read(text.c_str());
    while (substep_read_some() != 0) {
    }
    require(is_json(substep_open_read("input")), "openRead answers in JSON");
  } else if (name == "set") {
    require(is_json(substep_set(text.c_str())), "set answers in JSON");
  } else if (name == "link") {
    require(is_json(substep_open_link(text.c_str())), "openLink answers in JSON");
  } else if (name == "step" && small()) {
    limit_work();
    substep_step(std::min(std::atoi(text.c_str()), kFrames));
  } else if (name == "substep" && small()) {
    limit_work();
    substep_substep();
  } else if (name == "goTo") {
    substep_go_to(std::strtod(text.c_str(), nullptr));
  } else if (name == "play") {
    substep_play(1);
  } else if (name == "pause") {
    substep_play(0);
  } else if (name == "reset") {
    substep_reset();
  } else if (name == "draw") {
    draw();
  } else if (name == "tell") {
    substep_tell(text.c_str());
  } else if (name == "trouble") {
    substep_trouble("input", text.c_str(), text.c_str());
  }
}

/// Queries that a user may make after any action.
void look() {
  require(imgui::complaints() == 0, "Dear ImGui is called correctly");
  require(is_json(substep_report()), "report is JSON");
  require(is_json(substep_settings()), "settings are JSON");
  require(is_json(substep_scenes()), "scenes are JSON");
  require(is_json(substep_widgets()), "widgets are JSON");
  require(std::string(substep_hash()).size() == 16, "a hash has 16 digits");
  require(std::string(substep_history()).find('\n') != std::string::npos, "a history has lines");
  require(std::string(substep_command()).starts_with("./dev cli run "), "there is a command line");
  const std::string what = test::not_finite(app().session.state());
  require(what.empty(), "the state is finite, not its " + what);
  const SceneResult saved = read_scene(substep_saved_scene());
  // A torn chain is not a valid start; a run that holds can be saved.
  require(saved.scene || !app().session.verdict().holds(),
          "a run that holds can be saved and read");
  const std::string link = substep_link();
  const std::string own = substep_own_scene();
  // The page packs a user's scene into the link; the engine receives the two separately.
  if (own.empty()) {
    substep_open_link(link.c_str());
    require(app().trouble.problems.empty(), "a written link can be read");
    const std::string again = substep_link();
    require(again == link, "a written link is the same experiment: " + link + " " + again);
  } else {
    require(read_scene(own).scene != nullptr, "the link's own scene can be read");
  }
}

}  // namespace
}  // namespace substep::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace substep::fuzz;
  const std::string text = text_of(data, size);
  open_page();
  std::size_t at = 0;
  for (int i = 0; i < kCalls && at < text.size(); ++i) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    call(text.substr(at, end - at));
    at = end + 1;
  }
  draw();
  look();
  return 0;
}
