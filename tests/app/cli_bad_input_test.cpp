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

TEST_P(BadCommandLine, EndsWithTwoAndNamesTheAllowedValues) {
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
                "--n-max: must be a whole number from 1 to 10000, not 0"},
        BadCall{"SolverOfNoKind", "run bridge --solver admm",
                "--solver: must be pgs, bpp, xpbd or newton, not admm"},
        BadCall{"ModeOfNoKind", "hash bridge --mode fast",
                "--mode: must be none, const, damping, adaptive, capped, stiffness, inertia or "
                "blend, not fast"},
        BadCall{"NegativeSeconds", "run bridge --seconds -1",
                "--seconds: must be from 0 to 86400, not -1"},
        BadCall{"SecondsNoNumber", "run bridge --seconds nan",
                "--seconds: must be from 0 to 86400, not nan"},
        BadCall{"LoadNoNumber", "run bridge --load nan", "--load: must be from "},
        BadCall{"ErrorNoNumber", "recommend pendulum --error nan",
                "--error: must be from 1e-15 to 1e15, not nan"},
        BadCall{"AngleNoNumber", "generate rope --angle nan",
                "--angle: must be from -89 to 89, not nan"},
        BadCall{"SecondsAndFrames", "run bridge --seconds 1 --frames 1", "excludes"},
        BadCall{"UnknownFlag", "run bridge --speed 3", "--speed"},
        BadCall{"UnknownCommand", "chek",
                "no command is called chek (did you mean \"check\"?)\n"
                "Commands: run sweep cost recommend doctor merge reproduce check exam hash scenes "
                "generate import export map\n"},
        BadCall{"JobsZero", "sweep pendulum --jobs 0",
                "--jobs: must be a whole number from 1 to 1024, not 0"},
        BadCall{"ErrorOfNoKind", "recommend pendulum --of speed",
                "--of: must be path, energy, gap or overlap, not speed"},
        BadCall{"NoCommand", "", "subcommand"},
        BadCall{"NoScene", "run", "scene or --experiments is required"},
        BadCall{"NoSceneToCheck", "check", "scene or --all is required"},
        BadCall{"TwoResultsOnStandardOutput", "run bridge --csv - --json -",
                "already used by --csv"},
        BadCall{"ReportAndBadgeOnStandardOutput", "doctor pendulum --html - --badge -",
                "--badge: standard output is already used by --html"},
        BadCall{"StatesAndJointsOnStandardOutput", "run bridge --states - --joints -",
                "--joints: standard output is already used by --states"},
        BadCall{"StatesInNoFolder", "run bridge --frames 1 --states /no/such/folder/a.csv",
                "/no/such/folder/a.csv: No such file or directory"},
        BadCall{"ExportOfNoScene", "export brigde",
                "brigde: no such scene or file (did you mean \"bridge\"?)"},
        BadCall{"ExportInNoFolder", "export pendulum --out /no/such/folder/a.xml",
                "/no/such/folder/a.xml: No such file or directory"},
        BadCall{"ExportOfNothing", "export", "scene is required"},
        BadCall{"UnknownScene", "run brigde",
                "brigde: no such scene or file (did you mean \"bridge\"?)"},
        BadCall{"SceneIsAFolder", "run /", "/: cannot read /: "},
        BadCall{"CsvInNoFolder", "run bridge --frames 1 --csv /no/such/folder/a.csv",
                "/no/such/folder/a.csv: No such file or directory"},
        BadCall{"AngleBeyondRange", "generate rope --angle 100",
                "--angle: must be from -89 to 89, not 100"},
        BadCall{"LinkWithoutWidth", "generate rope --link-width 0", "--link-width: must be from "},
        BadCall{"LinkMassNegative", "generate rope --link-mass -1", "--link-mass: must be from "},
        BadCall{"BoxSizeNoNumber", "generate rope --box-size nan", "--box-size: must be from "},
        BadCall{"AnchorTooFar", "generate rope --anchor 0 2e5 0",
                "--anchor: must be from -100000 to 100000, not 2e5"},
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
  EXPECT_EQ(run.err, path.string() + ": /bodies/0/mass: must be at least 1e-30 (kg), not -1\n" +
                         path.string() +
                         ": /joints/0/type: must be ball, hinge, prismatic, weld, distance, "
                         "universal, cylindrical or rope, not \"hnige\"\n");
}

}  // namespace
}  // namespace substep
