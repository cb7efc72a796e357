#include <CLI/CLI.hpp>

#include "app/cli/commands.hpp"

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
      "  substep check --all\n"
      "Exit code: 0 all went well, 1 a verdict is not as expected, 2 bad input, 3 the state "
      "stopped\n"
      "being finite.");
  int exit_code = kOk;
  add_run(app, exit_code);
  add_check(app, exit_code);
  add_hash(app, exit_code);
  add_scenes(app, exit_code);
  add_generate(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool is_help = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    app.exit(error);
    return is_help ? kOk : kBadInput;
  }
  return exit_code;
}
