// The first screen: two runs side by side, their explanation, and the buttons for laboratory and
// tour.

#include "app/text/introduction.hpp"

#include <algorithm>
#include <string>

#include "app/app.hpp"
#include "app/text/citation.hpp"
#include "app/ui/over_picture.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr ImGuiWindowFlags kGround =
    kPlaced | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoInputs |
    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoBringToFrontOnFocus;

constexpr float kAbove = 10.0F;  // gap above the label of a picture

// Layout of the screen: pictures side by side, or stacked if it is narrow.
struct ScreenMeasures {
  bool stacked = false;
  bool low = false;  // a phone in landscape
  bool large = false;
  float pad = 24.0F;
  float head = 0.0F;   // height of name and sentences
  float label = 0.0F;  // height of the label of a picture
  float foot = 0.0F;   // height of buttons and paper
  float button = 44.0F;
};

float lines_height(ImFont* font, const std::string& text, float width) {
  return text_size(font, wrapped(font, text, width)).y;
}

ScreenMeasures measure_screen(const Look& look, const IntroductionWords& words, ImVec2 display) {
  ScreenMeasures m;
  m.stacked = display.x < 600.0F && display.y > display.x;
  m.low = display.y < 480.0F;
  m.large = display.x >= 1000.0F && display.y >= 600.0F;
  m.pad = m.stacked || m.low ? 16.0F : 32.0F;
  const float width = display.x - 2.0F * m.pad;
  m.head = m.pad + 32.0F + lines_height(look.fonts.regular, kPurpose, width);
  ImFont* claim = m.low ? look.fonts.small : look.fonts.regular;
  m.head += 4.0F + lines_height(claim, words.claim, width);
  m.label = m.large ? 68.0F : 48.0F;
  if (m.low) m.button = 36.0F;
  m.foot = 12.0F + m.button + 12.0F + lines_height(look.fonts.small, words.paper, width) + m.pad;
  if (m.low) m.foot = 12.0F + m.button + 12.0F;  // the paper is beside the buttons
  return m;
}

ViewRect picture_area(const ScreenMeasures& m, ImVec2 display) {
  return {0.0F, m.head, display.x, std::max(1.0F, display.y - m.head - m.foot)};
}

// Wrapped text, each line centred or left-aligned.
// @return its lower end
float paragraph(const Look& look, ImFont* font, ImVec2 from, float width, bool centred, ImU32 color,
                const std::string& text) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const std::string lines = wrapped(font, text, width);
  float y = from.y;
  for (std::size_t at = 0; at < lines.size();) {
    const std::size_t end = std::min(lines.find('\n', at), lines.size());
    const std::string line = lines.substr(at, end - at);
    const ImVec2 size = text_size(font, line);
    const float x = centred ? from.x + 0.5F * (width - size.x) : from.x;
    draw_over(look, draw, font, {x, y}, color, line);
    y += size.y;
    at = end + 1;
  }
  return y;
}

void draw_head(const Look& look, const ScreenMeasures& m, const IntroductionWords& words,
               float width) {
  const Theme& t = *look.theme;
  const bool centred = !m.stacked;
  float y = paragraph(look, look.fonts.title, {m.pad, m.pad}, width, centred, t.text, "substep");
  y = paragraph(look, look.fonts.regular, {m.pad, m.pad + 32.0F}, width, centred, t.text, kPurpose);
  paragraph(look, m.low ? look.fonts.small : look.fonts.regular, {m.pad, y + 4.0F}, width, centred,
            t.dim, words.claim);
}

void picture_label(const Look& look, const ScreenMeasures& m, const ViewRect& picture,
                   const IntroductionWords::Label& label, ImU32 note_color) {
  const float pad = m.stacked ? m.pad : 8.0F;
  const float width = picture.width - 2.0F * pad;
  const ImVec2 at(picture.x + pad, picture.y + picture.height + 2.0F);
  ImFont* title = m.large ? look.fonts.title : look.fonts.medium;
  ImFont* note = m.large ? look.fonts.regular : look.fonts.small;
  const float y = paragraph(look, title, at, width, !m.stacked, look.theme->text,
                            fitted(title, label.title, width));
  paragraph(look, note, {at.x, y + 2.0F}, width, !m.stacked, note_color,
            fitted(note, label.note, width));
}

// A separate window: the covered part of the picture is not drawn.
void ground(const char* id, float top, float bottom, float width) {
  ImGui::SetNextWindowPos({0.0F, top});
  ImGui::SetNextWindowSize({width, bottom - top});
  ImGui::Begin(id, nullptr, kGround);
  ImGui::End();
}

// The label of a picture on the panel colour, over the grid.
void draw_grounds(const ScreenMeasures& m, const ViewRect& held, const ViewRect& torn,
                  ImVec2 display) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
  const float label = torn.y + torn.height - kAbove;
  if (m.stacked) ground("##introduction_label", label, held.y, display.x);
  ground("##introduction_foot", held.y + held.height - kAbove, display.y, display.x);
  ImGui::PopStyleVar(2);
}

// The clock of both runs, between their labels, or to the right of the upper one; and a line
// between their pictures.
void draw_clock(const Look& look, const ScreenMeasures& m, const ViewRect& held,
                const ViewRect& torn, float width, const std::string& text) {
  const ImU32 line = fade(look.theme->faint, 0.5F);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (!m.stacked) {
    draw.AddLine({held.x, held.y + 16.0F}, {held.x, held.y + held.height - 24.0F}, line);
  }
  ImFont* font = look.fonts.small;
  const float size = text_size(font, text).x;
  const float x = m.stacked ? width - m.pad - size : 0.5F * (width - size);
  draw_over(look, draw, font, {x, torn.y + torn.height + 4.0F}, look.theme->dim, text);
}

// The three buttons. @return whether the laboratory was chosen
bool draw_foot(const Look& look, const ScreenMeasures& m, const IntroductionWords& words,
               ImVec2 display, Session& session, Desk& desk) {
  constexpr float kGap = 12.0F;
  const float pause = m.button;  // a square
  const float width = m.stacked ? 0.5F * (display.x - 2.0F * (m.pad + kGap) - pause) : 144.0F;
  const float y = display.y - m.foot + 12.0F;
  const float left = m.stacked || m.low ? m.pad : 0.5F * (display.x - kGap) - width;
  ImGui::SetCursorScreenPos({left, y});
  const bool chosen = button(look, "try", Icon::kNone, "Try it", ButtonKind::kPrimary, width,
                             m.button, "Open the laboratory (Enter)");
  ImGui::SameLine(0.0F, kGap);
  if (button(look, "tour", Icon::kNone, "Tour", ButtonKind::kPlain, width, m.button, kTourTip)) {
    desk.follow = "tour=1";
  }
  ImGui::SameLine(0.0F, kGap);
  const bool playing = session.playing();
  if (button(look, playing ? "pause" : "play", playing ? Icon::kPause : Icon::kPlay, "",
             ButtonKind::kGhost, pause, m.button, playing ? "Pause (Space)" : "Play (Space)")) {
    session.toggle();
  }
  if (m.low) {
    const float x = left + 2.0F * (width + kGap) + pause + 16.0F;
    paragraph(look, look.fonts.small, {x, y}, display.x - m.pad - x, false, look.theme->dim,
              words.paper);
  } else {
    paragraph(look, look.fonts.small, {m.pad, y + m.button + 12.0F}, display.x - 2.0F * m.pad,
              !m.stacked, look.theme->dim, words.paper);
  }
  return chosen;
}

// A tap outside the buttons, Enter or Escape.
bool left_otherwise() {
  const ImGuiIO& io = ImGui::GetIO();
  const bool tapped = ImGui::IsWindowHovered() && !ImGui::IsAnyItemHovered() &&
                      ImGui::IsMouseReleased(ImGuiMouseButton_Left) &&
                      io.MouseDragMaxDistanceSqr[ImGuiMouseButton_Left] < 36.0F;
  // Enter activates the focused button.
  const bool enter = ImGui::IsKeyPressed(ImGuiKey_Enter, false) ||
                     ImGui::IsKeyPressed(ImGuiKey_KeypadEnter, false);
  return tapped || (enter && !io.NavVisible) || ImGui::IsKeyPressed(ImGuiKey_Escape, false);
}

}  // namespace

// The stable run first: it is the session, and its picture fills the remaining window.
std::vector<ViewRect> introduction_panes(const Look& look, const Lab& lab) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const ScreenMeasures m = measure_screen(look, introduction_words(lab), display);
  ViewRect torn = picture_area(m, display);
  if (m.stacked) torn.height *= 0.5F;
  if (!m.stacked) torn.width *= 0.5F;
  torn.height = std::max(1.0F, torn.height - m.label);
  ViewRect held = torn;
  if (m.stacked) held.y += torn.height + m.label;
  if (!m.stacked) held.x += torn.width;
  return {held, torn};
}

// Together they fill the window.
Part introduction_part(const Viewport& viewport, std::size_t pane) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const ViewRect& held = viewport.panes[0];
  const float x = held.x / display.x;
  const float y = held.y / display.y;
  if (held.x > 0.0F) return pane == 0 ? Part{x, 0.0F, 1.0F - x, 1.0F} : Part{0.0F, 0.0F, x, 1.0F};
  return pane == 0 ? Part{0.0F, y, 1.0F, 1.0F - y} : Part{0.0F, 0.0F, 1.0F, y};
}

void introduction(App& app) {
  const Look& look = app.look;
  const Theme& t = *look.theme;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const IntroductionWords words = introduction_words(app);
  const ScreenMeasures m = measure_screen(look, words, display);
  app.view_rect = picture_area(m, display);
  const std::vector<ViewRect> panes = introduction_panes(look, app);
  const ViewRect& held = panes[0];
  const ViewRect& torn = panes[1];
  bool leave = false;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0F);
  draw_grounds(m, held, torn, display);
  ImGui::SetNextWindowPos({0.0F, 0.0F});
  ImGui::SetNextWindowSize(display);
  if (ImGui::Begin("##introduction", nullptr,
                   kPlaced | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoBackground)) {
    draw_head(look, m, words, display.x - 2.0F * m.pad);
    const Verdict* verdict = Introduction::torn(app);
    const bool failed = verdict != nullptr && !verdict->holds();
    picture_label(look, m, torn, words.torn, failed ? t.orange : t.dim);
    picture_label(look, m, held, words.held, t.teal);
    draw_clock(look, m, held, torn, display.x, words.clock);
    leave = draw_foot(look, m, words, display, app.session, app.desk) || left_otherwise();
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
  if (!leave) return;
  app.introduction.leave(app);
  app.desk.tour_hint = false;  // the hint was beside the button
}

}  // namespace substep::ui
