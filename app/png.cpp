#include "app/png.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace substep {
namespace {

using Bytes = std::vector<std::uint8_t>;

void put32(Bytes& out, std::uint32_t v) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::uint8_t>(v >> shift));
}

// CRC-32 as PNG wants it (polynomial 0xedb88320).
std::uint32_t crc(const Bytes& bytes, std::size_t from) {
  static const auto table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t n = 0; n < 256; ++n) {
      std::uint32_t c = n;
      for (int k = 0; k < 8; ++k) c = (c & 1U) != 0 ? 0xedb88320U ^ (c >> 1U) : c >> 1U;
      t[n] = c;
    }
    return t;
  }();
  std::uint32_t c = 0xffffffffU;
  for (std::size_t i = from; i < bytes.size(); ++i) c = table[(c ^ bytes[i]) & 0xffU] ^ (c >> 8U);
  return c ^ 0xffffffffU;
}

void put_chunk(Bytes& out, std::string_view type, const Bytes& data) {
  put32(out, static_cast<std::uint32_t>(data.size()));
  const std::size_t from = out.size();
  out.insert(out.end(), type.begin(), type.end());
  out.insert(out.end(), data.begin(), data.end());
  put32(out, crc(out, from));
}

// A zlib stream of stored blocks.
Bytes stored(const Bytes& raw) {
  Bytes out{0x78, 0x01};
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  constexpr std::size_t kBlock = 65535;
  for (std::size_t i = 0; i < raw.size(); i += kBlock) {
    const std::size_t size = std::min(kBlock, raw.size() - i);
    out.push_back(i + size == raw.size() ? 1 : 0);
    const auto length = static_cast<std::uint16_t>(size);
    const auto inverse = static_cast<std::uint16_t>(~length);
    for (const std::uint16_t v : {length, inverse}) {
      out.push_back(static_cast<std::uint8_t>(v & 0xffU));
      out.push_back(static_cast<std::uint8_t>(v >> 8U));
    }
    for (std::size_t j = i; j < i + size; ++j) {
      out.push_back(raw[j]);
      a = (a + raw[j]) % 65521U;
      b = (b + a) % 65521U;
    }
  }
  put32(out, (b << 16U) | a);
  return out;
}

}  // namespace

std::string encode_png(int width, int height, const std::vector<std::uint8_t>& rgb) {
  Bytes out{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  Bytes header;
  put32(header, static_cast<std::uint32_t>(width));
  put32(header, static_cast<std::uint32_t>(height));
  header.insert(header.end(), {8, 2, 0, 0, 0});
  put_chunk(out, "IHDR", header);
  Bytes raw;
  const std::size_t row = 3 * static_cast<std::size_t>(width);
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    raw.push_back(0);  // no filter
    const auto begin = rgb.begin() + static_cast<std::ptrdiff_t>(y * row);
    raw.insert(raw.end(), begin, begin + static_cast<std::ptrdiff_t>(row));
  }
  put_chunk(out, "IDAT", stored(raw));
  put_chunk(out, "IEND", {});
  return {out.begin(), out.end()};
}

}  // namespace substep
