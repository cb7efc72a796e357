// Invalid and malicious input gives a message and an exit code, within memory and time.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "core/io/json.hpp"
#include "core/model/text_checks.hpp"
#include "tests/app/child.hpp"
#include "tests/app/program.hpp"

namespace substep {
namespace {

fs::path fresh() {
  const fs::path at = folder() / "files";
  fs::remove_all(at);
  fs::create_directories(at);
  return at;
}

void expect_refused(const Outcome& run, const std::string& message) {
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_NE(run.err.find(message), std::string::npos) << run.err.substr(0, 1000);
  EXPECT_EQ(run.out, "");
}

TEST(Hostile, AFlagWithAValueIsRefused) {
  for (const char* value : {"maybe", "99999999999999999999999", ""}) {
    for (const char* flag : {"--islands=", "--no-islands=", "--quiet="}) {
      const Outcome run = substep(std::string("run pendulum --frames 1 ") + flag + value);
      EXPECT_TRUE(run.exit_code == 0 || run.exit_code == 2) << flag << value << run.exit_code;
      if (value == std::string("maybe")) {
        EXPECT_EQ(run.exit_code, 2) << flag;
        EXPECT_NE(run.err, "") << flag;
      }
    }
  }
}

TEST(Hostile, ANameOfFiveThousandLettersIsNotFound) {
  const std::string name(5000, 'a');
  for (const char* command : {"run ", "hash ", "check ", "cost ", "sweep ", "recommend "}) {
    expect_refused(substep(command + name), "no such scene or file");
  }
}

TEST(Hostile, AFolderIsNoFile) {
  const fs::path at = fresh();
  fs::create_directories(at / "more");
  expect_refused(substep("merge " + at.string() + " " + (at / "more").string()), "Is a directory");
  expect_refused(substep("run --experiments " + at.string()), "Is a directory");
  expect_refused(substep("run - <" + at.string()), "standard input: Is a directory");
}

TEST(Hostile, LackOfMemoryIsReported) {
  const fs::path at = fresh();
  ASSERT_EQ(substep("generate rope --links 19999 --out " + (at / "rope.json").string()).exit_code,
            0);
  const Outcome run = substep("run --frames 1 " + (at / "rope.json").string(), "ulimit -v 90000;");
  EXPECT_EQ(run.exit_code, 4) << run.err;
  EXPECT_NE(run.err.find("out of memory"), std::string::npos) << run.err;
}

// The test limits the address space: unbounded reading would exceed it.
TEST(Hostile, EndlessInputIsNotReadToItsEnd) {
  const std::string bound = "ulimit -v 1000000;";
  const fs::path at = fresh();
  expect_refused(substep("run - </dev/zero", bound), "standard input");
  expect_refused(substep("run /dev/zero", bound), "/dev/zero");
  expect_refused(substep("run --experiments /dev/zero", bound), "longer than 1048576 bytes");
  expect_refused(substep("run --experiments - </dev/zero", bound), "longer than 1048576 bytes");
  expect_refused(substep("merge " + at.string() + " /dev/zero", bound), "more than 1048576 bytes");
  const Outcome yes = substep("run --experiments -", bound + " yes |");
  expect_refused(yes, "standard input: 100 lines are wrong; the rest is not read");
  EXPECT_EQ(lines_of(yes.err).size(), 101U);
}

TEST(Hostile, FlagsWithoutEffectBesideExperimentsAreRefused) {
  const fs::path list = folder() / "list";
  std::ofstream(list) << "{\"scene\": \"free_fall\", \"seconds\": 0.1}\n";
  const std::string run = "run --experiments " + list.string();
  for (const std::string flag :
       {"--alpha 0.2", "--seconds 1", "--frames 1", "--csv -", "--json -", "--load 2", "--seed 1",
        "--quiet", "--preset paper", "--islands"}) {
    const Outcome refused = substep(run + " " + flag);
    expect_refused(refused, flag.substr(0, flag.find(' ')));
    EXPECT_NE(refused.err.find("excludes --experiments"), std::string::npos) << refused.err;
  }
  expect_refused(substep("run pendulum" + run.substr(3)), "/scene");
  expect_refused(substep("run - --experiments -"), "standard input is already used by the scene");
  EXPECT_EQ(substep("run free_fall" + run.substr(3)).exit_code, 0) << "its scene";
}

TEST(Hostile, FlagsWithoutEffectBesideAListAreRefused) {
  for (const std::string command :
       {"exam --list --json new", "exam --list --html new", "exam --list --case revolute",
        "sweep pendulum --list --out new"}) {
    const fs::path at = fresh();
    expect_refused(substep(command, "cd \"" + at.string() + "\" &&"), "excludes --");
    EXPECT_TRUE(fs::is_empty(at)) << command;
  }
}

TEST(Hostile, AnEmptyFileNameIsRefused) {
  for (const std::string command :
       {"run pendulum --frames 1 --csv \"\"", "run pendulum --frames 1 --json \"\"",
        "run pendulum --frames 1 --states \"\"", "run pendulum --frames 1 --joints \"\"",
        "run --experiments \"\"", "cost pendulum --frames 1 --json \"\"",
        "generate rope --out \"\"", "map --out \"\"", "map --picture \"\"",
        "exam --list --html \"\"", "exam --list --json \"\"", "sweep pendulum --list --out \"\"",
        "recommend pendulum --out \"\"", "reproduce --out \"\""}) {
    expect_refused(substep(command), "the name is empty");
  }
}

TEST(Hostile, MergeOfNothingMakesNoFolder) {
  const fs::path at = fresh();
  expect_refused(substep("merge " + (at / "nosuch").string()), "nosuch: there is no such folder");
  EXPECT_FALSE(fs::exists(at / "nosuch"));
  expect_refused(substep("merge " + at.string()), "there are no results to merge");
  EXPECT_TRUE(fs::is_empty(at));
}

TEST(Hostile, AnEditedSceneDoesNotMixIntoAnOldSweep) {
  const fs::path at = fresh();
  const fs::path scene = at / "p.json";
  Json json = Json::parse(text_of(SUBSTEP_SOURCE_DIR "/scenes/free_fall.json"));
  const auto sweep = [&] {
    std::ofstream(scene) << json.dump();
    return substep("sweep --seconds 0.05 --quiet --out " + (at / "s").string() + " " +
                   scene.string());
  };
  ASSERT_EQ(sweep().exit_code, 0);
  const std::string results = text_of(at / "s" / "results.jsonl");
  json["title"] = "Another title";
  EXPECT_EQ(sweep().exit_code, 0) << "it moves as before";
  json["gravity"] = {0, -5, 0};
  expect_refused(sweep(), "another scene of this name");
  EXPECT_EQ(text_of(at / "s" / "results.jsonl"), results);
}

/// Every line that a person reads is plain text.
void expect_harmless(const Outcome& run) {
  for (const std::string& text : {run.out, run.err}) {
    for (const std::string& line : lines_of(text))
      EXPECT_EQ(text_fault(line), std::nullopt) << line;
  }
}

TEST(Hostile, MessagesHaveNoControlCharacters) {
  const fs::path at = fresh();
  Json scene = Json::parse(text_of(SUBSTEP_SOURCE_DIR "/scenes/pendulum.json"));
  scene["\x1b[31mred\x07\xc2\x9b\xe2\x80\xae"] = 1;
  std::ofstream(at / "key.json") << scene.dump();
  std::ofstream(at / "list") << "{\"scene\": \"\\u001b[31m\", \"\\u001bkey\": 1}\n";
  const std::string raw = "$(printf '\\033[31mred\\007\\233\\302\\233\\342\\200\\256')";
  for (const std::string& command :
       {std::string("run ") + (at / "key.json").string(),
        "run --experiments " + (at / "list").string(), "run \"" + raw + "\"", "\"" + raw + "\"",
        "run pendulum --\"" + raw + "\"", "run pendulum --alpha \"" + raw + "\"",
        "run pendulum --seconds \"" + raw + "\"", "run pendulum --csv \"/nosuch/" + raw + "\"",
        "check \"" + raw + "\"", "exam --case \"" + raw + "\"", "merge \"/nosuch/" + raw + "\"",
        "run --experiments \"/nosuch/" + raw + "\"", "sweep pendulum --shard \"" + raw + "\""}) {
    const Outcome run = substep(command);
    EXPECT_EQ(run.exit_code, 2) << command;
    EXPECT_NE(run.err.find("\\x1b"), std::string::npos) << command << ": " << run.err;
    expect_harmless(run);
  }
}

TEST(Hostile, NamesOfScenesCannotSteerATerminal) {
  const fs::path at = fresh();
  for (const char* odd : {"\xc2\x9b"
                          "31m",
                          "\xe2\x80\xae", "\xe2\x81\xa7", "\xe2\x80\xa8", "\xef\xbb\xbf"}) {
    Json scene = Json::parse(text_of(SUBSTEP_SOURCE_DIR "/scenes/pendulum.json"));
    for (const char* place : {"/group", "/title", "/bodies/0/name", "/joints/0/name"}) {
      Json changed = scene;
      changed[Json::json_pointer(place)] = "a" + std::string(odd) + "b";
      std::ofstream(at / "name.json") << changed.dump();
      const Outcome run = substep("run " + (at / "name.json").string());
      expect_refused(run, place);
      expect_harmless(run);
    }
  }
}

/// Peak memory of a run of a ball in free flight [bytes].
std::size_t memory_of(const char* command, const char* frames) {
  const fs::path at = fresh();
  std::ofstream(at / "ball.json")
      << R"({"format": "substep-scene", "version": 2, "name": "ball", "title": "Ball",
             "effects": [], "criteria": {"duration": 86400},
             "bodies": [{"name": "ball", "shape": {"type": "sphere", "radius": 0.1}, "mass": 1,
                         "position": [0, 1, 0]}]})";
  constexpr double kPatience = 120.0;  // [s]
  HostileInput input;
  input.arguments = {command, "ball.json", "--frames", frames};
  const Ending end = run_child(SUBSTEP_PROGRAM, input, at, kPatience);
  EXPECT_EQ(end.exit_code, 0) << end.err;
  EXPECT_NE(end.out.find("holds"), std::string::npos) << end.out;
  return end.memory;
}

TEST(Hostile, MemoryDoesNotGrowWithTheFrames) {
  // Medians and percentiles need up to 16,384 values, about 1 MiB.
  for (const char* command : {"run", "cost"}) {
    const std::size_t less = memory_of(command, "20000");
    const std::size_t more = memory_of(command, "400000");
    EXPECT_LT(more, less + (std::size_t{2} << 20U)) << command;
  }
}

/// Runs a command and sends it a signal after a delay. The shell would start it with SIGINT
/// ignored. @return its outcome, and the time from the signal to its end [s]
std::pair<Outcome, double> interrupted_once(const std::string& command, const char* signal) {
  const fs::path took = folder() / "took";
  const Outcome run = substep(
      command,
      "bash -c 'env --default-signal \"$@\" & pid=$!; sleep 0.7; begin=$(date +%s%N); kill -" +
          std::string(signal) +
          " $pid; wait $pid; code=$?; echo $(( $(date +%s%N) - begin )) >\"$0\"; exit $code' \"" +
          took.string() + "\"");
  return {run, 1e-9 * std::stod(text_of(took))};
}

constexpr double kSoon = 0.3;  // [s], including the start of the shell's own programs

/// The shortest of three, because the machine may be busy; a program that waits is always slow.
std::pair<Outcome, double> interrupted(const std::string& command, const char* signal) {
  auto soonest = interrupted_once(command, signal);
  for (int i = 0; i < 2 && soonest.second > kSoon; ++i) {
    auto next = interrupted_once(command, signal);
    if (next.second < soonest.second) soonest = std::move(next);
  }
  return soonest;
}

constexpr std::pair<const char*, int> kSignals[] = {{"INT", 130}, {"TERM", 143}, {"HUP", 129}};

TEST(Hostile, InterruptedItEndsAtOnceWithTheFinishedResults) {
  const fs::path at = fresh();
  const std::string csv = (at / "run.csv").string();
  const std::string json = (at / "run.json").string();
  const std::string table = (at / "map.csv").string();
  std::ofstream(at / "list") << "{\"scene\": \"bridge\", \"seconds\": 3600}\n";
  for (const std::string& command :
       {"run pendulum --seconds 86400 --csv " + csv + " --json " + json,
        "run --experiments " + (at / "list").string(), std::string("check --all --json"),
        "map --out " + table, std::string("hash bridge --seconds 86400"),
        std::string("cost bridge --seconds 86400"), "exam --json " + (at / "exam.json").string()}) {
    for (const auto& [signal, code] : kSignals) {
      const auto [run, seconds] = interrupted(command, signal);
      EXPECT_EQ(run.exit_code, code) << command << " " << signal << run.err;
      EXPECT_NE(run.err.find("cancelled"), std::string::npos) << command << run.err;
      EXPECT_LT(seconds, kSoon) << command;
    }
  }
  const auto lines = lines_of(text_of(csv));
  ASSERT_GT(lines.size(), 10U);
  EXPECT_EQ(std::count(lines.back().begin(), lines.back().end(), ','),
            std::count(lines.front().begin(), lines.front().end(), ','));
  EXPECT_GT(Json::parse(text_of(json))["frames"].size(), 10U);
  EXPECT_EQ(lines_of(text_of(table)).front().rfind("map,value", 0), 0U);
  EXPECT_FALSE(fs::exists(at / "exam.json"));
  EXPECT_EQ(std::distance(fs::directory_iterator(at), fs::directory_iterator()), 4);
}

// 100,000 iterations in each of 10,000 sub-steps: a frame of minutes.
TEST(Hostile, InterruptedInALongFrameItEndsAtOnce) {
  const fs::path at = fresh();
  const std::string csv = (at / "run.csv").string();
  const std::string json = (at / "run.json").string();
  for (const auto& [signal, code] : kSignals) {
    const auto [run, seconds] = interrupted(
        "run bridge --solver pgs --iterations 100000 --mode const --n 10000 --work-budget 1e15 "
        "--csv " +
            csv + " --json " + json,
        signal);
    EXPECT_EQ(run.exit_code, code) << run.err;
    EXPECT_LT(seconds, kSoon);
  }
  EXPECT_EQ(lines_of(text_of(csv)).size(), 1U) << "the header";
  EXPECT_TRUE(Json::parse(text_of(json))["frames"].empty());
}

}  // namespace
}  // namespace substep
