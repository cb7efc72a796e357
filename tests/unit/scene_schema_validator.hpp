#pragma once
// The subset of JSON Schema 2020-12 that scene.schema.json uses, to validate scene files.

#include <string>
#include <vector>

#include "core/io/json.hpp"

namespace substep::test {

/// The violation of a schema by a value, as "pointer: keyword"; empty if it conforms. An unknown
/// keyword is an error as well.
std::vector<std::string> schema_errors(const Json& root, const Json& schema, const Json& value,
                                       const std::string& pointer = "");

}  // namespace substep::test
