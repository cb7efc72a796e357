// Two thousand hostile inputs, some of them each day: invalid scene files, contradictory flags,
// endless lists, full disks, and Ctrl-C. For every input the program ends by itself, within its
// time and memory; it reports the error without control characters; and if it reports success, no
// output is lost.
//
// SUBSTEP_HOSTILE_INPUTS sets the number of inputs, SUBSTEP_HOSTILE_SEED the first seed. A failure
// prints its seed, which reproduces it with one input.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "core/io/json.hpp"
#include "tests/app/child.hpp"
#include "tests/app/hostile_input.hpp"

namespace substep {
namespace {

namespace fs = std::filesystem;

// Time limits of a call without and with an interruption [s].
constexpr double kPatience = 10.0;
#if defined(__SANITIZE_ADDRESS__)
constexpr std::size_t kMostMemory = std::size_t{3}
                                    << 30U;  // the sanitizer keeps freed memory to detect uses
#else
constexpr std::size_t kMostMemory = std::size_t{1} << 30U;
#endif

using Files = std::map<std::string, std::string>;  // by name, and their text

Files contents_of(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.is_symlink()) continue;
    std::ifstream file(entry.path(), std::ios::binary);
    files[entry.path().lexically_relative(folder).string()] = {std::istreambuf_iterator<char>(file),
                                                               {}};
  }
  return files;
}

struct Call {
  Ending ending;
  Files before;
  Files after;
};

Call call(const HostileInput& input) {
  const fs::path folder = fs::path(testing::TempDir()) / "substep_hostile";
  fs::remove_all(folder);
  fs::create_directories(folder / "sub");
  for (const auto& [name, text] : input.files) {
    std::ofstream(folder / name, std::ios::binary) << text;
  }
  fs::create_symlink("scene.json", folder / "link.json");
  Call call;
  call.before = contents_of(folder);
  call.ending = run_child(SUBSTEP_PROGRAM, input, folder, kPatience);
  call.after = contents_of(folder);
  return call;
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

/// The first control character that could steer a terminal, or npos.
std::size_t steering(const std::string& text) {
  return static_cast<std::size_t>(std::find_if(text.begin(), text.end(),
                                               [](char c) {
                                                 const auto byte = static_cast<unsigned char>(c);
                                                 return (byte < 0x20 && c != '\n') || byte == 0x7f;
                                               }) -
                                  text.begin());
}

void expect_orderly_end(const HostileInput& input, const Call& call) {
  const Ending& end = call.ending;
  EXPECT_FALSE(end.hung) << "did not end when it was interrupted";
  EXPECT_EQ(end.signal, 0) << end.err;
  const bool known = (end.exit_code >= 0 && end.exit_code <= 3) || end.exit_code == 130;
  EXPECT_TRUE(known) << "exit code " << end.exit_code << ": " << end.err;
  EXPECT_TRUE(end.exit_code != 130 || end.interrupted) << end.err;
  if (input.interrupted_after == 0 && !input.may_be_long) {
    EXPECT_FALSE(end.interrupted) << "not done after " << kPatience << " s";
  } else if (end.interrupted) {
    EXPECT_EQ(end.exit_code, 130) << end.err;
    EXPECT_LT(end.seconds, 1.0);  // 0.2 s on an idle machine, checked by Hostile.Interrupted*
  }
  EXPECT_LT(end.memory, kMostMemory);
  EXPECT_FALSE(has(end.err, "Sanitizer") || has(end.err, "runtime error:")) << end.err;
  EXPECT_EQ(steering(end.err), end.err.size()) << "a control character is printed";
  EXPECT_EQ(steering(end.out), end.out.size()) << "a control character is printed";
  if (end.exit_code == 2) {
    EXPECT_FALSE(end.err.empty()) << "it failed without a message";
  }
  // Stop after many failures.
  EXPECT_LE(std::count(end.err.begin(), end.err.end(), '\n'), 1000);
}

/// Whether one result may fail when another has already been written.
bool may_fail_late(const HostileInput& input) {
  const auto& arguments = input.arguments;
  return input.output_is_full || input.output_is_closed ||
         std::count(arguments.begin(), arguments.end(), "/dev/full") > 0;
}

/// Earlier files: an input is unchanged, and so is the old file of a failed call.
void expect_files_are_intact(const HostileInput& input, const Call& call) {
  for (const auto& [name, text] : call.before) {
    const auto now = call.after.find(name);
    ASSERT_NE(now, call.after.end()) << name << " is missing";
    // An output: `generate` reads no scene.
    const bool read = name != "old" && input.arguments[0] != "generate";
    if (!read && (call.ending.exit_code != 2 || may_fail_late(input))) continue;
    EXPECT_TRUE(now->second == text) << name << " is overwritten";
  }
  for (const auto& [name, text] : call.after) {
    EXPECT_FALSE(name.ends_with(".new")) << name << " is left behind";
    const bool is_new = !call.before.contains(name) || call.before.at(name) != text;
    if (is_new && !text.empty()) {
      EXPECT_EQ(text.back(), '\n') << name << " is truncated";
    }
  }
  if (call.ending.exit_code != 2 || may_fail_late(input)) return;
  const auto& arguments = input.arguments;
  if (arguments.empty() || arguments[0] == "merge" || arguments[0] == "sweep") return;
  EXPECT_EQ(call.after.size(), call.before.size()) << "a partial result of a failed call";
}

/// "--json" and the like, and the files that they name.
std::map<std::string, std::string> outputs_of(const HostileInput& input) {
  std::map<std::string, std::string> outputs;
  for (std::size_t i = 0; i + 1 < input.arguments.size(); ++i) {
    const std::string& flag = input.arguments[i];
    for (const char* known : {"--csv", "--json", "--states", "--joints", "--out", "--html"}) {
      if (flag == known) outputs[flag] = input.arguments[i + 1];
    }
  }
  return outputs;
}

void expect_output_is_complete(const HostileInput& input, const Call& call) {
  for (const auto& [flag, file] : outputs_of(input)) {
    if (file == "-" || file.starts_with("/dev/")) {
      EXPECT_NE(file, "/dev/full");
      continue;
    }
    const fs::path named = fs::path(file).lexically_normal();
    const fs::path path = named == "link.json" ? "scene.json" : named;
    const auto found = call.after.find(path.string());
    ASSERT_NE(found, call.after.end()) << flag << " " << file << " is not there";
    EXPECT_FALSE(found->second.empty()) << flag;
    if (flag == "--json") {
      EXPECT_TRUE(Json::accept(found->second)) << flag << " " << file;
    }
  }
  if (!input.hampered()) return;
  // Without limits the program must not fail.
  HostileInput free = input;
  free.output_is_full = free.output_is_closed = false;
  free.most_file = 0;
  const Call all = substep::call(free);
  EXPECT_EQ(all.ending.exit_code, 0) << all.ending.err;
  if (input.output_is_full || input.output_is_closed) {
    EXPECT_EQ(all.ending.out, "") << "is lost";
  }
  const auto lines = [](const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_EQ(lines(call.ending.out), lines(all.ending.out));
  for (const auto& [name, text] : all.after) {
    EXPECT_TRUE(call.after.contains(name)) << name;
    EXPECT_EQ(lines(call.after.at(name)), lines(text)) << name;
  }
}

std::uint64_t number_from(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text && *text ? std::strtoull(text, nullptr, 10) : otherwise;
}

TEST(RandomInput, EndsWithAMessageAndLosesNothing) {
  const std::uint64_t first = number_from("SUBSTEP_HOSTILE_SEED", 1);
  const std::uint64_t count = number_from("SUBSTEP_HOSTILE_INPUTS", 100);
  std::map<int, int> endings;  // count of each exit code
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const HostileInput input = hostile_input(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + in_words(input));
    const Call made = call(input);
    ++endings[made.ending.exit_code];
    expect_orderly_end(input, made);
    expect_files_are_intact(input, made);
    if (made.ending.exit_code == 0) expect_output_is_complete(input, made);
  }
  // Coverage: many inputs pass the readers, and many do not.
  if (count >= 100) {
    EXPECT_GE(endings[0], static_cast<int>(count / 10));
    EXPECT_GE(endings[2], static_cast<int>(count / 10));
  }
}

}  // namespace
}  // namespace substep
