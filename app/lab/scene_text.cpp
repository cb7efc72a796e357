#include "app/lab/scene_text.hpp"

#include <algorithm>
#include <utility>

#include "core/io/json_text.hpp"
#include "core/lab/slice.hpp"

namespace substep {

void SceneText::show(std::string text, std::shared_ptr<const Scene> scene) {
  if (!text_.empty()) {
    history_.end_step();
    history_.add(difference(text_, text));
    history_.end_step();
  }
  text_ = std::move(text);
  loaded_ = text_;
  reading_.reset();
  problems_.clear();
  scene_ = std::move(scene);
  idle_ = 0.0;
  checked_ = true;
}

bool SceneText::edit(std::string text) {
  if (text == text_) return true;
  if (text.size() > kMost) return false;
  history_.add(difference(text_, text));
  text_ = std::move(text);
  text_changed();
  return true;
}

const TextChange* SceneText::undo() {
  const TextChange* change = history_.undo();
  if (change != nullptr) take(*change);
  return change;
}

const TextChange* SceneText::redo() {
  const TextChange* change = history_.redo();
  if (change != nullptr) take(*change);
  return change;
}

void SceneText::take(const TextChange& change) {
  change.apply(text_);
  text_changed();
}

void SceneText::text_changed() {
  reading_.reset();
  scene_.reset();
  checked_ = false;
  idle_ = 0.0;
}

void SceneText::advance(double dt, double seconds) {
  constexpr double kStep = 1.0;  // a pause ends a step of the history [s]
  idle_ += dt;
  if (idle_ > kStep) history_.end_step();
  if (checked_ || (text_.size() > kQuick && idle_ < kPause)) return;
  if (!reading_) reading_ = std::make_unique<SceneReading>(text_);
  if (!advance_for(seconds, [this] { return reading_->advance(); })) finish_check();
}

void SceneText::finish_check() {
  SceneResult result = std::exchange(reading_, nullptr)->result();
  const std::vector<TextPlace> places = places_of(result.problems, text_);
  problems_.clear();
  for (std::size_t i = 0; i < places.size(); ++i) {
    Problem& problem = result.problems[i];
    if (problem.pointer.empty()) take_place(problem.message);
    problems_.push_back({places[i], std::move(problem)});
  }
  const auto line = [](const PlacedProblem& problem) { return problem.place.line; };
  std::stable_sort(problems_.begin(), problems_.end(),
                   [&](const auto& a, const auto& b) { return line(a) < line(b); });
  scene_ = std::move(result.scene);
  checked_ = true;
}

std::optional<std::string> SceneText::formatted() const {
  Problems problems;
  const std::optional<Json> json = parse_json(text_, problems);
  if (!json || !problems.empty()) return std::nullopt;
  return json_file(*json);
}

}  // namespace substep
