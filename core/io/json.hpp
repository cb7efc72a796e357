#pragma once
// The JSON library as used here: ordered keys, no exceptions.

#include <nlohmann/json.hpp>

namespace substep {

using Json = nlohmann::ordered_json;

}  // namespace substep
