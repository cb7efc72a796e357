#pragma once
// The sections of a scene file, apart from its bodies and joints.

#include "core/io/body_names.hpp"
#include "core/io/object_reader.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// Whether this is a scene of a version that can be read at all. If not, nothing else is worth
/// telling.
bool read_version(ObjectReader& in, Problems& problems);
/// Name, title, group and the texts for people.
void read_about(ObjectReader& in, Scene& scene);
void read_camera(ObjectReader& in, Scene& scene, Problems& problems);
void read_contact(ObjectReader& in, Scene& scene, Problems& problems);
void read_criteria(ObjectReader& in, const BodyNames& names, Scene& scene, Problems& problems);
void read_start(ObjectReader& in, Scene& scene);
/// The list as it is written. @return whether there is one
bool read_effects(ObjectReader& in, Scene& scene);
/// A scene that lists its effects must list all that its content needs.
void check_listed_effects(ObjectReader& in, const Scene& scene, Problems& problems);

/// The items of a list, or null where it is missing, no list or longer than `most`.
const Json* read_list(ObjectReader& in, std::string_view key, std::size_t most, Presence presence);

}  // namespace substep
