#include "tests/app/hostile_input.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include "tests/app/hostile_dice.hpp"

namespace substep {
namespace {

constexpr const char* kScenes[] = {"pendulum",       "swinging_box", "bridge",        "free_fall",
                                   "ragdoll_drop",   "heavy_stack",  "sliding_box",   "heavy_top",
                                   "newtons_cradle", "wall",         "bouncing_balls"};

constexpr const char* kValues[] = {
    "",      "-1",    "0",     "1",       "2",        "nan",
    "inf",   "1e999", "1e-9",  "maybe",   "true",     "99999999999999999999",
    "0x10",  "1,5",   " 1",    "--",      "-",        "\x1b[31mred",
    "%s%n",  "\xff",  "bpp",   "pgs",     "const",    "adaptive",
    "euler", "scene", "../..", "stormer", "implicit", "10000",
    "100000"};

constexpr const char* kSettings[] = {
    "--solver", "--iterations", "--warm-start", "--no-warm-start", "--mode",    "--alpha",
    "--n",      "--n-max",      "--n-cap",      "--alpha-m",       "--beta",    "--policy",
    "--memory", "--islands",    "--no-islands", "--sleep",         "--drift",   "--tau",
    "--preset", "--integrator", "--gyroscopic", "--refinements",   "--pivots",  "--probe",
    "--forces", "--detection",  "--seed",       "--load",          "--seconds", "--quiet"};

// Output paths: none outside of the folder names a file that could be overwritten.
constexpr const char* kPlaces[] = {"new",         "old",       "scene.json",  "./scene.json",
                                   "link.json",   "/dev/null", "-",           "/dev/full",
                                   "no/such/new", ".",         "/",           "",
                                   "new",         "new",       "/dev/stdout", "sub/../old",
                                   "old/new"};

constexpr const char* kOutputs[] = {"--csv", "--json", "--states", "--joints"};

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string shipped(Dice& dice) {
  return text_of(std::filesystem::path(SUBSTEP_SOURCE_DIR) / "scenes" /
                 (std::string(dice.pick(kScenes)) + ".json"));
}

std::string value(Dice& dice) {
  if (dice.one_in(40)) return std::string(5000, 'n');
  return dice.pick(kValues);
}

void add_setting(HostileInput& input, Dice& dice) {
  const std::string flag = dice.pick(kSettings);
  if (dice.one_in(3)) {
    input.arguments.push_back(flag + "=" + value(dice));
  } else {
    input.arguments.push_back(flag);
    if (!dice.one_in(4)) input.arguments.push_back(value(dice));
  }
}

void add_output(HostileInput& input, const std::string& flag, Dice& dice) {
  input.arguments.push_back(flag);
  input.arguments.push_back(dice.one_in(30) ? std::string(300, 'n') : dice.pick(kPlaces));
}

/// Limits the output: a full disk, a closed stream, or a small file size.
void hamper(HostileInput& input, Dice& dice) {
  switch (dice.below(3)) {
    case 0:
      input.output_is_full = true;
      break;
    case 1:
      input.output_is_closed = true;
      break;
    default:
      input.most_file = 1 + dice.below(4000);
  }
}

/// A scene file, mutated or crowded, that is run, measured, hashed or swept.
void hostile_scene(HostileInput& input, Dice& dice) {
  input.files.emplace_back("scene.json", dice.one_in(12)
                                             ? crowd(10 + dice.below(700), dice.one_in(2))
                                             : mutated(shipped(dice), dice));
  const std::string commands[] = {"run", "run", "run", "cost", "hash", "scenes", "sweep"};
  const std::string& command = dice.pick(commands);
  const bool piped = command != "scenes" && dice.one_in(4);
  input.arguments = {command, piped ? "-" : "scene.json"};
  if (piped) input.standard_input = "scene.json";
  if (command == "sweep") {
    input.arguments.insert(input.arguments.end(), {"--list"});
  } else if (command != "scenes") {
    input.arguments.insert(input.arguments.end(), {"--frames", std::to_string(dice.below(3))});
  }
  if (command == "run" && dice.one_in(2)) add_output(input, dice.pick(kOutputs), dice);
  if (command == "cost" && dice.one_in(2)) add_output(input, "--json", dice);
}

/// Flags with invalid values, and paths that cannot be written.
void hostile_flags(HostileInput& input, Dice& dice) {
  input.files.emplace_back("scene.json", shipped(dice));
  input.files.emplace_back("old", "kept\n");
  const std::string commands[] = {"run", "run", "run", "cost", "hash", "generate", "exam", "merge"};
  const std::string& command = dice.pick(commands);
  input.arguments = {command};
  if (command == "generate") {
    const std::string kinds[] = {"rope", "swinging_box", "bridge", "heavy_stack", "nothing"};
    input.arguments.push_back(dice.pick(kinds));
    if (dice.one_in(2)) add_output(input, "--out", dice);
    if (dice.one_in(3)) input.arguments.insert(input.arguments.end(), {"--links", value(dice)});
    return;
  }
  if (command == "exam") {
    input.arguments.push_back("--list");
    if (dice.one_in(2)) add_output(input, "--html", dice);
    return;
  }
  if (command == "merge") {
    const char* const parts[] = {".", "sub", "nosuch", "old", "scene.json", "/dev/zero", "", "new"};
    for (std::size_t left = 1 + dice.below(3); left > 0; --left) {
      input.arguments.emplace_back(dice.pick(parts));
    }
    return;
  }
  input.arguments.emplace_back(dice.one_in(8) ? value(dice) : "scene.json");
  input.arguments.insert(input.arguments.end(), {"--frames", dice.one_in(8) ? value(dice) : "2"});
  for (std::size_t left = dice.below(4); left > 0; --left) add_setting(input, dice);
  const std::size_t outputs = command == "hash" ? 0 : dice.below(4);
  for (std::size_t i = 0; i < outputs; ++i) {
    add_output(input, command == "cost" ? "--json" : kOutputs[i], dice);
  }
}

/// Lists of experiments and result files that are invalid, endless or not files.
void hostile_list(HostileInput& input, Dice& dice) {
  std::string list;
  for (std::size_t left = dice.below(4); left > 0; --left) {
    list += R"({"scene": ")" + std::string(dice.pick(kScenes)) +
            R"(", "settings": {"mode": "const", "n": 2}, "seconds": 0.05, "load": 1, "seed": 0})" +
            "\n";
  }
  if (dice.one_in(2) && !list.empty()) {
    list = mutated(list, dice);
    input.may_be_long = true;
  }
  if (dice.one_in(6)) {
    for (int i = 0; i < 100000; ++i) list += "y\n";
  }
  input.files.emplace_back("list", list);
  input.files.emplace_back("results.part.jsonl", list);
  const char* const lists[] = {"list",         "list", "list",   "list", "/dev/zero",
                               "/dev/urandom", ".",    "nosuch", "",     "/dev/null"};
  const std::string path = dice.pick(lists);
  if (dice.one_in(4)) {
    input.arguments = {"merge", ".", path};
  } else if (dice.one_in(3)) {
    input.arguments = {"run", "--experiments", "-"};
    input.standard_input = path == "nosuch" ? "list" : path;
  } else {
    input.arguments = {"run", "--experiments", path};
    if (dice.one_in(4)) add_setting(input, dice);
    if (dice.one_in(6)) add_output(input, dice.pick(kOutputs), dice);
    if (dice.one_in(6)) input.arguments.emplace_back("pendulum");
  }
}

/// A run that is interrupted before it is finished.
void interruption(HostileInput& input, Dice& dice) {
  input.files.emplace_back("old", "kept\n");
  const char* const long_runs[] = {"bridge", "heavy_stack", "ragdoll_drop"};
  const std::string scene = dice.pick(long_runs);
  switch (dice.below(4)) {
    case 0:
      input.arguments = {"run", scene, "--seconds", "80000", "--csv", "old", "--json", "new"};
      break;
    case 1:
      input.arguments = {"sweep", scene, "--seconds", "1000", "--out", "swept"};
      break;
    case 2:
      input.arguments = {"check", scene};
      break;
    default:
      input.arguments = {"cost", scene, "--seconds", "80000", "--json", "old"};
  }
  // The program cannot handle signals before main().
  input.interrupted_after = 100 + static_cast<int>(dice.below(400));
}

}  // namespace

HostileInput hostile_input(std::uint64_t seed) {
  Dice dice(seed);
  HostileInput input;
  switch (dice.below(20)) {
    case 0:
      interruption(input, dice);
      return input;
    case 1:
    case 2:
    case 3:
    case 4:
      hostile_list(input, dice);
      break;
    case 5:
    case 6:
    case 7:
    case 8:
    case 9:
      hostile_flags(input, dice);
      break;
    default:
      hostile_scene(input, dice);
  }
  if (dice.one_in(8)) hamper(input, dice);
  if (dice.one_in(40)) input.standard_input.clear();
  return input;
}

std::string in_words(const HostileInput& input) {
  std::string words = "substep";
  for (const std::string& argument : input.arguments) {
    words += " '";
    for (const char c : argument.substr(0, 60)) {
      const auto byte = static_cast<unsigned char>(c);
      words += byte < 0x20 || byte >= 0x7f ? "\\" + std::to_string(byte) : std::string(1, c);
    }
    words += argument.size() > 60 ? "...'" : "'";
  }
  words += input.standard_input.empty() ? " <&-" : " <" + input.standard_input;
  if (input.output_is_full) words += " >/dev/full";
  if (input.output_is_closed) words += " >&-";
  if (input.most_file > 0) words += ", files of " + std::to_string(input.most_file) + " bytes";
  if (input.interrupted_after > 0) {
    words += ", SIGINT after " + std::to_string(input.interrupted_after) + " ms";
  }
  return words;
}

}  // namespace substep
