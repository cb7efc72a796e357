#include "app/app.hpp"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "app/arrangement.hpp"
#include "app/command.hpp"
#include "app/format.hpp"
#include "app/link.hpp"
#include "app/png.hpp"
#include "app/tour.hpp"
#include "app/ui/panels.hpp"
#include "core/io/number_text.hpp"
#include "core/io/saved_scene.hpp"
#include "core/io/scene_limits.hpp"
#include "core/io/scene_writer.hpp"
#include "core/io/setting_fields.hpp"

namespace substep {
namespace {

constexpr const char* kOwnScenes = "own_scenes";  // what Host::remember calls them
constexpr std::array<double, 7> kSpeeds{0.0625, 0.125, 0.25, 0.5, 1.0, 2.0, 4.0};

void change_speed(Session& session, int by) {
  const auto now = std::lower_bound(kSpeeds.begin(), kSpeeds.end(), session.speed() - 1e-9);
  const auto i = std::clamp<std::ptrdiff_t>((now - kSpeeds.begin()) + by, 0,
                                            static_cast<std::ptrdiff_t>(kSpeeds.size()) - 1);
  session.set_speed(kSpeeds[static_cast<std::size_t>(i)]);
}

void change_scale(App& app, double by) {
  app.desk.scale = std::clamp(std::round(10.0 * (app.desk.scale + by)) / 10.0, 0.8, 1.5);
  app.tell("Interface at " + fixed(100.0 * app.desk.scale, 0) + " %");
}

// One of two words. @return what is wrong, or ""
std::string choose(std::string_view value, std::array<std::string_view, 2> words, bool& on) {
  if (value != words[0] && value != words[1]) {
    return "'" + std::string(value) + "' is not " + std::string(words[0]) + " or " +
           std::string(words[1]);
  }
  on = value == words[1];
  return "";
}

std::string choose_panel(std::string_view value, Tab& tab) {
  static constexpr std::array<std::string_view, 5> kNames{"controls", "plots", "why", "compare",
                                                          "accuracy"};
  const auto* const found = std::find(kNames.begin(), kNames.end(), value);
  if (found == kNames.end()) {
    return "'" + std::string(value) + "' is not controls, plots, why, compare or accuracy";
  }
  tab = static_cast<Tab>(found - kNames.begin());
  return "";
}

// "off", or the number of a step: its experiment from the start.
std::string go_on_tour(App& app, std::string_view value) {
  const auto steps = tour_steps();
  const auto step = parse_number(value);
  const auto count = static_cast<double>(steps.size());
  if (value != "off" && (!step || *step != std::round(*step) || *step < 1.0 || *step > count)) {
    return "is not off or a whole number from 1 to " + std::to_string(steps.size());
  }
  app.desk.tour_hint = false;
  if (value == "off") {
    app.desk.tour = -1;
    return "";
  }
  app.desk.tour = static_cast<int>(*step) - 1;
  app.open_link(steps[static_cast<std::size_t>(app.desk.tour)].link);
  app.reset();
  app.session.play();
  return "";
}

// Keys by the character that they type, so that they are where the keyboard's layout has them.
void handle_key(App& app, ImWchar c) {
  Settings s = app.session.settings();
  switch (c) {
    case ' ':
      // The control that the keyboard is on takes the space bar.
      if (!ImGui::GetIO().NavVisible) app.session.toggle();
      break;
    case '.':
      app.session.pause();
      app.session.step();
      break;
    case ',':
      app.session.step_back();
      break;
    case ';':
      app.session.substep();
      break;
    case 'b':
    case 'B':
      ui::throw_ball(app);
      break;
    case 'r':
    case 'R':
      app.reset();
      break;
    case 'f':
    case 'F':
      app.view.frame_all(app.session);
      break;
    case 'h':
    case 'H':
      app.desk.panels = !app.desk.panels;
      break;
    case 't':
    case 'T':
      app.desk.dark = !app.desk.dark;
      break;
    case '[':
      change_speed(app.session, -1);
      break;
    case ']':
      change_speed(app.session, 1);
      break;
    case '+':
    case '=':
      change_scale(app, 0.1);
      break;
    case '-':
      change_scale(app, -0.1);
      break;
    case 'v':
    case 'V':
      app.desk.split = !app.desk.split;
      break;
    case '?':
      app.desk.help = !app.desk.help;
      break;
    case '1':
    case '2':
    case '3':
    case '4':
    case '5':
      s.mode = static_cast<Mode>(c - '1');
      app.change(s);
      break;
    default:
      break;
  }
}

void handle_keys(App& app) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput || io.KeyCtrl || io.KeyAlt || io.KeySuper) return;
  const ImVector<ImWchar> typed = io.InputQueueCharacters;
  for (const ImWchar c : typed) handle_key(app, c);
  if (ImGui::IsKeyPressed(ImGuiKey_Home)) app.session.go_to(0);
  if (ImGui::IsKeyPressed(ImGuiKey_End)) app.session.go_to(app.session.timeline().size() - 1);
}

// Fonts and colours follow the window that the app finds itself in.
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
  if (changed || app.look.theme != &theme || app.look.m.row != row) {
    app.look.theme = &theme;
    app.look.m.row = row;
    ui::apply_style(app.look);
  }
}

// A run that starts anew is seen from its start on, at the zoom that was chosen.
void restart_plots(Desk& desk) {
  for (ui::PlotState& plot : desk.plots) plot.set = false;
  desk.time.from = 0.0;
  desk.time.follow = true;
}

// Hands the picture that was asked for to the shell.
void take_capture(App& app, int width, int height) {
  const ViewRect& a = app.capture->area;
  const float ratio = ImGui::GetIO().DisplayFramebufferScale.x;
  const auto pixel = [ratio](float v, int most) {
    return std::clamp(static_cast<int>(std::lround(v * ratio)), 0, most);
  };
  const int x = pixel(a.x, width - 1);
  const int y = pixel(a.y, height - 1);
  const int w = std::max(1, pixel(a.x + a.width, width) - x);
  const int h = std::max(1, pixel(a.y + a.height, height) - y);
  const std::string png = encode_png(w, h, app.renderer->pixels(x, y, w, h));
  if (app.host.save_file) app.host.save_file(app.capture->name, png);
  app.capture.reset();
}

}  // namespace

Desk::Desk() {
  plot(Plot::kError).logarithmic = true;
  plot(Plot::kTime).shown = false;
}

App::App(Library shipped, std::unique_ptr<Renderer> draws)
    : library(std::move(shipped)), session(library.scenes().front()), renderer(std::move(draws)) {
  session.frame_taken = [this] { compare.take_frame(session); };
  session.scene_edited = [this](const SceneEdit& edit) { compare.edit(session, edit); };
  run(library.scenes().front());
}

void App::run(std::shared_ptr<const Scene> scene) {
  compare.close();  // it was about the other scene
  ++run_count;
  plain_scene = scene;
  load = 1.0;
  seed = 0;
  pause_at = 0.0;
  session.load(std::move(scene));
  change(session.settings());
  desk.selected = -1;
  restart_plots(desk);
}

bool App::open(std::string_view name) {
  auto scene = library.find(name);
  if (scene) run(std::move(scene));
  return scene != nullptr || session.scene().name == name;
}

bool App::open_text(std::string_view json, const std::string& from) {
  return open_result(read_scene(json), from);
}

bool App::open_result(SceneResult result, const std::string& from) {
  if (!result.scene) {
    trouble = {from + " was not loaded", std::move(result.problems)};
    return false;
  }
  trouble = {};
  const auto scene = library.add(*result.scene);
  own.add(scene);
  if (host.remember) host.remember(kOwnScenes, own.text());
  run(scene);
  session.play();
  return true;
}

void App::recall_scenes() {
  if (!host.recall) return;
  own = OwnScenes::read(host.recall(kOwnScenes));
  for (const auto& scene : own.scenes()) library.add(*scene);
}

void App::save_scene() {
  const Scene scene = saved_scene(session.scene(), session.state(), session.settings());
  const std::string text = write_scene(scene);
  // What has flown too far or spins too fast is beyond what a scene may hold.
  SceneResult result = read_scene(text);
  if (!result.scene) {
    trouble = {"This state cannot be a scene file", std::move(result.problems)};
  } else if (host.save_file) {
    host.save_file(scene.name + ".json", text);
  }
}

void App::reset() {
  ++run_count;
  session.reset();
  compare.restart(session);
  restart_plots(desk);
}

void App::vary(double new_load, int new_seed) {
  const Settings kept = session.settings();
  const auto plain = plain_scene;
  const double end = pause_at;
  run(std::make_shared<const Scene>(start_of(*plain, new_load, new_seed)));
  plain_scene = plain;
  load = new_load;
  seed = new_seed;
  pause_at = end;
  change(kept);
}

void App::run_result(const Result& result) {
  if (session.loaded_scene() != accuracy.scene()) run(accuracy.scene());
  change(result.experiment.settings);
  reset();
  session.play();
}

void App::change(const Settings& settings) {
  Settings s = settings;
  s.watch_stiffness = desk.view.tint;
  session.set_settings(s);
}

std::string App::set(std::string_view key, std::string_view value) {
  if (key == "scene") {
    return open(value) ? "" : "there is no scene of the name '" + std::string(value) + "'";
  }
  // What belongs to the window: taken from links and scripts, never written into links.
  if (key == "speed") {
    const auto speed = parse_number(value);
    if (!speed || *speed < 0.01 || *speed > 16.0) return "is not a number from 0.01 to 16";
    session.set_speed(*speed);
    return "";
  }
  if (key == "theme") return choose(value, {"light", "dark"}, desk.dark);
  if (key == "panels") return choose(value, {"off", "on"}, desk.panels);
  for (const ViewSwitch& option : kViewSwitches) {
    if (key == option.key) return choose(value, {"off", "on"}, desk.view.*option.member);
  }
  if (key == "views") return choose(value, {"ghosts", "split"}, desk.split);
  if (key == "panel") return choose_panel(value, desk.tab);
  if (key == "tour") return go_on_tour(*this, value);
  if (key == "scale") {
    const auto scale = parse_number(value);
    if (!scale || *scale < 0.8 || *scale > 1.5) return "is not a number from 0.8 to 1.5";
    desk.scale = *scale;
    return "";
  }
  if (key == "load" || key == "seed" || key == "seconds") {
    const auto number = parse_number(value);
    const Range range = key == "load"   ? kLoadRange
                        : key == "seed" ? Range{0.0, static_cast<double>(kMostSeed)}
                                        : kDurationRange;
    if (!number || !range.contains(*number)) return "is not " + range.text();
    if (key == "load") vary(*number, seed);
    if (key == "seed") vary(load, static_cast<int>(*number));
    if (key == "seconds") pause_at = *number;
    return "";
  }
  if (key == "accuracy") {
    bool on = accuracy.running();
    const std::string problem = choose(value, {"cancel", "run"}, on);
    if (!problem.empty()) return problem;
    on ? accuracy.start(session.loaded_scene()) : accuracy.cancel();
    return "";
  }
  if (key == "compare") {
    std::string problem;
    const std::vector<Overrides> runs =
        value == "off" ? std::vector<Overrides>{} : parse_overrides(value, problem);
    reset();
    compare.start(session, runs);
    return problem;
  }
  const SettingField* field = find_setting(key);
  if (field == nullptr) return "is not a setting";
  Settings s = session.settings();
  if (const auto problem = set_setting(*field, value, s)) return *problem;
  change(s);
  return "";
}

void App::open_link(std::string_view fragment) {
  std::vector<Problem> problems;
  // The scene first: it brings settings of its own, which the others then change.
  auto parts = parse_link(fragment);
  std::stable_partition(parts.begin(), parts.end(), [](const auto& p) { return p.key == "scene"; });
  if (std::none_of(parts.begin(), parts.end(), [](const auto& p) { return p.key == "compare"; })) {
    compare.close();
  }
  for (const LinkPart& part : parts) {
    const std::string problem = set(part.key, part.value);
    if (!problem.empty()) problems.push_back({part.key, problem});
  }
  if (!problems.empty()) trouble = {"The link could not be followed in full", std::move(problems)};
}

void App::tell(std::string text) { notice = {std::move(text), 5.0}; }

std::string App::link() const {
  Experiment experiment;
  experiment.settings = session.settings();
  experiment.duration = session.scene().criteria.duration;
  experiment.load = load;
  experiment.seed = seed;
  std::string link = make_link(session.scene(), experiment);
  if (compare.open()) {
    std::vector<Overrides> runs;
    for (const Compare::Run& run : compare.runs()) runs.push_back(run.overrides);
    link += "&compare=" + overrides_text(runs);
  }
  return link;
}

ImU32 App::compare_color(std::size_t run) const {
  const ui::Theme& t = *look.theme;
  return std::array<ImU32, Compare::kMost>{t.orange, t.teal, t.purple}.at(run);
}

const Scene& App::scene_in(std::size_t pane) const {
  return pane == 0 ? session.scene() : *compare.runs()[pane - 1].scene;
}

const Poses& App::poses_in(std::size_t pane) const {
  return pane == 0 ? session.poses() : compare.runs()[pane - 1].poses;
}

std::string App::command() const {
  return make_command(session.scene(), session.settings(), session.state().frame,
                      is_own(session.scene()));
}

namespace {

// The shell speaks in its own logical pixels, of which the interface's are `scale` times as large.
class Scaled {
 public:
  explicit Scaled(App& app) : size_(ImGui::GetIO().DisplaySize), ratio_(buffer_scale()) {
    const auto scale = static_cast<float>(app.desk.scale);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {size_.x / scale, size_.y / scale};
    io.DisplayFramebufferScale = {ratio_.x * scale, ratio_.y * scale};
    for (ImGuiInputEvent& event : ImGui::GetCurrentContext()->InputEventsQueue) {
      if (event.EventId <= app.last_event) continue;  // it waited since an earlier frame
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

// This run, and what it is compared with: each in a pane of its own, or over it as ghosts.
void draw_pictures(App& app, const ViewOptions& options, ImVec2 display) {
  app.panes = ui::view_panes(app);
  app.pictures.resize(app.panes.size());
  for (std::size_t i = 0; i < app.panes.size(); ++i) {
    Seen seen{&app.scene_in(i), &app.poses_in(i), nullptr, nullptr};
    if (i == 0) seen = {seen.scene, seen.poses, &app.session.state(), &app.session.trail()};
    app.view.build(seen, options, app.look.theme->view, app.panes[i],
                   static_cast<double>(display.x), static_cast<double>(display.y), app.pictures[i]);
    app.pictures[i].part = ui::part_of_window(app, i);
  }
  if (app.panes.size() > 1) return;
  for (std::size_t i = 0; i < app.compare.runs().size(); ++i) {
    const Compare::Run& run = app.compare.runs()[i];
    const ImVec4 c = ui::to_vec4(app.compare_color(i));
    SceneView::add_ghost(*run.scene, run.poses, {c.x, c.y, c.z, 0.5F}, app.pictures.front());
  }
}

}  // namespace

void frame(App& app, double wall_dt) {
  if (app.pixel_ratio == 0.0F) recall_arrangement(app);  // the shell is there now
  const Scaled scaled(app);
  app.frame_time += 0.05 * (std::clamp(wall_dt, 1e-4, 1.0) - app.frame_time);
  app.session.advance(wall_dt);
  if (app.pause_at > 0.0 && app.session.state().time > app.pause_at - 1e-9) {
    app.session.pause();
    app.pause_at = 0.0;  // whoever plays on wants to see more
  }
  // Beside a run that plays the sweep takes what a frame can spare.
  app.accuracy.advance(app.session.playing() ? 0.003 : 0.008);
  app.notice.left -= wall_dt;

  update_look(app);
  app.renderer->begin_frame();
  ImGui::NewFrame();
  handle_keys(app);
  app.desk.time.hover = app.desk.time.hover_next;
  app.desk.time.hover_next.reset();
  if (app.session.settings().watch_stiffness != app.desk.view.tint) {
    app.change(app.session.settings());
  }
  app.compare.follow(app.session);
  app.view.follow(app.session);
  app.view.camera.update(wall_dt, app.desk.reduced_motion);
  ui::draw_window(app);

  const ImGuiIO& io = ImGui::GetIO();
  ViewOptions shown = app.desk.view;
  if (app.compare.open()) shown.tint = false;  // colours say who is who then
  draw_pictures(app, shown, io.DisplaySize);
  ui::draw_over_picture(app);
  ImGui::Render();
  const int width = static_cast<int>(std::lround(io.DisplaySize.x * io.DisplayFramebufferScale.x));
  const int height = static_cast<int>(std::lround(io.DisplaySize.y * io.DisplayFramebufferScale.y));
  app.renderer->draw(app.pictures, *ImGui::GetDrawData(), width, height);
  if (app.capture) take_capture(app, width, height);

  remember_arrangement(app);
  if (app.host.link_changed) {
    std::string link = app.link();
    if (link != app.last_link) {
      app.last_link = std::move(link);
      app.host.link_changed(app.last_link);
    }
  }
}

}  // namespace substep
