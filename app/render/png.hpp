#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace substep {

/// 8-bit RGB, rows from the top, as a PNG file without compression.
std::string encode_png(int width, int height, const std::vector<std::uint8_t>& rgb);

}  // namespace substep
