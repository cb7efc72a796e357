#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <vector>

#include "app/cli/commands.hpp"
#include "core/io/object_reader.hpp"

namespace {

/// Whether the first word is a command or a flag. If not, it says what would be: the library would
/// only say that a command is missing.
bool knows_command(const CLI::App& app, const std::string& word) {
  std::vector<std::string_view> names;
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  for (const CLI::App* command : commands) {
    if (command->get_name() == word) return true;
    names.push_back(command->get_name());
  }
  if (word.empty() || word.front() == '-') return true;
  std::fprintf(stderr, "%s is not %s%s\nRun with --help for more information.\n", word.c_str(),
               substep::one_of(names).c_str(), substep::did_you_mean(word, names).c_str());
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace substep::cli;
  CLI::App app{"substep: stable simulation of constrained rigid bodies by adaptive sub-steps."};
  app.set_version_flag("--version", SUBSTEP_VERSION);
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);
  app.footer(
      "Examples:\n"
      "  substep scenes\n"
      "  substep run swinging_box\n"
      "  substep run swinging_box --mode none\n"
      "  substep run bridge --alpha 0.05 --seconds 4 --csv bridge.csv\n"
      "  substep generate rope --links 100 | substep run -\n"
      "  substep sweep swinging_box\n"
      "  substep check --all\n"
      "Exit code: 0 all went well, 1 a verdict is not as expected, 2 bad input, 3 the state "
      "stopped\n"
      "being finite, 130 cancelled.");
  int exit_code = kOk;
  add_run(app, exit_code);
  add_sweep(app, exit_code);
  add_cost(app, exit_code);
  add_recommend(app, exit_code);
  add_merge(app, exit_code);
  add_reproduce(app, exit_code);
  add_check(app, exit_code);
  add_exam(app, exit_code);
  add_hash(app, exit_code);
  add_scenes(app, exit_code);
  add_generate(app, exit_code);
  add_map(app, exit_code);
  if (argc > 1 && !knows_command(app, argv[1])) return kBadInput;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool is_help = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    app.exit(error);
    return is_help ? kOk : kBadInput;
  }
  return exit_code;
}
