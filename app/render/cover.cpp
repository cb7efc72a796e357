#include "app/render/cover.hpp"

#include <imgui_internal.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <utility>

namespace substep {
namespace {

PixelRect between(int left, int top, int right, int bottom) {
  return {left, top, std::max(0, right - left), std::max(0, bottom - top)};
}

// Appends the parts of a rectangle outside another: above, below, and on both sides.
void cut(const PixelRect& from, const PixelRect& c, std::vector<PixelRect>& left) {
  const int top = std::clamp(c.y, from.y, from.y + from.height);
  const int bottom = std::clamp(c.y + c.height, top, from.y + from.height);
  const int begin = std::clamp(c.x, from.x, from.x + from.width);
  const int end = std::clamp(c.x + c.width, begin, from.x + from.width);
  for (const PixelRect& r :
       {between(from.x, from.y, from.x + from.width, top),
        between(from.x, bottom, from.x + from.width, from.y + from.height),
        between(from.x, top, begin, bottom), between(end, top, from.x + from.width, bottom)}) {
    if (r.width > 0 && r.height > 0) left.push_back(r);
  }
}

}  // namespace

Panels panels_over_picture() {
  constexpr ImGuiWindowFlags kSeenThrough =
      ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_ChildWindow | ImGuiWindowFlags_Popup;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const ImVec2 ratio = ImGui::GetIO().DisplayFramebufferScale;
  const auto pixel = [](float at, float length, float scale, auto round) {
    return static_cast<int>(round(std::clamp(at, 0.0F, length) * scale));
  };
  const auto ceil = [](float x) { return std::ceil(x); };
  const auto floor = [](float x) { return std::floor(x); };
  Panels panels;
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    if (!window->Active || window->Hidden || (window->Flags & kSeenThrough) != 0) continue;
    ImRect all = window->Rect();
    ImRect inside = all;
    all.Expand(1.0F);
    inside.Expand(-window->WindowRounding - 1.0F);
    const PixelRect interior = between(
        pixel(inside.Min.x, size.x, ratio.x, ceil), pixel(inside.Min.y, size.y, ratio.y, ceil),
        pixel(inside.Max.x, size.x, ratio.x, floor), pixel(inside.Max.y, size.y, ratio.y, floor));
    if (interior.width <= 0 || interior.height <= 0) continue;
    panels.interiors.push_back(interior);
    panels.bounds.push_back(
        between(pixel(all.Min.x, size.x, ratio.x, floor), pixel(all.Min.y, size.y, ratio.y, floor),
                pixel(all.Max.x, size.x, ratio.x, ceil), pixel(all.Max.y, size.y, ratio.y, ceil)));
  }
  return panels;
}

std::vector<PixelRect> uncovered(const PixelRect& window, std::span<const PixelRect> covers) {
  std::vector<PixelRect> parts{window};
  for (const PixelRect& c : covers) {
    std::vector<PixelRect> left;
    for (const PixelRect& part : parts) cut(part, c, left);
    parts = std::move(left);
  }
  return parts;
}

PixelRect largest_uncovered(const PixelRect& window, std::span<const PixelRect> covers) {
  const auto area = [](const PixelRect& r) { return r.width * r.height; };
  PixelRect largest;
  for (const PixelRect& part : uncovered(window, covers)) {
    if (area(part) > area(largest)) largest = part;
  }
  if (4 * area(largest) < area(window)) return window;
  // uncovered() divides along the edges of all panels: extended up and down to the next one.
  int top = window.y;
  int bottom = window.y + window.height;
  for (const PixelRect& c : covers) {
    if (c.x >= largest.x + largest.width || c.x + c.width <= largest.x) continue;
    if (c.y < largest.y) {
      top = std::max(top, c.y + c.height);
    } else {
      bottom = std::min(bottom, c.y);
    }
  }
  return between(largest.x, top, largest.x + largest.width, bottom);
}

void keep_within(const PixelRect& part, ImDrawData& panels) {
  const ImVec2 pixel(1.0F / panels.FramebufferScale.x, 1.0F / panels.FramebufferScale.y);
  const ImRect within(static_cast<float>(part.x) * pixel.x, static_cast<float>(part.y) * pixel.y,
                      static_cast<float>(part.x + part.width) * pixel.x,
                      static_cast<float>(part.y + part.height) * pixel.y);
  const auto outside = [&](const ImDrawList* list) {
    ImRect bounds(FLT_MAX, FLT_MAX, -FLT_MAX, -FLT_MAX);
    for (const ImDrawVert& v : list->VtxBuffer) bounds.Add(v.pos);
    return !bounds.Overlaps(within);
  };
  ImVector<ImDrawList*>& lists = panels.CmdLists;
  lists.resize(
      static_cast<int>(std::remove_if(lists.begin(), lists.end(), outside) - lists.begin()));
  panels.CmdListsCount = lists.Size;
  // The back end truncates the left edge, the distance of the lower one from the window's, the
  // width and the height to whole pixels: none of them may fall short by rounding.
  constexpr float kSpare = 0.01F;  // [pixel]
  for (ImDrawList* list : lists) {
    for (ImDrawCmd& command : list->CmdBuffer) {
      ImVec4& clip = command.ClipRect;
      clip = {std::max(clip.x, within.Min.x) + kSpare * pixel.x,
              std::max(clip.y, within.Min.y) - 2 * kSpare * pixel.y,
              std::min(clip.z, within.Max.x) + 2 * kSpare * pixel.x,
              std::min(clip.w, within.Max.y) - kSpare * pixel.y};
    }
  }
}

}  // namespace substep
