#include "app/cli/results_text.hpp"

#include <algorithm>
#include <utility>

#include "app/cli/message.hpp"
#include "core/io/experiment.hpp"
#include "core/io/json_text.hpp"
#include "core/io/result.hpp"
#include "core/io/result_reader.hpp"

namespace substep::cli {
namespace {

/// The part of a result that must be equal for equal experiments: all but the times.
std::string without_timing(const std::string& line) {
  Json json = Json::parse(line, nullptr, false);
  if (json.is_object()) json.erase("timing");
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// "pendulum, 0123456789abcdef"
std::string scene_text(const std::string& name, std::uint64_t hash) {
  return name + ", " + hex_text(hash);
}

}  // namespace

bool StoredResults::is_of_scene(const std::string& place, const Experiment& experiment) {
  if (!scene_) scene_ = {experiment.scene, experiment.scene_hash, place};
  if (scene_->name == experiment.scene && scene_->hash == experiment.scene_hash) return true;
  const char* which =
      scene_->name == experiment.scene ? "another scene of this name" : "another scene";
  complain("%s: /scene_hash: a result of %s: must be of %s, as in %s, not %s", place.c_str(), which,
           scene_text(scene_->name, scene_->hash).c_str(), scene_->from.c_str(),
           scene_text(experiment.scene, experiment.scene_hash).c_str());
  return false;
}

bool StoredResults::read(const std::string& path, const std::string& text) {
  std::size_t number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string line = text.substr(at, end - at);
    at = end + 1;
    const std::string place = path + ':' + std::to_string(++number);
    if (line.find_first_not_of(" \t\r") == std::string::npos) {
      complain("%s: the line is empty: must be a result, one JSON object", place.c_str());
      return false;
    }
    Problems problems;
    const auto json = parse_json(line, problems);
    if (json && json->is_object() && json->contains("format")) {
      check_results_header(line, problems);
      if (problems.empty()) continue;
    }
    const auto experiment = json && problems.empty() ? read_result(*json, problems) : std::nullopt;
    for (const Problem& problem : problems) {
      complain("%s: %s", place.c_str(), to_string(problem).c_str());
    }
    if (!experiment || !is_of_scene(place, *experiment)) return false;
    const std::string id = experiment_id(*experiment);
    if (!add(id, line) && without_timing(lines_.at(id)) != without_timing(line)) {
      complain(
          "%s: another result of experiment %s differs; were they computed by different "
          "versions?",
          place.c_str(), id.c_str());
      return false;
    }
  }
  return true;
}

bool StoredResults::add(const std::string& id, std::string line) {
  if (!lines_.emplace(id, std::move(line)).second) return false;
  order_.push_back(id);
  return true;
}

std::string StoredResults::text() const {
  std::string text = results_header();
  for (const std::string& id : order_) text += lines_.at(id) + '\n';
  return text;
}

bool is_cut_line(const std::string& end) {
  if (!end.starts_with('{')) return false;
  try {
    return Json::parse(end).is_discarded();  // false: it is whole
  } catch (const Json::parse_error& error) {
    return error.byte > end.size();
  }
}

}  // namespace substep::cli
