#pragma once

#include "core/io/json.hpp"
#include "core/io/object_reader.hpp"
#include "core/model/settings.hpp"

namespace substep {

/// All settings, by the names of setting_fields().
Json settings_json(const Settings& settings);

/// The settings as a scene file states them: "preset": "paper", and what differs from it. The
/// paper's settings never change, so that a file keeps its meaning.
Json scene_settings_json(const Settings& settings);

/// Reads the member "settings" of an object, if present. Omitted settings are those of its member
/// "preset", or unchanged without one.
void read_settings(ObjectReader& parent, Settings& settings, Problems& problems);

/// The same in a scene file. Settings that a block omits are the defaults; in version 1 they are
/// the paper's, which were the defaults then. @param version of the file
void read_scene_settings(ObjectReader& parent, int version, Settings& settings, Problems& problems);

}  // namespace substep
