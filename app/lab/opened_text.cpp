#include "app/lab/opened_text.hpp"

#include <utility>

#include "core/import/import_model.hpp"

namespace substep {

OpenedText read_opened(std::string_view text, const std::string& from, const ModelFiles& files) {
  if (!is_model(text)) return {read_scene(text), ""};
  const ImportResult imported = import_model(text, from, files, {});
  OpenedText opened;
  opened.result.scene = imported.scene;
  const ImportReport& report = imported.report;
  for (const ImportNote& note : report.errors.notes) {
    opened.result.problems.push_back({note.place, note.text});
  }
  const std::size_t approximated = report.approximated.notes.size();
  const std::size_t left_out = report.left_out.notes.size();
  if (imported.scene != nullptr && approximated + left_out > 0) {
    opened.note = from + ": " + std::to_string(approximated) + " approximated, " +
                  std::to_string(left_out) + " left out: `substep import --report` lists them";
  }
  return opened;
}

OpenedText read_opened_file(const std::filesystem::path& path) {
  const auto text = read_model_file(path);
  if (!text || !is_model(*text)) return {read_scene_file(path.string()), ""};
  return read_opened(*text, path.filename().string(), files_beside(path));
}

}  // namespace substep
