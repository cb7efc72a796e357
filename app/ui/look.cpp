#include "app/ui/look.hpp"

#include <array>

#include <algorithm>

#include "app/fonts/fonts.hpp"

namespace substep::ui {
namespace {

// 0xRRGGBB, the usual notation.
constexpr ImU32 rgb(unsigned hex, unsigned alpha = 255) {
  return (alpha << IM_COL32_A_SHIFT) | (((hex >> 16U) & 0xffU) << IM_COL32_R_SHIFT) |
         (((hex >> 8U) & 0xffU) << IM_COL32_G_SHIFT) | ((hex & 0xffU) << IM_COL32_B_SHIFT);
}
Color color(unsigned hex, float alpha = 1.0F) {
  return {static_cast<float>((hex >> 16U) & 0xffU) / 255.0F,
          static_cast<float>((hex >> 8U) & 0xffU) / 255.0F,
          static_cast<float>(hex & 0xffU) / 255.0F, alpha};
}

Theme make_dark() {
  Theme t;
  t.dark = true;
  t.panel = rgb(0x181c24);
  t.panel_border = rgb(0x2b313d);
  t.raised = rgb(0x222835);
  t.well = rgb(0x0f1218);
  t.control = rgb(0x2c3341);
  t.control_hover = rgb(0x394253);
  t.track = rgb(0x303847);
  t.text = rgb(0xe8ecf2);
  t.dim = rgb(0x9aa4b3);
  t.faint = rgb(0x566070);
  t.accent = rgb(0x2f6fe4);
  t.accent_hover = rgb(0x4a86f0);
  t.on_accent = rgb(0xffffff);
  t.blue = rgb(0x4d90fe);
  t.orange = rgb(0xff8a4c);
  t.teal = rgb(0x46c6a0);
  t.amber = rgb(0xe3b341);
  t.purple = rgb(0xd9a8f5);
  t.grey = rgb(0x7d8798);
  t.view.background_top = color(0x2a303c);
  t.view.background_bottom = color(0x11141a);
  t.view.grid = color(0x8593a8, 0.24F);
  t.view.body = color(0xd9dee6);
  t.view.fixture = color(0x77818f);
  t.view.joint = color(0x4a5260);
  t.view.trail = color(0x5c9dff, 0.75F);
  t.view.stiff_low = color(0xccd6e6);
  t.view.stiff_mid = color(0xe6c9a8);
  t.view.stiff_high = color(0xf5803e);
  t.view.floor = color(0x3a424e, 0.95F);
  t.view.shade = color(0x0a0c10);
  t.view.ambient = 0.50F;
  t.view.shadow = 0.60F;
  t.view.contact = 0.62F;
  return t;
}

Theme make_light() {
  Theme t;
  t.dark = false;
  t.panel = rgb(0xffffff);
  t.panel_border = rgb(0xd5dbe4);
  t.raised = rgb(0xffffff);
  t.well = rgb(0xf1f3f7);
  t.control = rgb(0xe6eaf0);
  t.control_hover = rgb(0xd9dfe8);
  t.track = rgb(0xd3d9e3);
  t.text = rgb(0x161b24);
  t.dim = rgb(0x556072);
  t.faint = rgb(0xa4adbb);
  t.accent = rgb(0x1f5fd6);
  t.accent_hover = rgb(0x2f6ce0);
  t.on_accent = rgb(0xffffff);
  t.blue = rgb(0x1f6feb);
  t.orange = rgb(0xbc4407);
  t.teal = rgb(0x007a70);
  t.amber = rgb(0x8f5f00);
  t.purple = rgb(0x6d2fc4);
  t.grey = rgb(0x6b7586);
  t.view.background_top = color(0xf4f6f9);
  t.view.background_bottom = color(0xdde3eb);
  t.view.grid = color(0x5d6b80, 0.36F);
  t.view.body = color(0xc4cdd9);
  t.view.fixture = color(0x8c96a5);
  t.view.joint = color(0x5b6472);
  t.view.trail = color(0x1f6feb, 0.7F);
  t.view.stiff_low = color(0xc2cfe2);
  t.view.stiff_mid = color(0xf0cfa9);
  t.view.stiff_high = color(0xf07a35);
  t.view.floor = color(0xeef1f5, 0.95F);
  t.view.shade = color(0x39424f);
  t.view.ambient = 0.52F;
  t.view.shadow = 0.34F;
  t.view.contact = 0.42F;
  return t;
}

}  // namespace

const Theme& dark_theme() {
  static const Theme theme = make_dark();
  return theme;
}
const Theme& light_theme() {
  static const Theme theme = make_light();
  return theme;
}

ImU32 compare_color(const Look& look, std::size_t run) {
  const Theme& t = *look.theme;
  return std::array{t.orange, t.teal, t.purple}.at(run);
}

ImU32 fade(ImU32 color, float opacity) {
  ImVec4 c = to_vec4(color);
  c.w *= opacity;
  return ImGui::ColorConvertFloat4ToU32(c);
}

Fonts build_fonts(float pixel_ratio) {
  ImGuiIO& io = ImGui::GetIO();
  ImFontAtlas& atlas = *io.Fonts;
  atlas.Clear();
  atlas.Flags |= ImFontAtlasFlags_NoMouseCursors;
  static const ImWchar kRanges[] = {0x20, 0x17f, 0x391, 0x3c9, 0x2010, 0x2265, 0};
  const auto add = [&](const unsigned char* data, unsigned size, float height) {
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.GlyphRanges = kRanges;
    // Whole pixels are sharpest; at high pixel ratios, fractions give even letter spacing.
    config.OversampleH = pixel_ratio < 1.25F ? 2 : 1;
    config.OversampleV = 1;
    config.PixelSnapH = pixel_ratio >= 1.25F;
    // Dear ImGui does not write to font data that it does not own.
    return atlas.AddFontFromMemoryTTF(const_cast<unsigned char*>(data), static_cast<int>(size),
                                      height * pixel_ratio, &config);
  };
  // Sizes are line heights: Inter's em is 0.83 of them, so 16 is 13 pixels of type.
  Fonts fonts;
  fonts.regular = add(kInterRegular, kInterRegular_size, 16.0F);
  fonts.small = add(kInterRegular, kInterRegular_size, 14.0F);
  fonts.medium = add(kInterMedium, kInterMedium_size, 16.0F);
  fonts.small_medium = add(kInterMedium, kInterMedium_size, 14.0F);
  fonts.caps = add(kInterSemiBold, kInterSemiBold_size, 13.0F);
  fonts.title = add(kInterSemiBold, kInterSemiBold_size, 24.0F);
  fonts.large = add(kInterSemiBold, kInterSemiBold_size, 32.0F);
  io.FontGlobalScale = 1.0F / pixel_ratio;
  atlas.Build();
  return fonts;
}

void apply_style(const Look& look) {
  const Theme& t = *look.theme;
  ImGuiStyle style;
  style.WindowPadding = {look.m.pad, look.m.pad};
  style.WindowRounding = look.m.panel_radius;
  style.WindowBorderSize = 1.0F;
  style.PopupRounding = 8.0F;
  style.PopupBorderSize = 1.0F;
  style.FrameRounding = look.m.radius;
  style.FramePadding = {10.0F, 5.0F};
  style.ItemSpacing = {look.m.gap, look.m.gap};
  style.ScrollbarSize = 8.0F;
  style.ScrollbarRounding = 4.0F;
  style.WindowMinSize = {1.0F, 1.0F};
  style.AntiAliasedLinesUseTex = false;
  style.HoverStationaryDelay = 0.15F;
  style.HoverDelayNormal = 0.45F;
  ImVec4* c = style.Colors;
  c[ImGuiCol_Text] = to_vec4(t.text);
  c[ImGuiCol_TextDisabled] = to_vec4(t.dim);
  c[ImGuiCol_WindowBg] = to_vec4(t.panel);
  c[ImGuiCol_ChildBg] = {0, 0, 0, 0};
  c[ImGuiCol_PopupBg] = to_vec4(t.raised);
  c[ImGuiCol_Border] = to_vec4(t.panel_border);
  c[ImGuiCol_FrameBg] = to_vec4(t.well);
  c[ImGuiCol_ScrollbarBg] = {0, 0, 0, 0};
  c[ImGuiCol_ScrollbarGrab] = to_vec4(t.track);
  c[ImGuiCol_ScrollbarGrabHovered] = to_vec4(t.faint);
  c[ImGuiCol_ScrollbarGrabActive] = to_vec4(t.faint);
  c[ImGuiCol_ModalWindowDimBg] = {0.0F, 0.0F, 0.0F, 0.3F};
  c[ImGuiCol_Header] = to_vec4(t.control);
  c[ImGuiCol_HeaderHovered] = to_vec4(t.control);
  c[ImGuiCol_HeaderActive] = to_vec4(t.control_hover);
  c[ImGuiCol_NavHighlight] = to_vec4(t.accent_hover);
  c[ImGuiCol_TextSelectedBg] = to_vec4(fade(t.accent, 0.5F));
  ImGui::GetStyle() = style;
}

}  // namespace substep::ui
