// Output of the command line: it never overwrites an input, is written completely or not at all,
// and failures are reported.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/app/program.hpp"

namespace substep {
namespace {

/// A folder for the running test that contains only a copy of a scene.
fs::path with_scene() {
  const fs::path at = folder() / "files";
  fs::remove_all(at);
  fs::create_directories(at);
  fs::copy_file(SUBSTEP_SOURCE_DIR "/scenes/pendulum.json", at / "p.json");
  return at;
}

std::size_t files_in(const fs::path& at) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(at), fs::directory_iterator()));
}

TEST(Output, IsNeverWrittenOverTheScene) {
  const fs::path at = with_scene();
  const std::string scene = text_of(at / "p.json");
  fs::create_directories(at / "sub");
  fs::create_symlink(at / "p.json", at / "link.json");
  fs::create_hard_link(at / "p.json", at / "hard.json");
  const std::string path = (at / "p.json").string();
  for (const std::string& output : {path, (at / "sub" / ".." / "p.json").string(),
                                    (at / "link.json").string(), (at / "hard.json").string()}) {
    for (const std::string flag :
         {"run --frames 1 --csv", "run --frames 1 --json", "run --frames 1 --states",
          "run --frames 1 --joints", "cost --frames 1 --json"}) {
      const std::string command = flag + " " + output + " " + path;
      const Outcome run = substep(command);
      EXPECT_EQ(run.exit_code, 2) << command;
      EXPECT_NE(run.err.find(output + " is an input: it would be overwritten"), std::string::npos)
          << run.err;
      EXPECT_EQ(text_of(path), scene) << command;
    }
  }
  EXPECT_EQ(substep("run - --frames 1 --csv " + path + " <" + path).exit_code, 2);
  EXPECT_EQ(text_of(path), scene);
}

TEST(Output, IsNeverWrittenOverAShippedScene) {
  const fs::path at = with_scene();
  const Outcome run = substep("run p --frames 1 --csv " + (at / "p.json").string(),
                              "SUBSTEP_SCENES=" + at.string());
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("would be overwritten"), std::string::npos) << run.err;
}

TEST(Output, OfASweepIsNeverWrittenOverTheScene) {
  const fs::path at = with_scene();
  fs::rename(at / "p.json", at / "report.html");
  const std::string scene = text_of(at / "report.html");
  const std::string path = (at / "report.html").string();
  EXPECT_EQ(substep("sweep --seconds 0.1 --out " + at.string() + " " + path).exit_code, 2);
  EXPECT_EQ(text_of(path), scene);
  EXPECT_EQ(substep("merge " + at.string() + " --scene " + path).exit_code, 2);
  EXPECT_EQ(text_of(path), scene);
}

TEST(Output, TwoOfOneCommandDoNotShareAFile) {
  const fs::path at = with_scene();
  const std::string file = (at / "one").string();
  const std::string same = (at / "." / "one").string();
  for (const std::string& command :
       {"run pendulum --frames 1 --csv " + file + " --json " + same,
        "exam --case revolute --json " + file + " --html " + same,
        "map --seconds 0.01 --out " + file + " --picture " + same,
        std::string("map --seconds 0.01 --out - --picture -"),
        std::string("run pendulum --frames 1 --csv - --json /dev/stdout")}) {
    const Outcome run = substep(command);
    EXPECT_EQ(run.exit_code, 2) << command;
    EXPECT_NE(run.err.find("is already used by --"), std::string::npos) << run.err;
    EXPECT_FALSE(fs::exists(file));
  }
}

/// Runs `substep ARGUMENTS` in place of RUN in a bash script; keeps its stderr.
Outcome scripted(const std::string& arguments, const std::string& script) {
  const fs::path err = folder() / "err";
  const std::string command = "bash -c 'RUN() { \"" SUBSTEP_PROGRAM "\" " + arguments + " 2>" +
                              err.string() + "; }; " + script + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, "", text_of(err)};
}

const char* const kCommands[] = {"--help",
                                 "--version",
                                 "run --help",
                                 "run pendulum --frames 1",
                                 "run pendulum --frames 1 --quiet",
                                 "run pendulum --frames 1 --csv -",
                                 "run pendulum --frames 1 --json -",
                                 "run --experiments LIST",
                                 "sweep pendulum --list",
                                 "cost pendulum --frames 1",
                                 "cost pendulum --frames 1 --json -",
                                 "doctor pendulum --no-runs",
                                 "doctor pendulum --no-runs --json -",
                                 "doctor pendulum --no-runs --html -",
                                 "check free_fall --own",
                                 "check free_fall --own --json",
                                 "exam --list",
                                 "hash pendulum --frames 1",
                                 "scenes",
                                 "scenes --json",
                                 "map --seconds 0.01 --picture PICTURE",
                                 "generate rope",
                                 "generate rope --out -"};

TEST(Output, UnwritableStandardOutputIsAnError) {
  const fs::path list = folder() / "list";
  std::ofstream(list) << "{\"scene\": \"free_fall\", \"seconds\": 0.1}\n";
  for (std::string command : kCommands) {
    if (const std::size_t at = command.find("LIST"); at != std::string::npos) {
      command.replace(at, 4, list.string());
    }
    if (const std::size_t at = command.find("PICTURE"); at != std::string::npos) {
      command.replace(at, 7, (folder() / "picture.svg").string());
    }
    for (const char* lost : {">/dev/full", ">&-"}) {
      const Outcome run = scripted(command, "RUN " + std::string(lost));
      EXPECT_EQ(run.exit_code, 2) << command << " " << lost;
      const std::string expected = "standard output: could not be written completely";
      const std::size_t at = run.err.find(expected);
      EXPECT_NE(at, std::string::npos) << command << " " << lost << ": " << run.err;
      EXPECT_EQ(run.err.find(expected, at + 1), std::string::npos) << "reported once: " << run.err;
    }
  }
}

TEST(Output, ClosedPipeIsReported) {
  // The reader exits before anything is written.
  const Outcome run = scripted("run pendulum --seconds 1000 --csv -",
                               "{ sleep 0.3; RUN; } | true; exit ${PIPESTATUS[0]}");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("standard output: could not be written completely"), std::string::npos)
      << run.err;
}

TEST(Output, AFullDiskLeavesTheOldFileAndNoPartialOne) {
  for (const std::string command :
       {"run pendulum --frames 600 --csv FILE", "run pendulum --frames 600 --json FILE",
        "run pendulum --frames 600 --states FILE", "run pendulum --frames 600 --joints FILE",
        "generate rope --links 500 --out FILE"}) {
    const fs::path at = with_scene();
    std::ofstream(at / "old") << "kept";
    for (const char* name : {"old", "new"}) {
      std::string call = command;
      call.replace(call.find("FILE"), 4, (at / name).string());
      const Outcome run = substep(call, "ulimit -f 8;");
      EXPECT_EQ(run.exit_code, 2) << call;
      EXPECT_NE(run.err.find(name + std::string(": could not be written completely: File too")),
                std::string::npos)
          << call << run.err;
      EXPECT_EQ(text_of(at / "old"), "kept") << call;
      EXPECT_EQ(files_in(at), 2U) << call;
    }
  }
}

TEST(Output, FollowsLinksAndKeepsPermissions) {
  const fs::path at = with_scene();
  std::ofstream(at / "target") << "old";
  fs::permissions(at / "target", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("target", at / "link");
  fs::create_symlink("not_yet", at / "dangling");
  ASSERT_EQ(substep("run pendulum --frames 1 --csv " + (at / "link").string() + " --json " +
                    (at / "dangling").string())
                .exit_code,
            0);
  EXPECT_TRUE(fs::is_symlink(at / "link"));
  EXPECT_EQ(lines_of(text_of(at / "target")).size(), 2U);
  EXPECT_EQ(fs::status(at / "target").permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_TRUE(fs::is_symlink(at / "dangling"));
  EXPECT_NE(text_of(at / "not_yet").find("verdict"), std::string::npos);
}

TEST(Output, AFolderIsReportedBeforeTheRun) {
  const fs::path at = with_scene();
  const Outcome into = substep("run pendulum --seconds 80000 --csv " + at.string());
  EXPECT_EQ(into.exit_code, 2);
  EXPECT_NE(into.err.find(at.string() + ": Is a directory"), std::string::npos) << into.err;
  const std::string allowed(255, 'n');
  EXPECT_EQ(substep("run pendulum --frames 1 --csv " + (at / allowed).string()).exit_code, 0);
  EXPECT_TRUE(fs::exists(at / allowed));
}

TEST(Output, OtherNamesOfStandardOutputAreStandardOutput) {
  const Outcome run = substep("run free_fall --frames 2 --csv /dev/stdout");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(lines_of(run.out).size(), 3U) << run.out;
  EXPECT_NE(run.err.find("\nholds\n"), std::string::npos) << run.err;
}

TEST(Output, NonFiniteValuesAreWrittenAsDocumented) {
  const std::string csv = substep("run free_fall --frames 1 --csv -").out;
  const std::string json = substep("run free_fall --frames 1 --json -").out;
  EXPECT_NE(csv.find(",inf,"), std::string::npos) << csv;
  EXPECT_NE(json.find("\"dt_stable\": null"), std::string::npos) << json;
  const std::string readme = text_of(SUBSTEP_SOURCE_DIR "/core/lab/README.md");
  EXPECT_NE(readme.find("`inf` stands for an unbounded `dt_stable`"), std::string::npos);
}

}  // namespace
}  // namespace substep
