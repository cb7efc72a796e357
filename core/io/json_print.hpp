#pragma once

#include <string>

#include "core/io/json.hpp"

namespace substep {

/// A document as a file that people read: short lists on one line, numbers that lose nothing. The
/// same document gives the same bytes everywhere.
std::string json_file(const Json& json);

}  // namespace substep
