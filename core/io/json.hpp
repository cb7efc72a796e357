#pragma once
// The JSON library as this project uses it: keys keep their order, nothing throws.

#include <nlohmann/json.hpp>

namespace substep {

using Json = nlohmann::ordered_json;

}  // namespace substep
