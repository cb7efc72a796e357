// "Why this N?": the body and degree of freedom that set it, by the paper's law.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/lab/criterion.hpp"
#include "app/lab/stiffness.hpp"
#include "app/text/caption.hpp"
#include "app/text/format.hpp"
#include "app/ui/handles.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/timing.hpp"
#include "app/ui/widgets.hpp"
#include "core/model/methods.hpp"
#include "core/stepping/substep_clock.hpp"

namespace substep::ui {
namespace {

constexpr float kColumns = 32.0F;  // height of the columns of all bodies
constexpr std::size_t kMostBars = 12;

const std::string& name_of_body(const Scene& scene, const StiffnessLeader& who) {
  return scene.bodies[static_cast<std::size_t>(who.body)].name;
}

std::string stiffness_and_mass(const StiffnessLeader& who) {
  const bool turns = who.dof >= 3;
  return "k " + short_number(who.k) + (turns ? " N m/rad" : " N/m") + "  ·  M " +
         short_number(who.mass) + (turns ? " kg m²" : " kg");
}

Criterion criterion_of(const Session& session) {
  return substep::criterion_of(session.scene(), session.settings(), session.state(),
                               session.report());
}

// N by Eqs. 10 and 11.
int substeps_for(const Session& session, double r) {
  return wanted_substeps(session.scene().frame, stable_step(session.settings().alpha, r));
}

std::string cap_note(const FrameReport& report) {
  return grouped(report.n_wanted) + " required, " + grouped(report.n_substeps) + " used";
}

// Δt max; in a mode that does not use it, the N that it would mean beside the one taken.
std::string limit_note(const Session& session, const Criterion& criterion) {
  const double alpha = session.settings().alpha;
  if (!(criterion.r() > 0.0)) return "";
  const std::string at_alpha = " at α " + plain_number(alpha);
  if (entry_of(session.settings().mode).takes == nullptr) {
    return "Δt max " + duration(stable_step(alpha, criterion.r())) + at_alpha;
  }
  return "N = " + grouped(substeps_for(session, criterion.r())) + at_alpha + ", " +
         grouped(session.report().n_substeps) + " used";
}

// One column per body in scene order, with height proportional to k/M.
void body_columns(const Look& look, const Session& session, float height) {
  const Scene& scene = session.scene();
  const std::vector<double> shares = stiffness_shares(scene, session.state());
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::InvisibleButton("bodies", {width, height});
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(origin, {origin.x + width, origin.y + height}, look.theme->well, 4.0F);
  std::vector<std::size_t> moving;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (!scene.bodies[i].is_static) moving.push_back(i);
  }
  if (moving.empty()) return;
  const int leader = criterion_of(session).body();
  const float inner = width - 8.0F;
  const float pitch = inner / static_cast<float>(moving.size());
  const float gap = pitch >= 4.0F ? std::min(2.0F, 0.25F * pitch) : 0.0F;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const double share = shares[moving[i]];
    const double tall = std::max(share, 0.03);
    const float x = origin.x + 4.0F + pitch * static_cast<float>(i);
    const float top = origin.y + height - 4.0F - static_cast<float>(tall) * (height - 8.0F);
    const bool leads = static_cast<int>(moving[i]) == leader;
    draw.AddRectFilled({x, top}, {x + std::min(pitch - gap, 28.0F), origin.y + height - 4.0F},
                       leads ? look.theme->orange : look.theme->blue, 1.0F);
  }
  if (!hovered) return;
  const float at = (ImGui::GetIO().MousePos.x - origin.x - 4.0F) / pitch;
  const auto i =
      static_cast<std::size_t>(std::clamp(at, 0.0F, static_cast<float>(moving.size() - 1)));
  const Body& body = scene.bodies[moving[i]];
  const std::string text = "k/M is " + fixed(100.0 * shares[moving[i]], 1) +
                           " % of the largest. "
                           "One column for each body, in the order of the scene.";
  tooltip(look, body.name, text);
}

// A line of the law: text, its values below, the equation on the right.
void law_line(const Look& look, const std::string& law, const std::string& numbers,
              const char* equation) {
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const float end = draw_text_before(look.fonts.small, {origin.x + width, origin.y + 1.0F},
                                     look.theme->dim, equation);
  draw_text(look.fonts.regular, origin, look.theme->text,
            fitted(look.fonts.regular, law, end - origin.x - 8.0F));
  draw_text(look.fonts.small, {origin.x, origin.y + 18.0F}, look.theme->dim,
            fitted(look.fonts.small, numbers, width));
  ImGui::Dummy({width, 34.0F});
}

void law(const Look& look, const Session& session, const Criterion& criterion) {
  const double h = session.scene().frame;
  const double alpha = session.settings().alpha;
  const bool rotates = criterion.set_by == CriterionTerm::kRotation;
  const StiffnessLeader& leader = criterion.stiffness;
  const double r = criterion.r();
  const double dt = stable_step(alpha, r);
  if (rotates) {
    law_line(look, "r = rotation term = " + short_number(r) + " s⁻²",
             rotation_meaning(session.scene(), criterion), "");
  } else {
    law_line(look, "r = max k/M = " + short_number(r) + " s⁻²",
             "= " + short_number(leader.k) + " / " + short_number(leader.mass), "Eq. 9");
  }
  law_line(look, "Δt max = 2 √(α/r) = " + duration(dt),
           "= 2 √(" + plain_number(alpha) + " / " + short_number(r) + ")", "Eq. 10");
  law_line(look, "N = h/Δt max, rounded up = " + grouped(substeps_for(session, r)),
           "= " + short_number(1e3 * h) + " ms / " + duration(dt) + " = " + short_number(h / dt) +
               ", next frame",
           "Eq. 11");
}

// How the mode uses the law's N.
std::string taken_note(const Session& session) {
  const FrameReport& report = session.report();
  const Settings& s = session.settings();
  const ModeEntry& mode = entry_of(s.mode);
  if (mode.takes != nullptr) return with_values(mode.takes, s);
  if (mode.then != nullptr) {
    return report.capped ? "Capped: " + cap_note(report) + "; " + mode.then + "."
                         : "The cap of " + grouped(s.n_cap) + " was not reached.";
  }
  if (report.capped) return "Max sub-steps is " + grouped(s.n_max) + ": " + cap_note(report) + ".";
  return s.policy == Policy::kSubstep ? "Decided again after every sub-step." : "";
}

// What would set N without its current cause.
void without_leader(const Look& look, const Session& session, const Criterion& criterion,
                    const std::vector<StiffnessLeader>& list) {
  const Scene& scene = session.scene();
  const int next = list.size() < 2 ? 1 : substeps_for(session, list[1].r);
  std::string text;
  if (criterion.set_by == CriterionTerm::kRotation) {
    text = "Without the rotation term N would be " + grouped(criterion.n_stiffness) + ".";
  } else if (criterion.n_rotation > next) {
    text = "Without " + name_of_body(scene, list[0]) + " N would be " +
           grouped(criterion.n_rotation) + ", set by rotation.";
  } else if (list.size() < 2 || !(list[1].r > 0.0)) {
    text = "Without " + name_of_body(scene, list[0]) + " nothing would be stiff: N = 1.";
  } else {
    text = "Without " + name_of_body(scene, list[0]) + " N would be " + grouped(next) +
           ", set by " + name_of_body(scene, list[1]) + ".";
  }
  label(look.fonts.small, look.theme->dim, text);
}

void bar_tooltip(const Look& look, const Session& session, const StiffnessLeader& who) {
  const std::string title = name_of_body(session.scene(), who) + ", " + degree_of_freedom(who);
  const std::string text = stiffness_and_mass(who) + "\nk/M " + short_number(who.r) +
                           " s⁻²  ·  Δt max " +
                           duration(stable_step(session.settings().alpha, who.r));
  tooltip(look, title, text);
}

// Neighbours in a list whose bodies require the same N.
struct BarGroup {
  std::size_t first = 0;
  std::size_t count = 1;
  int n = 1;
};

std::vector<BarGroup> groups_of(const Session& session, const std::vector<StiffnessLeader>& list) {
  std::vector<BarGroup> groups;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const int n = substeps_for(session, list[i].r);
    if (!groups.empty() && groups.back().n == n) {
      ++groups.back().count;
    } else {
      groups.push_back({i, 1, n});
    }
  }
  return groups;
}

// "link_0", "link_0 to link_24" if they follow each other in the scene, else "12 bodies".
std::string name_of_group(const Scene& scene, const std::vector<StiffnessLeader>& list,
                          const BarGroup& group) {
  if (group.count == 1) return name_of_body(scene, list[group.first]);
  const auto begin = list.begin() + static_cast<std::ptrdiff_t>(group.first);
  const auto end = begin + static_cast<std::ptrdiff_t>(group.count);
  const auto [low, high] =
      std::minmax_element(begin, end, [](const auto& a, const auto& b) { return a.body < b.body; });
  if (high->body - low->body + 1 != static_cast<int>(group.count)) {
    return std::to_string(group.count) + " bodies";
  }
  return name_of_body(scene, *low) + " to " + name_of_body(scene, *high);
}

// One bar per body, or per group that requires the same N: the N that it alone requires.
void bars(const Look& look, const Session& session, Desk& desk, const Criterion& criterion,
          const std::vector<StiffnessLeader>& list) {
  constexpr float kRow = 20.0F;
  const Theme& t = *look.theme;
  const Scene& scene = session.scene();
  const bool sets = criterion.set_by == CriterionTerm::kStiffness;
  section(look, "N by stiffness of each body");
  tooltip(look, "N by stiffness of each body",
          "The N that each body alone would need, from the k/M of its stiffest degree of freedom. "
          "The largest is the stiffness term. Bodies that need the same N share a bar. A click "
          "selects the stiffest of them.");
  const std::vector<BarGroup> groups = groups_of(session, list);
  const float width = ImGui::GetContentRegionAvail().x;
  const float names = std::min(124.0F, 0.44F * width);
  constexpr float kNumbers = 34.0F;
  const float most = width - names - kNumbers - 12.0F;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const std::size_t shown = groups.size() <= kMostBars + 1 ? groups.size() : kMostBars;
  for (std::size_t i = 0; i < shown; ++i) {
    const StiffnessLeader& who = list[groups[i].first];
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::InvisibleButton("bar", {width, kRow})) {
      desk.selected = desk.selected == who.body ? -1 : who.body;
    }
    const bool hovered = ImGui::IsItemHovered() || desk.selected == who.body;
    draw_focus(look);
    mark(name_of_group(scene, list, groups[i]), at, {at.x + width, at.y + kRow}, "N by stiffness");
    bar_tooltip(look, session, who);
    ImGui::PopID();
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y);
    const bool leads = sets && i == 0;
    const ImU32 ink = leads || hovered ? t.text : t.dim;
    draw_text(look.fonts.small, {at.x, at.y + 3.0F}, ink,
              fitted(look.fonts.small, name_of_group(scene, list, groups[i]), names - 4.0F));
    const float x = at.x + names;
    const auto share = static_cast<float>(std::sqrt(who.r / list[0].r));  // N is proportional to √r
    draw.AddRectFilled({x, at.y + 5.0F}, {x + most, at.y + kRow - 5.0F}, t.well, 2.0F);
    draw.AddRectFilled({x, at.y + 5.0F}, {x + std::max(2.0F, share * most), at.y + kRow - 5.0F},
                       leads ? t.orange : t.blue, 2.0F);
    draw_text_before(look.fonts.small, {at.x + width, at.y + 3.0F}, ink, grouped(groups[i].n));
  }
  space(8.0F);
  if (shown < groups.size()) {
    const BarGroup& next = groups[shown];
    const std::string others =
        "and " + std::to_string(list.size() - next.first) + " others, N up to " + grouped(next.n);
    label(look.fonts.small, t.dim, others);
  }
}

// A term, its meaning below, its N on the right; the term that sets N in orange.
void term(const Look& look, const std::string& what, const std::string& meaning, int n, bool sets) {
  constexpr float kText = 14.0F;  // right of the mark
  const Theme& t = *look.theme;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float end = draw_text_before(look.fonts.medium, {at.x + width, at.y - 1.0F},
                                     sets ? t.orange : t.dim, grouped(n));
  draw.AddRectFilled({at.x, at.y + 4.0F}, {at.x + 8.0F, at.y + 12.0F}, sets ? t.orange : t.faint,
                     2.0F);
  draw_text(look.fonts.small_medium, {at.x + kText, at.y}, sets ? t.text : t.dim,
            fitted(look.fonts.small_medium, what, end - at.x - kText - 8.0F));
  draw_text(look.fonts.small, {at.x + kText, at.y + 18.0F}, t.dim,
            fitted(look.fonts.small, meaning, width - kText));
  ImGui::Dummy({width, 36.0F});
}

// The two terms of the criterion, each with the N that it requires: the larger one sets N.
void criterion_terms(const Look& look, const Session& session, const Criterion& c) {
  const Scene& scene = session.scene();
  section(look, "Which term sets N", "N");
  tooltip(look, "Which term sets N",
          "Two terms limit a sub-step. Stiffness: a force that rotates with a body acts like a "
          "spring, r = max k/M (Eq. 9). Rotation: a fast body must not rotate too far in a "
          "sub-step; the paper's rule does not include this. Each gives an r and with it an N "
          "(Eqs. 10, 11). The larger N is used.");
  term(look, stiffness_text(scene, c),
       c.stiffness.body < 0 ? "No constraint force rotates with a body."
                            : "k/M " + short_number(c.stiffness.r) + " s⁻², by Eq. 9",
       c.n_stiffness, c.set_by == CriterionTerm::kStiffness);
  term(look, rotation_text(scene, c), rotation_meaning(scene, c), c.n_rotation,
       c.set_by == CriterionTerm::kRotation);
}

// Why no stiffness is known.
const char* why_nothing(const FrameReport& report) {
  if (report.frame == 0) return "It is known after the first frame.";
  if (report.stages.stiffness) return "No force in a constraint: N = 1.";
  return "Not evaluated in this mode: switch on \"why this N\" under Show.";
}

void nothing_stiff(const Look& look, const Session& session) {
  label(look.fonts.medium, look.theme->text, "No geometric stiffness yet");
  label(look.fonts.small, look.theme->dim, why_nothing(session.report()));
}

}  // namespace

float why_summary_height() { return kHeading + 36.0F + 8.0F + kColumns; }

void why_summary(const Look& look, const Session& session, Desk& desk) {
  const Theme& t = *look.theme;
  const FrameReport& report = session.report();
  const Criterion criterion = criterion_of(session);
  const std::string note = report.capped ? cap_note(report) : limit_note(session, criterion);
  section(look, "Why this N", note, report.capped ? t.orange : t.text);
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const std::string first = setter_text(session.scene(), criterion);
  std::string second = why_nothing(report);
  if (criterion.set_by == CriterionTerm::kStiffness)
    second = stiffness_and_mass(criterion.stiffness);
  if (criterion.set_by == CriterionTerm::kRotation) second = both_terms_text(criterion);
  if (ImGui::InvisibleButton("why", {width, 36.0F})) desk.tab = Tab::kWhy;
  const bool hovered = ImGui::IsItemHovered();
  draw_text(look.fonts.medium, origin, hovered ? t.accent_hover : t.text,
            fitted(look.fonts.medium, first, width));
  draw_text(look.fonts.small, {origin.x, origin.y + 20.0F}, t.dim,
            fitted(look.fonts.small, second, width));
  draw_focus(look);
  const std::string tip =
      "The largest r sets the longest stable step Δt max = 2 √(α/r) (Eq. 10), and with it N "
      "(Eq. 11). r is the largest k/M (Eq. 9), or the rotation term if a body rotates fast. "
      "Now: " +
      both_terms_text(criterion) + ". Click for details.";
  tooltip(look, "Why this N", tip);
  body_columns(look, session, kColumns);
}

void why(const Look& look, const Session& session, Desk& desk) {
  const Theme& t = *look.theme;
  const Scene& scene = session.scene();
  const std::vector<StiffnessLeader> list = stiffness_by_body(scene, session.state());
  const Criterion criterion = criterion_of(session);
  section(look, "Why this N");
  const bool stiff = !list.empty() && list[0].r > 0.0;
  if (criterion.set_by == CriterionTerm::kNone) {
    nothing_stiff(look, session);
    return;
  }
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const float right = from.x + ImGui::GetContentRegionAvail().x;
  label(look.fonts.medium, t.text, setter_text(scene, criterion));
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() - 4.0F);
  const bool rotates = criterion.set_by == CriterionTerm::kRotation;
  label(look.fonts.small, t.dim,
        rotates ? both_terms_text(criterion) : stiffness_and_mass(criterion.stiffness));
  const float middle = ImGui::GetCursorScreenPos().y;
  mark("setter", from, {right, middle}, "why");
  law(look, session, criterion);
  mark("law", {from.x, middle}, {right, ImGui::GetCursorScreenPos().y}, "why");
  const std::string note = taken_note(session);
  if (!note.empty()) {
    label(look.fonts.small, session.report().capped ? t.orange : t.dim, note);
  }
  without_leader(look, session, criterion, list);
  space(look.m.section);
  criterion_terms(look, session, criterion);
  if (!stiff) return;
  space(look.m.section);
  bars(look, session, desk, criterion, list);
}

}  // namespace substep::ui
