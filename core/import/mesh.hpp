#pragma once
// Points of meshes. Only their convex hull counts here, so faces are not read.

#include <string>
#include <string_view>
#include <vector>

#include "core/math/types.hpp"

namespace substep {

/// Triples of numbers. @param fault set if the text has none
std::vector<Vec3> points_of_text(std::string_view text, std::string& fault);

/// Points of an OBJ or a binary STL, by the end of the file's name. @param fault set on failure
std::vector<Vec3> points_of_file(std::string_view name, std::string_view content,
                                 std::string& fault);

}  // namespace substep
