#pragma once

#include <string>

#include "core/io/json.hpp"
#include "core/io/object_reader.hpp"
#include "core/model/recommended.hpp"

namespace substep {

/// The member "recommended" of a scene file.
Json recommended_json(const Recommended& recommended);

/// Reads it back. @param version of the file
Recommended read_recommended(const Json& json, const std::string& pointer, int version,
                             Problems& problems);

}  // namespace substep
