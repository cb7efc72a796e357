#include "web/api.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/lab/frame_slices.hpp"
#include "app/lab/opened_text.hpp"
#include "app/text/citation.hpp"
#include "app/text/export.hpp"
#include "app/text/introduction.hpp"
#include "app/ui/handles.hpp"
#include "app/ui/interface_scale.hpp"
#include "core/import/import_model.hpp"
#include "core/io/experiment.hpp"
#include "core/io/scene_writer.hpp"
#include "core/model/names.hpp"
#include "core/model/setting_fields.hpp"
#include "web/instance.hpp"

using nlohmann::json;
using substep::App;
using substep::Problem;
using substep::web::instance;

namespace {

App& app() { return *instance->app; }

// Kept until the next call.
const char* keep_text(std::string value) {
  static std::string text;
  text = std::move(value);
  return text.c_str();
}

const char* keep(const json& value) {
  // Invalid UTF-8 from outside is shown as a replacement character.
  return keep_text(value.dump(-1, ' ', false, json::error_handler_t::replace));
}

json outcome(const std::vector<Problem>& problems) {
  json list = json::array();
  for (const Problem& p : problems)
    list.push_back({{"pointer", p.pointer}, {"message", p.message}});
  return {{"ok", problems.empty()}, {"problems", std::move(list)}};
}

/// The scene as text, and what its reader finds in it.
json scene_text() {
  const substep::SceneEditor& editor = app().editor;
  json problems = json::array();
  if (!editor.refused.empty()) problems.push_back({{"pointer", ""}, {"message", editor.refused}});
  for (const substep::PlacedProblem& placed : editor.text().problems()) {
    problems.push_back({{"line", placed.place.line},
                        {"column", placed.place.column},
                        {"pointer", placed.problem.pointer},
                        {"message", placed.problem.message}});
  }
  return {{"ok", problems.empty()},
          {"text", editor.text().text()},
          {"runs", editor.text().checked() && !editor.text().changed()},
          {"problems", std::move(problems)}};
}

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

/// Of the parsed scene, or of the model. @param from name of the file
substep::OpenedText read_result(const std::string& from) {
  if (!instance->model.empty()) {
    return substep::read_opened(std::exchange(instance->model, ""), from, {});
  }
  if (!instance->reading) return {{nullptr, {{"", "no scene was read"}}}, ""};
  return {std::exchange(instance->reading, nullptr)->result(), ""};
}

// Texts of the first screen, or null if it is not shown.
json introduction() {
  if (!app().introduction.open()) return nullptr;
  const substep::IntroductionWords words = introduction_words(app());
  return {{"purpose", substep::kPurpose},
          {"claim", words.claim},
          {"paper", words.paper},
          {"torn", words.torn.title + ": " + words.torn.note},
          {"held", words.held.title + ": " + words.held.note}};
}

std::string text_of(const json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

extern "C" {

const char* substep_open(const char* name) {
  const std::string problem = app().set("scene", name);
  return keep(
      outcome(problem.empty() ? std::vector<Problem>{} : std::vector<Problem>{{"scene", problem}}));
}

const char* substep_open_text(const char* text, const char* from) {
  const bool playing = app().session.playing();
  app().open_text(text, from);
  if (!playing) app().session.pause();
  return keep(outcome(app().trouble.problems));
}

const char* substep_set(const char* text) {
  const json object = json::parse(text, nullptr, false);
  if (!object.is_object()) return keep(outcome({{"", "must be an object of settings"}}));
  std::vector<Problem> problems;
  if (object.contains("scene")) {  // first: it resets the settings
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

void substep_step(int frames) {
  app().introduction.leave(app());
  for (int i = 0; i < frames && !app().session.stopped(); ++i) app().session.step();
}

void substep_substep() {
  app().introduction.leave(app());
  app().session.substep();
}

void substep_go_to(double time) {
  app().introduction.leave(app());
  app().session.go_to(app().session.timeline().at_time(time));
}

void substep_play(int on) {
  if (on != 0) {
    app().session.play();
  } else {
    app().session.pause();
  }
}

int substep_busy() { return app().busy() ? 1 : 0; }

void substep_reset() {
  app().introduction.leave(app());
  app().reset();
}

void substep_introduce() { app().introduction.offer(app()); }

const char* substep_open_link(const char* fragment) {
  app().trouble = {};
  app().open_link(fragment);
  return keep(outcome(app().trouble.problems));
}

void substep_read(const char* text) {
  instance->model = substep::is_model(text) ? text : "";
  instance->reading =
      instance->model.empty() ? std::make_unique<substep::SceneReading>(text) : nullptr;
}

int substep_read_some() {
  const auto until = substep::end_of_slice(substep::kSlice);
  while (instance->reading && instance->reading->advance()) {
    if (substep::FrameSlices::Clock::now() >= until) return 1;
  }
  return 0;
}

const char* substep_open_read(const char* from) {
  const bool playing = app().session.playing();
  substep::OpenedText read = read_result(from);
  if (app().open_paused(std::move(read.result), from)) {
    app().opened->plays = playing;
    if (!read.note.empty()) app().tell(std::move(read.note));
  }
  return keep(outcome(app().trouble.problems));
}

const char* substep_open_read_link(const char* fragment) {
  app().trouble = {};
  app().open_link_paused(fragment, read_result("the scene").result);
  return keep(outcome(app().trouble.problems));
}

void substep_start_opened() { app().start_opened(); }

const char* substep_link() { return keep_text(app().link()); }

const char* substep_command() { return keep_text(app().command()); }

const char* substep_own_scene() {
  const substep::Scene& scene = app().link_scene();
  const bool fits = substep::is_own(scene) && substep::OwnScenes::may_keep(scene);
  return keep_text(fits ? substep::write_scene(scene) : "");
}

const char* substep_saved_scene() {
  return keep_text(substep::write_scene(app().session.as_scene()));
}

const char* substep_scene_text() {
  app().editor.show_run_if_unchanged(app());
  return keep(scene_text());
}

const char* substep_edit_text(const char* text) {
  app().introduction.leave(app());
  app().editor.replace(app(), text);
  return keep(scene_text());
}

const char* substep_history() {
  const substep::Session& s = app().session;
  std::vector<substep::Channel> channels;
  for (int i = 0; i < static_cast<int>(substep::Channel::kCount); ++i) {
    channels.push_back(static_cast<substep::Channel>(i));
  }
  const substep::ExportedRun run{s.scene().name, &s.history()};
  return keep_text(substep::history_csv(s.scene(), {&run, 1}, channels, 0.0));
}

const char* substep_settings() {
  json list = json::array();
  for (const substep::SettingField& field : substep::setting_fields()) {
    list.push_back({{"name", field.name},
                    {"value", setting_text(field, app().session.settings())},
                    {"allowed", allowed_values(field)},
                    {"help", field.help}});
  }
  return keep(list);
}

void substep_trouble(const char* title, const char* place, const char* message) {
  app().trouble = {title, {{place, message}}};
}

void substep_tell(const char* text) { app().tell(text); }

void substep_recording(int on) { app().desk.recording = on != 0; }

const char* substep_hash() { return keep_text(substep::hex_text(app().session.hash())); }

const char* substep_report() {
  const substep::Session& s = app().session;
  const substep::FrameReport& r = s.report();
  const substep::Settings& set = s.settings();
  const float scale = substep::ui::interface_scale(app().desk, ImGui::GetIO().DisplaySize);
  const substep::ViewRect& v = app().view_rect;
  json out = {
      {"scene", s.scene().name},
      {"run", app().run_count},  // counts resets and loads
      {"title", s.scene().title},
      {"solver", substep::name_of(set.solver)},
      {"mode", substep::name_of(set.mode)},
      {"integrator", substep::name_of(set.integrator)},
      {"alpha", set.alpha},
      {"playing", s.playing()},
      {"stopped", s.stopped()},
      {"typing", app().desk.scene_text.active()},  // into the scene's text
      {"frame", s.state().frame},
      {"time", s.state().time},
      {"substeps_left", s.substeps_left()},
      {"latest", s.timeline().last().state.time},
      {"substeps", r.n_substeps},
      {"substeps_mean", r.n_mean},
      {"islands", r.islands},
      {"asleep", r.asleep},
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
      {"held", app().held() ? app().heavy.why : ""},
      {"selected", app().desk.selected < 0
                       ? ""
                       : s.scene().bodies[static_cast<std::size_t>(app().desk.selected)].name},
      {"ringed", app().desk.ringed},
      {"notice", app().notice.left > 0.0 ? app().notice.text : ""},
      {"view", {scale * v.x, scale * v.y, scale * v.width, scale * v.height}},
      {"frame_time", app().frame_time},
      {"introduction", introduction()},
      {"tour", app().desk.tour + 1},  // step number from 1, 0 outside the tour
  };
  if (r.leader.body >= 0) {
    out["leader"] = {{"body", s.scene().bodies[static_cast<std::size_t>(r.leader.body)].name},
                     {"dof", r.leader.dof},
                     {"k", number(r.leader.k)},
                     {"mass", number(r.leader.mass)}};
  }
  return keep(out);
}

const char* substep_widgets() {
  const float scale = substep::ui::interface_scale(app().desk, ImGui::GetIO().DisplaySize);
  json list = json::array();
  for (const substep::ui::Handle& h : substep::ui::handles()) {
    list.push_back({{"group", h.group},
                    {"label", h.label},
                    {"x", scale * h.min.x},
                    {"y", scale * h.min.y},
                    {"width", scale * (h.max.x - h.min.x)},
                    {"height", scale * (h.max.y - h.min.y)}});
  }
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const auto& poses = app().session.poses();
  for (std::size_t i = 0; i < app().session.scene().bodies.size(); ++i) {
    const Eigen::Vector4f p =
        app().pictures.front().view_projection * poses.x[i].cast<float>().homogeneous();
    if (!(p.w() > 0.0F)) continue;  // behind the eye
    list.push_back({{"group", "body"},
                    {"label", app().session.scene().bodies[i].name},
                    {"x", 0.5F * size.x * (1.0F + p.x() / p.w())},
                    {"y", 0.5F * size.y * (1.0F - p.y() / p.w())},
                    {"width", 0.0F},
                    {"height", 0.0F}});
  }
  return keep(list);
}

const char* substep_scenes() {
  json list = json::array();
  for (const auto& scene : app().library.scenes()) {
    list.push_back({{"name", scene->name}, {"title", scene->title}, {"group", scene->group}});
  }
  return keep(list);
}

}  // extern "C"
