#include <array>
#include <cmath>
#include <initializer_list>

#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr float kTurn = 6.28318531F;

/// Draws in coordinates from the centre of an icon, in units of its size.
struct Pen {
  ImDrawList& draw;
  ImVec2 centre;
  float size;
  ImU32 color;

  [[nodiscard]] ImVec2 at(ImVec2 p) const { return centre + p * size; }
  void line(ImVec2 from, ImVec2 to, float width = 0.12F) const {
    draw.AddLine(at(from), at(to), color, width * size);
  }
  /// A line through at most four points.
  void lines(std::initializer_list<ImVec2> through, float width = 0.12F) const {
    std::array<ImVec2, 4> points;
    int count = 0;
    for (const ImVec2 p : through) points.at(static_cast<std::size_t>(count++)) = at(p);
    draw.AddPolyline(points.data(), count, color, 0, width * size);
  }
  void triangle(ImVec2 a, ImVec2 b, ImVec2 c) const {
    draw.AddTriangleFilled(at(a), at(b), at(c), color);
  }
  void box(ImVec2 min, ImVec2 max, float rounding) const {
    draw.AddRectFilled(at(min), at(max), color, rounding * size);
  }
  void disc(ImVec2 middle, float radius, int segments = 0) const {
    draw.AddCircleFilled(at(middle), radius * size, color, segments);
  }
};

void draw_reset(const Pen& pen) {
  // Most of a circle, with an arrow head at its start.
  constexpr float kLine = 0.115F;
  pen.draw.PathArcTo(pen.at({0.04F, 0.0F}), 0.36F * pen.size, 0.43F * kTurn, -0.36F * kTurn, 28);
  pen.draw.PathStroke(pen.color, 0, kLine * pen.size);
  pen.lines({{-0.42F, -0.38F}, {-0.42F, -0.1F}, {-0.14F, -0.1F}}, kLine);
}

void draw_moon(const Pen& pen) {
  // A disc minus another one shifted up and right: two arcs between the intersections of the
  // circles.
  const float r = 0.38F * pen.size;
  const float cut = 0.85F * r;
  const float apart = 0.62F * r;
  const float along = (apart * apart + r * r - cut * cut) / (2.0F * apart);
  const float towards = -0.125F * kTurn;
  const float outer = std::acos(along / r);
  const float inner = std::acos((along - apart) / cut);
  pen.draw.PathArcTo(pen.centre, r, towards + outer, towards + kTurn - outer, 24);
  pen.draw.PathArcTo(pen.centre + ImVec2(std::cos(towards), std::sin(towards)) * apart, cut,
                     towards + kTurn - inner, towards + inner, 24);
  pen.draw.PathStroke(pen.color, ImDrawFlags_Closed, 0.1F * pen.size);
}

void draw_sun(const Pen& pen) {
  pen.disc({}, 0.2F, 16);
  for (int i = 0; i < 8; ++i) {
    const float a = kTurn * static_cast<float>(i) / 8.0F;
    const ImVec2 d(std::cos(a), std::sin(a));
    pen.line(d * 0.31F, d * 0.44F, 0.1F);
  }
}

void draw_corners(const Pen& pen) {
  constexpr float kFar = 0.36F;
  constexpr float kNear = 0.45F * kFar;
  for (const float x : {-1.0F, 1.0F}) {
    for (const float y : {-1.0F, 1.0F}) {
      pen.lines({{x * kFar, y * kNear}, {x * kFar, y * kFar}, {x * kNear, y * kFar}}, 0.1F);
    }
  }
}

// A tray with an arrow out of it.
void draw_share(const Pen& pen) {
  constexpr float kLine = 0.11F;
  pen.lines({{-0.36F, 0.04F}, {-0.36F, 0.4F}, {0.36F, 0.4F}, {0.36F, 0.04F}}, kLine);
  pen.line({0.0F, 0.18F}, {0.0F, -0.4F}, kLine);
  pen.lines({{-0.2F, -0.2F}, {0.0F, -0.42F}, {0.2F, -0.2F}}, kLine);
}

}  // namespace

void draw_icon(ImDrawList& draw, Icon icon, ImVec2 c, float s, ImU32 color) {
  const Pen pen{draw, c, s, color};
  switch (icon) {
    case Icon::kPlay:
      pen.triangle({-0.26F, -0.38F}, {0.4F, 0.0F}, {-0.26F, 0.38F});
      break;
    case Icon::kPause:
      pen.box({-0.32F, -0.36F}, {-0.09F, 0.36F}, 0.05F);
      pen.box({0.09F, -0.36F}, {0.32F, 0.36F}, 0.05F);
      break;
    case Icon::kStep:
      pen.triangle({-0.34F, -0.34F}, {0.2F, 0.0F}, {-0.34F, 0.34F});
      pen.box({0.22F, -0.34F}, {0.36F, 0.34F}, 0.04F);
      break;
    case Icon::kSubstep:
      // A smaller triangle inside a dotted frame.
      pen.triangle({-0.36F, -0.24F}, {0.02F, 0.0F}, {-0.36F, 0.24F});
      for (const float x : {0.14F, 0.34F}) pen.box({x - 0.04F, -0.24F}, {x + 0.05F, 0.24F}, 0.03F);
      break;
    case Icon::kReset:
      draw_reset(pen);
      break;
    case Icon::kHelp: {
      ImFont* font = ImGui::GetFont();
      draw_text(draw, font, c - text_size(font, "?") * 0.5F, color, "?");
      break;
    }
    case Icon::kSun:
      draw_sun(pen);
      break;
    case Icon::kMoon:
      draw_moon(pen);
      break;
    case Icon::kChevron:
      pen.lines({{-0.24F, -0.12F}, {0.0F, 0.14F}, {0.24F, -0.12F}});
      break;
    case Icon::kChevronUp:
      pen.lines({{-0.24F, 0.12F}, {0.0F, -0.14F}, {0.24F, 0.12F}});
      break;
    case Icon::kCheck:
      pen.lines({{-0.28F, 0.01F}, {-0.07F, 0.22F}, {0.29F, -0.2F}});
      break;
    case Icon::kCross:
      pen.line({-0.24F, -0.24F}, {0.24F, 0.24F});
      pen.line({-0.24F, 0.24F}, {0.24F, -0.24F});
      break;
    case Icon::kFrame:
      draw_corners(pen);
      break;
    case Icon::kPanels:
      draw.AddRect(pen.at({-0.42F, -0.34F}), pen.at({0.42F, 0.34F}), color, 0.1F * s, 0, 0.09F * s);
      pen.box({-0.42F, -0.34F}, {-0.1F, 0.34F}, 0.1F);
      break;
    case Icon::kList:
      for (const float y : {-0.26F, 0.0F, 0.26F}) {
        pen.disc({-0.32F, y}, 0.07F, 8);
        pen.line({-0.16F, y}, {0.38F, y});
      }
      break;
    case Icon::kSave:
      pen.line({0.0F, -0.4F}, {0.0F, 0.1F});
      pen.lines({{-0.22F, -0.1F}, {0.0F, 0.12F}, {0.22F, -0.1F}});
      pen.line({-0.34F, 0.36F}, {0.34F, 0.36F});
      break;
    case Icon::kBall:
      pen.disc({0.14F, -0.1F}, 0.26F);
      for (const float y : {-0.2F, 0.0F, 0.2F}) {
        const float from = y == 0.0F ? -0.42F : -0.34F;
        pen.line({from, y + 0.06F}, {-0.2F, 0.75F * y + 0.02F}, 0.08F);
      }
      break;
    case Icon::kShare:
      draw_share(pen);
      break;
    case Icon::kHold:  // a line that ends at a bar
      pen.line({-0.38F, 0.0F}, {0.2F, 0.0F});
      pen.line({0.28F, -0.34F}, {0.28F, 0.34F});
      break;
    case Icon::kFollow:  // a line with an arrow head
      pen.line({-0.38F, 0.0F}, {0.3F, 0.0F});
      pen.lines({{0.12F, -0.22F}, {0.34F, 0.0F}, {0.12F, 0.22F}});
      break;
    case Icon::kSweep:  // the past, behind a bar, is dotted
      pen.line({0.0F, -0.34F}, {0.0F, 0.34F});
      pen.line({0.12F, 0.0F}, {0.4F, 0.0F});
      for (const float x : {-0.36F, -0.16F}) pen.disc({x, 0.0F}, 0.06F, 8);
      break;
    case Icon::kUndo:
      pen.lines({{-0.14F, -0.36F}, {-0.38F, -0.12F}, {-0.14F, 0.12F}});
      pen.lines({{-0.36F, -0.12F}, {0.34F, -0.12F}, {0.34F, 0.34F}, {-0.1F, 0.34F}});
      break;
    case Icon::kRedo:
      pen.lines({{0.14F, -0.36F}, {0.38F, -0.12F}, {0.14F, 0.12F}});
      pen.lines({{0.36F, -0.12F}, {-0.34F, -0.12F}, {-0.34F, 0.34F}, {0.1F, 0.34F}});
      break;
    case Icon::kPencil:
      pen.lines({{-0.4F, 0.4F}, {-0.33F, 0.1F}, {0.2F, -0.43F}, {0.43F, -0.2F}}, 0.1F);
      pen.lines({{0.43F, -0.2F}, {-0.1F, 0.33F}, {-0.4F, 0.4F}}, 0.1F);
      pen.line({0.05F, -0.28F}, {0.28F, -0.05F}, 0.1F);
      break;
    case Icon::kNone:
      break;
  }
}

}  // namespace substep::ui
