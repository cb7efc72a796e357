// What window.substep is made of: each call takes and gives text, JSON where there is structure.

#include <emscripten.h>

#include <nlohmann/json.hpp>
#include <string>

#include "app/format.hpp"
#include "core/model/names.hpp"
#include "web/instance.hpp"

using nlohmann::json;
using substep::App;
using substep::Problem;
using substep::web::instance;

namespace {

App& app() { return *instance->app; }

const char* keep(const json& value) {
  static std::string text;
  // What is not UTF-8 came from outside and is shown with a mark instead.
  text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  return text.c_str();
}

json outcome(const std::vector<Problem>& problems) {
  json list = json::array();
  for (const Problem& p : problems)
    list.push_back({{"pointer", p.pointer}, {"message", p.message}});
  return {{"ok", problems.empty()}, {"problems", std::move(list)}};
}

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

std::string text_of(const json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

extern "C" {

/// A shipped scene by its name, or a scene as JSON.
EMSCRIPTEN_KEEPALIVE const char* substep_load(const char* text, const char* from) {
  const std::string_view view(text);
  if (view.find('{') == std::string_view::npos) {
    const std::string problem = app().set("scene", view);
    return keep(outcome(problem.empty() ? std::vector<Problem>{}
                                        : std::vector<Problem>{{"scene", problem}}));
  }
  const bool playing = app().session.playing();
  app().open_text(view, from);
  if (!playing) app().session.pause();
  return keep(outcome(app().trouble.problems));
}

/// Settings by name, as an object. Those that can be read hold, the others are told.
EMSCRIPTEN_KEEPALIVE const char* substep_set(const char* text) {
  const json object = json::parse(text, nullptr, false);
  if (!object.is_object()) return keep(outcome({{"", "is not an object of settings"}}));
  std::vector<Problem> problems;
  if (object.contains("scene")) {  // first: it brings settings of its own
    const std::string problem = app().set("scene", text_of(object["scene"]));
    if (!problem.empty()) problems.push_back({"scene", problem});
  }
  for (const auto& [key, value] : object.items()) {
    if (key == "scene") continue;
    const std::string problem = app().set(key, text_of(value));
    if (!problem.empty()) problems.push_back({key, problem});
  }
  return keep(outcome(problems));
}

/// Takes frames at once, without waiting for the clock.
EMSCRIPTEN_KEEPALIVE void substep_step(int frames) {
  for (int i = 0; i < frames && !app().session.stopped(); ++i) app().session.step();
}

EMSCRIPTEN_KEEPALIVE void substep_play(int on) {
  if (on != 0) {
    app().session.play();
  } else {
    app().session.pause();
  }
}

EMSCRIPTEN_KEEPALIVE int substep_playing() { return app().session.playing() ? 1 : 0; }

EMSCRIPTEN_KEEPALIVE void substep_reset() { app().reset(); }

EMSCRIPTEN_KEEPALIVE void substep_open_link(const char* fragment) { app().open_link(fragment); }

EMSCRIPTEN_KEEPALIVE const char* substep_hash() {
  static std::string text;
  text = substep::hex(app().session.hash());
  return text.c_str();
}

/// The last frame and how the run stands.
EMSCRIPTEN_KEEPALIVE const char* substep_report() {
  const substep::Session& s = app().session;
  const substep::FrameReport& r = s.report();
  const substep::Settings& set = s.settings();
  json out = {
      {"scene", s.scene().name},
      {"title", s.scene().title},
      {"solver", substep::name_of(set.solver)},
      {"mode", substep::name_of(set.mode)},
      {"integrator", substep::name_of(set.integrator)},
      {"alpha", set.alpha},
      {"playing", s.playing()},
      {"stopped", s.stopped()},
      {"frame", s.state().frame},
      {"time", s.state().time},
      {"substeps", r.n_substeps},
      {"substeps_wanted", r.n_wanted},
      {"capped", r.capped},
      {"dt_stable", number(r.dt_stable)},
      {"kinetic", number(r.kinetic)},
      {"potential", number(r.potential)},
      {"energy", number(r.energy)},
      {"constraint_error", number(r.constraint_error)},
      {"joint_gap", number(r.joint_gap)},
      {"penetration", number(r.penetration)},
      {"milliseconds", 1e3 * r.times.total},
      {"pace", s.pace()},
      {"holds", s.verdict().holds()},
      {"verdict", s.verdict().text()},
      {"trouble", app().trouble.title},
      {"frame_time", app().frame_time},
  };
  if (r.leader.body >= 0) {
    out["leader"] = {{"body", s.scene().bodies[static_cast<std::size_t>(r.leader.body)].name},
                     {"dof", r.leader.dof},
                     {"k", number(r.leader.k)},
                     {"mass", number(r.leader.mass)}};
  }
  return keep(out);
}

/// Names and titles of the scenes that there are.
EMSCRIPTEN_KEEPALIVE const char* substep_scenes() {
  json list = json::array();
  for (const auto& scene : app().library.scenes()) {
    list.push_back({{"name", scene->name}, {"title", scene->title}, {"group", scene->group}});
  }
  return keep(list);
}

EMSCRIPTEN_KEEPALIVE void substep_close_trouble() { app().trouble = {}; }

}  // extern "C"
