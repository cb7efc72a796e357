#include "app/ui/look.hpp"

#include <array>

#include "app/fonts/fonts.hpp"

namespace substep::ui {
namespace {

// 0xRRGGBB, the usual notation.
constexpr ImU32 rgb(unsigned hex) {
  return IM_COL32_A_MASK | (((hex >> 16U) & 0xffU) << IM_COL32_R_SHIFT) |
         (((hex >> 8U) & 0xffU) << IM_COL32_G_SHIFT) | ((hex & 0xffU) << IM_COL32_B_SHIFT);
}
Color color(unsigned hex, float alpha = 1.0F) {
  return {static_cast<float>((hex >> 16U) & 0xffU) / 255.0F,
          static_cast<float>((hex >> 8U) & 0xffU) / 255.0F,
          static_cast<float>(hex & 0xffU) / 255.0F, alpha};
}

Theme make_theme(bool dark) {
  const auto pick = [dark](unsigned in_dark, unsigned in_light) {
    return dark ? in_dark : in_light;
  };
  Theme t;
  t.dark = dark;
  t.panel = rgb(pick(0x181c24, 0xffffff));
  t.panel_border = rgb(pick(0x2b313d, 0xd5dbe4));
  t.raised = rgb(pick(0x222835, 0xffffff));
  t.well = rgb(pick(0x0f1218, 0xf1f3f7));
  t.control = rgb(pick(0x2c3341, 0xe6eaf0));
  t.control_hover = rgb(pick(0x394253, 0xd9dfe8));
  t.track = rgb(pick(0x303847, 0xd3d9e3));
  t.text = rgb(pick(0xe8ecf2, 0x161b24));
  t.dim = rgb(pick(0x9aa4b3, 0x556072));
  t.faint = rgb(pick(0x566070, 0xa4adbb));
  t.accent = rgb(pick(0x2f6fe4, 0x1f5fd6));
  t.accent_hover = rgb(pick(0x4a86f0, 0x2f6ce0));
  t.on_accent = rgb(0xffffff);
  t.blue = rgb(pick(0x4d90fe, 0x1a64dc));
  t.orange = rgb(pick(0xff8a4c, 0xbc4407));
  t.teal = rgb(pick(0x46c6a0, 0x007a70));
  t.amber = rgb(pick(0xe3b341, 0x8f5f00));
  t.purple = rgb(pick(0xd9a8f5, 0x6a28a8));
  t.grey = rgb(pick(0x7d8798, 0x6b7586));
  t.view.background_top = color(pick(0x2a303c, 0xf4f6f9));
  t.view.background_bottom = color(pick(0x11141a, 0xdde3eb));
  t.view.grid = color(pick(0x8593a8, 0x5d6b80), dark ? 0.24F : 0.36F);
  t.view.body = color(pick(0xd9dee6, 0xc4cdd9));
  t.view.fixture = color(pick(0x77818f, 0x8c96a5));
  t.view.joint = color(pick(0x4a5260, 0x5b6472));
  t.view.trail = color(pick(0x5c9dff, 0x1f6feb), dark ? 0.75F : 0.7F);
  t.view.stiff_low = color(pick(0xccd6e6, 0xc2cfe2));
  t.view.stiff_mid = color(pick(0xe6c9a8, 0xf0cfa9));
  t.view.stiff_high = color(pick(0xf5803e, 0xf07a35));
  t.view.floor = color(pick(0x3a424e, 0xeef1f5), 0.95F);
  t.view.shade = color(pick(0x0a0c10, 0x39424f));
  t.view.ambient = dark ? 0.50F : 0.52F;
  t.view.shadow = dark ? 0.60F : 0.34F;
  t.view.contact = dark ? 0.62F : 0.42F;
  return t;
}

}  // namespace

const Theme& dark_theme() {
  static const Theme theme = make_theme(true);
  return theme;
}
const Theme& light_theme() {
  static const Theme theme = make_theme(false);
  return theme;
}

ImU32 compare_color(const Look& look, std::size_t run) {
  const Theme& t = *look.theme;
  return std::array{t.orange, t.teal, t.purple}.at(run);
}

ImU32 to_u32(const Color& color, float opacity) {
  return ImGui::ColorConvertFloat4ToU32({color.r, color.g, color.b, opacity});
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
