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

std::vector<PixelRect> covered_by_panels() {
  constexpr ImGuiWindowFlags kSeenThrough =
      ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_ChildWindow | ImGuiWindowFlags_Popup;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const ImVec2 ratio = ImGui::GetIO().DisplayFramebufferScale;
  const auto pixel = [](float at, float length, float scale, auto round) {
    return static_cast<int>(round(std::clamp(at, 0.0F, length) * scale));
  };
  const auto ceil = [](float x) { return std::ceil(x); };
  const auto floor = [](float x) { return std::floor(x); };
  std::vector<PixelRect> covers;
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    if (!window->Active || window->Hidden || (window->Flags & kSeenThrough) != 0) continue;
    const float corner = window->WindowRounding + 1.0F;
    const ImVec2 min(window->Pos.x + corner, window->Pos.y + corner);
    const ImVec2 max(window->Pos.x + window->Size.x - corner,
                     window->Pos.y + window->Size.y - corner);
    const PixelRect inside =
        between(pixel(min.x, size.x, ratio.x, ceil), pixel(min.y, size.y, ratio.y, ceil),
                pixel(max.x, size.x, ratio.x, floor), pixel(max.y, size.y, ratio.y, floor));
    if (inside.width > 0 && inside.height > 0) covers.push_back(inside);
  }
  return covers;
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
  return 4 * area(largest) < area(window) ? window : largest;
}

void keep_within(const PixelRect& part, ImDrawData& panels) {
  constexpr float kRounding = 0.01F;  // the back end truncates to pixels
  const auto at = [&](int x, int y) {
    return ImVec2((static_cast<float>(x) + kRounding) / panels.FramebufferScale.x,
                  (static_cast<float>(y) + kRounding) / panels.FramebufferScale.y);
  };
  const ImVec2 min = at(part.x, part.y);
  const ImVec2 max = at(part.x + part.width, part.y + part.height);
  const auto outside = [&](const ImDrawList* list) {
    ImRect bounds(FLT_MAX, FLT_MAX, -FLT_MAX, -FLT_MAX);
    for (const ImDrawVert& v : list->VtxBuffer) bounds.Add(v.pos);
    return !bounds.Overlaps({min, max});
  };
  ImVector<ImDrawList*>& lists = panels.CmdLists;
  lists.resize(
      static_cast<int>(std::remove_if(lists.begin(), lists.end(), outside) - lists.begin()));
  panels.CmdListsCount = lists.Size;
  for (ImDrawList* list : lists) {
    for (ImDrawCmd& command : list->CmdBuffer) {
      ImVec4& clip = command.ClipRect;
      clip = {std::max(clip.x, min.x), std::max(clip.y, min.y), std::min(clip.z, max.x),
              std::min(clip.w, max.y)};
    }
  }
}

}  // namespace substep
