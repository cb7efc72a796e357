#include "app/lab/compare.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace substep {
namespace {

constexpr std::int64_t kCheckpointFrames = 32;
constexpr std::size_t kMostCheckpoints = 200;

void add_frame(Cost& cost, const FrameReport& report) {
  ++cost.frames;
  cost.substeps += report.n_substeps + report.n_discarded;
  cost.seconds += report.times.total;
}

}  // namespace

bool Compare::continues(const Run& run) const {
  return run.report.status == StepStatus::kOk && (past_failure || run.verdict->holds());
}

Settings Compare::settings_of(const Overrides& overrides, const Settings& session) {
  Settings s = with_overrides(session, overrides);
  s.watch_stiffness = false;  // only the session's bodies are tinted
  return s;
}

std::vector<Overrides> Compare::overrides() const {
  std::vector<Overrides> list;
  for (const Run& run : runs_) list.push_back(run.overrides);
  return list;
}

void Compare::start(const Session& session, std::vector<Overrides> runs) {
  runs_.clear();
  for (Overrides& overrides : runs) {
    if (runs_.size() == kMostCompared) break;
    runs_.emplace_back().overrides = std::move(overrides);
  }
  restart(session);
}

void Compare::restart(const Session& session) {
  scene_ = session.shared_scene();
  start_ = session.state().time;
  frame_ = session.state().frame;
  settings_ = session.settings();
  edits_.clear();
  hands_.clear();
  for (Run& run : runs_) begin(run, session);
}

void Compare::begin(Run& run, const Session& session) {
  use_scene(run, scene_);
  run.simulator->set_settings(settings_of(run.overrides, session.settings()));
  run.simulator->set_state(session.state());
  run.report = run.simulator->observe();
  run.verdict.emplace(*scene_, session.state(), run.report);
  run.account.start(run.report);
  run.history.start(run.report, scene_->frame, scene_->criteria.energy_scale.value_or(0.0));
  run.previous = {session.state().x, session.state().q};
  run.poses = run.previous;
  run.cost = {};
  run.divergence.reset();
  run.checkpoints.assign(1, {scene_, session.state(), *run.verdict, run.cost, run.account});
}

void Compare::use_scene(Run& run, const std::shared_ptr<const Scene>& scene) const {
  if (run.scene == scene && run.simulator) return;
  run.scene = scene;
  run.simulator = std::make_unique<Simulator>(scene);
  run.simulator->set_budget(kWindowBudget);
  run.slices.forget();
  run.simulator->set_settings(settings_of(run.overrides, settings_));
}

Cost Compare::cost(const Session& session) const {
  const History& history = session.history();
  const auto substeps = history[Channel::kSubsteps];
  const auto times = history[Channel::kTime];
  Cost cost;
  // A little later than the frame before, so that it is left out.
  const double first = std::max(start_, history.start_time()) + 0.5 * history.frame();
  for (std::size_t i = 0; i < history.size(); ++i) {
    if (history.time(i) < first || history.time(i) > session.state().time + 1e-9) continue;
    ++cost.frames;
    cost.substeps += std::lround(substeps[i]);
    cost.seconds += 1e-3 * static_cast<double>(times[i]);
  }
  return cost;
}

void Compare::add(const Session& session, Overrides one) {
  std::vector<Overrides> list = overrides();
  list.push_back(std::move(one));
  start(session, std::move(list));
}

void Compare::remove(const Session& session, std::size_t index) {
  std::vector<Overrides> list = overrides();
  list.erase(list.begin() + static_cast<std::ptrdiff_t>(index));
  start(session, std::move(list));
}

void Compare::change(const Session& session, std::size_t index, const Settings& settings) {
  Run& run = runs_[index];
  run.overrides = differences(settings, session.settings());
  run.slices.drop(*run.simulator);
  run.simulator->set_settings(settings_of(run.overrides, session.settings()));
}

// @return whether the frame has ended
bool Compare::step(Run& run, FrameSlices::Clock::time_point until) {
  const State& state = run.simulator->state();
  if (!run.slices.open()) {
    run.previous = {state.x, state.q};
    run.simulator->set_grab(hand_at(state.frame));
    if (run.simulator->grab()) run.verdict->disturb(state.time);
  }
  const std::optional<FrameReport> ended = run.slices.advance(*run.simulator, until);
  if (!ended) return false;
  run.report = *ended;
  run.verdict->add(*run.scene, state, run.report);
  if (run.report.status != StepStatus::kOk) return true;
  run.account.add(run.report, run.simulator->grab().has_value());
  run.history.add(run.report, run.account.put_in());
  add_frame(run.cost, run.report);
  if (state.frame % kCheckpointFrames != 0) return true;
  if (run.checkpoints.size() >= kMostCheckpoints) {
    // Removes every second one, since a long run is sampled more coarsely. The first stays.
    std::size_t i = 0;
    std::erase_if(run.checkpoints, [&i](const auto&) { return i++ % 2 == 1; });
  }
  run.checkpoints.push_back({run.scene, state, *run.verdict, run.cost, run.account});
  return true;
}

void Compare::watch(Run& run, const Session& session) {
  if (run.divergence) return;
  const State& here = run.simulator->state();
  const State& there = session.state();
  if (here.frame != there.frame || here.x.size() != there.x.size()) return;  // the run has stopped
  Divergence most;
  for (std::size_t i = 0; i < here.x.size(); ++i) {
    const double distance = (here.x[i] - there.x[i]).norm();
    if (distance > most.distance) most = {there.time, static_cast<int>(i), distance};
  }
  if (most.distance > kThreshold) run.divergence = most;
}

// Records the hand of the session's last frame, in place of records of this and later frames, which
// the session has discarded.
void Compare::note_hand(const Session& session) {
  const std::int64_t frame = session.state().frame - 1;
  while (!hands_.empty() && hands_.back().frame >= frame) hands_.pop_back();
  const bool held = !hands_.empty() && hands_.back().grab.has_value();
  if (held || session.held()) hands_.push_back({frame, session.held()});
}

const std::optional<Grab>& Compare::hand_at(std::int64_t frame) const {
  static const std::optional<Grab> kNone;
  const auto later =
      std::upper_bound(hands_.begin(), hands_.end(), frame,
                       [](std::int64_t value, const Hold& hold) { return value < hold.frame; });
  return later == hands_.begin() ? kNone : std::prev(later)->grab;
}

bool Compare::take_frame(const Session& session) {
  if (!open()) return true;
  const auto until = end_of_slice(kSlice);
  if (session.state().frame != frame_ + 1) {  // it was rewound since the last call
    for (Run& run : runs_) seek(run, session, session.state().frame - 1, until);
  }
  frame_ = session.state().frame;
  note_hand(session);
  for (Run& run : runs_) {
    seek(run, session, frame_, until);
    watch(run, session);
  }
  return !behind(session);
}

bool Compare::behind(const Session& session) const {
  return std::any_of(runs_.begin(), runs_.end(), [&](const Run& run) {
    return continues(run) &&
           (run.slices.open() || run.simulator->state().frame < session.state().frame);
  });
}

void Compare::edit(const Session& session, const SceneEdit& edit) {
  if (!open()) return;
  edits_.push_back(edit);
  follow(session);
}

// The edits between the scene at the start of the comparison and the given one, in order.
std::vector<const SceneEdit*> Compare::edits_up_to(const Scene& scene) const {
  std::vector<const SceneEdit*> path;
  const Scene* to = &scene;
  for (std::size_t i = edits_.size(); i-- > 0;) {
    if (edits_[i].to.get() != to) continue;
    path.push_back(&edits_[i]);
    to = edits_[i].from.get();
  }
  std::reverse(path.begin(), path.end());
  return path;
}

// Goes to a frame of the session's run: forwards from the current frame if possible, else from the
// last checkpoint before it. A checkpoint later than the edit of its scene belongs to
// discarded frames.
void Compare::seek(Run& run, const Session& session, std::int64_t frame,
                   FrameSlices::Clock::time_point until) {
  const std::vector<const SceneEdit*> path = edits_up_to(session.scene());
  const auto edit_of = [&](const std::shared_ptr<const Scene>& scene) -> const SceneEdit* {
    for (const SceneEdit* edit : path) {
      if (edit->from == scene) return edit;
    }
    return nullptr;
  };
  const auto on_the_way = [&](const std::shared_ptr<const Scene>& scene, std::int64_t at) {
    const SceneEdit* edit = edit_of(scene);
    return at <= frame && (edit != nullptr ? at <= edit->frame : scene == session.shared_scene());
  };
  if (!on_the_way(run.scene, run.simulator->state().frame)) {
    auto& list = run.checkpoints;
    while (list.size() > 1 && !on_the_way(list.back().scene, list.back().state.frame)) {
      list.pop_back();
    }
    run.slices.drop(*run.simulator);
    use_scene(run, list.back().scene);
    run.simulator->set_state(list.back().state);
    run.verdict = list.back().verdict;
    run.cost = list.back().cost;
    run.account = list.back().account;
    run.report = run.simulator->observe();
    run.previous = {list.back().state.x, list.back().state.q};
    run.history.cut(list.back().state.time);
    if (run.divergence && run.divergence->time > session.state().time) run.divergence.reset();
  }
  while (continues(run)) {
    const SceneEdit* edit = edit_of(run.scene);
    const bool now = edit != nullptr && edit->frame == run.simulator->state().frame;
    if (now) {
      State carried = edit->carry(run.simulator->state());
      use_scene(run, edit->to);
      run.simulator->set_state(std::move(carried));
      run.account.edited(run.simulator->observe());
      run.verdict->disturb(run.simulator->state().time);
      run.previous = {run.simulator->state().x, run.simulator->state().q};
    } else if (run.simulator->state().frame < frame) {
      if (!step(run, until) || FrameSlices::Clock::now() >= until) return;
    } else {
      break;
    }
  }
}

void Compare::follow(const Session& session) {
  if (!open()) return;
  const std::vector<const SceneEdit*> path = edits_up_to(session.scene());
  const Scene* first = path.empty() ? &session.scene() : path.front()->from.get();
  const bool before = session.state().frame < runs_[0].checkpoints.front().state.frame;
  if (first != scene_.get() || before) restart(session);
  if (settings_ != session.settings()) {
    settings_ = session.settings();
    for (Run& run : runs_) {
      run.slices.drop(*run.simulator);
      run.simulator->set_settings(settings_of(run.overrides, settings_));
    }
  }
  frame_ = session.state().frame;
  const auto until = end_of_slice(kSlice);
  for (Run& run : runs_) {
    seek(run, session, frame_, until);
    watch(run, session);
  }
  for (Run& run : runs_) {
    const double t = continues(run) ? session.between() : 1.0;
    const State& now = run.slices.state(*run.simulator);
    run.poses = run.previous;
    for (std::size_t i = 0; i < now.x.size(); ++i) {
      run.poses.x[i] = run.previous.x[i] + t * (now.x[i] - run.previous.x[i]);
      run.poses.q[i] = run.previous.q[i].slerp(t, now.q[i]);
    }
  }
}

}  // namespace substep
