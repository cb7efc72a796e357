#include "app/render/png.hpp"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

namespace substep {

std::string encode_png(int width, int height, const std::vector<std::uint8_t>& rgb) {
  std::string bytes;
  const auto append = [](void* out, void* data, int size) {
    static_cast<std::string*>(out)->append(static_cast<const char*>(data),
                                           static_cast<std::size_t>(size));
  };
  stbi_write_png_to_func(append, &bytes, width, height, 3, rgb.data(), 3 * width);
  return bytes;
}

}  // namespace substep
