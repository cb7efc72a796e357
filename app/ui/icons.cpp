#include <array>
#include <cmath>

#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr float kTurn = 6.28318531F;

void draw_reset(ImDrawList& draw, ImVec2 c, float s, ImU32 color) {
  // Most of a circle, with an arrow head at its start.
  const float r = 0.36F * s;
  const float line = 0.115F * s;
  draw.PathArcTo({c.x + 0.04F * s, c.y}, r, 0.43F * kTurn, -0.36F * kTurn, 28);
  draw.PathStroke(color, 0, line);
  const ImVec2 corner(c.x - 0.42F * s, c.y - 0.1F * s);
  const std::array<ImVec2, 3> head{
      {{corner.x, corner.y - 0.28F * s}, corner, {corner.x + 0.28F * s, corner.y}}};
  draw.AddPolyline(head.data(), 3, color, 0, line);
}

void draw_moon(ImDrawList& draw, ImVec2 c, float s, ImU32 color) {
  // A disc minus another one shifted up and right: two arcs between the intersections of the
  // circles.
  const float r = 0.38F * s;
  const float cut = 0.85F * r;
  const float apart = 0.62F * r;
  const float along = (apart * apart + r * r - cut * cut) / (2.0F * apart);
  const float towards = -0.125F * kTurn;
  const float outer = std::acos(along / r);
  const float inner = std::acos((along - apart) / cut);
  draw.PathArcTo(c, r, towards + outer, towards + kTurn - outer, 24);
  draw.PathArcTo({c.x + apart * std::cos(towards), c.y + apart * std::sin(towards)}, cut,
                 towards + kTurn - inner, towards + inner, 24);
  draw.PathStroke(color, ImDrawFlags_Closed, 0.1F * s);
}

void draw_sun(ImDrawList& draw, ImVec2 c, float s, ImU32 color) {
  draw.AddCircleFilled(c, 0.2F * s, color, 16);
  for (int i = 0; i < 8; ++i) {
    const float a = kTurn * static_cast<float>(i) / 8.0F;
    const ImVec2 d(std::cos(a), std::sin(a));
    draw.AddLine({c.x + 0.31F * s * d.x, c.y + 0.31F * s * d.y},
                 {c.x + 0.44F * s * d.x, c.y + 0.44F * s * d.y}, color, 0.1F * s);
  }
}

void draw_corners(ImDrawList& draw, ImVec2 c, float s, ImU32 color) {
  const float r = 0.36F * s;
  for (const float x : {-1.0F, 1.0F}) {
    for (const float y : {-1.0F, 1.0F}) {
      const std::array<ImVec2, 3> points{{{c.x + x * r, c.y + y * 0.45F * r},
                                          {c.x + x * r, c.y + y * r},
                                          {c.x + x * 0.45F * r, c.y + y * r}}};
      draw.AddPolyline(points.data(), 3, color, 0, 0.1F * s);
    }
  }
}

// A tray with an arrow out of it.
void draw_share(ImDrawList& draw, ImVec2 c, float s, ImU32 color) {
  const float line = 0.11F * s;
  const std::array<ImVec2, 4> tray{{{c.x - 0.36F * s, c.y + 0.04F * s},
                                    {c.x - 0.36F * s, c.y + 0.4F * s},
                                    {c.x + 0.36F * s, c.y + 0.4F * s},
                                    {c.x + 0.36F * s, c.y + 0.04F * s}}};
  draw.AddPolyline(tray.data(), 4, color, 0, line);
  draw.AddLine({c.x, c.y + 0.18F * s}, {c.x, c.y - 0.4F * s}, color, line);
  const std::array<ImVec2, 3> head{
      {{c.x - 0.2F * s, c.y - 0.2F * s}, {c.x, c.y - 0.42F * s}, {c.x + 0.2F * s, c.y - 0.2F * s}}};
  draw.AddPolyline(head.data(), 3, color, 0, line);
}

}  // namespace

void draw_icon(ImDrawList& draw, Icon icon, ImVec2 c, float s, ImU32 color) {
  const float line = 0.12F * s;
  switch (icon) {
    case Icon::kPlay:
      draw.AddTriangleFilled({c.x - 0.26F * s, c.y - 0.38F * s}, {c.x + 0.4F * s, c.y},
                             {c.x - 0.26F * s, c.y + 0.38F * s}, color);
      break;
    case Icon::kPause:
      draw.AddRectFilled({c.x - 0.32F * s, c.y - 0.36F * s}, {c.x - 0.09F * s, c.y + 0.36F * s},
                         color, 0.05F * s);
      draw.AddRectFilled({c.x + 0.09F * s, c.y - 0.36F * s}, {c.x + 0.32F * s, c.y + 0.36F * s},
                         color, 0.05F * s);
      break;
    case Icon::kStep:
      draw.AddTriangleFilled({c.x - 0.34F * s, c.y - 0.34F * s}, {c.x + 0.2F * s, c.y},
                             {c.x - 0.34F * s, c.y + 0.34F * s}, color);
      draw.AddRectFilled({c.x + 0.22F * s, c.y - 0.34F * s}, {c.x + 0.36F * s, c.y + 0.34F * s},
                         color, 0.04F * s);
      break;
    case Icon::kSubstep:
      // A smaller triangle inside a dotted frame.
      draw.AddTriangleFilled({c.x - 0.36F * s, c.y - 0.24F * s}, {c.x + 0.02F * s, c.y},
                             {c.x - 0.36F * s, c.y + 0.24F * s}, color);
      for (const float x : {0.14F, 0.34F}) {
        draw.AddRectFilled({c.x + (x - 0.04F) * s, c.y - 0.24F * s},
                           {c.x + (x + 0.05F) * s, c.y + 0.24F * s}, color, 0.03F * s);
      }
      break;
    case Icon::kReset:
      draw_reset(draw, c, s, color);
      break;
    case Icon::kHelp: {
      ImFont* font = ImGui::GetFont();
      const ImVec2 size = text_size(font, "?");
      draw_text(draw, font, {c.x - 0.5F * size.x, c.y - 0.5F * size.y}, color, "?");
      break;
    }
    case Icon::kSun:
      draw_sun(draw, c, s, color);
      break;
    case Icon::kMoon:
      draw_moon(draw, c, s, color);
      break;
    case Icon::kChevron:
    case Icon::kChevronUp: {
      const float down = icon == Icon::kChevron ? s : -s;
      const std::array<ImVec2, 3> points{{{c.x - 0.24F * s, c.y - 0.12F * down},
                                          {c.x, c.y + 0.14F * down},
                                          {c.x + 0.24F * s, c.y - 0.12F * down}}};
      draw.AddPolyline(points.data(), 3, color, 0, line);
      break;
    }
    case Icon::kCheck: {
      const std::array<ImVec2, 3> points{{{c.x - 0.28F * s, c.y + 0.01F * s},
                                          {c.x - 0.07F * s, c.y + 0.22F * s},
                                          {c.x + 0.29F * s, c.y - 0.2F * s}}};
      draw.AddPolyline(points.data(), 3, color, 0, line);
      break;
    }
    case Icon::kCross:
      draw.AddLine({c.x - 0.24F * s, c.y - 0.24F * s}, {c.x + 0.24F * s, c.y + 0.24F * s}, color,
                   line);
      draw.AddLine({c.x - 0.24F * s, c.y + 0.24F * s}, {c.x + 0.24F * s, c.y - 0.24F * s}, color,
                   line);
      break;
    case Icon::kFrame:
      draw_corners(draw, c, s, color);
      break;
    case Icon::kPanels:
      draw.AddRect({c.x - 0.42F * s, c.y - 0.34F * s}, {c.x + 0.42F * s, c.y + 0.34F * s}, color,
                   0.1F * s, 0, 0.09F * s);
      draw.AddRectFilled({c.x - 0.42F * s, c.y - 0.34F * s}, {c.x - 0.1F * s, c.y + 0.34F * s},
                         color, 0.1F * s);
      break;
    case Icon::kList:
      for (const float y : {-0.26F, 0.0F, 0.26F}) {
        draw.AddCircleFilled({c.x - 0.32F * s, c.y + y * s}, 0.07F * s, color, 8);
        draw.AddLine({c.x - 0.16F * s, c.y + y * s}, {c.x + 0.38F * s, c.y + y * s}, color, line);
      }
      break;
    case Icon::kSave: {
      const std::array<ImVec2, 3> head{{{c.x - 0.22F * s, c.y - 0.1F * s},
                                        {c.x, c.y + 0.12F * s},
                                        {c.x + 0.22F * s, c.y - 0.1F * s}}};
      draw.AddLine({c.x, c.y - 0.4F * s}, {c.x, c.y + 0.1F * s}, color, line);
      draw.AddPolyline(head.data(), 3, color, 0, line);
      draw.AddLine({c.x - 0.34F * s, c.y + 0.36F * s}, {c.x + 0.34F * s, c.y + 0.36F * s}, color,
                   line);
      break;
    }
    case Icon::kBall:
      draw.AddCircleFilled({c.x + 0.14F * s, c.y - 0.1F * s}, 0.26F * s, color);
      for (const float y : {-0.2F, 0.0F, 0.2F}) {
        const float from = y == 0.0F ? -0.42F : -0.34F;
        draw.AddLine({c.x + from * s, c.y + (y + 0.06F) * s},
                     {c.x - 0.2F * s, c.y + (0.75F * y + 0.02F) * s}, color, 0.08F * s);
      }
      break;
    case Icon::kShare:
      draw_share(draw, c, s, color);
      break;
    case Icon::kNone:
      break;
  }
}

}  // namespace substep::ui
