// What is drawn anew where a window keeps its pixels: all that changed, and nothing is lost.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "app/render/picture_changes.hpp"
#include "app/render/tiles.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

// A window that a plain rasteriser draws to, as Dear ImGui's OpenGL back end would: cut at whole
// pixels, blended, with the font atlas as texture.
class Sheet {
 public:
  Sheet(int width, int height)
      : width_(width), height_(height), pixels_(static_cast<std::size_t>(width * height)) {
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&atlas_, &atlas_width_, &atlas_height_);
  }

  void clear(const PixelRect& r) {
    for (int y = r.y; y < r.y + r.height; ++y) {
      for (int x = r.x; x < r.x + r.width; ++x) at(x, y) = {};
    }
  }

  void draw(const ImDrawData& data) {
    for (const ImDrawList* list : data.CmdLists) {
      for (const ImDrawCmd& command : list->CmdBuffer) draw(*list, command, data);
    }
  }

  bool operator==(const Sheet& other) const { return pixels_ == other.pixels_; }

  [[nodiscard]] std::size_t painted() const {
    return static_cast<std::size_t>(
        std::count_if(pixels_.begin(), pixels_.end(), [](const Rgba& p) { return p[3] > 0.0F; }));
  }

 private:
  using Rgba = std::array<float, 4>;

  Rgba& at(int x, int y) { return pixels_[static_cast<std::size_t>(y * width_ + x)]; }

  void draw(const ImDrawList& list, const ImDrawCmd& command, const ImDrawData& data) {
    const float sx = data.FramebufferScale.x;
    const float sy = data.FramebufferScale.y;
    const ImVec4& c = command.ClipRect;
    const int left = std::max(0, static_cast<int>(c.x * sx));
    const int right =
        std::min(width_, static_cast<int>(c.x * sx) + static_cast<int>(c.z * sx - c.x * sx));
    const int bottom =
        std::min(height_, height_ - static_cast<int>(static_cast<float>(height_) - c.w * sy));
    const int top = std::max(0, bottom - static_cast<int>(c.w * sy - c.y * sy));
    for (unsigned i = 0; i < command.ElemCount; i += 3) {
      std::array<const ImDrawVert*, 3> v{};
      for (unsigned k = 0; k < 3; ++k) {
        const ImDrawIdx index = list.IdxBuffer[static_cast<int>(command.IdxOffset + i + k)];
        v[k] = &list.VtxBuffer[static_cast<int>(command.VtxOffset + index)];
      }
      const auto edge = [](ImVec2 a, ImVec2 b, float x, float y) {
        return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
      };
      std::array<ImVec2, 3> p{};
      for (std::size_t k = 0; k < 3; ++k) p[k] = {v[k]->pos.x * sx, v[k]->pos.y * sy};
      const float area = edge(p[0], p[1], p[2].x, p[2].y);
      if (area == 0.0F) continue;
      const auto [x0, x1] = std::minmax({p[0].x, p[1].x, p[2].x});
      const auto [y0, y1] = std::minmax({p[0].y, p[1].y, p[2].y});
      for (int y = std::max(top, static_cast<int>(y0));
           y < std::min(bottom, static_cast<int>(y1) + 1); ++y) {
        for (int x = std::max(left, static_cast<int>(x0));
             x < std::min(right, static_cast<int>(x1) + 1); ++x) {
          const float px = static_cast<float>(x) + 0.5F;
          const float py = static_cast<float>(y) + 0.5F;
          const std::array<float, 3> w{edge(p[1], p[2], px, py) / area,
                                       edge(p[2], p[0], px, py) / area,
                                       edge(p[0], p[1], px, py) / area};
          if (w[0] < 0.0F || w[1] < 0.0F || w[2] < 0.0F) continue;
          blend(at(x, y), v, w);
        }
      }
    }
  }

  void blend(Rgba& pixel, const std::array<const ImDrawVert*, 3>& v,
             const std::array<float, 3>& w) const {
    Rgba colour{};
    float u = 0.0F;
    float t = 0.0F;
    for (std::size_t k = 0; k < 3; ++k) {
      const ImVec4 c = ImGui::ColorConvertU32ToFloat4(v[k]->col);
      colour[0] += w[k] * c.x;
      colour[1] += w[k] * c.y;
      colour[2] += w[k] * c.z;
      colour[3] += w[k] * c.w;
      u += w[k] * v[k]->uv.x;
      t += w[k] * v[k]->uv.y;
    }
    const int column =
        std::clamp(static_cast<int>(u * static_cast<float>(atlas_width_)), 0, atlas_width_ - 1);
    const int row =
        std::clamp(static_cast<int>(t * static_cast<float>(atlas_height_)), 0, atlas_height_ - 1);
    const float alpha =
        colour[3] * static_cast<float>(atlas_[row * atlas_width_ + column]) / 255.0F;
    for (std::size_t k = 0; k < 3; ++k) pixel[k] = colour[k] * alpha + pixel[k] * (1.0F - alpha);
    pixel[3] = alpha + pixel[3] * (1.0F - alpha);
  }

  int width_;
  int height_;
  std::vector<Rgba> pixels_;
  unsigned char* atlas_ = nullptr;
  int atlas_width_ = 0;
  int atlas_height_ = 0;
};

void draw_all(Sheet& sheet, const std::vector<Layer>& layers) {
  for (const Layer& layer : layers) sheet.draw(layer.lists);
}

TEST(Tiles, ShowWhatDrawingAllShows) {
  for (const float ratio : {1.0F, 1.5F}) {
    Headless h(900, 500, ratio);
    const int width = static_cast<int>(900 * ratio);
    const int height = static_cast<int>(500 * ratio);
    TileRecord record;
    Sheet kept(width, height);
    std::size_t drawn = 0;
    const auto look = [&](const std::string& after) {
      Sheet fresh(width, height);
      const std::vector<Layer>& layers = h.renderer->layers;
      draw_all(fresh, layers);
      const std::vector<PixelRect> parts = record.changes(width, height, layers);
      for (const PixelRect& part : parts) {
        drawn += static_cast<std::size_t>(part.width * part.height);
        kept.clear(part);
      }
      kept.draw(limited_to(parts, layers));
      ASSERT_GT(fresh.painted(), 10000U);
      EXPECT_TRUE(kept == fresh) << "after " << after << ", ratio " << ratio;
    };
    look("the start");
    const auto whole = static_cast<std::size_t>(width * height);
    EXPECT_EQ(drawn, whole);
    drawn = 0;
    h.app->session.play();
    for (int i = 0; i < 5; ++i) {
      h.frames(1);
      look("a frame");
    }
    EXPECT_LT(drawn, 5 * whole / 2) << "what stays is not drawn again";
    h.app->desk.help = true;  // a card over the panels
    h.frames(2);
    look("a card came");
    h.app->desk.help = false;
    h.frames(2);
    look("it went");
    ASSERT_EQ(h.app->set("theme", "light"), "");
    h.frames(2);
    look("another theme");
    h.app->session.pause();
    h.frames(200);  // until the frame rate shown has settled
    look("the last frame");
    drawn = 0;
    h.frames(1);
    look("nothing");
    EXPECT_EQ(drawn, 0U) << "at rest nothing is drawn";
    drawn = 0;
    record.forget();
    look("it was forgotten");
    EXPECT_EQ(drawn, whole);
    const std::vector<PixelRect> grown = record.changes(width + 1, height, h.renderer->layers);
    ASSERT_EQ(grown.size(), 1U) << "a window of another size is empty";
    EXPECT_EQ(grown[0], (PixelRect{0, 0, width + 1, height}));
  }
}

TEST(Tiles, OfAKeptPanelStayAsTheyWere) {
  Headless h;
  TileRecord record;
  std::vector<Layer> layers = h.renderer->layers;
  record.changes(1280, 720, layers);
  h.app->session.play();
  h.frames(3);
  layers = h.renderer->layers;
  for (Layer& layer : layers) layer.showing = Showing::kKept;
  EXPECT_TRUE(record.changes(1280, 720, layers).empty());
  for (Layer& layer : layers) layer.showing = Showing::kDraw;
  EXPECT_FALSE(record.changes(1280, 720, layers).empty()) << "its turn came";
  EXPECT_TRUE(record.changes(1280, 720, layers).empty());
}

// Where a point of the world is seen, as shares of the window.
Eigen::Vector2f seen(const Picture& picture, const Eigen::Vector3f& point) {
  const Eigen::Vector4f p = picture.view_projection * point.homogeneous();
  return {0.5F + 0.5F * p.x() / p.w(), 0.5F - 0.5F * p.y() / p.w()};
}

bool holds(const Part& part, const Picture& picture, const Eigen::Vector2f& p) {
  const Part& w = picture.part;
  if (p.x() < w.x || p.x() > w.x + w.width || p.y() < w.y || p.y() > w.y + w.height) return true;
  return p.x() >= part.x && p.x() <= part.x + part.width && p.y() >= part.y &&
         p.y() <= part.y + part.height;
}

TEST(ChangedPart, HoldsWhatMovedAndItsShadow) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> share(-1.0F, 1.0F);
  double area = 0.0;
  int frames = 0;
  for (const std::string name : {"swinging_box", "heavy_stack", "wrecking_ball", "ragdoll_drop"}) {
    Headless h;
    ASSERT_TRUE(h.app->open(name));
    h.app->session.play();
    h.frames(60);
    for (int i = 0; i < 20; ++i) {
      const Picture before = h.renderer->picture;
      h.frames(1);
      const Picture now = h.renderer->picture;
      const Part part = changed_parts({&before, 1}, {&now, 1}).front();
      area += static_cast<double>(part.width * part.height);
      ++frames;
      const Eigen::Vector3f light =
          Eigen::Map<const Eigen::Vector3f>(now.to_light.data()).normalized();
      const Eigen::Map<const Eigen::Vector3f> origin(now.ground.origin.data());
      const Eigen::Map<const Eigen::Vector3f> normal(now.ground.normal.data());
      const auto expect_inside = [&](const Eigen::Vector3f& point) {
        EXPECT_TRUE(holds(part, now, seen(now, point))) << name;
        const float height = (point - origin).dot(normal);
        if (height < 0.0F) return;
        const Eigen::Vector3f shadow = point - height / normal.dot(light) * light;
        EXPECT_TRUE(holds(part, now, seen(now, shadow))) << name << ", its shadow";
      };
      for (std::size_t b = 0; b < now.boxes.size(); ++b) {
        if (before.boxes[b] == now.boxes[b]) continue;
        for (const Instance& box : {before.boxes[b], now.boxes[b]}) {
          const Eigen::Quaternionf q(box.orientation[3], box.orientation[0], box.orientation[1],
                                     box.orientation[2]);
          for (int s = 0; s < 20; ++s) {
            const Eigen::Vector3f local(share(random) * box.half_extents[0],
                                        share(random) * box.half_extents[1],
                                        share(random) * box.half_extents[2]);
            expect_inside(Eigen::Map<const Eigen::Vector3f>(box.position.data()) + q * local);
          }
        }
      }
      for (std::size_t b = 0; b < now.balls.size(); ++b) {
        if (before.balls[b] == now.balls[b]) continue;
        for (const Instance& ball : {before.balls[b], now.balls[b]}) {
          for (int s = 0; s < 20; ++s) {
            const Eigen::Vector3f out =
                Eigen::Vector3f(share(random), share(random), share(random)).normalized();
            expect_inside(Eigen::Map<const Eigen::Vector3f>(ball.position.data()) +
                          ball.half_extents[0] * out);
          }
        }
      }
      if (before.ribbons == now.ribbons) continue;
      for (const Picture* picture : {&before, &now}) {
        for (const RibbonVertex& v : picture->ribbons) {
          EXPECT_TRUE(
              holds(part, now, seen(now, Eigen::Map<const Eigen::Vector3f>(v.position.data()))))
              << name << ", a ribbon";
        }
      }
    }
  }
  EXPECT_LT(area, 0.5 * frames) << "not much of the window, or nothing is saved";
}

TEST(ChangedPart, IsAllWhereTheViewMoves) {
  Headless h;
  const Picture before = h.renderer->picture;
  Picture now = before;
  const auto part = [&] { return changed_parts({&before, 1}, {&now, 1}).front(); };
  EXPECT_EQ(part().width, 0.0F) << "nothing changed";
  now.view_projection(0, 3) += 0.1F;
  EXPECT_EQ(part(), now.part);
  now = before;
  now.boxes.pop_back();
  EXPECT_EQ(part(), now.part);
  now = before;
  now.background_top.r += 0.1F;
  EXPECT_EQ(part(), now.part);
}

// Pictures side by side: the first is drawn in all of the window, and the others over it.
TEST(ChangedPart, HoldsWhatAPictureBelowIsDrawnOver) {
  Headless h;
  Picture below = h.renderer->picture;
  Picture over = below;
  over.part = {0.5F, 0.1F, 0.5F, 0.9F};
  const std::vector<Picture> before{below, over};
  below.background_top.r += 0.1F;  // all of it is drawn
  const std::vector<Picture> now{below, over};
  const std::vector<Part> parts = changed_parts(before, now);
  EXPECT_EQ(parts[0], (Part{0.0F, 0.0F, 1.0F, 1.0F}));
  EXPECT_EQ(parts[1], over.part) << "it did not change, but was drawn over";
  const std::vector<Part> none = changed_parts(before, before);
  EXPECT_EQ(none[0].width * none[0].height, 0.0F);
  EXPECT_EQ(none[1].width * none[1].height, 0.0F);
}

}  // namespace
}  // namespace substep
