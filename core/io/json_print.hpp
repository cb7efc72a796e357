#pragma once

#include <string>

#include "core/io/json.hpp"

namespace substep {

/// A document as human-readable text: short lists on one line, lossless numbers. The bytes are the
/// same on every machine.
std::string json_file(const Json& json);

}  // namespace substep
