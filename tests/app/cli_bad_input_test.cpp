// Bad input to the command line: exit code 2 and a message that names the allowed range.

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/app/program.hpp"

namespace substep {
namespace {

struct BadCall {
  const char* kind;
  std::string arguments;
  std::string message;  // somewhere on stderr
};
void PrintTo(const BadCall& call, std::ostream* out) { *out << call.kind; }

class BadCommandLine : public testing::TestWithParam<BadCall> {};

TEST_P(BadCommandLine, EndsWithTwoAndSaysWhatIsAllowed) {
  const Outcome run = substep(GetParam().arguments);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find(GetParam().message), std::string::npos) << run.err;
  EXPECT_EQ(run.out, "");
}

std::string kind_of(const testing::TestParamInfo<BadCall>& call) { return call.param.kind; }

INSTANTIATE_TEST_SUITE_P(
    Calls, BadCommandLine,
    testing::Values(
        BadCall{"AlphaBeyondRange", "run bridge --alpha 3",
                "--alpha: must be above 0 and at most 1, not 3"},
        BadCall{"AlphaNoNumber", "run bridge --alpha much",
                "--alpha: must be above 0 and at most 1, not much"},
        BadCall{"CountZero", "run bridge --n-max 0",
                "--n-max: 0 is not a whole number from 1 to 10000"},
        BadCall{"SolverOfNoKind", "run bridge --solver admm",
                "--solver: admm is not pgs, bpp, xpbd or newton"},
        BadCall{"ModeOfNoKind", "hash bridge --mode fast",
                "--mode: fast is not none, const, damping, adaptive, capped, stiffness, "
                "inertia or blend"},
        BadCall{"NegativeSeconds", "run bridge --seconds -1", "not in range"},
        BadCall{"SecondsNoNumber", "run bridge --seconds nan", "not in range"},
        BadCall{"LoadNoNumber", "run bridge --load nan", "not in range"},
        BadCall{"ErrorNoNumber", "recommend pendulum --error nan", "not in range"},
        BadCall{"AngleNoNumber", "generate rope --angle nan", "not in range"},
        BadCall{"SecondsAndFrames", "run bridge --seconds 1 --frames 1", "excludes"},
        BadCall{"UnknownFlag", "run bridge --speed 3", "--speed"},
        BadCall{
            "UnknownCommand", "chek",
            "chek is not run, sweep, cost, recommend, merge, reproduce, check, exam, hash, scenes, "
            "generate or "
            "map (did "
            "you mean \"check\"?)"},
        BadCall{"NoCommand", "", "subcommand"},
        BadCall{"NoScene", "run", "scene or --experiments is required"},
        BadCall{"NoSceneToCheck", "check", "scene or --all is required"},
        BadCall{"TwoResultsOnStandardOutput", "run bridge --csv - --json -",
                "already used by --csv"},
        BadCall{"StatesAndJointsOnStandardOutput", "run bridge --states - --joints -",
                "--joints: standard output is already used by --states"},
        BadCall{"StatesInNoFolder", "run bridge --frames 1 --states /no/such/folder/a.csv",
                "/no/such/folder/a.csv: No such file or directory"},
        BadCall{"UnknownScene", "run brigde",
                "brigde: no such scene or file (did you mean \"bridge\"?)"},
        BadCall{"SceneIsAFolder", "run /", "/: cannot read /: "},
        BadCall{"CsvInNoFolder", "run bridge --frames 1 --csv /no/such/folder/a.csv",
                "/no/such/folder/a.csv: No such file or directory"},
        BadCall{"AngleBeyondRange", "generate rope --angle 100", "not in range"},
        BadCall{"LinkWithoutWidth", "generate rope --link-width 0", "not in range"},
        BadCall{"LinkMassNegative", "generate rope --link-mass -1", "not in range"},
        BadCall{"BoxSizeNoNumber", "generate rope --box-size nan", "not in range"},
        BadCall{"AnchorTooFar", "generate rope --anchor 0 2e5 0", "not in range"},
        BadCall{"AnchorOfTwoNumbers", "generate rope --anchor 1 2", "--anchor"}),
    kind_of);

TEST(CommandLine, BadSceneFileEndsWithTwoAndAllProblems) {
  const fs::path path = folder() / "bad.json";
  std::string text = text_of(SUBSTEP_SOURCE_DIR "/scenes/pendulum.json");
  text.replace(text.find("\"mass\": 1"), 9, "\"mass\": -1");
  text.replace(text.find("\"type\": \"hinge\""), 15, "\"type\": \"hnige\"");
  std::ofstream(path) << text;
  const Outcome run = substep("run \"" + path.string() + "\"");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, path.string() + ": /bodies/0/mass: must be above 0 (kg), not -1\n" +
                         path.string() +
                         ": /joints/0/type: \"hnige\" is not ball, hinge or prismatic\n");
}

}  // namespace
}  // namespace substep
