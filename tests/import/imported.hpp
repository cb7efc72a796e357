#pragma once
// Models in a few lines, and what becomes of them.

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <variant>

#include "core/import/import_model.hpp"

namespace substep::test {

using Files = std::map<std::string, std::string>;

inline ImportResult imported(std::string_view text, const ImportOptions& options = {},
                             const Files& files = {}) {
  const ModelFiles read = [&](const std::string& name) -> std::optional<std::string> {
    const auto found = files.find(name);
    return found == files.end() ? std::nullopt : std::optional(found->second);
  };
  return import_model(text, "model.xml", read, options);
}

/// An MJCF model whose <worldbody> has this content.
inline std::string world(const std::string& bodies, const std::string& before = "",
                         const std::string& after = "") {
  return "<mujoco>" + before + "<worldbody>" + bodies + "</worldbody>" + after + "</mujoco>";
}

/// All notes, one per line.
inline std::string lines(const ImportNotes& notes) {
  std::string text;
  for (const ImportNote& note : notes.notes) text += to_string(note) + "\n";
  return text;
}

/// The only error of a model that is refused.
inline std::string error_of(std::string_view text, const ImportOptions& options = {},
                            const Files& files = {}) {
  const ImportResult result = imported(text, options, files);
  if (result.scene != nullptr) return "it was read";
  const std::string errors = lines(result.report.errors);
  return errors.substr(0, errors.empty() ? 0 : errors.size() - 1);
}

inline const Body& body_called(const Scene& scene, std::string_view name) {
  return *std::find_if(scene.bodies.begin(), scene.bodies.end(),
                       [&](const Body& body) { return body.name == name; });
}

template <class J>
const J& joint_called(const Scene& scene, std::string_view name) {
  for (const Joint& joint : scene.joints) {
    const J* found = std::get_if<J>(&joint);
    if (found != nullptr && found->name == name) return *found;
  }
  static const J none;
  return none;
}

}  // namespace substep::test
