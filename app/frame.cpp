// One frame on the screen.

#include <imgui_internal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "app/app.hpp"
#include "app/render/png.hpp"
#include "app/shell/arrangement.hpp"
#include "app/text/citation.hpp"
#include "app/ui/handles.hpp"
#include "app/ui/interface_scale.hpp"
#include "app/ui/keys.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/vector_figure.hpp"
#include "core/io/experiment.hpp"

namespace substep {
namespace {

// Fonts and colours follow the window's pixel ratio and theme.
void update_look(App& app) {
  const ImGuiIO& io = ImGui::GetIO();
  const float ratio = std::clamp(io.DisplayFramebufferScale.x, 0.5F, 4.0F);
  bool changed = false;
  if (std::abs(ratio - app.pixel_ratio) > 1e-3F) {
    app.look.fonts = ui::build_fonts(ratio);
    if (app.pixel_ratio != 0.0F) app.renderer->fonts_changed();
    app.pixel_ratio = ratio;
    changed = true;
  }
  const ui::Theme& theme = app.desk.dark ? ui::dark_theme() : ui::light_theme();
  const bool touch = io.DisplaySize.x < 900.0F;
  const float row = touch ? 32.0F : 26.0F;
  // The panels of a window of 720 need no scrolling.
  const float section = io.DisplaySize.y < 800.0F ? 9.0F : 13.0F;
  if (changed || app.look.theme != &theme || app.look.m.row != row ||
      app.look.m.section != section) {
    app.look.theme = &theme;
    app.look.m.row = row;
    app.look.m.section = section;
    ui::apply_style(app.look);
    // A finger's target of 44 pixels, around a control of 32.
    if (touch) ImGui::GetStyle().TouchExtraPadding = {6.0F, 6.0F};
  }
}

// Saves the requested picture through the host.
void take_capture(App& app, int width, int height) {
  const ViewRect& a = app.desk.capture->area;
  const float ratio = ImGui::GetIO().DisplayFramebufferScale.x;
  const auto pixel = [ratio](float v, int most) {
    return std::clamp(static_cast<int>(std::lround(v * ratio)), 0, most);
  };
  const int x = pixel(a.x, width - 1);
  const int y = pixel(a.y, height - 1);
  const int w = std::max(1, pixel(a.x + a.width, width) - x);
  const int h = std::max(1, pixel(a.y + a.height, height) - y);
  app.renderer->present(true);
  const std::string png = encode_png(w, h, app.renderer->pixels(x, y, w, h));
  if (app.host.save_file) app.host.save_file(app.desk.capture->name, png);
  app.desk.capture.reset();
}

// Draws a figure beside the window's panels, without presenting them, and saves it as SVG.
void take_figure(App& app) {
  const Figure figure = *std::exchange(app.desk.figure, std::nullopt);
  if (!app.host.save_file) return;
  app.renderer->present(true);  // its panels are drawn once more
  ui::Look paper = app.look;
  paper.theme = &ui::light_theme();
  const ui::FigureFrame drawing;
  ImGui::NewFrame();
  const WindowPart part = ui::figure_window(paper, figure);
  ui::forget_handles();
  ui::draw_window(app);
  ui::draw_over_picture(app);
  ImGui::Render();
  Experiment experiment = experiment_of(app.session.scene(), app.session.settings(), app.seed);
  experiment.load = app.load;
  Json about = experiment_json(experiment);
  about["link"] = app.link();
  about["citation"] = std::string(kPaperAuthors) + ", " + kPaperTitle + ", doi:" + kPaperDoi;
  app.host.save_file(figure.name,
                     ui::svg_figure(paper, *ImGui::GetDrawData(), part, figure.millimetres,
                                    {app.session.scene().title, app.command(), about.dump()}));
}

// Converts from the shell's logical pixels to interface pixels, which are `scale` times as large.
class Scaled {
 public:
  explicit Scaled(App& app) : size_(ImGui::GetIO().DisplaySize), ratio_(buffer_scale()) {
    const float scale = ui::interface_scale(app.desk, size_);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {size_.x / scale, size_.y / scale};
    io.DisplayFramebufferScale = {ratio_.x * scale, ratio_.y * scale};
    for (ImGuiInputEvent& event : ImGui::GetCurrentContext()->InputEventsQueue) {
      if (event.EventId <= app.last_event) continue;  // delayed from an earlier frame
      app.last_event = event.EventId;
      if (event.Type != ImGuiInputEventType_MousePos) continue;
      event.MousePos.PosX /= scale;
      event.MousePos.PosY /= scale;
    }
  }
  ~Scaled() {
    ImGui::GetIO().DisplaySize = size_;
    ImGui::GetIO().DisplayFramebufferScale = ratio_;
  }
  Scaled(const Scaled&) = delete;
  Scaled& operator=(const Scaled&) = delete;

 private:
  static ImVec2 buffer_scale() { return ImGui::GetIO().DisplayFramebufferScale; }
  ImVec2 size_;
  ImVec2 ratio_;
};

// This run and those compared with it: in separate panes, or overlaid as ghosts.
void draw_pictures(App& app, const ViewOptions& options, ImVec2 display) {
  app.panes = app.introduction.open() ? ui::introduction_panes(app.look, app)
                                      : ui::view_panes(app.compare, app.desk, app);
  app.pictures.resize(app.panes.size());
  for (std::size_t i = 0; i < app.panes.size(); ++i) {
    Seen seen{&app.scene_in(i), &app.poses_in(i), nullptr, nullptr};
    if (i == 0 && !app.frozen()) {
      seen = {seen.scene, seen.poses, &app.session.state(), &app.session.trail()};
    }
    app.view.build(seen, options, app.look.theme->view, app.panes[i],
                   static_cast<double>(display.x), static_cast<double>(display.y), app.pictures[i]);
    app.pictures[i].part =
        app.introduction.open() ? ui::introduction_part(app, i) : ui::part_of_window(app, i);
  }
  if (app.panes.size() > 1) return;
  if (const Poses* exact = app.exam.at(app.session); exact && !app.compare.open()) {
    const ImVec4 c = ui::to_vec4(ui::compare_color(app.look, 0));
    SceneView::add_ghost(app.session.scene(), *exact, {c.x, c.y, c.z, 0.5F}, app.pictures.front());
  }
  for (std::size_t i = 0; i < app.compare.runs().size(); ++i) {
    const Compare::Run& run = app.compare.runs()[i];
    const ImVec4 c = ui::to_vec4(ui::compare_color(app.look, i));
    SceneView::add_ghost(*run.scene, run.poses, {c.x, c.y, c.z, 0.5F}, app.pictures.front());
  }
}

// In a comparison all runs share one view, which stays.
void follow_failure(App& app) {
  std::optional<Bounds> around;
  if (const auto failure = app.failure_in(0); failure && !app.compare.open()) {
    const double gap = (failure->to - failure->from).norm();
    around = app.view.bounds_around(failure->centre(), std::max(gap, failure->radius));
  }
  app.failure_camera.follow(app.view.camera, around, !app.desk.reduced_motion);
}

}  // namespace

void frame(App& app, double wall_dt, bool whole) {
  const Scaled scaled(app);
  app.desk.whole = whole;
  app.frame_time += 0.05 * (std::clamp(wall_dt, 1e-4, 1.0) - app.frame_time);
  app.quality.observe(wall_dt, app.own_time);
  app.introduction.follow(app, !app.desk.reduced_motion);
  app.tour.follow(app);
  const auto begun = std::chrono::steady_clock::now();
  if (app.seeking()) {
    app.continue_seek(kSlice);
  } else if (!app.compare.behind(app.session)) {
    app.session.advance(wall_dt);
  }
  if (app.pause_at > 0.0 && app.session.state().time > app.pause_at - 1e-9) {
    app.session.pause();
    app.pause_at = 0.0;  // playing again continues past the end
  }
  const double slice = Accuracy::slice(app.session.playing(), wall_dt - app.own_time);
  if (app.find_n.busy()) {  // a sweep in progress waits
    app.find_n.advance(FindN::slice(wall_dt - app.own_time));
  } else {
    app.accuracy.advance(slice);
  }
  if (!app.session.playing()) app.try_remedies(slice);
  app.own_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  app.notice.left -= wall_dt;
  app.editor.open = app.desk.tab >= Tab::kText;
  app.editor.follow(app, wall_dt);

  update_look(app);
  app.renderer->begin_frame();
  ImGui::NewFrame();
  ui::forget_handles();
  ui::handle_keys(app);
  app.desk.time.hover = app.desk.time.hover_next;
  app.desk.time.hover_next.reset();
  if (app.session.settings().watch_stiffness != app.desk.view.tint) {
    app.watch_stiffness(app.desk.view.tint);
  }
  app.compare.follow(app.session);
  app.view.follow(app.session, std::exchange(app.keeps_view, false));
  follow_failure(app);
  app.view.camera.update(wall_dt, app.desk.reduced_motion);
  ui::draw_window(app);

  const ImGuiIO& io = ImGui::GetIO();
  ViewOptions shown = app.desk.view;
  if (app.compare.open()) shown.tint = false;  // colours identify the runs instead
  draw_pictures(app, shown, io.DisplaySize);
  ui::draw_over_picture(app);
  ImGui::Render();
  const int width = static_cast<int>(std::lround(io.DisplaySize.x * io.DisplayFramebufferScale.x));
  const int height = static_cast<int>(std::lround(io.DisplaySize.y * io.DisplayFramebufferScale.y));
  app.renderer->draw(app.pictures, *ImGui::GetDrawData(),
                     {width, height, app.quality.quality(), app.desk.whole});
  if (app.desk.capture) take_capture(app, width, height);
  if (app.desk.figure) take_figure(app);

  if (!app.desk.follow.empty()) app.open_link(std::exchange(app.desk.follow, ""));
  remember_arrangement(app);
  // The address is unchanged until the laboratory is shown, so that reloading shows the same.
  if (app.host.link_changed && !app.introduction.open()) {
    std::string link = app.link();
    if (link != app.last_link || app.plain_scene != app.last_linked) {
      app.last_link = std::move(link);
      app.last_linked = app.plain_scene;
      app.host.link_changed(app.last_link);
    }
  }
}

}  // namespace substep
