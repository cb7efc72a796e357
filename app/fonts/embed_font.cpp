// Turns the glyphs of a font that the application shows into a C++ source file.
//
//   embed_font FONT.otf NAME OUT.cpp
//
// A complete Inter has 260 kB per weight; the glyphs below take a tenth. Each outline is rewritten
// as a plain Type 2 charstring (no subroutines, no hints) in a minimal OpenType file with the
// tables that ImGui's rasteriser reads: CFF, cmap, head, hhea, hmtx, maxp. All digits get the same
// width, so that changing numbers do not jitter.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <imstb_truetype.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace {

using Bytes = std::vector<std::uint8_t>;

// First and last code point of each range that the application may show; those missing in the font
// are skipped.
constexpr std::array<std::pair<int, int>, 14> kRanges{{
    {0x20, 0x7e},      // ASCII
    {0xa0, 0x17f},     // Latin-1 and Latin Extended-A: titles of users' scenes
    {0x391, 0x3c9},    // Greek
    {0x2010, 0x2026},  // dashes, quotes, bullet, ellipsis
    {0x2070, 0x208e},  // superscripts and subscripts
    {0x2150, 0x215f},  // fractions
    {0x2190, 0x2193},  // arrows
    {0x2202, 0x2202},  // partial
    {0x2206, 0x2206},  // increment
    {0x2211, 0x2212},  // sum, minus
    {0x221a, 0x221e},  // root, proportional to, infinity
    {0x2248, 0x2248},  // almost equal
    {0x2260, 0x2265},  // not equal, less or equal, greater or equal
    {0x21e7, 0x21e7},  // shift
}};

void put(Bytes& out, std::uint32_t value, int size) {
  for (int i = size - 1; i >= 0; --i) {
    out.push_back(static_cast<std::uint8_t>((value >> (8 * i)) & 0xffU));
  }
}
void put_int(Bytes& out, int value, int size) { put(out, static_cast<std::uint32_t>(value), size); }

void append(Bytes& out, const Bytes& more) { out.insert(out.end(), more.begin(), more.end()); }

// A number of a Type 2 charstring (Adobe technical note 5177, section 3.2).
void put_number(Bytes& out, int v) {
  if (v >= -107 && v <= 107) {
    put_int(out, v + 139, 1);
  } else if (v >= 108 && v <= 1131) {
    put_int(out, (v - 108) / 256 + 247, 1);
    put_int(out, (v - 108) % 256, 1);
  } else if (v <= -108 && v >= -1131) {
    put_int(out, (-v - 108) / 256 + 251, 1);
    put_int(out, (-v - 108) % 256, 1);
  } else {
    put(out, 28, 1);
    put_int(out, v & 0xffff, 2);
  }
}

Bytes charstring(const stbtt_fontinfo& font, int glyph, int shift) {
  constexpr std::uint32_t kLine = 5;
  constexpr std::uint32_t kCurve = 8;
  constexpr std::uint32_t kEnd = 14;
  constexpr std::uint32_t kMove = 21;
  stbtt_vertex* vertices = nullptr;
  const int count = stbtt_GetGlyphShape(&font, glyph, &vertices);
  Bytes out;
  int x = -shift;  // the pen; outlines are relative
  int y = 0;
  const auto go = [&](int to_x, int to_y) {
    put_number(out, to_x - x);
    put_number(out, to_y - y);
    x = to_x;
    y = to_y;
  };
  for (int i = 0; i < count; ++i) {
    const stbtt_vertex& v = vertices[i];
    if (v.type == STBTT_vcubic) {
      go(v.cx, v.cy);
      go(v.cx1, v.cy1);
      go(v.x, v.y);
      put(out, kCurve, 1);
    } else {
      go(v.x, v.y);
      put(out, v.type == STBTT_vmove ? kMove : kLine, 1);
    }
  }
  put(out, kEnd, 1);
  stbtt_FreeShape(&font, vertices);
  return out;
}

// An INDEX of the Compact Font Format (technical note 5176, section 5) with four-byte offsets.
Bytes cff_index(const std::vector<Bytes>& items) {
  Bytes out;
  put(out, static_cast<std::uint32_t>(items.size()), 2);
  if (items.empty()) return out;
  put(out, 4, 1);
  std::uint32_t offset = 1;
  put(out, offset, 4);
  for (const Bytes& item : items) put(out, offset += static_cast<std::uint32_t>(item.size()), 4);
  for (const Bytes& item : items) append(out, item);
  return out;
}

Bytes cff_table(const std::vector<Bytes>& charstrings) {
  Bytes out{1, 0, 4, 4};  // version 1.0, header of 4 bytes
  append(out, cff_index({{'S'}}));
  // Top DICT: 29 (a four-byte number) and operator 17, the offset of the charstrings.
  constexpr std::size_t kDictIndex = 2 + 1 + 2 * 4 + 6;
  const std::size_t start = out.size() + kDictIndex + 2 + 2;  // then two empty indices
  Bytes dict{29};
  put(dict, static_cast<std::uint32_t>(start), 4);
  put(dict, 17, 1);
  append(out, cff_index({dict}));
  append(out, cff_index({}));  // strings
  append(out, cff_index({}));  // global subroutines
  append(out, cff_index(charstrings));
  return out;
}

struct Glyph {
  int codepoint = 0;
  int source = 0;  // index in the source font
  int advance = 0;
  int shift = 0;  // to the right
};

std::vector<Glyph> choose_glyphs(const stbtt_fontinfo& font) {
  std::vector<Glyph> glyphs;
  int digit = 0;  // widest
  for (const auto& [first, last] : kRanges) {
    for (int c = first; c <= last; ++c) {
      const int source = stbtt_FindGlyphIndex(&font, c);
      if (source == 0) continue;
      Glyph glyph{c, source, 0, 0};
      stbtt_GetGlyphHMetrics(&font, source, &glyph.advance, nullptr);
      if (c >= '0' && c <= '9') digit = std::max(digit, glyph.advance);
      glyphs.push_back(glyph);
    }
  }
  for (Glyph& glyph : glyphs) {
    if (glyph.codepoint < '0' || glyph.codepoint > '9') continue;
    glyph.shift = (digit - glyph.advance) / 2;
    glyph.advance = digit;
  }
  std::sort(glyphs.begin(), glyphs.end(),
            [](const Glyph& a, const Glyph& b) { return a.codepoint < b.codepoint; });
  return glyphs;
}

// One group per code point; short enough, and simple in format 12.
Bytes cmap_table(const std::vector<Glyph>& glyphs) {
  Bytes out;
  put(out, 0, 2);
  put(out, 1, 2);
  put(out, 3, 2);   // Windows
  put(out, 10, 2);  // full Unicode
  put(out, 12, 4);  // offset of the subtable
  put(out, 12, 2);
  put(out, 0, 2);
  put(out, static_cast<std::uint32_t>(16 + 12 * glyphs.size()), 4);
  put(out, 0, 4);
  put(out, static_cast<std::uint32_t>(glyphs.size()), 4);
  std::uint32_t id = 1;
  for (const Glyph& glyph : glyphs) {
    put_int(out, glyph.codepoint, 4);
    put_int(out, glyph.codepoint, 4);
    put(out, id++, 4);
  }
  return out;
}

Bytes font_file(const stbtt_fontinfo& font, const Bytes& source) {
  const std::vector<Glyph> glyphs = choose_glyphs(font);
  std::vector<Bytes> charstrings{charstring(font, 0, 0)};
  Bytes hmtx;
  int advance = 0;
  stbtt_GetGlyphHMetrics(&font, 0, &advance, nullptr);
  put_int(hmtx, advance, 2);
  put(hmtx, 0, 2);
  for (const Glyph& glyph : glyphs) {
    charstrings.push_back(charstring(font, glyph.source, glyph.shift));
    put_int(hmtx, glyph.advance, 2);
    put(hmtx, 0, 2);
  }
  const auto count = static_cast<std::uint32_t>(charstrings.size());
  const auto from = [&](int offset, std::size_t size) {
    const auto begin = source.begin() + offset;
    return Bytes(begin, begin + static_cast<std::ptrdiff_t>(size));
  };
  Bytes hhea = from(font.hhea, 36);
  hhea[34] = static_cast<std::uint8_t>(count >> 8);
  hhea[35] = static_cast<std::uint8_t>(count & 0xffU);
  Bytes maxp;
  put(maxp, 0x00005000, 4);
  put(maxp, count, 2);

  const std::vector<std::pair<std::string_view, Bytes>> tables{{"CFF ", cff_table(charstrings)},
                                                               {"cmap", cmap_table(glyphs)},
                                                               {"head", from(font.head, 54)},
                                                               {"hhea", hhea},
                                                               {"hmtx", hmtx},
                                                               {"maxp", maxp}};
  Bytes out{'O', 'T', 'T', 'O'};
  put(out, static_cast<std::uint32_t>(tables.size()), 2);
  for (int i = 0; i < 3; ++i) put(out, 0, 2);  // search hints, unused here
  std::size_t offset = out.size() + 16 * tables.size();
  for (const auto& [tag, table] : tables) {
    out.insert(out.end(), tag.begin(), tag.end());
    put(out, 0, 4);  // checksum: not read
    put(out, static_cast<std::uint32_t>(offset), 4);
    put(out, static_cast<std::uint32_t>(table.size()), 4);
    offset += (table.size() + 3) / 4 * 4;
  }
  for (const auto& entry : tables) {
    append(out, entry.second);
    while (out.size() % 4 != 0) out.push_back(0);
  }
  return out;
}

int embed(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: embed_font FONT.otf NAME OUT.cpp\n", stderr);
    return 2;
  }
  std::ifstream in(argv[1], std::ios::binary);
  const Bytes source{std::istreambuf_iterator<char>(in), {}};
  stbtt_fontinfo font{};
  if (source.empty() || stbtt_InitFont(&font, source.data(), 0) == 0) {
    std::fprintf(stderr, "embed_font: %s cannot be read as a font\n", argv[1]);
    return 2;
  }
  const Bytes file = font_file(font, source);
  std::ofstream out(argv[3]);
  out << "// Made by embed_font from "
      << std::string_view(argv[1]).substr(std::string_view(argv[1]).rfind('/') + 1)
      << ".\n#include \"app/fonts/fonts.hpp\"\n\nnamespace substep {\n"
      << "const unsigned int " << argv[2] << "_size = " << file.size() << ";\n"
      << "const unsigned char " << argv[2] << "[] = {";
  for (std::size_t i = 0; i < file.size(); ++i) {
    out << (i % 24 == 0 ? "\n" : "") << static_cast<unsigned>(file[i]) << ',';
  }
  out << "};\n}  // namespace substep\n";
  return out.flush() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return embed(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "embed_font: %s\n", error.what());
    return 1;
  }
}
