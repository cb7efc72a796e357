#pragma once
// Runs the command line as a separate program.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace substep {

namespace fs = std::filesystem;

/// The output of a program and its exit code.
struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

inline std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A folder for the running test.
inline fs::path folder() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  fs::path path = fs::path(testing::TempDir()) / "substep_cli" / test->name();
  fs::create_directories(path);
  return path;
}

/// Runs `substep ARGUMENTS`, through a shell.
inline Outcome substep(const std::string& arguments, const std::string& before = "") {
  const fs::path out = folder() / "out";
  const fs::path err = folder() / "err";
  const std::string command = before + " \"" SUBSTEP_PROGRAM "\" " + arguments + " >\"" +
                              out.string() + "\" 2>\"" + err.string() + "\"";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out), text_of(err)};
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace substep
