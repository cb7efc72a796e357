#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>

#include "app/cli/bounded_text.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/message.hpp"
#include "app/cli/output.hpp"
#include "app/cli/scene_source.hpp"
#include "app/cli/within.hpp"
#include "core/import/import_model.hpp"
#include "core/io/json_text.hpp"
#include "core/io/scene_writer.hpp"

namespace substep::cli {
namespace {

struct ImportCommandOptions {
  std::string model;
  std::string out;
  bool report = false;
  ImportOptions how;
};

void print_notes(std::FILE* words, const char* heading, const ImportNotes& notes) {
  if (notes.empty()) return;
  say(words, "%s:\n", heading);
  for (const ImportNote& note : notes.notes) {
    say(words, "  %s\n", visible_text(to_string(note)).c_str());
  }
  if (notes.more > 0) say(words, "  and %zu more\n", notes.more);
}

void print_report(std::FILE* words, const ImportReport& report, const std::string& name) {
  say(words, "%s\n", visible_text(name).c_str());
  for (const std::string& line : report.came_in) say(words, "  %s\n", visible_text(line).c_str());
  if (!report.starts.empty()) {
    say(words, "  starts in the pose of the model; --key starts in: %s\n",
        visible_text(report.starts).c_str());
  }
  print_notes(words, "approximated", report.approximated);
  print_notes(words, "left out", report.left_out);
}

int import(const ImportCommandOptions& options) {
  const bool is_input = options.model == "-";
  const std::filesystem::path path = options.model;
  const std::string name = is_input ? "standard input" : path.filename().string();
  std::ifstream file;
  if (!is_input) file.open(path, std::ios::binary);
  std::string text;
  if ((!is_input && !file) ||
      read_bounded(is_input ? std::cin : file, kMaxTextSize, text) == Reading::kFailed) {
    complain("%s: %s", name.c_str(), std::strerror(errno));
    return kBadInput;
  }
  if (!is_input) protect_input(options.model);
  const ModelFiles files = is_input ? ModelFiles() : model_files(path);
  const ImportResult result = import_model(text, name, files, options.how);
  for (const ImportNote& note : result.report.errors.notes) {
    complain("%s", to_string(note).c_str());
  }
  // If the scene goes to standard output, words go to stderr.
  const bool writes = !options.report || !options.out.empty();
  const std::string out = options.out.empty() ? "-" : options.out;
  if (result.scene != nullptr || options.report) {
    print_report(writes && is_standard_output(out) ? stderr : stdout, result.report, name);
  }
  if (result.scene == nullptr) return kBadInput;
  if (writes && !write_file(out, write_scene(*result.scene))) return kBadInput;
  return kOk;
}

}  // namespace

void add_import(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ImportCommandOptions>();
  CLI::App* command =
      app.add_subcommand("import", "Make a scene of a model in MJCF, URDF or the JSON of SLRBS");
  command->add_option("model", options->model, "file of the model, - for standard input")
      ->required()
      ->check(named());
  command->add_option("--out", options->out, "scene file to write; default standard output")
      ->check(named());
  command->add_flag(
      "--report", options->report,
      "print what came in, what was approximated and what was left out; write a scene "
      "only to --out");
  command->add_option("--key", options->how.key, "MJCF: start in this keyframe, by name or number")
      ->check(named());
  command->add_flag("--collide", options->how.collide,
                    "let spheres, boxes and planes collide, except those of one robot");
  command->add_flag("--free-root", options->how.free_root,
                    "URDF: do not fix the root link to the world");
  command->footer(
      "Nothing is dropped in silence: the report lists each part with its line. Without --collide\n"
      "nothing collides. Z is up in MJCF and URDF and becomes Y. Exit code 2 if the model cannot "
      "be\n"
      "read.\n"
      "Examples:\n"
      "  substep import my_robot.xml --report\n"
      "  substep import my_robot.xml --key home --out my_robot.json\n"
      "  substep import my_robot.urdf | substep run -");
  command->callback([options, &exit_code] { exit_code = import(*options); });
}

}  // namespace substep::cli
