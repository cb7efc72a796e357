#include "app/ui/thumbnails.hpp"

#include <algorithm>

#include "app/ui/look.hpp"

namespace substep::ui {
namespace {

constexpr int kMostMade = 4;  // in a frame
constexpr float kFrameRounding = 4.0F;

}  // namespace

// Null if too many were made in this frame.
const Thumbnail* Thumbnails::of(const std::shared_ptr<const Scene>& scene,
                                const ViewPalette& palette) {
  std::erase_if(entries_, [](const Entry& e) { return e.scene.expired(); });
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) {
    return e.scene.lock() == scene && e.floor == palette.floor;
  });
  if (found != entries_.end()) return &found->picture;
  if (frame_ != ImGui::GetFrameCount()) made_ = 0;
  frame_ = ImGui::GetFrameCount();
  if (++made_ > kMostMade) return nullptr;
  return &entries_.emplace_back(Entry{scene, palette.floor, thumbnail_of(*scene, palette)}).picture;
}

void Thumbnails::draw(ImDrawList& draw, const std::shared_ptr<const Scene>& scene,
                      const ViewPalette& palette, ImVec2 min, ImVec2 max) {
  draw.AddRectFilled(min, max, to_u32(palette.floor, 1.0F), kFrameRounding);
  const Thumbnail* picture = of(scene, palette);
  if (picture == nullptr) return;
  const float height = max.y - min.y;
  std::vector<ImVec2> points;
  draw.PushClipRect(min, max, true);
  for (const Thumbnail::Polygon& polygon : picture->polygons) {
    points.clear();
    for (std::size_t i = 0; i < polygon.count; ++i) {
      const auto& p = picture->points[polygon.first + i];
      points.emplace_back(min.x + height * p[0], min.y + height * p[1]);
    }
    const auto count = static_cast<int>(points.size());
    const ImU32 color = to_u32(polygon.color, 1.0F);
    draw.AddConvexPolyFilled(points.data(), count, color);
    if (polygon.outlined) {
      draw.AddPolyline(points.data(), count, color, ImDrawFlags_Closed, 1.0F);
    }
  }
  draw.PopClipRect();
}

}  // namespace substep::ui
