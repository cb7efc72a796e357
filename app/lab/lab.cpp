#include "app/lab/lab.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "app/text/event_text.hpp"
#include "app/text/link.hpp"
#include "core/io/experiment.hpp"
#include "core/io/scene_writer.hpp"
#include "core/lab/slice.hpp"
#include "core/lab/start_text.hpp"
#include "core/model/number_text.hpp"
#include "core/model/setting_fields.hpp"

namespace substep {
namespace {

constexpr const char* kOwnScenes = "own_scenes";  // key of Host::remember

}  // namespace

Lab::Lab(Library shipped) : library(std::move(shipped)), session(library.scenes().front()) {
  session.frame_taken = [this] {
    const bool together = compare.take_frame(session);
    if (session.just_failed() && hold_at_failure) note_failure();
    return together;
  };
  session.scene_edited = [this](const SceneEdit& edit) { compare.edit(session, edit); };
  run(library.scenes().front());
}

void Lab::run(std::shared_ptr<const Scene> scene) {
  compare.close();  // it belonged to the other scene
  ++run_count;
  keeps_view = false;
  plain_scene = scene;
  load = 1.0;
  seed = 0;
  pause_at = 0.0;
  const bool watched = session.settings().watch_stiffness;
  session.load(std::move(scene));
  watch_stiffness(watched);
  std::string note = overlap_text(session.scene(), session.settings(), session.report());
  if (!note.empty()) tell(std::move(note));
  if (restarted) restarted(true);
}

bool Lab::open(std::string_view name) {
  auto scene = library.find(name);
  if (scene) run(std::move(scene));
  return scene != nullptr || session.scene().name == name;
}

bool Lab::open_text(std::string_view text, const std::string& from) {
  return open_opened(read_opened(text, from, {}), from);
}

bool Lab::open_file(const std::filesystem::path& path) {
  return open_opened(read_opened_file(path), path.filename().string());
}

bool Lab::open_opened(OpenedText read, const std::string& from) {
  if (!open_result(std::move(read.result), from)) return false;
  if (!read.note.empty()) tell(std::move(read.note));
  return true;
}

bool Lab::open_result(SceneResult result, const std::string& from) {
  if (!open_paused(std::move(result), from)) return false;
  start_opened();
  return true;
}

bool Lab::open_paused(SceneResult result, const std::string& from) {
  if (!result.scene) {
    trouble = {from + " was not loaded", std::move(result.problems)};
    return false;
  }
  trouble = {};
  RunStart before = run_start();
  run(add_own(*result.scene));
  session.pause();
  opened = {run_count, true, std::move(before)};
  return true;
}

RunStart Lab::run_start() const {
  if (held()) return heavy.before;  // the waiting run never started
  RunStart start{plain_scene, session.settings(), load, seed, pause_at, {}, session.playing()};
  const EventLog& log = session.log();
  const auto events = log.empty() ? std::nullopt : log.events();
  if (events) {
    start.settings = log.start();
    start.events = *events;
  } else if (session.edition() != nullptr) {  // load and seed are already in its bodies
    start.scene = session.edition()->start;
    start.load = 1.0;
    start.seed = 0;
  }
  return start;
}

void Lab::run(const RunStart& start) {
  const RunStart copy = start;  // run() may replace the object that `start` refers to
  run(copy.scene);
  if (copy.load != 1.0 || copy.seed != 0) vary(copy.load, copy.seed);
  change(copy.settings);
  if (!copy.events.empty()) {
    session.follow(copy.events);
    reset();
  }
  pause_at = copy.pause_at;
  if (copy.playing) {
    session.play();
  } else {
    session.pause();
  }
}

void Lab::start_opened() {
  if (opened && opened->run == run_count) {  // no other run has begun since
    heavy = {heavy_start(session.shared_scene(), session.settings()), run_count,
             std::move(opened->before)};
    if (held()) {
      session.pause();
    } else if (opened->plays && !seeking()) {
      session.play();
    }
  }
  opened.reset();
}

std::shared_ptr<const Scene> Lab::add_own(const Scene& scene) {
  auto added = library.add(scene);
  own.add(added);
  store_own();
  return added;
}

void Lab::remove_own(const std::string& name) {
  library.remove_own(name);
  own.remove(name);
}

void Lab::store_own() {
  if (host.remember) host.remember(kOwnScenes, own.text());
}

void Lab::recall_scenes() {
  if (!host.recall) return;
  own = OwnScenes::read(host.recall(kOwnScenes));
  for (const auto& scene : own.scenes()) library.add(*scene);
}

void Lab::save_scene() {
  const Scene scene = session.as_scene();
  const std::string text = write_scene(scene);
  // Positions and speeds beyond the limits of the scene format are rejected.
  SceneResult result = read_scene(text);
  if (!result.scene) {
    trouble = {"This state cannot be saved as a scene file", std::move(result.problems),
               "No file was written."};
  } else if (host.save_file) {
    host.save_file(scene.name + ".json", text);
  }
}

void Lab::reset() {
  ++run_count;
  session.reset();
  compare.restart(session);
  if (restarted) restarted(false);
}

void Lab::vary(double new_load, int new_seed) {
  const Settings kept = session.settings();
  const auto plain = plain_scene;
  const double end = pause_at;
  std::vector<Overrides> beside = compare.overrides();
  const bool varies = new_load != 1.0 || new_seed != 0;
  run(varies ? std::make_shared<const Scene>(start_of(*plain, new_load, new_seed)) : plain);
  plain_scene = plain;
  load = new_load;
  seed = new_seed;
  pause_at = end;
  change(kept);
  if (!beside.empty()) compare.start(session, std::move(beside));
}

void Lab::run_result(const Result& result) {
  if (plain_scene != accuracy.scene()) run(accuracy.scene());
  if (load != result.experiment.load || seed != 0) vary(result.experiment.load, 0);
  change(result.experiment.settings);
  reset();
  session.play();
}

FindScene Lab::find_scene() const {
  if (const Session::Edition* edition = session.edition()) return {edition->start};
  return {plain_scene, load, seed};
}

void Lab::start_find_n() {
  accuracy.picture = AccuracyPicture::kFindN;
  if (!FindN::has(find_n.next_axis, session.scene())) find_n.next_axis = ErrorAxis::kTrajectory;
  const ErrorAxis axis = find_n.next_axis;
  find_n.start(find_scene(), axis, find_n.next_limit.at(static_cast<std::size_t>(axis)));
}

void Lab::run_found(const Result& result) {
  const FindScene of = find_n.of();
  if (of == find_scene() && session.edition() == nullptr) {
    change(result.experiment.settings);
    reset();
    session.play();
    return;
  }
  run(RunStart{of.plain, result.experiment.settings, of.load, of.seed, 0.0, {}, true});
}

void Lab::keep(const Recommended& recommended) {
  Scene scene = *accuracy.scene();
  scene.settings = recommended.settings;
  scene.recommended = recommended;
  const auto kept = add_own(scene);
  accuracy.assign_to(kept);
  run(kept);
  session.play();
  tell("Kept as " + kept->name + ": it starts with this");
}

void Lab::measure_costs() {
  Experiment experiment = experiment_of(*plain_scene, session.settings(), seed);
  experiment.load = load;
  accuracy.effects.start(plain_scene, std::move(experiment));
}

const CostBreakdown* Lab::costs() const {
  const EffectCosts& measured = accuracy.effects;
  if (measured.experiment() == nullptr || measured.scene() != plain_scene) return nullptr;
  const Experiment& of = *measured.experiment();
  Settings now = session.settings();
  now.watch_stiffness = of.settings.watch_stiffness;
  const bool same = of.settings == now && of.load == load && of.seed == seed;
  return same ? measured.breakdown() : nullptr;
}

void Lab::change(const Settings& settings) {
  Settings s = settings;
  s.watch_stiffness = session.settings().watch_stiffness;
  // The other settings take effect with the next sub-step.
  if (s.probe != session.settings().probe && session.state().frame > 0) {
    tell("The probe acts at the start: reset to see its effect");
  }
  session.set_settings(s);
}

void Lab::watch_stiffness(bool on) {
  Settings s = session.settings();
  s.watch_stiffness = on;
  session.set_settings(s);
}

void Lab::tell(std::string text) { notice = {std::move(text), 5.0}; }

// The motion after a failure is not physical. In a comparison the other runs need the clock, so
// this run continues, but its picture stays.
void Lab::note_failure() {
  if (compare.open()) {
    const State& state = session.state();
    failed_frame_ = {session.shared_scene(), {state.x, state.q}, session.report()};
  } else {
    session.hold();
  }
}

const RemedyTrials* Lab::remedy_trials() const {
  return trials_ && trials_run_ == run_count && !session.verdict().holds() ? &*trials_ : nullptr;
}

void Lab::try_remedies(double seconds) {
  if (session.verdict().holds()) return;
  if (trials_run_ != run_count || !trials_) {
    const Scene& scene = session.scene();
    const double failed_at = session.verdict().failed_at();
    const Timeline& timeline = session.timeline();
    const Moment& then = timeline[timeline.at_time(failed_at)];
    const double judged = std::max(scene.criteria.duration, failed_at);
    trials_.emplace(session.shared_scene(),
                    remedies(then.settings, session.stopped() ? session.report() : then.report,
                             session.verdict().exceeded()),
                    Trial{.frames = std::llround(judged / scene.frame), .enough = 3});
    trials_run_ = run_count;
  }
  advance_for(seconds, [&] { return trials_->advance(); });
}

bool Lab::frozen() const {
  return compare.open() && hold_at_failure && !session.verdict().holds() &&
         failed_frame_.scene != nullptr &&
         failed_frame_.report.time == session.verdict().failed_at();
}

const Scene& Lab::scene_in(std::size_t pane) const {
  if (pane > 0) return *compare.runs()[pane - 1].scene;
  return frozen() ? *failed_frame_.scene : session.scene();
}

const Poses& Lab::poses_in(std::size_t pane) const {
  if (pane > 0) return compare.runs()[pane - 1].poses;
  return frozen() ? failed_frame_.poses : session.poses();
}

std::optional<Failure> Lab::failure_in(std::size_t pane) const {
  if (pane > 0) {
    const Compare::Run& run = compare.runs()[pane - 1];
    if (compare.past_failure) return std::nullopt;
    return failure_of(*run.scene, run.poses, run.report, *run.verdict);
  }
  const Verdict& verdict = session.verdict();
  if (!hold_at_failure || verdict.holds()) return std::nullopt;
  if (frozen()) {
    return failure_of(*failed_frame_.scene, failed_frame_.poses, failed_frame_.report, verdict);
  }
  // The user may have continued the run.
  if (session.playing() || (!session.stopped() && session.report().time != verdict.failed_at())) {
    return std::nullopt;
  }
  return failure_of(session.scene(), session.poses(), session.report(), verdict);
}

const Scene& Lab::edited_scene() const {
  return session.edition() != nullptr ? *session.edition()->start : *plain_scene;
}

std::string Lab::command() const {
  const Scene& scene = edited_scene();
  const std::int64_t since = session.edition() != nullptr ? session.edition()->frame : 0;
  const std::int64_t frames = session.state().frame - since;
  std::string command = "./dev cli run " + scene.name + (is_own(scene) ? ".json" : "") +
                        setting_flags(session.settings(), scene.settings);
  if (frames > 0) command += " --frames " + std::to_string(frames);
  if (session.edition() != nullptr) return command;  // load and seed are already in its bodies
  if (load != 1.0) command += " --load " + number_text(load);
  if (seed != 0) command += " --seed " + std::to_string(seed);
  return command;
}

std::string Lab::events_in_link() const {
  if (session.log().empty()) return "";
  const auto events = session.log().events();
  if (!events || !fits_link(*events, session.loaded())) return "";
  std::string text = events_text(*events, session.log().start());
  return text.size() <= kMostEventText ? text : "";
}

const Scene& Lab::link_scene() const {
  // Without load and seed, which are separate in the link and would be applied twice.
  return events_in_link().empty() ? edited_scene() : *plain_scene;
}

double Lab::heaviest_mass() const {
  double most = 0.0;
  for (const Body& body : session.loaded().bodies) {
    if (!body.is_static) most = std::max(most, body.mass);
  }
  return most;
}

void Lab::seek(double time) {
  seek_to_ = time;
  seek_run_ = run_count;
  session.pause();
  if (time < session.state().time) session.go_to(session.timeline().at_time(time));
  seek_frame_ = kNotBegun;
}

void Lab::continue_seek(double seconds) {
  if (!seeking() || held()) return;
  const bool begun = seek_frame_ != kNotBegun;
  if (begun && (session.playing() || session.state().frame != seek_frame_)) {
    seek_to_ = 0.0;  // the user took over
    return;
  }
  session.pause();  // "Run it" of a heavy run plays
  seek_frame_ = session.state().frame;
  const auto until = end_of_slice(seconds);
  const double before = seek_to_ - 0.5 * session.scene().frame;
  while (session.state().time < before && session.verdict().holds() && !session.stopped()) {
    if (compare.behind(session)) return;
    session.step();
    seek_frame_ = session.state().frame;
    if (FrameSlices::Clock::now() >= until) return;
  }
  seek_to_ = 0.0;
  session.pause();
}

std::string Lab::link() const {
  const std::string events = events_in_link();
  const bool edited = events.empty() && session.edition() != nullptr;
  Experiment experiment;
  experiment.settings = events.empty() ? session.settings() : session.log().start();
  experiment.duration = session.scene().criteria.duration;
  if (!edited) {  // else load and seed are already in its bodies
    experiment.load = load;
    experiment.seed = seed;
  }
  std::string link = make_link(edited ? edited_scene() : *plain_scene, experiment);
  if (!events.empty()) link += "&events=" + events;
  if (compare.open()) link += "&compare=" + overrides_text(compare.overrides());
  return link;
}

}  // namespace substep
