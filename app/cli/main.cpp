#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "app/cli/cancel.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/message.hpp"
#include "app/cli/output.hpp"
#include "core/io/object_reader.hpp"

namespace substep::cli {
namespace {

/// Whether the first word is a command or a flag. If not, prints the commands; the library would
/// only report a missing command.
bool knows_command(const CLI::App& app, const std::string& word) {
  std::vector<std::string_view> names;
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  for (const CLI::App* command : commands) {
    if (command->get_name() == word) return true;
    names.push_back(command->get_name());
  }
  if (word.empty() || word.front() == '-') return true;
  complain("no command is called %s%s", word.c_str(), did_you_mean(word, names).c_str());
  std::string list;
  for (const std::string_view name : names) list.append(" ").append(name);
  complain("Commands:%s", list.c_str());
  complain("Run with --help for more information.");
  return false;
}

/// The library's one-line message with a pointer to the help; quoted text is escaped.
std::string failure(const CLI::App* app, const CLI::Error& error) {
  return visible_lines(CLI::FailureMessage::simple(app, error));
}

int parse_and_run(int argc, char** argv) {
  CLI::App app{"substep: stable simulation of constrained rigid bodies by adaptive sub-steps."};
  app.set_version_flag("--version", SUBSTEP_VERSION);
  app.require_subcommand(1);
  app.failure_message(failure);
  app.footer(
      "Examples:\n"
      "  substep scenes\n"
      "  substep run swinging_box\n"
      "  substep run swinging_box --mode none\n"
      "  substep run bridge --alpha 0.05 --seconds 4 --csv bridge.csv\n"
      "  substep generate rope --links 100 | substep run -\n"
      "  substep sweep swinging_box\n"
      "  substep check --all\n"
      "Exit code: 0 success, 1 a verdict is not as expected, 2 bad input, 3 non-finite state,\n"
      "4 out of memory or internal error; cancelled: 130 by Ctrl-C, 143 by SIGTERM, 129 by "
      "SIGHUP.");
  int exit_code = kOk;
  for (const auto add :
       {add_run, add_sweep, add_cost, add_recommend, add_doctor, add_merge, add_reproduce,
        add_check, add_exam, add_hash, add_scenes, add_generate, add_import, add_export, add_map}) {
    add(app, exit_code);
  }
  if (argc > 1 && !knows_command(app, argv[1])) return kBadInput;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool is_help = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    app.exit(error);
    return is_help ? kOk : kBadInput;
  }
  if (exit_code != kCancelled) return exit_code;
  say_cancelled();
  return cancelled_code();
}

/// Ends the program when memory is exhausted. An exception would not always propagate: the JSON
/// library allocates memory to free memory.
[[noreturn]] void end_without_memory() {
  std::set_new_handler(nullptr);
  end_outputs(false);
  constexpr std::string_view kText = "substep: out of memory\n";
  [[maybe_unused]] const auto n = ::write(STDERR_FILENO, kText.data(), kText.size());
  std::_Exit(kInternalError);
}

/// For exceptions that cannot be caught, such as Eigen's inside noexcept functions.
[[noreturn]] void end_terminated() {
  try {
    if (const auto error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    end_without_memory();
  } catch (...) {
    // Other exceptions are unexpected.
  }
  std::set_new_handler(nullptr);  // it would end the outputs again
  end_outputs(false);
  complain("substep: ended by an unexpected error");
  std::_Exit(kInternalError);
}

/// Every exception ends the program with a message.
int caught(int argc, char** argv) {
  std::set_new_handler(end_without_memory);
  std::set_terminate(end_terminated);
  cancel_on_signal();
  try {
    return parse_and_run(argc, argv);
  } catch (const std::exception& error) {
    complain("substep: ended by an unexpected error: %s", error.what());
  }
  return kInternalError;
}

}  // namespace
}  // namespace substep::cli

int main(int argc, char** argv) {
  using namespace substep::cli;
  prepare_streams();
  const int exit_code = caught(argc, argv);
  return flush_standard_output() ? exit_code : kBadInput;
}
