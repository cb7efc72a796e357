// Sweeps on the command line: killed, split, merged, and with foreign files.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <map>
#include <random>
#include <set>

#include "core/io/json.hpp"
#include "tests/app/program.hpp"

namespace substep {
namespace {

/// An exact and quick scene: a sweep of it takes about a second.
constexpr const char* kSweep = "sweep pendulum --seconds 0.5 --quiet --jobs 2 ";

/// An empty folder for the running test.
fs::path fresh(const std::string& name) {
  const fs::path path = folder() / name;
  fs::remove_all(path);
  return path;
}

/// Results without their times: independent of how a sweep was run.
std::vector<std::string> figures(const fs::path& file) {
  std::vector<std::string> lines;
  for (const std::string& line : lines_of(text_of(file))) {
    Json json = Json::parse(line, nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << line;
    if (json.is_object()) json.erase("timing");
    lines.push_back(json.dump());
  }
  return lines;
}

const std::vector<std::string>& whole_sweep() {
  static const std::vector<std::string> lines = [] {
    const fs::path out = fresh("whole");
    EXPECT_EQ(substep(kSweep + ("--out " + out.string())).exit_code, 0);
    return figures(out / "results.jsonl");
  }();
  return lines;
}

/// A developer's machine may lack the tools that a test needs; a full test run must have them.
void skip_without(const char* what) {
  ASSERT_EQ(std::getenv("CI"), nullptr) << "missing: " << what;
  GTEST_SKIP() << "missing: " << what;
}

constexpr const char* kCharts = "the chart library: npm ci --prefix app/report, then build";
constexpr const char* kParallel = "GNU Parallel";

// One complete sweep; of the others a sample is recomputed by the tests of the panel.
TEST(SweepCommand, ShipsTheFilesOfTheScenesFolder) {
  const fs::path out = fresh("free_fall.txt");
  ASSERT_EQ(substep("sweep free_fall --ship " + out.string()).exit_code, 0);
  EXPECT_EQ(text_of(out), text_of(fs::path(SUBSTEP_SOURCE_DIR) / "scenes/sweeps/free_fall.txt"));
}

TEST(SweepCommand, WritesOneResultALineAndAReport) {
  const fs::path out = fresh("sweep");
  const Outcome sweep = substep("sweep pendulum --seconds 0.5 --out " + out.string());
  ASSERT_EQ(sweep.exit_code, 0) << sweep.err;
  EXPECT_EQ(sweep.err, "") << "progress is for terminals only";
  const auto lines = lines_of(text_of(out / "results.jsonl"));
  ASSERT_GT(lines.size(), 100U);
  EXPECT_EQ(lines.front(), R"({"format":"substep-results","version":1})");
  std::set<std::string> ids;
  std::set<std::string> series;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const Json result = Json::parse(lines[i], nullptr, false);
    ASSERT_TRUE(result.is_object()) << lines[i];
    EXPECT_TRUE(ids.insert(result["id"]).second);
    series.insert(result["series"]);
    EXPECT_GT(result["work"]["flops"], 0);
  }
  EXPECT_GE(series.size(), 12U);
  const std::string report = text_of(out / "report.html");
  if (report.empty()) return skip_without(kCharts);
  EXPECT_EQ(report.find("<!doctype html>"), 0U);
  EXPECT_NE(report.find(*ids.begin()), std::string::npos);
  EXPECT_EQ(report.find("src=\"http"), std::string::npos) << "it opens without a network";
}

/// Command prefix that sends a signal to the program after a delay once a file has a given number
/// of lines, independent of the speed of the machine.
std::string signalled(const std::string& signal, const fs::path& file, std::size_t lines,
                      int later_ms = 0) {
  return "bash -c '\"$@\" & pid=$!; while kill -0 $pid 2>/dev/null && "
         "[ \"$(cat \"$0\" 2>/dev/null | wc -l)\" -lt " +
         std::to_string(lines) + " ]; do sleep 0.002; done; sleep " +
         std::to_string(1e-3 * later_ms) + "; kill -" + signal +
         " $pid 2>/dev/null; wait $pid' \"" + file.string() + "\"";
}

TEST(SweepCommand, KilledAtAnyMomentItGivesTheSameResults) {
  // Long enough that the file can be watched as it grows.
  const std::string sweep = "sweep pendulum --seconds 5 --quiet --jobs 2 --out ";
  const fs::path all = fresh("all");
  ASSERT_EQ(substep(sweep + all.string()).exit_code, 0);
  const std::vector<std::string> whole = figures(all / "results.jsonl");
  const fs::path out = fresh("killed");
  const fs::path file = out / "results.jsonl";
  std::mt19937 random(11);
  std::uniform_int_distribution<std::size_t> more(1, 25);  // further runs before the signal
  std::uniform_int_distribution<int> later_ms(0, 30);      // in the middle of a run or of a line
  int killed = 0;
  std::size_t before = 0;
  for (int round = 0; round < 60 && killed < 20; ++round) {
    if (before + 30 > whole.size()) {  // nearly done: it ends normally, and a new sweep begins
      ASSERT_EQ(substep(sweep + out.string()).exit_code, 0);
      EXPECT_EQ(figures(file), whole);
      fs::remove_all(out);
      before = 0;
    }
    const Outcome run = substep(sweep + out.string(),
                                signalled("KILL", file, before + more(random), later_ms(random)));
    killed += run.exit_code == 137 ? 1 : 0;
    const std::size_t now = lines_of(text_of(file)).size();
    EXPECT_GE(now + 1, before) << "finished runs are kept";  // a last line may have been cut short
    before = now;
  }
  EXPECT_EQ(killed, 20);
  ASSERT_EQ(substep(sweep + out.string()).exit_code, 0);
  EXPECT_EQ(figures(file), whole);
}

TEST(SweepCommand, InterruptedItReportsThatAndContinues) {
  const fs::path out = fresh("interrupted");
  const Outcome run = substep("sweep swinging_box --seconds 5 --jobs 2 --out " + out.string(),
                              signalled("TERM", out / "results.jsonl", 2));
  EXPECT_EQ(run.exit_code, 143);
  EXPECT_NE(run.err.find("cancelled"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("continues from there"), std::string::npos);
}

TEST(SweepCommand, ATruncatedLineIsRunAgain) {
  const fs::path out = fresh("cut");
  ASSERT_EQ(substep(kSweep + ("--out " + out.string())).exit_code, 0);
  const fs::path file = out / "results.jsonl";
  fs::resize_file(file, fs::file_size(file) - 40);
  ASSERT_EQ(substep(kSweep + ("--out " + out.string())).exit_code, 0);
  EXPECT_EQ(figures(file), whole_sweep());
}

TEST(SweepCommand, ForeignFilesAreRefusedAndUnchanged) {
  const fs::path out = fresh("foreign");
  fs::create_directories(out);
  const std::string good = R"({"format":"substep-results","version":1})";
  for (const std::string& text :
       {std::string("frame,time\n0,0\n"), std::string("my notes"), good + "\nnot json\n",
        good + "\n{\"id\": 7}\n",
        good + "\n{}\n{\"half\": ", std::string("{\"format\":\"substep-results\",\"version\":9}\n"),
        std::string("\0\1\2", 3)}) {
    const fs::path file = out / "results.jsonl";
    std::ofstream(file, std::ios::binary) << text;
    const Outcome sweep = substep(kSweep + ("--out " + out.string()));
    EXPECT_EQ(sweep.exit_code, 2) << text;
    EXPECT_NE(sweep.err.find("results.jsonl"), std::string::npos) << sweep.err;
    EXPECT_EQ(text_of(file), text);
  }
}

TEST(SweepCommand, TwoDoNotWriteOneFile) {
  const fs::path out = fresh("locked");
  fs::create_directories(out);
  const int other = open((out / "results.jsonl").c_str(), O_RDWR | O_CREAT, 0666);
  ASSERT_GE(other, 0);
  ASSERT_EQ(flock(other, LOCK_EX), 0);
  const Outcome sweep = substep(kSweep + ("--out " + out.string()));
  EXPECT_EQ(sweep.exit_code, 2);
  EXPECT_NE(sweep.err.find("another sweep"), std::string::npos) << sweep.err;
  close(other);
}

TEST(SweepCommand, AnUnwritableFolderIsReported) {
  const fs::path file = folder() / "a_file";
  std::ofstream(file) << "x";
  const Outcome sweep = substep(kSweep + ("--out " + (file / "out").string()));
  EXPECT_EQ(sweep.exit_code, 2);
  EXPECT_NE(sweep.err.find("a_file"), std::string::npos) << sweep.err;
}

// Reading /dev/full never ends: it returns zeros for ever and rejects writes.
TEST(SweepCommand, AResultsFileThatIsNotRegularIsRefused) {
  const fs::path out = fresh("device");
  fs::create_directories(out);
  fs::create_symlink("/dev/full", out / "results.jsonl");
  const Outcome sweep = substep(kSweep + ("--out " + out.string()));
  EXPECT_EQ(sweep.exit_code, 2);
  EXPECT_NE(sweep.err.find("results.jsonl: not a regular file"), std::string::npos) << sweep.err;
  EXPECT_TRUE(fs::is_symlink(out / "results.jsonl"));
}

// A limit on the file size models a full disk: the write fails in the middle of a line.
TEST(SweepCommand, AFullDiskLosesNothingThatIsFinished) {
  const fs::path out = fresh("full");
  const Outcome full = substep(kSweep + ("--out " + out.string()), "ulimit -f 30;");
  EXPECT_EQ(full.exit_code, 2);
  EXPECT_NE(full.err.find("the previous results are kept"), std::string::npos) << full.err;
  const std::string text = text_of(out / "results.jsonl");
  EXPECT_EQ(text.back(), '\n');
  EXPECT_GT(lines_of(text).size(), 2U);
  ASSERT_EQ(substep(kSweep + ("--out " + out.string())).exit_code, 0);
  EXPECT_EQ(figures(out / "results.jsonl"), whole_sweep());
}

/// GNU Parallel, which ./dev installs for the tests; another program has the same name.
bool has_parallel() { return std::system("parallel --version 2>/dev/null | grep -q GNU") == 0; }

/// A recipe of core/lab/README.md, unchanged except for the program and the folder.
void follow(std::string recipe, const fs::path& out) {
  const auto replace = [&](const std::string& word, const std::string& by) {
    for (std::size_t at = 0; (at = recipe.find(word, at)) != std::string::npos; at += by.size()) {
      recipe.replace(at, word.size(), by);
    }
  };
  replace("OUT", out.string());
  replace("substep ", "\"" SUBSTEP_PROGRAM "\" ");
  replace("SCENE", "pendulum --seconds 0.5 --quiet");
  ASSERT_EQ(std::system(recipe.c_str()), 0) << recipe;
}

TEST(SweepCommand, PartsRunSideBySideWithParallelMergeToTheWhole) {
  if (!has_parallel()) return skip_without(kParallel);
  const fs::path out = fresh("parts");
  follow("parallel substep sweep SCENE --out OUT --jobs 1 --shard {}/4 ::: 1 2 3 4", out);
  EXPECT_TRUE(fs::exists(out / "results.3-of-4.jsonl"));
  follow("substep merge OUT", out);
  EXPECT_EQ(figures(out / "results.jsonl"), whole_sweep());
}

TEST(SweepCommand, PartsRunSideBySideWithXargsMergeToTheWhole) {
  const fs::path out = fresh("xargs");
  follow("seq 4 | xargs -P 4 -I{} substep sweep SCENE --out OUT --jobs 1 --shard {}/4", out);
  follow("substep merge OUT", out);
  EXPECT_EQ(figures(out / "results.jsonl"), whole_sweep());
}

// One experiment a line in, one result a line out, in any order.
TEST(SweepCommand, AListSpreadWithParallelMergesToTheWhole) {
  if (!has_parallel()) return skip_without(kParallel);
  const fs::path out = fresh("list_parallel");
  fs::create_directories(out);
  follow(
      "substep sweep SCENE --list | parallel --pipe -N8 substep run --experiments - "
      "> OUT/more.jsonl",
      out);
  follow("substep merge OUT OUT/more.jsonl", out);
  EXPECT_EQ(figures(out / "results.jsonl"), whole_sweep());
}

TEST(SweepCommand, AListSpreadWithSplitMergesToTheWhole) {
  const fs::path out = fresh("list_split");
  fs::create_directories(out);
  follow("substep sweep SCENE --list | split --lines 60 - OUT/list.", out);
  follow("ls OUT/list.* | xargs -P 2 -I{} sh -c 'substep run --experiments {} > {}.jsonl'", out);
  follow("substep merge OUT OUT/list.*.jsonl", out);
  EXPECT_EQ(figures(out / "results.jsonl"), whole_sweep());
}

// Only the last references are kept: one that is found again is the same.
TEST(SweepCommand, ExperimentsOfManyDurationsTakingTurnsHaveTheSameResults) {
  const fs::path list = folder() / "turns";
  {
    std::ofstream out(list);
    for (int i = 0; i < 18; ++i) {
      out << R"({"scene": "pendulum", "seconds": 0.)" << 1 + i % 6 << "}\n";
    }
  }
  const Outcome run = substep("run --experiments " + list.string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::vector<Json> results;
  for (const std::string& line : lines_of(run.out)) {
    results.push_back(Json::parse(line, nullptr, false));
    results.back().erase("timing");
  }
  ASSERT_EQ(results.size(), 18U);
  for (std::size_t i = 0; i < results.size(); ++i) {
    EXPECT_TRUE(results[i]["errors"].contains("trajectory_peak")) << "no reference";
    EXPECT_EQ(results[i], results[i % 6]);
  }
}

TEST(SweepCommand, InvalidExperimentsAreReportedByLineAndTheOthersRun) {
  const fs::path out = folder() / "list";
  std::ofstream(out) << "{\"scene\": \"free_fall\", \"seconds\": 0.1}\n"
                        "{\"scene\": \"nowhere\"}\n"
                        "{\"scene\": \"free_fall\", \"settings\": {\"alpha\": 7}}\n";
  const Outcome run = substep("run --experiments " + out.string());
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(lines_of(run.out).size(), 1U);
  EXPECT_NE(run.err.find(":2: /scene"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find(":3: /settings/alpha"), std::string::npos) << run.err;
}

// The command of a clicked point must reproduce its values: it is the command that the report
// shows.
TEST(SweepCommand, TheCommandOfAResultGivesItsHash) {
  const fs::path out = fresh("commands");
  ASSERT_EQ(substep("sweep swinging_box --seconds 0.25 --quiet --out " + out.string()).exit_code,
            0);
  const std::string report = text_of(out / "report.html");
  if (report.empty()) return skip_without(kCharts);
  const std::string begin = R"(<script type="application/json" id="data">)";
  const std::size_t at = report.find(begin) + begin.size();
  const Json data =
      Json::parse(report.substr(at, report.find("</script>", at) - at), nullptr, false);
  ASSERT_TRUE(data.is_object());
  int seen = 0;
  for (std::size_t i = 0; i < data["results"].size(); i += 17) {
    const Json& result = data["results"][i];
    const std::string command = result["command"];
    if (!result["holds"]) continue;  // `run` continues a failed run to its end
    const Outcome run = substep(command.substr(std::string("substep ").size()));
    ASSERT_EQ(run.exit_code, 0) << command;
    EXPECT_NE(run.out.find(result["hash"].get<std::string>()), std::string::npos) << command;
    ++seen;
  }
  EXPECT_GT(seen, 5);
}

}  // namespace
}  // namespace substep
