#include "app/render/tiles.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <utility>

namespace substep {
namespace {

// A rectangle in pixels, with fractions.
struct Area {
  float left;
  float top;
  float right;
  float bottom;

  [[nodiscard]] bool empty() const { return !(left < right && top < bottom); }
};

Area common(const Area& a, const Area& b) {
  return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right),
          std::min(a.bottom, b.bottom)};
}

using Triangle = std::array<const ImDrawVert*, 3>;

Area area_of(const Triangle& t, ImVec2 ratio) {
  const auto [left, right] = std::minmax({t[0]->pos.x, t[1]->pos.x, t[2]->pos.x});
  const auto [top, bottom] = std::minmax({t[0]->pos.y, t[1]->pos.y, t[2]->pos.y});
  return {left * ratio.x, top * ratio.y, right * ratio.x, bottom * ratio.y};
}

Area clip_of(const ImDrawCmd& command, ImVec2 ratio) {
  const ImVec4& c = command.ClipRect;
  return {c.x * ratio.x, c.y * ratio.y, c.z * ratio.x, c.w * ratio.y};
}

Area area_of(const PixelRect& r) {
  return {static_cast<float>(r.x), static_cast<float>(r.y), static_cast<float>(r.x + r.width),
          static_cast<float>(r.y + r.height)};
}

// Dear ImGui's back end cuts at whole pixels: left edge, width and height are rounded down, and so
// is the distance of the lower edge from the window's.
Area pixels_cut(const ImDrawCmd& command, ImVec2 ratio, int height) {
  const Area c = clip_of(command, ratio);
  const float left = std::trunc(c.left);
  const float bottom =
      static_cast<float>(height) - std::trunc(static_cast<float>(height) - c.bottom);
  return {left, bottom - std::trunc(c.bottom - c.top), left + std::trunc(c.right - c.left), bottom};
}

// What it rounds to this box of whole pixels, in spite of rounding errors.
ImVec4 cut_of(const Area& pixels, ImVec2 ratio) {
  return {(pixels.left + 0.2F) / ratio.x, (pixels.top - 0.7F) / ratio.y,
          (pixels.right + 0.7F) / ratio.x, (pixels.bottom - 0.2F) / ratio.y};
}

Triangle triangle(const ImDrawList& list, const ImDrawCmd& command, unsigned first) {
  Triangle t{};
  for (unsigned corner = 0; corner < 3; ++corner) {
    const ImDrawIdx index = list.IdxBuffer[static_cast<int>(command.IdxOffset + first + corner)];
    t[corner] = &list.VtxBuffer[static_cast<int>(command.VtxOffset + index)];
  }
  return t;
}

std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
  return (std::rotl(hash, 23) ^ word) * 0x9E3779B97F4A7C15U;
}

template <class T>
std::uint64_t mixed_bytes(std::uint64_t hash, const T& value) {
  static_assert(sizeof(T) % 4 == 0);
  std::array<std::uint32_t, sizeof(T) / 4> words{};
  std::memcpy(words.data(), &value, sizeof(T));
  for (const std::uint32_t word : words) hash = mixed(hash, word);
  return hash;
}

// Neighbours that changed, put together: runs of a row, and equal runs of rows below each other.
std::vector<PixelRect> together(const std::vector<bool>& changed, int columns, int rows) {
  std::vector<PixelRect> parts;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto is_changed = [&](int c) {
        return c < columns && changed[static_cast<std::size_t>(row * columns + c)];
      };
      if (!is_changed(column)) continue;
      const int begin = column;
      while (is_changed(column)) ++column;
      const auto above = std::find_if(parts.begin(), parts.end(), [&](const PixelRect& p) {
        return p.x == begin && p.width == column - begin && p.y + p.height == row;
      });
      if (above != parts.end())
        ++above->height;
      else
        parts.push_back({begin, row, column - begin, 1});
    }
  }
  return parts;
}

}  // namespace

std::vector<std::uint64_t> TileRecord::tiles_of(const ImDrawData& lists) const {
  std::vector<std::uint64_t> tiles(static_cast<std::size_t>(columns_ * rows_));
  const ImVec2 ratio = lists.FramebufferScale;
  const Area window{0.0F, 0.0F, static_cast<float>(columns_ * kTile),
                    static_cast<float>(rows_ * kTile)};
  const auto tile = [](float pixel) { return static_cast<int>(pixel) / kTile; };
  for (const ImDrawList* list : lists.CmdLists) {
    for (const ImDrawCmd& command : list->CmdBuffer) {
      const Area clip = common(clip_of(command, ratio), window);
      const std::uint64_t manner =
          mixed(mixed_bytes(1, command.ClipRect), std::hash<ImTextureID>{}(command.TextureId));
      for (unsigned i = 0; i < command.ElemCount; i += 3) {
        const Triangle t = triangle(*list, command, i);
        Area box = area_of(t, ratio);
        // One that touches a pixel's edge may colour it.
        box = common({box.left - 1.0F, box.top - 1.0F, box.right + 1.0F, box.bottom + 1.0F}, clip);
        if (box.empty()) continue;
        std::uint64_t hash = manner;
        for (const ImDrawVert* vertex : t) hash = mixed_bytes(hash, *vertex);
        const int right = std::min(tile(box.right), columns_ - 1);
        const int bottom = std::min(tile(box.bottom), rows_ - 1);
        for (int row = tile(box.top); row <= bottom; ++row) {
          for (int column = tile(box.left); column <= right; ++column) {
            std::uint64_t& at = tiles[static_cast<std::size_t>(row * columns_ + column)];
            at = mixed(at, hash);
          }
        }
      }
    }
  }
  return tiles;
}

std::vector<PixelRect> TileRecord::changes(int width, int height, std::span<const Layer> layers) {
  const bool all = width != width_ || height != height_;  // a window of another size is empty
  width_ = width;
  height_ = height;
  columns_ = (width + kTile - 1) / kTile;
  rows_ = (height + kTile - 1) / kTile;
  std::vector<bool> changed(static_cast<std::size_t>(columns_ * rows_), all);
  std::vector<Shown> before;
  std::swap(before, shown_);
  if (all) before.clear();
  const auto compare = [&changed](const std::vector<std::uint64_t>& a,
                                  const std::vector<std::uint64_t>* b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a[i] != (b != nullptr ? (*b)[i] : 0)) changed[i] = true;
    }
  };
  auto next = before.begin();  // those in front of it are accounted for
  for (const Layer& layer : layers) {
    const auto known =
        std::find_if(next, before.end(), [&](const Shown& shown) { return shown.id == layer.id; });
    Shown& now = shown_.emplace_back();
    now.id = layer.id;
    if (known != before.end() && layer.showing == Showing::kKept) {
      now.tiles = std::move(known->tiles);
    } else {
      now.tiles = tiles_of(layer.lists);
      compare(now.tiles, known != before.end() ? &known->tiles : nullptr);
    }
    if (known == before.end()) continue;
    for (; next != known; ++next) compare(next->tiles, nullptr);  // gone, or now over this one
    ++next;
  }
  for (; next != before.end(); ++next) compare(next->tiles, nullptr);

  // What is drawn anew below a kept layer shows a part of that as it is now, and one that has
  // changed back by its turn would not be seen to.
  constexpr std::uint64_t kUnknown = 1;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (layers[i].showing != Showing::kKept) continue;
    for (std::size_t t = 0; t < changed.size(); ++t) {
      if (changed[t] && shown_[i].tiles[t] != 0) shown_[i].tiles[t] = kUnknown;
    }
  }
  std::vector<PixelRect> parts = together(changed, columns_, rows_);
  for (PixelRect& p : parts) {
    p = {p.x * kTile, p.y * kTile, std::min(p.width * kTile, width - p.x * kTile),
         std::min(p.height * kTile, height - p.y * kTile)};
  }
  return parts;
}

ImDrawData limited_to(std::span<const PixelRect> parts, std::span<const Layer> layers) {
  ImDrawData all;
  if (layers.empty()) return all;
  all = layers.front().lists;
  all.CmdLists.clear();
  const ImVec2 ratio = all.FramebufferScale;
  const int height = static_cast<int>(all.DisplaySize.y * ratio.y);
  for (const Layer& layer : layers) {
    for (ImDrawList* list : layer.lists.CmdLists) {
      ImVector<ImDrawCmd> commands;
      ImVector<ImDrawIdx> indices;
      for (const PixelRect& part : parts) {
        for (const ImDrawCmd& command : list->CmdBuffer) {
          const Area clip = common(pixels_cut(command, ratio, height), area_of(part));
          if (clip.empty()) continue;
          ImDrawCmd limited = command;
          limited.ClipRect = cut_of(clip, ratio);
          limited.IdxOffset = static_cast<unsigned>(indices.Size);
          for (unsigned i = 0; i < command.ElemCount; i += 3) {
            const Area box = area_of(triangle(*list, command, i), ratio);
            if (box.right < clip.left - 1.0F || box.left > clip.right + 1.0F ||
                box.bottom < clip.top - 1.0F || box.top > clip.bottom + 1.0F) {
              continue;
            }
            for (unsigned corner = 0; corner < 3; ++corner) {
              indices.push_back(list->IdxBuffer[static_cast<int>(command.IdxOffset + i + corner)]);
            }
          }
          limited.ElemCount = static_cast<unsigned>(indices.Size) - limited.IdxOffset;
          if (limited.ElemCount > 0) commands.push_back(limited);
        }
      }
      if (commands.empty()) continue;
      list->CmdBuffer.swap(commands);
      list->IdxBuffer.swap(indices);
      all.CmdLists.push_back(list);
    }
  }
  all.CmdListsCount = all.CmdLists.Size;
  return all;
}

}  // namespace substep
