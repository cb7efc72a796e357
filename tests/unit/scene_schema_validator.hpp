#pragma once
// As much of JSON Schema 2020-12 as scene.schema.json uses, to check scene files against it.

#include <string>
#include <vector>

#include "core/io/json.hpp"

namespace substep::test {

/// What of a value breaks a schema, as "pointer: keyword"; empty where it conforms. A keyword that
/// is not understood is an error as well.
std::vector<std::string> schema_errors(const Json& root, const Json& schema, const Json& value,
                                       const std::string& pointer = "");

}  // namespace substep::test
