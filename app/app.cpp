#include "app/app.hpp"

#include <array>
#include <utility>

#include "app/text/command.hpp"
#include "core/io/experiment.hpp"
#include "core/io/scene_writer.hpp"
#include "core/model/number_text.hpp"

namespace substep {
namespace {

constexpr const char* kOwnScenes = "own_scenes";  // what Host::remember calls them
// A run that starts anew is seen from its start on, at the zoom that was chosen.
void restart_plots(Desk& desk) {
  for (ui::PlotState& plot : desk.plots) plot.set = false;
  desk.time.from = 0.0;
  desk.time.follow = true;
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

std::shared_ptr<const Scene> App::add_own(const Scene& scene) {
  auto added = library.add(scene);
  own.add(added);
  if (host.remember) host.remember(kOwnScenes, own.text());
  return added;
}

bool App::open_result(SceneResult result, const std::string& from) {
  if (!result.scene) {
    trouble = {from + " was not loaded", std::move(result.problems)};
    return false;
  }
  trouble = {};
  run(add_own(*result.scene));
  session.play();
  return true;
}

void App::recall_scenes() {
  if (!host.recall) return;
  own = OwnScenes::read(host.recall(kOwnScenes));
  for (const auto& scene : own.scenes()) library.add(*scene);
}

void App::save_scene() {
  const Scene scene = session.as_scene();
  const std::string text = write_scene(scene);
  // What has flown too far or spins too fast is beyond what a scene may hold.
  SceneResult result = read_scene(text);
  if (!result.scene) {
    trouble = {"This state cannot be a scene file", std::move(result.problems),
               "No file was written."};
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
  if (result.experiment.load != 1.0) vary(result.experiment.load, 0);
  change(result.experiment.settings);
  reset();
  session.play();
}

void App::keep(const Recommended& recommended) {
  Scene scene = *accuracy.scene();
  scene.settings = recommended.settings;
  scene.recommended = recommended;
  const auto kept = add_own(scene);
  accuracy.is_of(kept);
  run(kept);
  session.play();
  tell("Kept as " + kept->name + ": it starts with this");
}

void App::measure_costs() {
  Experiment experiment = experiment_of(*plain_scene, session.settings(), seed);
  experiment.load = load;
  accuracy.effects.start(plain_scene, std::move(experiment));
}

const CostBreakdown* App::costs() const {
  const EffectCosts& measured = accuracy.effects;
  if (measured.experiment() == nullptr || measured.scene() != plain_scene) return nullptr;
  const Experiment& of = *measured.experiment();
  Settings now = session.settings();
  now.watch_stiffness = of.settings.watch_stiffness;
  const bool same = of.settings == now && of.load == load && of.seed == seed;
  return same ? measured.breakdown() : nullptr;
}

void App::change(const Settings& settings) {
  Settings s = settings;
  s.watch_stiffness = desk.view.tint;
  // All others act from the next sub-step on.
  if (s.probe != session.settings().probe && session.state().frame > 0) {
    tell("The probe acts at a start: reset to see what it does");
  }
  session.set_settings(s);
}

void App::tell(std::string text) { notice = {std::move(text), 5.0}; }

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
  const std::int64_t since = session.edition() != nullptr ? session.edition()->frame : 0;
  std::string command = make_command(link_scene(), session.settings(),
                                     session.state().frame - since, is_own(link_scene()));
  if (session.edition() != nullptr) return command;  // its bodies have load and seed already
  if (load != 1.0) command += " --load " + number_text(load);
  if (seed != 0) command += " --seed " + std::to_string(seed);
  return command;
}

}  // namespace substep
