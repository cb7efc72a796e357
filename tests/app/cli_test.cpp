// The command line, run as a program.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/json.hpp"
#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/model/names.hpp"
#include "core/model/number_text.hpp"
#include "core/model/setting_fields.hpp"
#include "core/sim/simulator.hpp"
#include "tests/app/program.hpp"

namespace substep {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> cells;
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

TEST(CommandLine, RunEndsWithTheVerdict) {
  const Outcome holds = substep("run pendulum --seconds 1");
  EXPECT_EQ(holds.exit_code, 0) << holds.err;
  EXPECT_EQ(lines_of(holds.out).back(), "holds");
  EXPECT_EQ(holds.err, "") << "progress is for terminals only";

  const Outcome fails = substep("run swinging_box --mode none --seconds 1");
  EXPECT_EQ(fails.exit_code, 0) << "a run that fails is a result";
  EXPECT_EQ(lines_of(fails.out).back().find("fails at 0.3"), 0U) << fails.out;
}

TEST(CommandLine, RunPrintsTheMethod) {
  const Outcome run =
      substep("run swinging_box --frames 6 --solver pgs --iterations 7 --mode capped --n-cap 3");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(lines_of(run.out).front(),
            "swinging_box: pgs 7, capped at 3, alpha 0.1, decided per frame, euler, drift soft");
  EXPECT_NE(run.out.find("in 6 frames"), std::string::npos);
}

TEST(CommandLine, CsvHasTheColumnsOfTheScenesEffects) {
  const auto header = [](const std::string& scene) {
    return lines_of(substep("run " + scene + " --frames 1 --csv -").out).front();
  };
  EXPECT_EQ(
      header("swinging_box"),
      "frame,time,substeps,discarded,substeps_mean,islands,asleep,substeps_wanted,capped,dt_min,dt_"
      "max,dt_"
      "stable,r,leader,leader_dof,"
      "kinetic,potential,elastic,energy,px,py,pz,lx,ly,lz,constraint_error,joint_gap,joint_rows,"
      "iterations,"
      "pivots,"
      "unsolved,residual,x,y,z,ms");
  EXPECT_EQ(
      header("spinning_top"),
      "frame,time,substeps,discarded,substeps_mean,islands,asleep,substeps_wanted,capped,dt_"
      "min,dt_max,dt_"
      "stable,r,leader,leader_dof,"
      "kinetic,elastic,energy,px,py,pz,lx,ly,lz,iterations,pivots,unsolved,residual,x,y,z,ms");
  EXPECT_EQ(header("heavy_stack"),
            "frame,time,substeps,discarded,substeps_mean,islands,asleep,substeps_wanted,capped,dt_"
            "min,dt_max,dt_"
            "stable,r,leader,leader_dof,"
            "kinetic,potential,elastic,energy,parting,px,py,pz,lx,ly,lz,penetration,contact_rows,"
            "iterations,pivots,"
            "unsolved,residual,"
            "x,y,z,ms");
  EXPECT_NE(header("bridge").find("contact_rows,friction_rows,"), std::string::npos);
}

TEST(CommandLine, AModelWorksWhereASceneDoes) {
  const std::string model = "\"" SUBSTEP_SOURCE_DIR "/tests/import/models/arm.xml\"";
  const fs::path scene = folder() / "arm.json";
  ASSERT_EQ(substep("import " + model + " --out \"" + scene.string() + "\"").exit_code, 0);
  const Outcome of_scene = substep("hash \"" + scene.string() + "\" --frames 3");
  ASSERT_EQ(of_scene.exit_code, 0) << of_scene.err;
  const Outcome of_model = substep("hash " + model + " --frames 3");
  EXPECT_EQ(of_model.exit_code, 0) << of_model.err;
  EXPECT_EQ(of_model.out, of_scene.out);
  EXPECT_NE(of_model.err.find("parts are left out: see `substep import`"), std::string::npos)
      << of_model.err;
  EXPECT_EQ(substep("doctor " + model + " --no-runs").err.find("Exit"), std::string::npos);
}

TEST(CommandLine, CsvHasEveryFrameInFullPrecision) {
  const fs::path csv = folder() / "run.csv";
  const Outcome run = substep("run swinging_box --frames 5 --csv \"" + csv.string() + "\"");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::vector<std::string> lines = lines_of(text_of(csv));
  ASSERT_EQ(lines.size(), 6U);
  const std::vector<std::string> names = cells_of(lines[0]);
  const auto column = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const auto scene = read_scene_file(SUBSTEP_SOURCE_DIR "/scenes/swinging_box.json").scene;
  ASSERT_NE(scene, nullptr);
  Simulator simulator(scene);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const FrameReport report = simulator.step();
    const std::vector<std::string> cells = cells_of(lines[i]);
    ASSERT_EQ(cells.size(), names.size());
    EXPECT_EQ(cells[column("frame")], std::to_string(i));
    EXPECT_EQ(cells[column("substeps")], std::to_string(report.n_substeps));
    EXPECT_EQ(parse_number(cells[column("energy")]), report.energy);
    EXPECT_EQ(parse_number(cells[column("x")]), simulator.state().x.back().x());
  }
}

TEST(CommandLine, StatesAndJointsHaveEveryBodyAndFrameInFullPrecision) {
  const fs::path states = folder() / "states.csv";
  const fs::path joints = folder() / "joints.csv";
  const Outcome run = substep("run swinging_box --frames 3 --states \"" + states.string() +
                              "\" --joints \"" + joints.string() + "\"");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::vector<std::string> poses = lines_of(text_of(states));
  const std::vector<std::string> forces = lines_of(text_of(joints));
  EXPECT_EQ(poses[0], "frame,time,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz");
  EXPECT_EQ(forces[0], "frame,time,joint,fx,fy,fz,tx,ty,tz,gap,force_time");
  const auto scene = read_scene_file(SUBSTEP_SOURCE_DIR "/scenes/swinging_box.json").scene;
  ASSERT_NE(scene, nullptr);
  ASSERT_EQ(poses.size(), 1 + 4 * scene->bodies.size()) << "the start and the floor are included";
  ASSERT_EQ(forces.size(), 1 + 3 * scene->joints.size());
  EXPECT_EQ(cells_of(poses[1])[2], "floor");
  Simulator simulator(scene);
  for (std::size_t frame = 0; frame <= 3; ++frame) {
    const State& state = simulator.state();
    const std::vector<std::string> box = cells_of(poses[(frame + 1) * scene->bodies.size()]);
    EXPECT_EQ(box[0] + ' ' + box[2], std::to_string(frame) + " box");
    EXPECT_EQ(parse_number(box[1]), state.time);
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      EXPECT_EQ(parse_number(box[3 + at]), state.x.back()[i]);
      EXPECT_EQ(parse_number(box[7 + at]), state.q.back().vec()[i]);
      EXPECT_EQ(parse_number(box[10 + at]), state.u_synchronised.back()[i]);
      EXPECT_EQ(parse_number(box[13 + at]), state.u_synchronised.back()[3 + i]);
    }
    if (frame > 0) {
      const std::vector<std::string> hinge = cells_of(forces[frame * scene->joints.size()]);
      const JointForce force = simulator.constraint_forces().joints.back();
      EXPECT_EQ(hinge[2], "hinge_25");
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(parse_number(hinge[3 + i]), force.force[static_cast<int>(i)]);
        EXPECT_EQ(parse_number(hinge[6 + i]), force.torque[static_cast<int>(i)]);
      }
    }
    simulator.step();
  }
}

TEST(CommandLine, TwoResultsInOneFileAreRefused) {
  const std::string file = (folder() / "one.csv").string();
  const std::string same = (folder() / "." / "one.csv").string();
  for (const bool exists : {false, true}) {
    if (exists) std::ofstream(file) << "kept";
    const Outcome run =
        substep("run pendulum --frames 1 --csv \"" + file + "\" --states \"" + same + "\"");
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_NE(run.err.find("--states: " + same + " is already used by --csv"), std::string::npos)
        << run.err;
  }
  EXPECT_EQ(text_of(file), "kept");
  EXPECT_EQ(substep("run pendulum --frames 1 --csv /dev/null --states /dev/null").exit_code, 0);
}

TEST(CommandLine, CsvOnStandardOutputIsAlone) {
  const Outcome run = substep("run free_fall --frames 2 --csv -");
  EXPECT_EQ(lines_of(run.out).size(), 3U) << run.out;
  EXPECT_EQ(lines_of(run.err).back(), "holds");
}

TEST(CommandLine, JsonHasSettingsFramesAndVerdict) {
  const Outcome run = substep("run free_fall --frames 3 --mode const --n 2 --json -");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json json = Json::parse(run.out, nullptr, false);
  ASSERT_TRUE(json.is_object()) << run.out;
  EXPECT_EQ(json["scene"], "free_fall");
  EXPECT_EQ(json["settings"]["mode"], "const");
  EXPECT_EQ(json["settings"]["n"], 2);
  EXPECT_EQ(json["start"]["consistent"], true);
  EXPECT_EQ(json["start"]["energy_found"], json["start"]["energy_begun"]);
  EXPECT_EQ(json["frames"].size(), 3U);
  EXPECT_EQ(json["frames"][2]["substeps"], 2);
  EXPECT_TRUE(json["frames"][0]["dt_stable"].is_null());
  EXPECT_EQ(json["work"]["substeps"], 6);
  EXPECT_GT(json["timing"]["stages"]["total"], 0.0);
  EXPECT_EQ(json["holds"], true);
  EXPECT_EQ(json["verdict"], "holds");
  EXPECT_EQ(json["hash"].get<std::string>().size(), 16U);
}

TEST(CommandLine, CostReportsStagesRowsEffectsAndTheCriterion) {
  const Outcome people = substep("cost bridge --seconds 0.5");
  ASSERT_EQ(people.exit_code, 0) << people.err;
  for (const char* line : {"\njoint rows ", "\nsolve ", "\ncriterion ", "\nfriction ",
                           "The criterion: ", "\nholds\n"}) {
    EXPECT_NE(people.out.find(line), std::string::npos) << line << people.out;
  }
  const Outcome run = substep("cost bridge --seconds 0.5 --solver pgs --json -");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json json = Json::parse(run.out, nullptr, false);
  ASSERT_TRUE(json.is_object()) << run.out;
  EXPECT_EQ(json["settings"]["solver"], "pgs");
  EXPECT_GT(json["work"]["rows"]["friction"], 0);
  EXPECT_GT(json["work"]["criterion"]["flops"], 0);
  EXPECT_GT(json["timing"]["stages"]["solve"], 0.0);
  EXPECT_GT(json["effects"]["friction"]["flops"], 0.0);
  EXPECT_FALSE(json["effects"].contains("restitution"));
}

TEST(CommandLine, RecommendFindsTheCheapestWithinAnErrorAndTheMostExactWithinACost) {
  const Outcome error = substep("recommend pendulum --error 1e-2 --seconds 2");
  EXPECT_EQ(error.exit_code, 0) << error.err;
  EXPECT_NE(error.out.find("The cheapest within 0.01 m: "), std::string::npos) << error.out;
  EXPECT_NE(error.out.find("the largest alpha that meets the limit is "), std::string::npos)
      << error.out;
  const std::size_t command = error.out.find("substep run pendulum");
  ASSERT_NE(command, std::string::npos);
  const std::string line = error.out.substr(command, error.out.find('\n', command) - command);
  EXPECT_EQ(substep(line.substr(8) + " --seconds 2").exit_code, 0) << "the printed command runs";
  const Outcome cost = substep("recommend pendulum --operations 3000 --seconds 2");
  EXPECT_NE(cost.out.find("The most accurate within 3e+03 operations per frame: "),
            std::string::npos)
      << cost.out;
  EXPECT_NE(cost.out.find("the smallest alpha that meets the limit is "), std::string::npos)
      << cost.out;
  EXPECT_EQ(substep("recommend pendulum --error 1e-15 --seconds 1").exit_code, 1);
  EXPECT_EQ(substep("recommend pendulum --error 1 --ms 1").exit_code, 2);
  EXPECT_EQ(substep("recommend pendulum --of colour").exit_code, 2);
  const Outcome overlap = substep("recommend pendulum --of overlap");
  EXPECT_EQ(overlap.exit_code, 2);
  EXPECT_NE(overlap.err.find("it has no contacts: --of path, energy or gap"), std::string::npos)
      << overlap.err;
}

// A run that is accurate for half a second may fail in the next.
TEST(CommandLine, RecommendTriesTheWholeDurationOfTheScene) {
  Scene scene = *read_scene_file(SUBSTEP_SOURCE_DIR "/scenes/swinging_box.json").scene;
  scene.criteria.duration = 1.0;
  std::ofstream(folder() / "box.json") << write_scene(scene);
  const std::string box = "\"" + (folder() / "box.json").string() + "\"";
  const Outcome found = substep("recommend " + box + " --error 0.5 --seconds 0.3 --out " + box);
  EXPECT_EQ(found.exit_code, 0) << found.err;
  EXPECT_NE(found.out.find("runs hold for 0.3 s"), std::string::npos) << found.out;
  EXPECT_NE(found.out.find("Cheaper, but no recommendation: bpp, const, euler, n = 1 fails at 0.3"),
            std::string::npos)
      << found.out;
  EXPECT_NE(found.out.find("It holds for 1 s. Errors and costs are those of the first 0.3 s."),
            std::string::npos)
      << found.out;
  const auto kept = read_scene_file((folder() / "box.json").string()).scene;
  ASSERT_NE(kept, nullptr);
  ASSERT_TRUE(kept->recommended.has_value());
  EXPECT_NE(kept->recommended->why.find("It holds for 1 s, a cheaper one does not."),
            std::string::npos)
      << kept->recommended->why;
  EXPECT_EQ(lines_of(substep("run " + box).out).back(), "holds");
}

TEST(CommandLine, RecommendChoosesABodyIfNoneIsTracked) {
  const auto scene_of = [](const std::string& bodies) {
    return R"({"format": "substep-scene", "version": 2, "name": "own", "title": "Own",
               "criteria": {"duration": 1}, "bodies": [)" +
           bodies + "]}";
  };
  const std::string own = "\"" + (folder() / "own.json").string() + "\"";
  std::ofstream(folder() / "own.json") << scene_of(
      R"({"name": "floor", "static": true, "shape": {"type": "plane"}, "position": [0, 0, 0]},
         {"name": "slow", "shape": {"type": "sphere", "radius": 0.1}, "mass": 1,
          "position": [3, 0.3, 0]},
         {"name": "fast", "shape": {"type": "sphere", "radius": 0.1}, "mass": 1,
          "position": [0, 1, 0], "velocity": [4, 0, 0]})");
  const Outcome found = substep("recommend " + own + " --error 1e-3 --out " + own);
  EXPECT_EQ(found.exit_code, 0) << found.out << found.err;
  EXPECT_NE(found.out.find("No body is tracked: the path of 'fast' is compared."),
            std::string::npos)
      << found.out;
  const auto kept = read_scene_file((folder() / "own.json").string()).scene;
  ASSERT_NE(kept, nullptr);
  EXPECT_EQ(kept->criteria.track, 2) << "what the recommendation is about";
  const Outcome energy = substep("recommend " + own + " --of energy");
  EXPECT_NE(energy.out.find("The true motion does not keep its energy (impacts)"),
            std::string::npos)
      << energy.out;

  std::ofstream(folder() / "own.json") << scene_of(
      R"({"name": "ball", "shape": {"type": "sphere", "radius": 0.1}, "mass": 1,
          "position": [3, 0.3, 0]})");
  const Outcome none = substep("recommend " + own + " --seconds 0");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("no body leaves its place"), std::string::npos) << none.err;
}

TEST(CommandLine, RecommendPromisesNoMoreThanTheReferenceAllows) {
  const std::string file = "\"" + (folder() / "rocker.json").string() + "\"";
  const Outcome found = substep("recommend crank_rocker --error 1e-12 --seconds 0.2 --out \"" +
                                (folder() / "none.json").string() + "\"");
  EXPECT_EQ(found.exit_code, 1) << found.out;
  EXPECT_NE(found.out.find("4096 sub-steps per frame) is uncertain by "), std::string::npos)
      << found.out;
  EXPECT_NE(found.out.find("m are not promised."), std::string::npos) << found.out;
  EXPECT_FALSE(fs::exists(folder() / "none.json")) << "it is not what was asked for";

  Scene scene = *read_scene_file(SUBSTEP_SOURCE_DIR "/scenes/crank_rocker.json").scene;
  scene.criteria.joint_gap = 1e-12;
  std::ofstream(folder() / "rocker.json") << write_scene(scene);
  const Outcome failed = substep("recommend " + file + " --error 1e-3 --seconds 0.2");
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_NE(failed.out.find("No error of the path can be promised"), std::string::npos)
      << failed.out;
}

TEST(CommandLine, RecommendWritesTheSceneThatStartsWithIt) {
  const std::string rope = "\"" + (folder() / "rope.json").string() + "\"";
  ASSERT_EQ(substep("generate rope --links 3 --out " + rope).exit_code, 0);
  const Outcome found = substep("recommend " + rope + " --error 1e-3 --seconds 1 --out " + rope);
  ASSERT_EQ(found.exit_code, 0) << found.err;
  const auto scene = read_scene_file((folder() / "rope.json").string()).scene;
  ASSERT_NE(scene, nullptr);
  ASSERT_TRUE(scene->recommended.has_value());
  EXPECT_EQ(scene->settings, scene->recommended->settings);
  EXPECT_NE(scene->settings, PaperSettings{});
  EXPECT_LE(scene->recommended->reached, 1e-3);
  EXPECT_EQ(scene->recommended->seconds, 1.0);

  // A run starts with it, and --preset selects it again.
  const auto json_of = [&](const std::string& flags) {
    return Json::parse(substep("run " + rope + " --seconds 1 --json - " + flags).out, nullptr,
                       false);
  };
  const Json plain = json_of("");
  for (const SettingField& field : setting_fields()) {
    const Json& value = plain["settings"][std::string(field.name)];
    EXPECT_EQ(value.is_string() ? value.get<std::string>() : value.dump(),
              setting_text(field, scene->settings))
        << field.name;
  }
  const double frames = plain["work"]["frames"].get<double>();
  EXPECT_NEAR(plain["work"]["flops"].get<double>() / frames, scene->recommended->operations,
              0.01 * scene->recommended->operations);
  EXPECT_EQ(json_of("--solver pgs --preset recommended")["settings"]["solver"], "pgs")
      << "the preset comes before the other flags";
  EXPECT_EQ(json_of("--preset recommended")["hash"], plain["hash"]);
  EXPECT_NE(json_of("--preset paper")["hash"], plain["hash"]);

  // A recommendation does not depend on an earlier one.
  const std::string before = text_of(folder() / "rope.json");
  EXPECT_EQ(substep("recommend " + rope + " --error 1e-3 --seconds 1 --out -").out, before);
  // The scene's own settings remain the start.
  Scene own = *scene;
  own.settings = PaperSettings{.mode = Mode::kConst, .n = 5};
  own.recommended.reset();
  std::ofstream(folder() / "own.json") << write_scene(own);
  const Outcome kept = substep("recommend \"" + (folder() / "own.json").string() +
                               "\" --error 1e-3 --seconds 1 --out -");
  const auto with_own = read_scene(kept.out).scene;
  ASSERT_NE(with_own, nullptr) << kept.out;
  EXPECT_EQ(with_own->settings, own.settings);
  EXPECT_TRUE(with_own->recommended.has_value());

  // If nothing is within the error, nothing is written; a cost is not an error.
  const std::string none = "\"" + (folder() / "none.json").string() + "\"";
  EXPECT_EQ(substep("recommend " + rope + " --error 1e-15 --seconds 0.2 --out " + none).exit_code,
            1);
  EXPECT_FALSE(fs::exists(folder() / "none.json"));
  EXPECT_EQ(substep("recommend pendulum --ms 1 --out " + none).exit_code, 2);
  EXPECT_EQ(substep("recommend pendulum --all --error 1").exit_code, 2);
  EXPECT_NE(substep("recommend pendulum --all").out.find("\"pendulum\""), std::string::npos);
  EXPECT_EQ(substep("recommend --all --seconds 1").exit_code, 2);
  EXPECT_EQ(substep("recommend").exit_code, 2);
}

// With the methods that read it.
TEST(CommandLine, EverySettingIsAFlag) {
  std::set<std::string_view> given;
  for (const auto& [flags, settings] : std::initializer_list<std::pair<const char*, const char*>>{
           {"--solver pgs --iterations 3 --share-iterations --warm-start --mode blend --alpha 0.2 "
            "--n-cap 7 --alpha-m 0.5 --beta 0.8 --policy substep --memory 0.5 --hold 9 --redo "
            "--islands --sleep --no-probe --integrator leapfrog --gyroscopic explicit --drift soft "
            "--tau 0.01 --drift-order 2 --detection frame --contact-stiffness exact "
            "--no-rotation-criterion --friction-cone cone --watch-stiffness",
            R"({"solver": "pgs", "iterations": 3, "share_iterations": true, "warm_start": true,
                "mode": "blend", "alpha": 0.2, "n_cap": 7, "alpha_m": 0.5, "beta": 0.8,
                "policy": "substep", "memory": 0.5, "hold": 9, "redo": true, "islands": true,
                "sleep": true, "probe": false, "integrator": "leapfrog",
                "gyroscopic": "explicit", "drift": "soft", "tau": 0.01, "drift_order": 2,
                "detection": "frame", "contact_stiffness": "exact", "rotation_criterion": false,
                "friction_cone": "cone", "watch_stiffness": true})"},
           {"--solver newton --forces mean --pivots 4 --mode const --n 5",
            R"({"solver": "newton", "forces": "mean", "pivots": 4, "mode": "const", "n": 5})"},
           {"--solver bpp --refinements 2 --mode adaptive --n-max 6",
            R"({"solver": "bpp", "refinements": 2, "mode": "adaptive", "n_max": 6})"}}) {
    const Outcome run = substep(std::string("run free_fall --frames 1 --json - ") + flags);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Json used = Json::parse(run.out, nullptr, false)["settings"];
    const Json expected = Json::parse(settings);
    for (const SettingField& field : setting_fields()) {
      const auto value = expected.find(std::string(field.name));
      if (value == expected.end()) continue;
      given.insert(field.name);
      EXPECT_EQ(used[std::string(field.name)], *value) << field.name;
    }
  }
  EXPECT_EQ(given.size(), setting_fields().size());
}

TEST(CommandLine, HashIsThatOfTheState) {
  const auto scene = read_scene_file(SUBSTEP_SOURCE_DIR "/scenes/bridge.json").scene;
  ASSERT_NE(scene, nullptr);
  Simulator simulator(scene);
  Settings settings = scene->settings;
  settings.mode = Mode::kConst;
  simulator.set_settings(settings);
  for (int i = 0; i < 20; ++i) simulator.step();
  std::array<char, 32> hash{};
  std::snprintf(hash.data(), hash.size(), "%016llx\n",
                static_cast<unsigned long long>(state_hash(simulator.state())));
  EXPECT_EQ(substep("hash bridge --frames 20 --mode const --n 16").out, hash.data());
  EXPECT_NE(substep("hash bridge --frames 20 --mode const --n 15").out, hash.data());
}

TEST(CommandLine, RunReportsAnInconsistentStart) {
  const auto run_start = [](const std::string& start) {
    Scene scene = *read_scene_file(SUBSTEP_SOURCE_DIR "/scenes/pendulum.json").scene;
    scene.bodies[0].velocity = {1.2, 0.0, 0.0};
    scene.bodies[0].position.z() += 0.02;
    scene.start = *value_of<StartPolicy>(start);
    const fs::path path = folder() / (start + ".json");
    std::ofstream(path) << write_scene(scene);
    return substep("run \"" + path.string() + "\" --seconds 0.1");
  };
  const std::string found =
      "The start was inconsistent: joint 'hinge' open by 2 cm, 'hinge' moving apart at 1.2 m/s; ";
  const Outcome projected = run_start("project");
  EXPECT_EQ(projected.exit_code, 0) << projected.err;
  EXPECT_NE(projected.out.find("\n" + found + "projected. Energy "), std::string::npos)
      << projected.out;
  EXPECT_NE(run_start("keep").out.find("\n" + found + "kept. Energy "), std::string::npos);
  const Outcome refused = run_start("refuse");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("/joints/0: \"start\" is \"refuse\""), std::string::npos)
      << refused.err;
  EXPECT_EQ(substep("run pendulum --seconds 0.1").out.find("inconsistent"), std::string::npos);
}

TEST(CommandLine, MapIsATableAndAPicture) {
  const fs::path table = folder() / "map.csv";
  const fs::path picture = folder() / "map.svg";
  const Outcome map = substep("map --seconds 0.02 --out \"" + table.string() + "\" --picture \"" +
                              picture.string() + "\"");
  ASSERT_EQ(map.exit_code, 0) << map.err;
  const auto lines = lines_of(text_of(table));
  ASSERT_EQ(lines.size(), 1U + 3 * 7 * 7 * 2);
  EXPECT_EQ(lines.front(), "map,value,alpha,solver,holds,seconds,n_median,n_max,substeps");
  const std::string svg = text_of(picture);
  EXPECT_TRUE(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
  const auto count = [&](const std::string& what) {
    std::size_t n = 0;
    for (auto at = svg.find(what); at != std::string::npos; at = svg.find(what, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("class='cell'"), lines.size() - 1);
  EXPECT_EQ(count("<text"), count("</text>"));
}

TEST(CommandLine, CheckComparesWithTheExpectedVerdict) {
  EXPECT_EQ(substep("check pendulum free_fall").exit_code, 0);
  const fs::path path = folder() / "fails.json";
  std::string text = text_of(SUBSTEP_SOURCE_DIR "/scenes/swinging_box.json");
  const std::string paper = R"("preset": "paper")";
  text.replace(text.find(paper), paper.size(), paper + R"(, "mode": "none")");
  std::ofstream(path) << text;
  const Outcome unexpected = substep("check --own pendulum \"" + path.string() + "\"");
  EXPECT_EQ(unexpected.exit_code, 1);
  EXPECT_NE(unexpected.out.find("FAILED swinging_box"), std::string::npos) << unexpected.out;
  EXPECT_NE(unexpected.out.find("1 not as expected"), std::string::npos) << unexpected.out;

  text.replace(text.find("\"expected\": \"holds\""), 19, "\"expected\": \"fails\"");
  std::ofstream(path) << text;
  const Outcome expected = substep("check --own --json \"" + path.string() + "\"");
  EXPECT_EQ(expected.exit_code, 0);
  const Json json = Json::parse(expected.out, nullptr, false);
  EXPECT_EQ(json[0]["ok"], true);
  EXPECT_EQ(json[0]["expected"], "fails");
  EXPECT_EQ(substep("check no_such_scene pendulum").exit_code, 2);
}

TEST(CommandLine, ListsTheShippedScenes) {
  const Outcome table = substep("scenes");
  EXPECT_EQ(table.exit_code, 0);
  std::size_t files = 0;  // all but scene.schema.json
  for (const auto& entry : fs::directory_iterator(SUBSTEP_SOURCE_DIR "/scenes")) {
    files += entry.path().extension() == ".json" && !entry.path().stem().has_extension() ? 1U : 0U;
  }
  EXPECT_EQ(lines_of(table.out).size(), files + 1) << table.out;
  const Json json = Json::parse(substep("scenes --json").out, nullptr, false);
  ASSERT_EQ(json.size(), files);
  const auto bridge =
      std::find_if(json.begin(), json.end(), [](const Json& s) { return s["name"] == "bridge"; });
  ASSERT_NE(bridge, json.end());
  EXPECT_EQ((*bridge)["bodies"], 22);
}

TEST(CommandLine, TakesScenesFromTheFolderInTheEnvironment) {
  std::ofstream(folder() / "mine.json") << text_of(SUBSTEP_SOURCE_DIR "/scenes/free_fall.json");
  const Outcome run =
      substep("run mine --frames 1", "SUBSTEP_SCENES=\"" + folder().string() + "\"");
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

TEST(CommandLine, TheDoctorSaysByItsExitCodeWhetherAStepHolds) {
  const Outcome holds = substep("doctor pendulum --seconds 0.5");
  EXPECT_EQ(holds.exit_code, 0) << holds.err;
  EXPECT_NE(holds.out.find("pendulum: a step of 16.7 ms in substep: holds"), std::string::npos)
      << holds.out;
  EXPECT_NE(holds.out.find("2/w_max, 0.583 s"), std::string::npos) << holds.out;
  EXPECT_EQ(substep("doctor swinging_box --no-runs --step 0.0045").exit_code, 1);
  const Outcome fails = substep("doctor swinging_box --seconds 0.5 --json -");
  EXPECT_EQ(fails.exit_code, 2) << fails.err;
  const Json json = Json::parse(fails.out);
  EXPECT_EQ(json["verdict"], "fails");
  EXPECT_NEAR(json["start"][0]["geometric_step"], 5.37e-3, 1e-5);
  EXPECT_FALSE(json["remedies"].empty());
  EXPECT_EQ(substep("doctor no_such_scene").exit_code, 3);
  EXPECT_EQ(substep("doctor pendulum --engine none").exit_code, 2);
}

TEST(CommandLine, TheDoctorWritesAReportAndABadge) {
  const std::filesystem::path html = folder() / "step.html";
  const std::filesystem::path badge = folder() / "step.svg";
  const Outcome run = substep("doctor swinging_box --no-runs --engine mujoco --html \"" +
                              html.string() + "\" --badge \"" + badge.string() + '"');
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_NE(run.out.find("Largest step: 5.37 ms"), std::string::npos) << run.out;
  const std::string page = text_of(html.string());
  EXPECT_NE(page.find("MuJoCo, integrator Euler, needs steps below 5.37 ms, set by the geometric "),
            std::string::npos)
      << page;
  EXPECT_NE(page.find("option timestep=&quot;0.00384&quot;"), std::string::npos) << page;
  EXPECT_NE(text_of(badge.string()).find("below 5.37 ms"), std::string::npos);
  const Outcome on_output = substep("doctor pendulum --no-runs --html -");
  EXPECT_TRUE(on_output.out.starts_with("<!doctype html>")) << on_output.out;
  EXPECT_TRUE(on_output.out.ends_with("</html>\n")) << "and nothing else";
}

TEST(CommandLine, HelpHasExamples) {
  for (const char* command : {"", "run", "check", "hash", "generate"}) {
    const Outcome run = substep(std::string(command) + " --help");
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_NE(run.out.find("Example"), std::string::npos) << command;
  }
  EXPECT_EQ(substep("--version").exit_code, 0);
}

}  // namespace
}  // namespace substep
