// The right panel: what happens, and why.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "app/format.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr float kTimeLabels = 18.0F;  // below the last plot
constexpr float kHeading = 24.0F;     // a section's heading with the gap below it

// A coloured dot with its name and value, right-aligned at `right`. @return where it starts
float legend(const Look& look, float right, float y, ImU32 color, const std::string& text) {
  const ImVec2 size = text_size(look.fonts.small, text.c_str());
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float x = right - size.x;
  draw_text(draw, look.fonts.small, {x, y}, look.theme->text, text.c_str());
  draw.AddCircleFilled({x - 8.0F, y + 0.5F * size.y}, 3.5F, color);
  return x - 24.0F;
}

void substeps_plot(App& app, float height) {
  const Look& look = app.look;
  const Theme& t = *look.theme;
  const History& h = app.session.history();
  const Settings& s = app.session.settings();
  const double n = shown_value(h[Channel::kSubsteps], h, app.desk.time);
  section(look, "Sub-steps per frame", std::isfinite(n) ? ("N = " + fixed(n, 0)).c_str() : "",
          t.blue);
  tooltip(look, "Sub-steps per frame",
          "Blue: the N taken in each frame (Eq. 11). Dashed: the least N that is stable, h √r / 2, "
          "which is N at alpha = 1. Below that line the scene gains energy.");

  PlotSpec spec;
  spec.id = "substeps";
  spec.from_zero = true;
  spec.counts = true;
  spec.least_span = 4.0;
  const auto limit = h[Channel::kLimit];
  const bool has_limit = std::any_of(limit.begin(), limit.end(), [](float v) { return v > 0.0F; });
  if (has_limit && s.mode != Mode::kDamping) {
    spec.series.push_back({limit, t.amber, false, false, true, 1.0F});
  }
  spec.series.push_back({h[Channel::kSubsteps], t.blue, true, true, false, 1.5F});
  // A cap is worth a line once N comes near it.
  const int cap = s.mode == Mode::kAdaptive ? s.n_max : s.mode == Mode::kCapped ? s.n_cap : 0;
  const auto taken = h[Channel::kSubsteps];
  const std::size_t recent = taken.size() - std::min<std::size_t>(taken.size(), 600);
  const float most =
      taken.empty()
          ? 0.0F
          : *std::max_element(taken.begin() + static_cast<std::ptrdiff_t>(recent), taken.end());
  if (cap > 0 && most >= 0.7F * static_cast<float>(cap)) {
    spec.levels.push_back({static_cast<double>(cap), "cap " + std::to_string(cap), t.orange});
  }
  plot(look, spec, h, {ImGui::GetContentRegionAvail().x, height}, app.desk.time,
       app.desk.substeps_range);
}

void energy_plot(App& app, float height, bool last) {
  const Look& look = app.look;
  const Theme& t = *look.theme;
  const History& h = app.session.history();
  const auto kinetic = h[Channel::kKinetic];
  const auto change = h[Channel::kEnergyChange];
  double scale = 0.0;
  for (const float v : kinetic) scale = std::max(scale, static_cast<double>(v));
  const auto& exchanged = app.session.scene().criteria.energy_scale;
  const Unit unit = unit_for(std::max(scale, 1e-3));

  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float right = origin.x + ImGui::GetContentRegionAvail().x;
  section(look, (std::string("Energy, ") + unit.prefix + "J").c_str());
  tooltip(look, "Energy",
          "Kinetic energy, and how much the total has changed since the start: none, ideally. "
          "The percentage is of the energy that the motion exchanges.");
  const double now = shown_value(change, h, app.desk.time);
  const double whole = exchanged.value_or(scale);
  std::string total = "total";
  if (std::isfinite(now) && whole > 0.0) {
    total += " " + (std::abs(now) > 99.0 * whole
                        ? short_number(now / unit.factor) + " " + unit.prefix + "J"
                        : percent(now / whole));
  }
  const float x = legend(look, right, origin.y, t.orange, total);
  legend(look, x, origin.y, t.teal, "kinetic");

  PlotSpec spec;
  spec.id = "energy";
  spec.time_labels = last;
  spec.from_zero = true;
  spec.factor = unit.factor;
  spec.least_span = unit.factor;
  spec.series.push_back({kinetic, t.teal, false, true, false, 1.5F});
  spec.series.push_back({change, t.orange, false, false, false, 1.5F});
  plot(look, spec, h, {ImGui::GetContentRegionAvail().x, height + (last ? kTimeLabels : 0.0F)},
       app.desk.time, app.desk.energy_range);
}

void error_plot(App& app, float height) {
  const Look& look = app.look;
  const Theme& t = *look.theme;
  const History& h = app.session.history();
  const Effects& effects = app.session.scene().effects;
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  float right = origin.x + ImGui::GetContentRegionAvail().x;
  section(look, "Error, m");
  tooltip(look, "Constraint error",
          "Joints: the sum over all joints of the 1-norm of phi. Overlap: the deepest contact. "
          "On a logarithmic scale.");
  PlotSpec spec;
  spec.id = "error";
  spec.logarithmic = true;
  spec.time_labels = true;
  const auto add = [&](Channel channel, const char* name, ImU32 color) {
    const double value = shown_value(h[channel], h, app.desk.time);
    right = legend(look, right, origin.y, color,
                   std::string(name) + (std::isfinite(value) ? " " + coarse_number(value) : ""));
    spec.series.push_back({h[channel], color, false, false, false, 1.5F});
  };
  if (effects.contact) add(Channel::kPenetration, "overlap", t.amber);
  if (effects.joints) add(Channel::kJointError, "joints", t.purple);
  plot(look, spec, h, {ImGui::GetContentRegionAvail().x, height + kTimeLabels}, app.desk.time,
       app.desk.error_range);
}

std::string degree_of_freedom(const Scene& scene, const StiffnessLeader& leader) {
  static constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
  const auto axis = static_cast<std::size_t>(leader.dof % 3);
  const Body& body = scene.bodies[static_cast<std::size_t>(leader.body)];
  return body.name + (leader.dof < 3 ? ", along " : ", rotation about ") + kAxes[axis];
}

// One column per body in the order of the scene, as high as its k/M is of the largest.
void body_columns(App& app, float height) {
  const Look& look = app.look;
  const Scene& scene = app.session.scene();
  const std::vector<double> shares = stiffness_shares(scene, app.session.state());
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
  const int leader = app.session.report().leader.body;
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
  const std::string text = "k/M is " + fixed(100.0 * shares[moving[i]], 1) + " % of the largest.";
  tooltip(look, body.name.c_str(), text.c_str());
}

struct Stage {
  const char* name;
  double seconds;
  ImU32 color;
};

std::vector<Stage> stages(const App& app) {
  const Theme& t = *app.look.theme;
  const StageTimes& times = app.session.times();
  const Effects& effects = app.session.scene().effects;
  std::vector<Stage> list{{"solve", times.solve, t.blue}};
  if (effects.joints) list.push_back({"joints", times.joints, t.teal});
  if (effects.contact) list.push_back({"contact", times.contact, t.amber});
  if (effects.friction) list.push_back({"friction", times.friction, t.orange});
  list.push_back({"stiffness", times.stiffness, t.purple});
  double known = 0.0;
  for (const Stage& stage : list) known += stage.seconds;
  list.push_back({"rest", std::max(0.0, times.total - known), t.grey});
  return list;
}

}  // namespace

float why_height() { return kHeading + 24.0F + 20.0F + 48.0F; }

float timing_height(const App& app) {
  const std::size_t rows = (stages(app).size() + 1) / 2;
  return kHeading + 20.0F + 20.0F * static_cast<float>(rows);
}

void plots(App& app, float height) {
  // All of one height, the last with the labels of the time axis below it. A scene with nothing to
  // violate has no plot of errors.
  const Effects& effects = app.session.scene().effects;
  const bool errors = effects.joints || effects.contact;
  const float count = errors ? 3.0F : 2.0F;
  const float gap = app.look.m.section;
  const float rest = height - count * kHeading - (count - 1.0F) * gap - kTimeLabels;
  const float unit = std::floor(std::max(rest / count, 56.0F));
  substeps_plot(app, unit);
  space(gap);
  energy_plot(app, unit, !errors);
  if (!errors) return;
  space(gap);
  error_plot(app, unit);
}

void why(App& app) {
  const Look& look = app.look;
  const Theme& t = *look.theme;
  const FrameReport& report = app.session.report();
  const StiffnessLeader& leader = report.leader;
  const bool capped = report.capped;
  const std::string note = capped ? "wanted " + std::to_string(report.n_wanted) + ", capped"
                           : std::isfinite(report.dt_stable)
                               ? "dt max " + duration(report.dt_stable)
                               : "";
  section(look, "Why this N", note.c_str(), capped ? t.orange : t.text);
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  std::string first = "nothing stiff yet";
  std::string second = "K is zero or not evaluated in this mode.";
  if (leader.body >= 0) {
    first = degree_of_freedom(app.session.scene(), leader);
    const bool turns = leader.dof >= 3;
    second = "k " + short_number(leader.k) + (turns ? " N m/rad" : " N/m") + "  ·  M " +
             short_number(leader.mass) + (turns ? " kg m²" : " kg");
  }
  draw_text(draw, look.fonts.medium, origin, t.text,
            fitted(look.fonts.medium, first, width).c_str());
  draw_text(draw, look.fonts.small, {origin.x, origin.y + 20.0F}, t.dim,
            fitted(look.fonts.small, second, width).c_str());
  ImGui::Dummy({width, 36.0F});
  tooltip(look, "Why this N",
          "The degree of freedom with the largest k/M sets r (Eq. 9), with it the longest stable "
          "step dt max = 2 √(α/r) (Eq. 10), and with it N (Eq. 11).");
  body_columns(app, 48.0F);
}

void timing(App& app) {
  const Look& look = app.look;
  const Theme& t = *look.theme;
  const std::vector<Stage> list = stages(app);
  const double total = app.session.times().total;
  section(look, "Time per frame", total > 0.0 ? duration(total).c_str() : "");
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(origin, {origin.x + width, origin.y + 12.0F}, t.well, 3.0F);
  float x = origin.x;
  for (const Stage& stage : list) {
    if (!(total > 0.0)) break;
    const float w = static_cast<float>(stage.seconds / total) * width;
    if (w >= 1.0F) {
      draw.AddRectFilled({x, origin.y}, {x + w - 1.0F, origin.y + 12.0F}, stage.color, 2.0F);
    }
    x += w;
  }
  // Two to a row: name at the left, time at the right of its half.
  const float half = 0.5F * (width + 24.0F);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const float left = origin.x + half * static_cast<float>(i % 2);
    const std::size_t row = i / 2;
    const float y = origin.y + 20.0F + 20.0F * static_cast<float>(row);
    draw.AddRectFilled({left, y + 4.0F}, {left + 8.0F, y + 12.0F}, list[i].color, 2.0F);
    draw_text(draw, look.fonts.small, {left + 12.0F, y}, t.dim, list[i].name);
    if (total > 0.0) {
      const std::string value = duration(list[i].seconds);
      const float w = text_size(look.fonts.small, value.c_str()).x;
      draw_text(draw, look.fonts.small, {left + half - 24.0F - w, y}, t.text, value.c_str());
    }
  }
  ImGui::Dummy({width, timing_height(app) - kHeading});
  tooltip(
      look, "Time per frame",
      "Wall time of the simulation by stage, smoothed over half a second. A stage that the scene "
      "does not call for does not exist.");
}

}  // namespace substep::ui
