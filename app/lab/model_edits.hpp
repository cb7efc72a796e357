#pragma once
// Changes of a model by hand, each as a change of its text. They take a valid text with the scene
// that it describes, and give the whole text: valid or not, its reader says. Effects that a change
// needs are added to those that the text lists.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/json.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// A scene with a floor and gravity, in which nothing moves yet.
std::string new_scene_text(const std::string& name, const std::string& title);

/// With another value at a pointer such as "/bodies/3/mass" or "/gravity/1"; null removes it. Where
/// the text has a value it alone changes; else the text is formatted.
std::string with_value(const std::string& text, const std::string& pointer, const Json& value);

/// A value that the user may change: a text, a number or three.
struct ModelField {
  std::string name;     // "mass", "limit lower"
  std::string pointer;  // "/bodies/3/mass"
  std::string unit;     // "" if it has none
  std::vector<std::string> values;
};
std::vector<ModelField> fields_of_body(const Scene& scene, int body);
std::vector<ModelField> fields_of_joint(const Scene& scene, std::size_t joint);
std::vector<ModelField> fields_of_scene(const Scene& scene);
/// What the user typed: a number if it is one. Nothing restores the default. A new name is that of
/// the body in joints and criteria too. @param part of the field's values
std::string with_typed(const std::string& text, const Scene& scene, const ModelField& field,
                       std::size_t part, const std::string& typed);

enum class BodyPart : unsigned char { kLink, kBall, kBox };
/// How a new body is held.
struct Hold {
  int by = kWorld;       // a body or kWorld
  std::size_t type = 0;  // of the joint, index into kTypes<Joint>
};
/// Adds a body, the last one: at the free end of the one that holds it, else above it or the floor.
/// It overlaps no other body if there is room. A link continues another with its size and mass.
std::string with_body(const std::string& text, const Scene& scene, BodyPart part, int near,
                      const std::optional<Hold>& hold);
/// Adds a copy of a body, without joints, beside it.
std::string with_copy(const std::string& text, const Scene& scene, int body);
/// Removes a body with its joints, and what the criteria say about it.
std::string without_body(const std::string& text, const Scene& scene, int body);
std::string without_joint(const std::string& text, std::size_t joint);
/// Joins two bodies, or one and the world, where they are closest. @param type see Hold
std::string with_joint(const std::string& text, const Scene& scene, int a, int b, std::size_t type);
/// Makes a body static, or moving with the mass of water.
std::string with_motion(const std::string& text, const Scene& scene, int body, bool moves);

}  // namespace substep
