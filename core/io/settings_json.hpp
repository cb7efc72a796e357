#pragma once

#include "core/io/json.hpp"
#include "core/io/object_reader.hpp"
#include "core/model/settings.hpp"

namespace substep {

/// All settings, by the names of setting_fields().
Json settings_json(const Settings& settings);

/// Reads the member "settings" of an object, if present. Omitted settings are unchanged.
void read_settings(ObjectReader& parent, Settings& settings, Problems& problems);

}  // namespace substep
