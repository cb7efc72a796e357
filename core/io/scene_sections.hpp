#pragma once
// The sections of a scene file, apart from its bodies and joints.

#include <optional>
#include <string_view>

#include "core/io/body_names.hpp"
#include "core/io/object_reader.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// In criteria: the energy is not judged.
inline constexpr std::string_view kAnyGain = "any";

/// The version of the file, or nothing if it is not supported: no further problems are reported
/// then.
std::optional<int> read_version(ObjectReader& in, Problems& problems);
/// Name, title, group and descriptive texts.
void read_about(ObjectReader& in, Scene& scene);
void read_camera(ObjectReader& in, Scene& scene, Problems& problems);
void read_contact(ObjectReader& in, Scene& scene, Problems& problems);
void read_criteria(ObjectReader& in, const BodyNames& names, Scene& scene, Problems& problems);
void read_start(ObjectReader& in, Scene& scene);
/// Reads the list as written. @return true if present
bool read_effects(ObjectReader& in, Scene& scene);
/// A scene that lists its effects must list all that its content needs.
void check_listed_effects(ObjectReader& in, const Scene& scene, Problems& problems);

}  // namespace substep
