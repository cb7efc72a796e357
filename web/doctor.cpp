// The step doctor for the page: no application runs in its module, see web/doctor_worker.mjs.
// Arguments and results are text, JSON if structured. A returned text is valid until the next call.

#include <emscripten.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/import/import_model.hpp"
#include "core/io/diagnosis_html.hpp"
#include "core/io/diagnosis_json.hpp"
#include "core/io/json_text.hpp"
#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"

using substep::Json;
using substep::Problems;

namespace {

/// What was opened last, and said of it last.
struct Patient {
  std::shared_ptr<const substep::Scene> scene;
  std::optional<substep::Diagnosis> diagnosis;
};
Patient patient;

const char* keep_text(std::string value) {
  static std::string text;
  text = std::move(value);
  return text.c_str();
}

const char* keep(const Json& value) {
  return keep_text(value.dump(-1, ' ', false, Json::error_handler_t::replace));
}

Json refusal(const Problems& problems) {
  Json list = Json::array();
  for (const substep::Problem& p : problems) {
    list.push_back({{"pointer", p.pointer}, {"message", p.message}});
  }
  return {{"ok", false}, {"problems", std::move(list)}};
}

Json notes_json(const substep::ImportNotes& notes) {
  Json list = Json::array();
  for (const substep::ImportNote& note : notes.notes) list.push_back(to_string(note));
  if (notes.more > 0) list.push_back("and " + std::to_string(notes.more) + " more");
  return list;
}

}  // namespace

extern "C" {

/// Opens a scene or a model. @param from name of its file
/// @return {ok, problems}, or {ok, name, title, frame, imported}; imported is null for a scene,
/// else {came_in, starts, key, approximated, left_out, timestep, integrator}: lists of texts with
/// their lines, the keyframe in which it starts if its own pose does not fit its joints, and what
/// the model says of its engine (0 and "" if nothing)
EMSCRIPTEN_KEEPALIVE const char* substep_doctor_open(const char* text, const char* from) {
  Json imported = nullptr;
  substep::SceneResult read;
  if (substep::is_model(text)) {
    substep::ImportOptions how;
    substep::ImportResult result = substep::import_model(text, from, {}, how);
    if (!result.scene && !result.report.starts.empty()) {
      // Its own pose does not close its loops, perhaps: the first of the others may.
      how.key = result.report.starts.substr(0, result.report.starts.find(", "));
      substep::ImportResult other = substep::import_model(text, from, {}, how);
      if (other.scene) result = std::move(other);
    }
    const substep::ImportReport& report = result.report;
    imported = {{"came_in", report.came_in},
                {"starts", report.starts},
                {"key", result.scene ? how.key : ""},
                {"approximated", notes_json(report.approximated)},
                {"left_out", notes_json(report.left_out)},
                {"timestep", report.timestep},
                {"integrator", report.integrator}};
    read.scene = std::move(result.scene);
    for (const auto& error : report.errors.notes)
      read.problems.push_back({error.place, error.text});
  } else {
    read = substep::read_scene(text);
  }
  if (!read.scene) return keep(refusal(read.problems));
  patient = {read.scene, std::nullopt};
  return keep({{"ok", true},
               {"name", read.scene->name},
               {"title", read.scene->title},
               {"frame", read.scene->frame},
               {"imported", std::move(imported)}});
}

/// Answers a question about it. @param text {engine, step, held, seconds, runs}
/// @return {ok, problems}, or {ok, diagnosis}: that of `substep doctor --json`
EMSCRIPTEN_KEEPALIVE const char* substep_doctor_diagnose(const char* text) {
  if (!patient.scene) return keep(refusal({{"", "no model is open"}}));
  Problems problems;
  const auto json = substep::parse_json(text, problems);
  const auto question = json ? substep::read_question(*json, problems) : std::nullopt;
  if (!question || !problems.empty()) return keep(refusal(problems));
  substep::Diagnosis diagnosis = substep::diagnose(patient.scene, *question);
  if (diagnosis.verdict == substep::Diagnosis::Verdict::kNotUnderstood) {
    return keep(refusal({{"", diagnosis.problem}}));
  }
  patient.diagnosis = std::move(diagnosis);
  return keep(
      {{"ok", true}, {"diagnosis", substep::diagnosis_json(*patient.scene, *patient.diagnosis)}});
}

/// The scene that was opened or made of a model, as a file. "" if there is none.
EMSCRIPTEN_KEEPALIVE const char* substep_doctor_scene() {
  return keep_text(patient.scene ? substep::write_scene(*patient.scene) : "");
}

/// Its run after the doctor's shake with a step, as the file of a scene. @param step [s]
EMSCRIPTEN_KEEPALIVE const char* substep_doctor_run(double step) {
  if (!patient.scene || !substep::kStepRange.contains(step)) return keep_text("");
  const double gain = patient.diagnosis ? substep::gain_of(*patient.diagnosis, step) : 0.0;
  return keep_text(substep::write_scene(substep::scene_at_step(*patient.scene, step, gain)));
}

/// The model that a remedy of the last diagnosis makes, as the file of a scene. "" if it does not
/// change the model. @param remedy its place in the list
EMSCRIPTEN_KEEPALIVE const char* substep_doctor_remedied(int remedy) {
  if (!patient.diagnosis || remedy < 0) return keep_text("");
  const auto& remedies = patient.diagnosis->remedies;
  const auto i = static_cast<std::size_t>(remedy);
  const bool is_changed = i < remedies.size() && remedies[i].changed != nullptr;
  return keep_text(is_changed ? substep::write_scene(*remedies[i].changed) : "");
}

/// The last diagnosis as a page. "" if there is none.
EMSCRIPTEN_KEEPALIVE const char* substep_doctor_html() {
  return keep_text(patient.diagnosis ? substep::diagnosis_html(*patient.scene, *patient.diagnosis)
                                     : "");
}

/// The last diagnosis as a picture for a README. "" if there is none.
EMSCRIPTEN_KEEPALIVE const char* substep_doctor_badge() {
  return keep_text(patient.diagnosis ? substep::diagnosis_badge(*patient.diagnosis) : "");
}

/// Names and titles of the engines.
EMSCRIPTEN_KEEPALIVE const char* substep_doctor_engines() {
  Json list = Json::array();
  for (const substep::Engine& engine : substep::kEngines) {
    list.push_back({{"name", engine.name}, {"title", engine.title}});
  }
  return keep(list);
}

}  // extern "C"
