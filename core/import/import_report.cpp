#include "core/import/import_report.hpp"

#include <utility>

namespace substep {

void ImportNotes::add(std::string place, std::string text) {
  const auto same = index_.find(text);
  if (same != index_.end()) {
    ++notes[same->second].count;
  } else if (notes.size() < kMost) {
    index_.emplace(text, notes.size());
    notes.push_back({std::move(place), std::move(text), 1});
  } else {
    ++more;
  }
}

std::string to_string(const ImportNote& note) {
  std::string text = note.place.empty() ? note.text : note.place + ": " + note.text;
  if (note.count > 1) text += " (and " + std::to_string(note.count - 1) + " more)";
  return text;
}

}  // namespace substep
