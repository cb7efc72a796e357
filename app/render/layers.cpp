#include "app/render/layers.hpp"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>
#include <utility>

namespace substep {
namespace {

PixelRect pixels_of(const ImGuiWindow& window, ImVec2 ratio) {
  const int left = static_cast<int>(std::floor(window.Pos.x * ratio.x));
  const int top = static_cast<int>(std::floor(window.Pos.y * ratio.y));
  const int right = static_cast<int>(std::ceil((window.Pos.x + window.Size.x) * ratio.x));
  const int bottom = static_cast<int>(std::ceil((window.Pos.y + window.Size.y) * ratio.y));
  return {left, top, right - left, bottom - top};
}

PixelRect inside(const PixelRect& r, int margin) {
  return {r.x + margin, r.y + margin, std::max(0, r.width - 2 * margin),
          std::max(0, r.height - 2 * margin)};
}

// The part of the window that there is.
PixelRect clipped(const PixelRect& r, const ImDrawData& panels) {
  const auto size = [](float length, float ratio) {
    return static_cast<int>(std::lround(length * ratio));
  };
  const int left = std::max(r.x, 0);
  const int top = std::max(r.y, 0);
  const int right = std::min(r.x + r.width, size(panels.DisplaySize.x, panels.FramebufferScale.x));
  const int bottom =
      std::min(r.y + r.height, size(panels.DisplaySize.y, panels.FramebufferScale.y));
  return {left, top, std::max(0, right - left), std::max(0, bottom - top)};
}

bool fills(const Layer& layer) { return layer.covers.width > 0 && layer.covers.height > 0; }

template <class T>
std::size_t mixed(std::size_t hash, const ImVector<T>& items) {
  const std::string_view bytes(reinterpret_cast<const char*>(items.Data),
                               static_cast<std::size_t>(items.size_in_bytes()));
  return hash * 31 + std::hash<std::string_view>{}(bytes);
}

// Vertices say where and in which colour, commands what is cut off and what the texture is.
std::size_t look_of(const Layer& layer) {
  std::size_t hash = 0;
  for (const ImDrawList* list : layer.lists.CmdLists) {
    hash = mixed(mixed(mixed(hash, list->VtxBuffer), list->IdxBuffer), list->CmdBuffer);
  }
  return hash;
}

// What is left of a rectangle beside another: above, below, and at its sides.
void cut(const PixelRect& from, const PixelRect& c, std::vector<PixelRect>& left) {
  const int top = std::clamp(c.y, from.y, from.y + from.height);
  const int bottom = std::clamp(c.y + c.height, top, from.y + from.height);
  const int begin = std::clamp(c.x, from.x, from.x + from.width);
  const int end = std::clamp(c.x + c.width, begin, from.x + from.width);
  for (const PixelRect& r : {PixelRect{from.x, from.y, from.width, top - from.y},
                             PixelRect{from.x, bottom, from.width, from.y + from.height - bottom},
                             PixelRect{from.x, top, begin - from.x, bottom - top},
                             PixelRect{end, top, from.x + from.width - end, bottom - top}}) {
    if (r.width > 0 && r.height > 0) left.push_back(r);
  }
}

}  // namespace

std::vector<PixelRect> uncovered(const PixelRect& window, std::span<const PixelRect> covers) {
  std::vector<PixelRect> parts{window};
  for (const PixelRect& c : covers) {
    std::vector<PixelRect> left;
    for (const PixelRect& part : parts) cut(part, c, left);
    parts = std::move(left);
  }
  return parts;
}

std::vector<Layer> layers_of(const ImDrawData& panels) {
  std::vector<Layer> layers;
  for (ImDrawList* list : panels.CmdLists) {
    const ImGuiWindow* window = ImGui::FindWindowByName(list->_OwnerName);
    const ImGuiWindow* root = window != nullptr ? window->RootWindow : nullptr;
    const ImGuiID id = root != nullptr ? root->ID : 0;
    if (layers.empty() || layers.back().id != id) {
      Layer& layer = layers.emplace_back();
      layer.id = id;
      layer.lists = panels;
      layer.lists.CmdLists.clear();
      if (root != nullptr && (root->Flags & ImGuiWindowFlags_NoBackground) == 0) {
        const PixelRect whole = pixels_of(*root, panels.FramebufferScale);
        const float corner = root->WindowRounding * panels.FramebufferScale.x;
        layer.area = clipped(whole, panels);
        layer.covers = clipped(inside(whole, static_cast<int>(std::ceil(corner)) + 1), panels);
      }
    }
    layers.back().lists.CmdLists.push_back(list);
    layers.back().lists.CmdListsCount = layers.back().lists.CmdLists.Size;
  }
  return layers;
}

void LayerKeeper::plan(std::vector<Layer>& layers, bool sparing) {
  std::vector<Kept> before;
  std::swap(before, kept_);
  if (!sparing) return;
  Layer* turn = nullptr;  // of those that changed, the one that waited longest
  std::size_t turn_kept = 0;
  std::size_t turn_look = 0;
  for (Layer& layer : layers) {
    if (!fills(layer)) continue;
    const std::size_t look = look_of(layer);
    const auto known = std::find_if(before.begin(), before.end(), [&](const Kept& k) {
      return k.id == layer.id && k.area == layer.area;
    });
    if (known == before.end()) {
      layer.showing = Showing::kDrawAndKeep;
      kept_.push_back({layer.id, layer.area, look, 0});
      continue;
    }
    layer.showing = Showing::kKept;
    kept_.push_back({layer.id, layer.area, known->look, known->age + 1});
    const int age = kept_.back().age;
    if (look == known->look || age < kTurn) continue;
    if (turn != nullptr && age <= kept_[turn_kept].age) continue;
    turn = &layer;
    turn_kept = kept_.size() - 1;
    turn_look = look;
  }
  if (turn == nullptr) return;
  turn->showing = Showing::kDrawAndKeep;
  kept_[turn_kept].look = turn_look;
  kept_[turn_kept].age = 0;
}

}  // namespace substep
