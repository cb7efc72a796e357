#pragma once

#include <string>

#include "core/io/json.hpp"
#include "core/io/object_reader.hpp"
#include "core/model/recommended.hpp"

namespace substep {

/// What a scene file has as "recommended".
Json recommended_json(const Recommended& recommended);

/// Reads it back. Of its settings, what is left out is the default.
Recommended read_recommended(const Json& json, const std::string& pointer, Problems& problems);

}  // namespace substep
