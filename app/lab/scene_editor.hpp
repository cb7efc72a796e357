#pragma once

#include <memory>
#include <string>

#include "app/lab/scene_text.hpp"
#include "core/model/scene.hpp"

namespace substep {

struct Lab;

/// The scene of a run as text to edit, without its drawing. The text follows the run's scene, and a
/// valid text becomes the run's scene, among the user's own.
class SceneEditor {
 public:
  /// A valid text runs after this time without edits [s].
  static constexpr double kPause = 0.3;

  bool open = false;         // else the text does not follow
  bool while_typing = true;  // whether a valid text runs without being asked to
  std::string refused;       // why the last edit was refused, or ""
  std::string too_long;      // why the run's scene has no text here, or ""

  /// Call once per frame. @param dt wall time since the last call [s]
  void follow(Lab& lab, double dt);
  /// @return false if the text is too long
  bool edit(std::string text);
  /// @return the change of the text, or null
  const TextChange* undo();
  const TextChange* redo();
  /// Gives the text the line breaks of scene files. @return false if it is not JSON
  bool format();
  /// An edit by a program: shows the run's text if it does not yet, replaces it, checks it at once,
  /// and runs it if it is valid.
  void replace(Lab& lab, std::string text);
  /// The scene to change by hand: that of the run and its text. Null if there is no text, or if it
  /// has problems or another scene than the run.
  std::shared_ptr<const Scene> by_hand(const Lab& lab);
  /// A change of its text by hand: runs it if it is valid. @return else its problems, and nothing
  /// changes
  Problems change(Lab& lab, std::string text);
  /// Undoes the last change, or redoes one, and runs the text at once if it is valid.
  void step_back(Lab& lab);
  void step_forward(Lab& lab);
  /// Runs the text from its start, if it is valid and differs from what runs. Settings of the
  /// method that differ from the scene's, load, seed and comparison are kept.
  void apply(Lab& lab);
  /// Shows the scene of the run, unless the text has changes that do not run.
  void show_run_if_unchanged(const Lab& lab);
  /// Shows the scene of the run; undo() returns to the text.
  void show_run(const Lab& lab);
  /// Keeps the text although the run has another scene now.
  void keep_text(const Lab& lab);
  /// Saves the text as a file, also with problems.
  void save(Lab& lab) const;

  [[nodiscard]] const SceneText& text() const { return text_; }
  /// Counts replacements of the text that are not edits of the field that shows it.
  [[nodiscard]] int version() const { return version_; }
  /// Whether the text has changes that do not run, and the run has another scene than the one that
  /// they began with.
  [[nodiscard]] bool conflict() const { return conflict_; }
  /// Whether apply() would run the text.
  [[nodiscard]] bool can_apply() const {
    return text_.scene() != nullptr && text_.changed() && !conflict_;
  }
  /// Whether follow() has something to do soon.
  [[nodiscard]] bool waiting() const {
    return open && (!text_.checked() || (while_typing && can_apply()) || unstored_);
  }

 private:
  [[nodiscard]] static std::shared_ptr<const Scene> scene_of(const Lab& lab);
  [[nodiscard]] std::string free_name(const Lab& lab, const std::string& wanted) const;
  void show(const std::shared_ptr<const Scene>& scene);
  void run_now(Lab& lab);

  SceneText text_;
  std::shared_ptr<const Scene> base_;  // the run's scene that the text began with or became
  std::string made_;                   // name of the own scene that this text became, or ""
  int version_ = 0;
  bool conflict_ = false;
  bool unstored_ = false;  // the own scenes changed since they were stored
};

}  // namespace substep
