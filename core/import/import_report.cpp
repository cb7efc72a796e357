#include "core/import/import_report.hpp"

#include <algorithm>
#include <utility>

namespace substep {

void ImportNotes::add(std::string place, std::string text) {
  const auto same = std::find_if(notes.begin(), notes.end(),
                                 [&](const ImportNote& note) { return note.text == text; });
  if (same != notes.end()) {
    ++same->count;
  } else if (notes.size() < kMost) {
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
