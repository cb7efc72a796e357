// The comparison in the picture: side by side in panes, or as ghosts with a legend.

#include <algorithm>
#include <string>

#include "app/text/format.hpp"
#include "app/text/verdict_words.hpp"
#include "app/ui/over_picture.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr float kCaptionHeight = 64.0F;  // height of title and method at the top of the view
constexpr float kPad = 12.0F;

struct Entry {
  std::string name;
  ImU32 color = 0;
  const Verdict* verdict = nullptr;
  int n = 0;  // sub-steps of the frame that the panels show
};

std::vector<Entry> entries(const Look& look, const Session& session, const Compare& compare,
                           Desk& desk) {
  std::vector<Entry> list{{run_title(session, compare), look.theme->blue, &session.verdict(),
                           session.report().n_substeps}};
  for (std::size_t i = 0; i < compare.runs().size(); ++i) {
    const Compare::Run& run = compare.runs()[i];
    list.push_back({overrides_title(run.overrides, session.settings()), compare_color(look, i),
                    &*run.verdict, run.report.n_substeps});
  }
  desk.shown_ns.resize(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (desk.whole) desk.shown_ns[i] = list[i].n;
    list[i].n = desk.shown_ns[i];
  }
  return list;
}

// Above the picture; below it in a narrow view, whose upper half the bodies need.
void legend(const Look& look, const std::vector<Entry>& all, bool judged,
            const Viewport& viewport) {
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  constexpr float kNarrow = 500.0F;
  const ViewRect& v = viewport.view_rect;
  const float x = v.x + 24.0F;
  const float line = text_size(look.fonts.regular, "N").y + 8.0F;
  float y = v.width < kNarrow ? v.y + v.height - 4.0F - line * static_cast<float>(all.size())
                              : v.y + kCaptionHeight + 8.0F;
  const float room = v.width - 64.0F;
  for (const Entry& entry : all) {
    const std::string stands = !judged                  ? "Ready"
                               : entry.verdict->holds() ? "N " + std::to_string(entry.n)
                                                        : verdict_note(*entry.verdict, true);
    const std::string text =
        fitted(look.fonts.regular, entry.name + "  ·  " + stands, std::max(40.0F, room));
    const ImVec2 size = text_size(look.fonts.regular, text);
    draw.AddRectFilled({x - 8.0F, y - 2.0F}, {x + size.x + 28.0F, y + size.y + 2.0F},
                       fade(look.theme->panel, 0.8F), look.m.radius);
    draw.AddCircleFilled({x + 5.0F, y + 0.5F * size.y}, 5.0F, entry.color);
    draw_text(draw, look.fonts.regular, {x + 18.0F, y}, look.theme->text, text);
    y += line;
  }
}

// Name and verdict in the top left corner of a pane, N in the top right.
void pane_label(const Look& look, const Entry& entry, bool judged, const ViewRect& r) {
  const Theme& t = *look.theme;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.PushClipRect({r.x, r.y}, {r.x + r.width, r.y + r.height}, true);
  const std::string n = "N " + std::to_string(entry.n);
  const ImVec2 at(r.x + kPad, r.y + 8.0F);
  constexpr float kNarrow = 150.0F;  // narrower: N or the failure's time is below the name
  const bool narrow = r.width < kNarrow;
  float right = r.x + r.width - kPad;  // right end of the name
  if (!narrow) {
    right -= text_size(look.fonts.medium, n).x;
    draw_over(look, draw, look.fonts.medium, {right, at.y}, t.text, n);
    right -= 12.0F;
  }
  draw.AddCircleFilled({at.x + 5.0F, at.y + 8.0F}, 5.0F, entry.color);
  const float room = std::max(24.0F, right - at.x - 18.0F);
  draw_over(look, draw, look.fonts.medium, {at.x + 18.0F, at.y}, t.text,
            fitted(look.fonts.medium, entry.name, room));
  const ImU32 ink = !judged ? t.dim : entry.verdict->holds() ? t.teal : t.orange;
  const Icon icon = !judged ? Icon::kNone : entry.verdict->holds() ? Icon::kCheck : Icon::kCross;
  draw_icon(draw, icon, {at.x + 6.0F, at.y + 26.0F}, 12.0F, ink);
  std::string note = verdict_note(*entry.verdict, judged);
  if (narrow) note = entry.verdict->holds() ? n : fixed(entry.verdict->failed_at(), 2) + " s";
  draw_over(look, draw, look.fonts.small, {at.x + 18.0F, at.y + 19.0F}, ink, note);
  draw.PopClipRect();
}

void pane_borders(const Look& look, const Viewport& viewport) {
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const ImU32 line = fade(look.theme->faint, 0.5F);
  for (std::size_t i = 0; i < viewport.panes.size(); ++i) {
    const ViewRect& r = viewport.panes[i];
    draw.AddLine({r.x, r.y}, {r.x + r.width, r.y}, line);
    if (r.x > viewport.view_rect.x + 1.0F) draw.AddLine({r.x, r.y}, {r.x, r.y + r.height}, line);
  }
}

}  // namespace

std::vector<ViewRect> view_panes(const Compare& compare, const Desk& desk,
                                 const Viewport& viewport) {
  const ViewRect& v = viewport.view_rect;
  const ViewRect all{v.x, v.y + kCaptionHeight, v.width, std::max(1.0F, v.height - kCaptionHeight)};
  const bool narrow = v.width < 480.0F;  // the caption reaches the middle
  if (!desk.split || !compare.open()) return {narrow ? all : v};
  const std::size_t count = 1 + compare.runs().size();
  const auto cell = [&](std::size_t columns) {
    const std::size_t rows = count / columns;
    return ViewRect{all.x, all.y, all.width / static_cast<float>(columns),
                    all.height / static_cast<float>(rows)};
  };
  std::size_t columns = count;
  for (std::size_t c = count - 1; c > 0; --c) {
    if (count % c != 0) continue;
    if (viewport.view.camera.magnification(cell(c)) >
        viewport.view.camera.magnification(cell(columns))) {
      columns = c;
    }
  }
  std::vector<ViewRect> panes;
  for (std::size_t i = 0; i < count; ++i) {
    ViewRect r = cell(columns);
    r.x += static_cast<float>(i % columns) * r.width;
    r.y += static_cast<float>(i / columns) * r.height;
    panes.push_back(r);
  }
  return panes;
}

// The first picture fills the window, since the others are drawn over it; those at the view's edges
// continue under the panels.
Part part_of_window(const Viewport& viewport, std::size_t pane) {
  if (pane == 0) return {};
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const ViewRect& r = viewport.panes[pane];
  const ViewRect& v = viewport.view_rect;
  const bool first = r.x < v.x + 1.0F;
  const bool last = r.x + r.width > v.x + v.width - 1.0F;
  const bool lowest = r.y + r.height > v.y + v.height - 1.0F;
  const float left = first ? 0.0F : r.x / display.x;
  const float right = last ? 1.0F : (r.x + r.width) / display.x;
  const float bottom = lowest ? 1.0F : (r.y + r.height) / display.y;
  return {left, r.y / display.y, right - left, bottom - r.y / display.y};
}

void compare_legend(const Look& look, const Session& session, const Compare& compare, Desk& desk,
                    const Viewport& viewport) {
  if (!compare.open()) return;
  const std::vector<Entry> list = entries(look, session, compare, desk);
  if (viewport.panes.size() == 1) {
    legend(look, list, session.judged(), viewport);
    return;
  }
  pane_borders(look, viewport);
  for (std::size_t i = 0; i < std::min(list.size(), viewport.panes.size()); ++i) {
    pane_label(look, list[i], session.judged(), viewport.panes[i]);
  }
}

}  // namespace substep::ui
