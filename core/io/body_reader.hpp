#pragma once

#include <string>

#include "core/io/json.hpp"
#include "core/model/body.hpp"
#include "core/model/problem.hpp"

namespace substep {

/// One entry of "bodies". @return the body; incomplete if problems were added
Body read_body(const Json& json, const std::string& pointer, Problems& problems);

}  // namespace substep
