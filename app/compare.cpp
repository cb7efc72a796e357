#include "app/compare.hpp"

#include <algorithm>
#include <utility>

#include "core/io/setting_fields.hpp"

namespace substep {
namespace {

constexpr std::int64_t kCheckpointFrames = 32;
constexpr std::size_t kMostCheckpoints = 200;

// Parts of a text between separators; none of an empty text.
std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    const std::string_view part = text.substr(0, text.find(separator));
    text.remove_prefix(std::min(part.size() + 1, text.size()));
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

Overrides differences(const Settings& of, const Settings& from) {
  Overrides list;
  for (const SettingField& field : setting_fields()) {
    if (field.name == "watch_stiffness") continue;  // what is looked at, not what is done
    std::string value = setting_text(field, of);
    if (value != setting_text(field, from)) list.push_back({std::string(field.name), value});
  }
  return list;
}

std::vector<Overrides> all_overrides(const std::vector<Compare::Run>& runs) {
  std::vector<Overrides> list;
  for (const Compare::Run& run : runs) list.push_back(run.overrides);
  return list;
}

void add_frame(Cost& cost, const FrameReport& report) {
  ++cost.frames;
  cost.substeps += report.n_substeps;
  cost.seconds += report.times.total;
}

}  // namespace

Settings Compare::settings_of(const Overrides& overrides, const Settings& session) {
  Settings s = session;
  s.watch_stiffness = false;  // only the session's bodies are tinted
  for (const Override& o : overrides) {
    if (const SettingField* field = find_setting(o.key)) set_setting(*field, o.value, s);
  }
  return s;
}

void Compare::start(const Session& session, std::vector<Overrides> runs) {
  runs_.clear();
  for (Overrides& overrides : runs) {
    if (runs_.size() == kMost) break;
    runs_.emplace_back().overrides = std::move(overrides);
  }
  restart(session);
}

void Compare::restart(const Session& session) {
  scene_ = &session.scene();
  frame_ = session.state().frame;
  settings_ = session.settings();
  cost_ = {};
  for (Run& run : runs_) begin(run, session);
}

void Compare::begin(Run& run, const Session& session) {
  run.simulator = std::make_unique<Simulator>(session.shared_scene());
  run.simulator->set_settings(settings_of(run.overrides, session.settings()));
  run.simulator->set_state(session.state());
  run.report = run.simulator->observe();
  run.verdict.emplace(session.scene(), session.state(), run.report);
  run.history.start(run.report, session.scene().frame);
  run.previous = {session.state().x, session.state().q};
  run.poses = run.previous;
  run.cost = {};
  run.divergence.reset();
  run.checkpoints.assign(1, {session.state(), *run.verdict, run.cost});
}

void Compare::add(const Session& session, Overrides overrides) {
  std::vector<Overrides> list = all_overrides(runs_);
  list.push_back(std::move(overrides));
  start(session, std::move(list));
}

void Compare::remove(const Session& session, std::size_t index) {
  std::vector<Overrides> list = all_overrides(runs_);
  list.erase(list.begin() + static_cast<std::ptrdiff_t>(index));
  start(session, std::move(list));
}

void Compare::change(const Session& session, std::size_t index, const Settings& settings) {
  Run& run = runs_[index];
  run.overrides = differences(settings, session.settings());
  run.simulator->set_settings(settings_of(run.overrides, session.settings()));
}

void Compare::step(Run& run) {
  const State& state = run.simulator->state();
  if (run.report.status != StepStatus::kOk) return;
  run.previous = {state.x, state.q};
  run.report = run.simulator->step();
  run.verdict->add(*scene_, state, run.report);
  if (run.report.status != StepStatus::kOk) return;
  run.history.add(run.report);
  add_frame(run.cost, run.report);
  if (state.frame % kCheckpointFrames != 0) return;
  if (run.checkpoints.size() >= kMostCheckpoints) {
    // Every second one goes: a long run is seen from farther apart. The first stays.
    std::vector<Run::Checkpoint> kept;
    for (std::size_t i = 0; i < run.checkpoints.size(); i += 2) {
      kept.push_back(std::move(run.checkpoints[i]));
    }
    run.checkpoints = std::move(kept);
  }
  run.checkpoints.push_back({state, *run.verdict, run.cost});
}

void Compare::watch(Run& run, const Session& session) {
  if (run.divergence) return;
  const State& here = run.simulator->state();
  const State& there = session.state();
  if (here.frame != there.frame) return;  // it stopped
  Divergence most;
  for (std::size_t i = 0; i < here.x.size(); ++i) {
    const double distance = (here.x[i] - there.x[i]).norm();
    if (distance > most.distance) most = {there.time, static_cast<int>(i), distance};
  }
  if (most.distance > kThreshold) run.divergence = most;
}

void Compare::take_frame(const Session& session) {
  if (!open() || scene_ != &session.scene() || session.state().frame != frame_ + 1) return;
  frame_ = session.state().frame;
  add_frame(cost_, session.report());
  for (Run& run : runs_) {
    step(run);
    watch(run, session);
  }
}

// Back to the last checkpoint before, and on from there.
void Compare::seek(Run& run, const Session& session) {
  const std::int64_t frame = session.state().frame;
  if (run.simulator->state().frame > frame) {
    auto& list = run.checkpoints;
    while (list.size() > 1 && list.back().state.frame > frame) list.pop_back();
    run.simulator->set_state(list.back().state);
    run.verdict = list.back().verdict;
    run.cost = list.back().cost;
    run.report = run.simulator->observe();
    run.history.cut(list.back().state.time);
    if (run.divergence && run.divergence->time > session.state().time) run.divergence.reset();
  }
  while (run.simulator->state().frame < frame && run.report.status == StepStatus::kOk) step(run);
}

void Compare::follow(const Session& session) {
  if (!open()) return;
  const bool before = session.state().frame < runs_[0].checkpoints.front().state.frame;
  if (scene_ != &session.scene() || before) {
    restart(session);
  }
  if (settings_ != session.settings()) {
    settings_ = session.settings();
    for (Run& run : runs_) run.simulator->set_settings(settings_of(run.overrides, settings_));
  }
  if (session.state().frame != frame_) {
    frame_ = session.state().frame;
    for (Run& run : runs_) {
      seek(run, session);
      watch(run, session);
    }
  }
  const double t = session.between();
  for (Run& run : runs_) {
    const State& now = run.simulator->state();
    for (std::size_t i = 0; i < now.x.size(); ++i) {
      run.poses.x[i] = run.previous.x[i] + t * (now.x[i] - run.previous.x[i]);
      run.poses.q[i] = run.previous.q[i].slerp(t, now.q[i]);
    }
  }
}

std::string overrides_text(const std::vector<Overrides>& runs) {
  std::string text;
  for (const Overrides& overrides : runs) {
    if (&overrides != &runs.front()) text += ';';
    for (const Override& o : overrides) {
      if (&o != &overrides.front()) text += ',';
      text.append(o.key).append(":").append(o.value);
    }
  }
  return text;
}

std::vector<Overrides> parse_overrides(std::string_view text, std::string& problem) {
  std::vector<Overrides> runs;
  for (const std::string_view part : split(text, ';')) {
    Overrides overrides;
    for (const std::string_view pair : split(part, ',')) {
      const std::size_t colon = std::min(pair.find(':'), pair.size());
      const std::string key(pair.substr(0, colon));
      const std::string value(pair.substr(std::min(colon + 1, pair.size())));
      const SettingField* field = find_setting(key);
      Settings scratch;
      if (field == nullptr) {
        problem = "'" + key + "' is not a setting";
      } else if (const auto wrong = set_setting(*field, value, scratch)) {
        problem = key + " " + *wrong;
      } else {
        overrides.push_back({key, value});
      }
    }
    runs.push_back(std::move(overrides));
  }
  if (runs.size() > Compare::kMost) {
    problem = "more than " + std::to_string(Compare::kMost) + " methods beside the run";
    runs.resize(Compare::kMost);
  }
  return runs;
}

std::string overrides_title(const Overrides& overrides) {
  if (overrides.empty()) return "the same";
  std::string title;
  for (const Override& o : overrides) {
    if (!title.empty()) title += ", ";
    if (o.key == "solver") {
      title += o.value == "pgs" ? "PGS" : "BPP";
    } else if (o.key == "n") {
      title += "constant " + o.value;
    } else {
      title += o.key == "mode" || o.key == "integrator" ? o.value : o.key + " " + o.value;
    }
  }
  return title;
}

}  // namespace substep
