#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace substep {

/// A remark about a place of a model.
struct ImportNote {
  std::string place;      // "cassie.xml:34", or "/joints/1" in JSON
  std::string text;       // the part, and what stands for it if anything does
  std::size_t count = 1;  // places with the same text; `place` is the first
};

/// A list of remarks; the same text again counts up. Bounded, so that hostile input cannot exhaust
/// memory: `more` counts what was not kept.
struct ImportNotes {
  static constexpr std::size_t kMost = 1000;
  std::vector<ImportNote> notes;
  std::size_t more = 0;

  void add(std::string place, std::string text);
  [[nodiscard]] bool empty() const { return notes.empty(); }

 private:
  std::map<std::string, std::size_t> index_;  // of notes, by their text
};

/// What an importer did with a model. Nothing is dropped in silence.
struct ImportReport {
  std::vector<std::string> came_in;  // "9 moving bodies, 20.3 kg"
  std::string starts;                // other starts that the model has: "home, squat"; or ""
  double timestep = 0.0;             // of the engine that the model is for; 0: it says none [s]
  std::string integrator;            // of that engine, or ""
  ImportNotes approximated;          // read, but not as the model has it
  ImportNotes left_out;              // not read
  ImportNotes errors;                // why there is no scene
};

/// "cassie.xml:34: text (and 3 more)"
std::string to_string(const ImportNote& note);

}  // namespace substep
