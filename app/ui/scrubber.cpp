// The past as a track: drag along it to show any saved frame; failures are marked.

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/text/format.hpp"
#include "app/ui/handles.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr float kKnob = 7.0F;

// Times along the track; at the start of a run there is no past and the knob is on the left.
struct TimeTrack {
  float left;
  float right;
  double begin;
  double end;

  [[nodiscard]] float x(double time) const {
    if (!(end > begin)) return left;
    const double share = std::clamp((time - begin) / (end - begin), 0.0, 1.0);
    return left + static_cast<float>(share) * (right - left);
  }
  [[nodiscard]] double time(float x) const {
    const auto share = static_cast<double>(std::clamp((x - left) / (right - left), 0.0F, 1.0F));
    return begin + share * (end - begin);
  }
};

void draw_track(const Look& look, const Session& session, ImDrawList& draw, const TimeTrack& track,
                float y, bool bright) {
  const Theme& t = *look.theme;
  const Verdict& last = session.stopped() || session.timeline().at_end()
                            ? session.verdict()
                            : session.timeline().last().verdict;
  const float now = track.x(session.state().time);
  draw.AddRectFilled({track.left, y - 2.0F}, {track.right, y + 2.0F}, t.track, 2.0F);
  draw.AddRectFilled({track.left, y - 2.0F}, {now, y + 2.0F}, t.accent, 2.0F);
  if (!last.holds()) {
    const float fell = std::min(track.x(last.failed_at()), track.right - 3.0F);
    draw.AddRectFilled({fell, y - 2.0F}, {track.right, y + 2.0F}, t.orange, 2.0F);
  }
  if (bright) draw.AddCircleFilled({now, y}, kKnob + 4.0F, fade(t.accent, 0.25F));
  draw.AddCircleFilled({now, y}, kKnob, t.dark ? t.text : IM_COL32_WHITE);
  if (!t.dark) draw.AddCircle({now, y}, kKnob, t.accent, 0, 1.5F);
}

}  // namespace

void scrubber(const Look& look, Session& session, ImVec2 at, float width, float height) {
  const Timeline& past = session.timeline();
  ImGui::SetCursorScreenPos(at);
  ImGui::InvisibleButton("past", {width, height});
  mark("past", {at.x + kKnob, at.y}, {at.x + width - kKnob, at.y + height});
  const bool hovered = ImGui::IsItemHovered();
  const bool active = ImGui::IsItemActive();
  const TimeTrack track{at.x + kKnob, at.x + width - kKnob, past[0].state.time,
                        std::max(past.last().state.time, session.state().time)};
  const float pointer = ImGui::GetIO().MousePos.x;
  if (active && track.end > track.begin) {
    const std::size_t wanted = past.at_time(track.time(pointer));
    if (wanted != past.index() || session.substeps_left() > 0 || session.stopped() ||
        session.playing()) {
      session.go_to(wanted);
    }
  }
  if (ImGui::IsItemFocused() && !ImGui::GetCurrentContext()->NavDisableHighlight) {
    if (ImGui::IsKeyPressed(ImGuiKey_LeftArrow)) session.step_back();
    if (ImGui::IsKeyPressed(ImGuiKey_RightArrow) && !past.at_end()) session.go_to(past.index() + 1);
  }
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw_track(look, session, draw, track, std::round(at.y + 0.5F * height), hovered || active);
  draw_focus(look);
  if (!active && hovered) {
    const std::string when = fixed(track.time(pointer), 2) + " s";
    tooltip(look, when,
            "Drag to look back (, and . step by frames). The run continues from the selected "
            "frame, bit for bit; later frames are discarded.");
  }
}

}  // namespace substep::ui
