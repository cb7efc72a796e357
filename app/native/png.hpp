#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace substep {

/// Writes 8-bit RGB, rows from the top, as a PNG file without compression.
/// @return false where the file could not be written
bool write_png(const std::string& path, int width, int height,
               const std::vector<std::uint8_t>& rgb);

}  // namespace substep
