#pragma once

#include <string>

#include "core/io/json.hpp"
#include "core/model/body.hpp"
#include "core/model/problem.hpp"

namespace substep {

/// One entry of "bodies". @return the body; where problems were added, as far as it could be read
Body read_body(const Json& json, const std::string& pointer, Problems& problems);

}  // namespace substep
