#include <memory>
#include <string>

#include "app/cli/commands.hpp"
#include "app/cli/message.hpp"
#include "app/cli/output.hpp"
#include "app/cli/scene_source.hpp"
#include "app/cli/within.hpp"
#include "core/import/export_mjcf.hpp"
#include "core/model/text_checks.hpp"
#include "core/model/validate.hpp"

namespace substep::cli {
namespace {

constexpr int kNotAll = 1;  // exit code of --strict

struct ExportCommandOptions {
  std::string scene;
  std::string out = "-";
  bool strict = false;
};

void print_all(const char* heading, const ImportNotes& notes) {
  if (notes.empty()) return;
  say(stderr, "%s:\n", heading);
  for (const ImportNote& note : notes.notes) {
    say(stderr, "  %s\n", visible_text(to_string(note)).c_str());
  }
  if (notes.more > 0) say(stderr, "  and %zu more\n", notes.more);
}

int export_scene(const ExportCommandOptions& options) {
  const auto scene = load_scene(options.scene);
  if (scene == nullptr) return kBadInput;
  if (const auto refused = refusal_of(scene.get())) {
    complain("%s", refused->c_str());
    return kBadInput;
  }
  const ExportedModel model = export_mjcf(*scene);
  print_all("approximated", model.approximated);
  print_all("left out", model.left_out);
  if (!write_file(options.out, model.text)) return kBadInput;
  const bool is_whole = model.approximated.empty() && model.left_out.empty();
  return options.strict && !is_whole ? kNotAll : kOk;
}

}  // namespace

void add_export(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ExportCommandOptions>();
  CLI::App* command = app.add_subcommand("export", "Write a scene as a model of MuJoCo (MJCF)");
  command
      ->add_option("scene", options->scene,
                   "name or file of a scene, or file of a model, - for standard input")
      ->required()
      ->check(named());
  command->add_option("--out", options->out, "file to write; default standard output")
      ->check(named());
  command->add_flag("--strict", options->strict,
                    "exit code 1 if the model does not say all of the scene");
  command->footer(
      "Nothing is dropped in silence: what MJCF says otherwise or not at all is listed on stderr, "
      "by\n"
      "joint and body. Y is up in a scene and becomes Z. Angles and travels are 0 at the start;\n"
      "velocities of the start are those of the keyframe 'start'.\n"
      "Examples:\n"
      "  substep export whirling_chain --out whirling_chain.xml\n"
      "  substep export whirling_chain --strict | substep import -");
  command->callback([options, &exit_code] { exit_code = export_scene(*options); });
}

}  // namespace substep::cli
