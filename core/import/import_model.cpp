#include "core/import/import_model.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/import/mjcf.hpp"
#include "core/import/scene_names.hpp"
#include "core/import/slrbs.hpp"
#include "core/import/urdf.hpp"
#include "core/io/json_text.hpp"
#include "core/model/number_text.hpp"
#include "core/model/problem.hpp"
#include "core/model/validate.hpp"

namespace substep {
namespace {

bool is_xml(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '<';
}

/// A problem of the scene at its place in the model: "/joints/3/limit" is in the joint's element.
void add_problem(const Problem& problem, const ScenePlaces& places, const Scene& scene,
                 ImportNotes& errors) {
  const auto at = [&](const char* list,
                      const std::vector<std::string>& known) -> std::optional<std::size_t> {
    const std::string prefix = std::string("/") + list + "/";
    if (!problem.pointer.starts_with(prefix)) return std::nullopt;
    const std::string rest = problem.pointer.substr(prefix.size());
    const auto number = parse_integer(rest.substr(0, rest.find('/')));
    if (!number || *number < 0 || static_cast<std::size_t>(*number) >= known.size()) {
      return std::nullopt;
    }
    return static_cast<std::size_t>(*number);
  };
  if (const auto i = at("bodies", places.bodies)) {
    errors.add(places.bodies[*i], "body '" + scene.bodies[*i].name + "': " + problem.message);
  } else if (const auto j = at("joints", places.joints)) {
    errors.add(places.joints[*j],
               "joint '" + base(scene.joints[*j]).name + "': " + problem.message);
  } else {
    errors.add(problem.pointer, problem.message);
  }
}

enum class Format : std::uint8_t { kMjcf, kUrdf, kSlrbs };

/// False, with errors, if options are given that the format does not have.
bool takes_options(Format format, const std::string& name, const ImportOptions& options,
                   ImportReport& report) {
  if (!options.key.empty() && format != Format::kMjcf) {
    report.errors.add(name, "only MJCF has keyframes");
  }
  if (options.free_root && format != Format::kUrdf) {
    report.errors.add(name, "only the root link of URDF can be freed");
  }
  return report.errors.empty();
}

std::optional<Scene> read_xml(std::string_view text, const std::string& name,
                              const ModelFiles& files, const ImportOptions& options,
                              ImportReport& report, ScenePlaces& places) {
  XmlFault fault;
  std::optional<XmlElement> root = parse_xml(text, fault);
  if (!root) {
    report.errors.add(name + ":" + std::to_string(fault.line), fault.message);
    return std::nullopt;
  }
  std::optional<Mechanism> mechanism;
  if (root->name == "mujoco") {
    if (!takes_options(Format::kMjcf, name, options, report)) return std::nullopt;
    mechanism = read_mjcf(*std::move(root), name, files, options, report);
  } else if (root->name == "robot") {
    if (!takes_options(Format::kUrdf, name, options, report)) return std::nullopt;
    mechanism = read_urdf(*root, name, options, report);
  } else {
    report.errors.add(name + ":" + std::to_string(root->line),
                      "<" + root->name + "> is neither <mujoco> (MJCF) nor <robot> (URDF)");
  }
  if (!mechanism) return std::nullopt;
  return assemble(*std::move(mechanism), options, report, places);
}

std::optional<Scene> read_json(std::string_view text, const std::string& name,
                               const ImportOptions& options, ImportReport& report,
                               ScenePlaces& places) {
  Problems problems;
  const std::optional<Json> json = parse_json(text, problems);
  for (const Problem& problem : problems) {
    report.errors.add(problem.pointer.empty() ? name : problem.pointer, problem.message);
  }
  if (!json || !problems.empty()) return std::nullopt;
  if (!is_slrbs(*json)) {
    report.errors.add(name, "is not a model in MJCF, URDF or the JSON of SLRBS");
    return std::nullopt;
  }
  if (!takes_options(Format::kSlrbs, name, options, report)) return std::nullopt;
  return read_slrbs(*json, options, report, places);
}

}  // namespace

bool is_model(std::string_view text) {
  const auto has = [&](std::string_view word) { return text.find(word) != std::string_view::npos; };
  return is_xml(text) || (has("\"bodies\"") && has("\"geometry\"") && !has("\"substep-scene\""));
}

ImportResult import_model(std::string_view text, const std::string& name, const ModelFiles& files,
                          const ImportOptions& options) {
  ImportResult result;
  ImportReport& report = result.report;
  ScenePlaces places;
  const std::optional<Scene> scene = is_xml(text)
                                         ? read_xml(text, name, files, options, report, places)
                                         : read_json(text, name, options, report, places);
  const auto moves = [](const Body& body) { return !body.is_static; };
  if (scene && report.errors.empty() &&
      std::none_of(scene->bodies.begin(), scene->bodies.end(), moves)) {
    report.errors.add("/bodies", "no body moves");  // a model is imported to be moved
  } else if (scene && report.errors.empty()) {
    for (const Problem& problem : validate(*scene)) {
      add_problem(problem, places, *scene, report.errors);
    }
  }
  if (scene && report.errors.empty()) {
    result.scene = std::make_shared<const Scene>(*scene);
  } else if (options.key.empty() && !report.starts.empty()) {
    report.errors.add(name,
                      "the model has other starts, for `substep import --key`: " + report.starts);
  }
  return result;
}

}  // namespace substep
