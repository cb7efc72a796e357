#include "app/lab/scene_editor.hpp"

#include <algorithm>
#include <utility>

#include "app/lab/lab.hpp"
#include "app/text/format.hpp"
#include "core/io/scene_writer.hpp"
#include "core/model/scene_limits.hpp"

namespace substep {
namespace {

std::string kilobytes(std::size_t bytes) {
  return grouped(static_cast<double>((bytes + 999) / 1000)) + " kB";
}

bool same_view(const Camera& a, const Camera& b) {
  return a.eye == b.eye && a.target == b.target && a.width == b.width;
}

}  // namespace

// With the user's changes, as links and saved files have it.
std::shared_ptr<const Scene> SceneEditor::scene_of(const Lab& lab) {
  return lab.session.edition() != nullptr ? lab.session.edition()->start : lab.plain_scene;
}

void SceneEditor::follow(Lab& lab, double dt) {
  if (unstored_ && (!open || text_.idle() > 1.0)) {
    lab.store_own();
    unstored_ = false;
  }
  if (!open) return;
  show_run_if_unchanged(lab);
  text_.advance(dt, kSlice);
  if (while_typing && can_apply() && text_.idle() >= kPause) apply(lab);
}

// Without what was found for the scene as it was: an edit makes it another one.
void SceneEditor::show(const std::shared_ptr<const Scene>& scene) {
  base_ = scene;
  made_.clear();
  conflict_ = false;
  refused.clear();
  too_long.clear();
  ++version_;
  Scene shown = *scene;
  shown.recommended.reset();
  shown.verdicts.clear();
  // Writing a scene of ten thousand bodies takes as long as a frame.
  constexpr std::size_t kShortest = 70;  // text of a body or a joint [bytes]
  std::string text;
  if (kShortest * (shown.bodies.size() + shown.joints.size()) <= SceneText::kMost) {
    text = write_scene(shown);
  }
  if (text.empty() || text.size() > SceneText::kMost) {
    too_long = "This scene has " + grouped(static_cast<double>(shown.bodies.size())) +
               " bodies. A text of more than " + kilobytes(SceneText::kMost) +
               " is not edited here: save the scene and use a text editor.";
    text.clear();
  }
  text_.show(std::move(text), scene);
}

bool SceneEditor::edit(std::string text) {
  const std::size_t size = text.size();
  refused.clear();
  if (text_.edit(std::move(text))) return true;
  refused = "A text may have at most " + kilobytes(SceneText::kMost) + ", not " + kilobytes(size);
  ++version_;
  return false;
}

void SceneEditor::replace(Lab& lab, std::string text) {
  const bool was_open = std::exchange(open, true);
  follow(lab, 0.0);
  keep_text(lab);  // it stands for this scene, not for an earlier one
  if (edit(std::move(text))) {
    ++version_;
    run_now(lab);
  }
  open = was_open;
}

void SceneEditor::run_now(Lab& lab) {
  while (!text_.checked()) text_.advance(SceneText::kPause, kSlice);
  apply(lab);
}

std::shared_ptr<const Scene> SceneEditor::by_hand(const Lab& lab) {
  show_run_if_unchanged(lab);
  const bool sound = too_long.empty() && !conflict_ && text_.checked() && text_.problems().empty();
  return sound ? text_.scene() : nullptr;
}

Problems SceneEditor::change(Lab& lab, std::string text) {
  if (text == text_.text()) return {};
  Problems problems = read_scene(text).problems;
  if (!problems.empty()) return problems;
  text_.end_step();
  replace(lab, std::move(text));
  text_.end_step();
  if (!refused.empty()) return {{"", refused}};
  return {};
}

void SceneEditor::step_back(Lab& lab) {
  if (undo() != nullptr) run_now(lab);
}

void SceneEditor::step_forward(Lab& lab) {
  if (redo() != nullptr) run_now(lab);
}

const TextChange* SceneEditor::undo() {
  const TextChange* change = text_.undo();
  if (change != nullptr) ++version_;
  return change;
}

const TextChange* SceneEditor::redo() {
  const TextChange* change = text_.redo();
  if (change != nullptr) ++version_;
  return change;
}

bool SceneEditor::format() {
  auto text = text_.formatted();
  if (!text) return false;
  edit(*std::move(text));
  ++version_;
  return true;
}

void SceneEditor::show_run_if_unchanged(const Lab& lab) {
  const auto now = scene_of(lab);
  const bool same = now == base_;
  conflict_ = !same && base_ != nullptr && text_.changed();
  if (!same && !conflict_) show(now);
}

void SceneEditor::show_run(const Lab& lab) { show(scene_of(lab)); }

void SceneEditor::keep_text(const Lab& lab) {
  base_ = scene_of(lab);
  made_.clear();
  conflict_ = false;
}

// While a name is typed it may be that of another scene for a moment, which must not be replaced.
std::string SceneEditor::free_name(const Lab& lab, const std::string& wanted) const {
  const auto taken = [&](const std::string& name) {
    const auto known = lab.library.find(name);
    return known != nullptr && (!is_own(*known) || (known != base_ && name != made_));
  };
  const auto with_end = [&](const std::string& end) {
    return wanted.substr(0, kMaxNameSize - end.size()) + end;
  };
  if (!taken(wanted)) return wanted;
  std::string name = with_end("_own");
  for (int i = 2; taken(name); ++i) name = with_end("_own_" + std::to_string(i));
  return name;
}

void SceneEditor::apply(Lab& lab) {
  if (!can_apply()) return;
  Scene scene = *text_.scene();
  scene.name = free_name(lab, scene.name);
  RunStart before = lab.run_start();
  // Those in the text count where the text changed them.
  const Settings settings =
      with_overrides(lab.session.settings(), differences(scene.settings, base_->settings));
  const bool varied = lab.session.edition() == nullptr;  // else they are already in its bodies
  const double load = varied ? lab.load : 1.0;
  const int seed = varied ? lab.seed : 0;
  std::vector<Overrides> beside = lab.compare.overrides();

  if (!made_.empty() && made_ != scene.name) lab.remove_own(std::exchange(made_, ""));
  if (lab.library.find(scene.name) == nullptr) made_ = scene.name;
  const auto own = lab.library.add(scene);
  lab.own.add(own);
  unstored_ = true;

  lab.run(own);
  if (load != 1.0 || seed != 0) lab.vary(load, seed);
  lab.change(settings);
  lab.pause_at = before.pause_at;
  if (!beside.empty()) lab.compare.start(lab.session, std::move(beside));
  lab.keeps_view = same_view(scene.camera, base_->camera);
  const bool plays = lab.session.playing();
  lab.session.pause();
  lab.opened = OpenedRun{lab.run_count, plays, std::move(before)};
  lab.start_opened();
  base_ = own;
  text_.mark_loaded();
}

void SceneEditor::save(Lab& lab) const {
  if (!lab.host.save_file) return;
  const Scene& scene = text_.scene() != nullptr ? *text_.scene() : *base_;
  lab.host.save_file(scene.name + ".json", text_.text());
}

}  // namespace substep
