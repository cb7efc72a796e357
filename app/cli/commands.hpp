#pragma once
// The subcommands of the command line, one file each.

#include <CLI/CLI.hpp>
#include <string>

namespace substep::cli {

// Exit codes.
inline constexpr int kOk = 0;
inline constexpr int kUnexpectedVerdict = 1;
inline constexpr int kBadInput = 2;
inline constexpr int kNotFinite = 3;
inline constexpr int kInternalError = 4;  // out of memory, or an internal error
// The shells' code for Ctrl-C; main() returns that of the signal, and says so: cancelled_code().
inline constexpr int kCancelled = 130;

// Each adds its subcommand and writes its exit code.
void add_run(CLI::App& app, int& exit_code);
void add_sweep(CLI::App& app, int& exit_code);
void add_cost(CLI::App& app, int& exit_code);
void add_recommend(CLI::App& app, int& exit_code);
void add_doctor(CLI::App& app, int& exit_code);
void add_reproduce(CLI::App& app, int& exit_code);
void add_merge(CLI::App& app, int& exit_code);
void add_check(CLI::App& app, int& exit_code);
void add_exam(CLI::App& app, int& exit_code);
void add_hash(CLI::App& app, int& exit_code);
void add_scenes(CLI::App& app, int& exit_code);
void add_generate(CLI::App& app, int& exit_code);
void add_import(CLI::App& app, int& exit_code);
void add_export(CLI::App& app, int& exit_code);
void add_map(CLI::App& app, int& exit_code);

/// Runs experiments, one JSON object per line, and prints one result per line as each completes.
/// @param path file, or "-" for standard input
/// @param scene name or file of the scene used by the experiments; "": shipped scenes
/// @return exit code; an invalid line is reported on stderr and the others still run
int run_experiments(const std::string& path, const std::string& scene);

/// Runs the hard set with every setting that could be recommended and prints the verdicts and costs
/// as Markdown. @param jobs parallel runs; 0: one per processor
/// @return false if cancelled; nothing is printed in that case
bool print_hard_table(int jobs);

}  // namespace substep::cli
