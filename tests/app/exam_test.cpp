// `substep exam`, run as a program, on quick cases.

#include <gtest/gtest.h>

#include <string>

#include "core/io/json.hpp"
#include "tests/app/program.hpp"

namespace substep {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(ExamCommand, ListsEveryCase) {
  const Outcome list = substep("exam --list");
  EXPECT_EQ(list.exit_code, 0) << list.err;
  EXPECT_GE(lines_of(list.out).size(), 20U);
  EXPECT_TRUE(has(list.out, "\nrevolute "));
  EXPECT_TRUE(has(list.out, "squeezer         IFToMM A03, Andrews' squeezing mechanism\n"))
      << list.out;
}

TEST(ExamCommand, PrintsEveryRunItsTolerancesAndASummary) {
  const Outcome run = substep("exam --case revolute");
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_EQ(run.err, "") << "progress is for terminals only";
  for (const char* part : {"[1] exact position <= 2e-06 m: ", "[6] reaction force <= 0.001 N: ",
                           "euler, adaptive     alpha 0.1 ", "newton numerov          n 256 ",
                           "\n  passes\n", "1 of 1 cases pass\n"}) {
    EXPECT_TRUE(has(run.out, part)) << part << '\n' << run.out;
  }
}

TEST(ExamCommand, JsonHasEveryRunAndDeterminesTheExitCode) {
  for (const char* name : {"revolute", "symmetric_body"}) {
    const Outcome run = substep("exam --json - --case " + std::string(name));
    const Json json = Json::parse(run.out, nullptr, false);
    ASSERT_TRUE(json.is_array()) << run.out;
    ASSERT_EQ(json.size(), 1U);
    EXPECT_EQ(json[0]["case"], name);
    EXPECT_EQ(json[0]["runs"].size(), 18U);
    const std::size_t quantities = json[0]["quantities"].size();
    bool reached = false;
    bool kept = true;
    for (const Json& one : json[0]["runs"]) {
      EXPECT_EQ(one["errors"].size(), quantities);
      EXPECT_EQ(one["within"].size(), quantities);
      reached = reached || one["passes"].get<bool>();
      kept = kept && one["keeps"].get<bool>();
    }
    EXPECT_EQ(json[0]["passes"], reached && kept) << name;
    EXPECT_EQ(run.exit_code, reached && kept ? 0 : 1) << name;
  }
}

// The two cases of 216 spheres take two thirds of the time: ExamOfSpheres runs the quick runs of
// both, and the nightly Exam.EveryCasePasses all.
TEST(ExamCommand, EveryCaseButThoseOf216SpheresPasses) {
  std::string command = "exam --quiet";
  for (const std::string& line : lines_of(substep("exam --list").out)) {
    const std::string name = line.substr(0, line.find(' '));
    if (!has(name, "_666")) command += " --case " + name;
  }
  const Outcome run = substep(command);
  const std::vector<std::string> lines = lines_of(run.out);
  ASSERT_EQ(lines.size(), 19U) << run.out;
  for (const std::string& line : lines) EXPECT_FALSE(has(line, "FAILS")) << line;
  EXPECT_EQ(lines.back(), "18 of 18 cases pass");
}

TEST(ExamCommand, PageIsSelfContainedAndHasEveryCase) {
  const fs::path page = folder() / "exam.html";
  const Outcome run =
      substep("exam --quiet --case revolute --case squeezer --html \"" + page.string() + "\"");
  EXPECT_EQ(run.exit_code, 0) << run.out;
  EXPECT_EQ(lines_of(run.out).size(), 3U) << run.out;
  const std::string html = text_of(page);
  EXPECT_TRUE(has(html, "<section class=\"claim passes\" id=\"revolute\">")) << html;
  EXPECT_TRUE(has(html, "<section class=\"claim passes\" id=\"squeezer\">"));
  EXPECT_TRUE(html.ends_with("</html>\n"));
  EXPECT_FALSE(has(html, "src=") || has(html, "<script")) << "nothing is fetched or run";
}

TEST(ExamCommand, BadInputIsReportedWithExitCode2) {
  const Outcome run = substep("exam --case revolut");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_TRUE(has(run.err, "revolut: no such case (did you mean \"revolute\"?)")) << run.err;
  EXPECT_EQ(substep("exam --case revolute --quiet --html /nowhere/exam.html").exit_code, 2);
}

}  // namespace
}  // namespace substep
