#pragma once
// The JSON library as used here: ordered keys, no exceptions.

#include <nlohmann/json.hpp>
#include <string>

namespace substep {

using Json = nlohmann::ordered_json;

/// A document as human-readable text: short lists on one line, lossless numbers. The bytes are the
/// same on every machine.
std::string json_file(const Json& json);

}  // namespace substep
