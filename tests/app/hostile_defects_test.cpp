// Defects that hostile inputs have found in the command line, one a line: what is there, what is
// called, and how it must end.

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/app/program.hpp"

namespace substep {
namespace {

struct Defect {
  const char* before;   // shell commands in the folder; RESULTS is a valid results file
  const char* command;  // arguments of the program
  int exit_code;
  const char* message;  // a part of stderr
  const char* after;    // a shell test: what must be true then
};

// The folder has p.json, a pendulum, and r/results.jsonl, its sweep, with r/scene.json; m.xml, a
// model with the mesh a.obj; and g.urdf. Copies end in .copy.
const Defect kDefects[] = {
    // A sweep that is shipped onto its scene.
    {"", "sweep p.json --ship p.json", 2, "p.json is an input", "cmp p.json p.copy"},
    {"ln -s p.json l", "sweep p.json --ship l", 2, "l is an input", "cmp p.json p.copy"},
    {"ln p.json h", "sweep p.json --ship h", 2, "h is an input", "cmp p.json p.copy"},
    // A model and its files are inputs of every command.
    {"", "import m.xml --out m.xml", 2, "m.xml: it is an input", "cmp m.xml m.copy"},
    {"ln -s m.xml l", "import m.xml --out l", 2, "l: it is an input", "cmp m.xml m.copy"},
    {"", "import m.xml --out a.obj", 2, "a.obj: it is an input", "cmp a.obj a.copy"},
    {"", "run m.xml --frames 1 --quiet --csv a.obj", 2, "a.obj: it is an input",
     "cmp a.obj a.copy"},
    {"", "export m.xml --out a.obj", 2, "a.obj: it is an input", "cmp a.obj a.copy"},
    {"", "cost m.xml --frames 2 --json a.obj", 2, "a.obj: it is an input", "cmp a.obj a.copy"},
    {"", "doctor m.xml --no-runs --html a.obj", 3, "a.obj: it is an input", "cmp a.obj a.copy"},
    {"", "sweep m.xml --ship a.obj", 2, "a.obj: it is an input", "cmp a.obj a.copy"},
    {"", "recommend m.xml --frames 2 --out m.xml", 2, "m.xml: it is an input", "cmp m.xml m.copy"},
    {"", "export p.json --out ./p.json", 2, "p.json: it is an input", "cmp p.json p.copy"},
    // Files of a sweep's folder that are the same file.
    {"ln -sf scene.json r/report.html; cp r/scene.json s", "merge r --quiet", 2,
     "already used by scene.json", "cmp r/scene.json s"},
    {"ln -sf results.jsonl r/report.html", "merge r --quiet", 2, "already used by results",
     "cmp r/results.jsonl results.copy"},
    {"ln -sf scene.json r/report.html", "sweep p.json --seconds 0.05 --out r", 2,
     "already used by scene.json", "true"},
    {"mkdir d; ln -s scene.json d/report.html", "sweep p.json --seconds 0.05 --out d", 2,
     "already used by scene.json", "[ ! -e d/scene.json ]"},
    {"mkdir d; head -20 RESULTS >keep; ln keep d/results.jsonl; tail -5 RESULTS "
     ">d/results.1.jsonl; "
     "cp keep k",
     "merge d keep", 2, "d/results.jsonl: it is an input", "cmp keep k"},
    // A scene from a pipe is read once.
    {"mkfifo f; (cat p.json >f &)", "run f --frames 1 --quiet", 0, "", "true"},
    {"rm r/scene.json; mkfifo r/scene.json", "sweep p.json --seconds 0.05 --out r", 2,
     "r/scene.json: not a regular file", "true"},
    // A setting that the chosen method does not read.
    {"", "run p.json --frames 1 --solver bpp --iterations 5", 2,
     "--iterations: solver bpp does not read it, only pgs, xpbd and newton", "true"},
    {"", "run p.json --frames 1 --mode adaptive --n 5", 2, "--n: mode adaptive does not read it",
     "true"},
    {"", "hash p.json --frames 1 --mode const --n 5 --alpha 0.1", 2,
     "--alpha: mode const does not read it", "true"},
    {"", "cost p.json --frames 2 --mode adaptive --policy frame --memory 0.5", 2,
     "--memory: policy frame does not read it, only substep", "true"},
    {"", "run p.json --frames 1 --drift exact --solver bpp --tau 0.01", 2,
     "--tau: drift law exact does not read it, only soft", "true"},
    {"", "run p.json --frames 1 --quiet --drift soft --tau 0.01", 0, "", "true"},
    // Results from a pipe in the folder are not waited for.
    {"mkdir d; mkfifo d/results.jsonl; cp RESULTS d/results.1.jsonl", "merge d", 2,
     "d/results.jsonl: not a regular file", "true"},
    {"mkdir d; mkfifo d/results.1.jsonl", "merge d", 2, "d/results.1.jsonl: not a regular file",
     "[ ! -e d/results.jsonl ]"},
    // Results that contradict themselves.
    {"mkdir d; sed '2s/\"seconds\":0.05/\"seconds\":86401/' RESULTS >d/results.1.jsonl", "merge d",
     2, "d/results.1.jsonl:2: /seconds: must be at most 86400 (s)", "true"},
    {"mkdir d; sed '2s/\"frames\":3/\"frames\":0/' RESULTS >d/results.1.jsonl", "merge d", 2,
     "/substeps: must be 0 in a run without frames", "true"},
    {"mkdir d; sed '2s/\"verdict\":\"/&not /' RESULTS >d/results.1.jsonl", "merge d", 2,
     ":2: /verdict: must be", "true"},
    {"mkdir d; sed '2s/\"seed\":0/\"seed\":0.0/' RESULTS >d/results.1.jsonl", "merge d --quiet", 0,
     "", "true"},
    // Results with a field of another type, out of range, or that contradicts another.
    {"mkdir d; sed '2s/\"seconds\":0.05/\"seconds\":\"x\"/' RESULTS >d/results.1.jsonl", "merge d",
     2, "d/results.1.jsonl:2: /seconds: must be a number", "[ ! -e d/results.jsonl ]"},
    {"mkdir d; sed '3s/\"holds\":[a-z]*/\"holds\":7/' RESULTS >d/results.1.jsonl", "merge d", 2,
     "d/results.1.jsonl:3: /holds: must be true or false", "true"},
    {"mkdir d; sed '2s/\"alpha\":[0-9.e-]*/\"alpha\":\"x\"/' RESULTS >d/results.1.jsonl", "merge d",
     2, "d/results.1.jsonl:2: /settings/alpha: must be", "true"},
    {"mkdir d; sed '2s/\"alpha\":[0-9.e-]*/\"alpha\":0.77/' RESULTS >d/results.1.jsonl", "merge d",
     2, "the id of this experiment", "true"},
    {"mkdir d; sed '2s/\"substeps\":[0-9]*/\"substeps\":-1/' RESULTS >d/results.1.jsonl", "merge d",
     2, "/substeps: must be a whole number from 0", "true"},
    {"mkdir d; sed '2s/\"flops\":[0-9]*/\"flops\":0.5/' RESULTS >d/results.1.jsonl", "merge d", 2,
     "/flops: must be a whole number", "true"},
    {"mkdir d; sed '2s/\"peak\":[0-9.e-]*/\"peak\":[]/' RESULTS >d/results.1.jsonl", "merge d", 2,
     "/peak: must be a number", "true"},
    {"mkdir d; sed '2s/\"scene_hash\":\"./\"scene_hash\":\"0/' RESULTS >d/results.1.jsonl",
     "merge d", 2, ":2: /id: must be", "true"},
    {"mkdir d; sed '2s/\"series\":\"/\"series\":\"x/' RESULTS >d/results.1.jsonl", "merge d", 2,
     ":2: /series: must be", "true"},
    {"mkdir d; sed '2s/\"timing\":{/&\"colour\":1,/' RESULTS >d/results.1.jsonl", "merge d", 2,
     ":2: /timing/colour: unknown key", "true"},
    {"mkdir d; sed '2s/\"reference\":{/\"ref\":{/' RESULTS >d/results.1.jsonl", "merge d", 2,
     ":2: /reference: missing", "true"},
    {"sed -i '2s/\"seed\":0/\"seed\":1.5/' RESULTS", "sweep p.json --seconds 0.05 --out r", 2,
     "r/results.jsonl:2: /seed: must be a whole number", "true"},
    {"mkdir d; sed '2s/.*//' RESULTS >d/results.1.jsonl", "merge d", 2,
     "d/results.1.jsonl:2: the line is empty", "true"},
    // Results of another scene.
    {"", "merge r --scene wall", 2, ":2: /scene_hash: a result of another scene: must be of wall, ",
     "[ ! -e r/report.html ] || cmp r/report.html report.copy"},
    {"mkdir d; cp RESULTS d/results.1.jsonl; sed 's/-9.81/-5/' p.json >q.json",
     "merge d --scene q.json", 2, "a result of another scene of this name",
     "[ ! -e d/results.jsonl ]"},
    {"sed -i 's/-9.81/-5/' p.json; rm r/scene.json", "sweep p.json --seconds 0.05 --out r", 2,
     "r/results.jsonl:2: /scene_hash: ", "cmp r/results.jsonl results.copy"},
    {"sed 's/-9.81/-5/' p.json >q.json; PROGRAM sweep q.json --seconds 0.05 --out d; rm "
     "d/scene.json",
     "merge d", 2, "is not that of pendulum in `substep scenes`", "true"},
    {"mkdir d; cp RESULTS d/results.1.jsonl", "merge d", 0, "", "[ -e d/results.jsonl ]"},
    {"PROGRAM sweep wall --seconds 0.01 --out d; cp RESULTS d/results.1.jsonl; rm d/scene.json",
     "merge d", 2, "d/results.1.jsonl:2: /scene_hash: a result of another scene", "true"},
    // A last line without a line feed is a result; one that is cut short is reported.
    {"printf %s \"$(cat RESULTS)\" >t; mkdir d; mv t d/results.1.jsonl", "merge d --quiet", 0, "",
     "cmp d/results.jsonl results.copy"},
    {"printf %s \"$(cat RESULTS)\" >t; mv t RESULTS", "sweep p.json --seconds 0.05 --out r", 0, "",
     "cmp r/results.jsonl results.copy"},
    {"mkdir d; head -c -9 RESULTS >d/results.1.jsonl", "merge d --quiet", 0,
     "the last line is cut short; it is left out", "true"},
    {"truncate -s -9 RESULTS", "sweep p.json --seconds 0.05 --out r --quiet", 0,
     "the last line is cut short; it is removed", "[ $(wc -l <RESULTS) = $(wc -l <results.copy) ]"},
    // One that is not the beginning of a result is not removed.
    {"printf 'do not delete me' >>RESULTS", "sweep p.json --seconds 0.05 --out r", 2,
     "it is unchanged", "grep -q 'do not delete me' RESULTS"},
    {"mkdir d; { cat RESULTS; printf '[1,2]'; } >d/results.1.jsonl", "merge d", 2,
     "d/results.1.jsonl:", "[ ! -e d/results.jsonl ]"},
    // The scene of an earlier sweep is damaged.
    {"echo '{' >r/scene.json", "sweep p.json --seconds 0.05 --out r", 2, "r/scene.json: damaged",
     "cmp r/results.jsonl results.copy"},
    {"echo '{' >r/scene.json", "merge r", 2, "r/scene.json: line 2, column 1",
     "cmp r/results.jsonl results.copy"},
    // Links with the names of temporary files.
    {"echo kept >k; ln -s ../k r/results.jsonl.new; sed -n '1p;3p;2p;4,$p' RESULTS >t; mv t "
     "RESULTS",
     "sweep p.json --seconds 0.05 --out r --quiet", 0, "",
     "[ \"$(cat k)\" = kept ] && [ -L r/results.jsonl.new ]"},
    // Flags that would be ignored.
    {"", "sweep pendulum --list --mode none", 2, "--mode: is no flag of sweep", "true"},
    {"", "sweep pendulum --list --solver pgs", 2, "--solver: is no flag of sweep", "true"},
    {"", "sweep pendulum --list --integrator euler", 2, "--integrator: is no flag of sweep",
     "true"},
    {"", "sweep pendulum --list --preset paper", 2, "--preset: is no flag of sweep", "true"},
    {"", "sweep pendulum --list --forces end", 2, "--forces: is no flag of sweep", "true"},
    {"", "sweep pendulum --list --drift soft", 2, "--drift: is no flag of sweep", "true"},
    {"", "sweep pendulum --list --policy frame", 2, "--policy: is no flag of sweep", "true"},
    {"", "sweep pendulum --list --detection frame", 2, "--detection: is no flag of sweep", "true"},
    {"", "sweep pendulum --list --n 3", 2, "--n: is no flag of sweep", "true"},
    {"", "sweep pendulum --list --islands", 2, "--islands: is no flag of sweep", "true"},
    {"", "sweep pendulum --list --no-sleep", 2, "--sleep: is no flag of sweep", "true"},
    {"", "sweep pendulum --list --jobs 1", 2, "--jobs excludes --list", "true"},
    {"", "sweep pendulum --ship s --seconds 1", 2, "--seconds excludes --ship", "[ ! -e s ]"},
    {"", "sweep pendulum --ship s --seeds 2", 2, "--seeds excludes --ship", "[ ! -e s ]"},
    {"", "sweep pendulum --ship s --iterations 9", 2, "--iterations excludes --ship", "[ ! -e s ]"},
    {"", "sweep pendulum --ship s --shard 1/2", 2, "--shard excludes --ship", "[ ! -e s ]"},
    {"", "sweep pendulum --ship s --list", 2, "--list excludes --ship", "[ ! -e s ]"},
    {"", "sweep pendulum --ship s --out o", 2, "--out excludes --ship", "[ ! -e s ]"},
    {"", "sweep pendulum --ship s --quiet", 2, "--quiet excludes --ship", "[ ! -e s ]"},
    {"", "check --hard --json", 2, "--json excludes --hard", "true"},
    {"", "check --hard --own", 2, "--own excludes --hard", "true"},
    {"", "check --hard --seed 1", 2, "--seed excludes --hard", "true"},
    {"", "check --hard --all", 2, "--all excludes --hard", "true"},
    {"", "check --hard pendulum", 2, "scene excludes --hard", "true"},
    {"", "run pendulum --frames 1 --sleep --no-sleep", 2, "--sleep excludes --no-sleep", "true"},
    {"", "run pendulum --frames 1 --no-islands --islands", 2, "--islands excludes --no-islands",
     "true"},
    {"", "run pendulum --frames 1 --alpha 0.1 --alpha 0.2", 2, "--alpha", "true"},
    {"", "run pendulum --frames 1 --preset paper --preset steady", 2, "--preset", "true"},
    {"", "exam --list --quiet", 2, "excludes --", "true"},
    {"", "doctor pendulum --no-runs --seconds 5", 2, "--seconds excludes --no-runs", "true"},
    {"", "doctor pendulum --no-runs --work-budget 1e6", 2, "--no-runs excludes --work-budget",
     "true"},
    {"", "doctor pendulum --no-runs --memory-budget 9", 2, "--no-runs excludes --memory-budget",
     "true"},
    {"", "import m.xml --free-root", 2, "only the root link of URDF", "true"},
    {"", "import g.urdf --key home", 2, "only MJCF has keyframes", "true"},
    {"", "merge p.json", 2, "p.json: it is not a folder", "true"},
};

/// Runs a script in a folder. @return its exit code
int shell(const fs::path& at, std::string script) {
  const auto replace = [&](const std::string& word, const std::string& by) {
    for (std::size_t i = 0; (i = script.find(word, i)) != std::string::npos; i += by.size()) {
      script.replace(i, word.size(), by);
    }
  };
  replace("RESULTS", "r/results.jsonl");
  replace("PROGRAM", SUBSTEP_PROGRAM);
  const fs::path file = at.string() + ".sh";
  std::ofstream(file) << "set -e\ncd \"" << at.string() << "\"\n" << script << '\n';
  const int status = std::system(("bash \"" + file.string() + "\" >/dev/null 2>&1").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

const char* const kMesh =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const char* const kModel = R"(<mujoco><asset><mesh name="a" file="a.obj"/></asset><worldbody>
<body pos="0 0 1"><joint axis="0 1 0"/><geom type="mesh" mesh="a" mass="1"/></body>
</worldbody></mujoco>)";
const char* const kUrdf = R"(<robot name="r"><link name="a"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>)";

TEST(HostileDefects, StayMended) {
  const fs::path whole = folder() / "whole";
  fs::remove_all(whole);
  fs::create_directories(whole);
  fs::copy_file(SUBSTEP_SOURCE_DIR "/scenes/pendulum.json", whole / "p.json");
  std::ofstream(whole / "a.obj") << kMesh;
  std::ofstream(whole / "m.xml") << kModel;
  std::ofstream(whole / "g.urdf") << kUrdf;
  const std::string go = "cd \"" + whole.string() + "\" &&";
  ASSERT_EQ(substep("sweep p.json --seconds 0.05 --out r --quiet", go).exit_code, 0);
  ASSERT_EQ(
      shell(whole,
            "for f in p.json m.xml a.obj; do cp $f ${f%.*}.copy; done; cp RESULTS results.copy; "
            "[ ! -e r/report.html ] || cp r/report.html report.copy"),
      0);
  const fs::path at = folder() / "files";
  for (const Defect& defect : kDefects) {
    const std::string what = std::string(defect.before) + "; " + defect.command;
    fs::remove_all(at);
    fs::copy(whole, at, fs::copy_options::recursive);
    ASSERT_EQ(shell(at, defect.before), 0) << what;
    const Outcome run = substep(defect.command, "cd \"" + at.string() + "\" &&");
    EXPECT_EQ(run.exit_code, defect.exit_code) << what << '\n' << run.err;
    EXPECT_NE(run.err.find(defect.message), std::string::npos) << what << '\n' << run.err;
    EXPECT_EQ(shell(at, defect.after), 0) << what << "\nthen: " << defect.after;
  }
}

}  // namespace
}  // namespace substep
