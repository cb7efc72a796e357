// Commands, saved scene files and stored scenes of the user (links: ui_link_test).

#include <gtest/gtest.h>

#include <imgui_internal.h>

#include <cstdio>
#include <map>

#include "core/io/experiment.hpp"
#include "core/io/saved_scene.hpp"
#include "core/io/scene_writer.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

// Calls that the test's host received.
struct Kept {
  std::map<std::string, std::string> files;
  std::map<std::string, std::string> memory;

  void serve(App& app) {
    app.host.save_file = [this](const std::string& name, const std::string& bytes) {
      files[name] = bytes;
    };
    app.host.remember = [this](const std::string& key, const std::string& value) {
      memory[key] = value;
    };
    app.host.recall = [this](const std::string& key) { return memory[key]; };
  }
};

std::string renamed(const Scene& scene, const std::string& name) {
  Scene copy = scene;
  copy.name = name;
  copy.title = name;
  return write_scene(copy);
}

#ifdef SUBSTEP_PROGRAM
std::string output_of(std::string command) {
  const std::string start = "./dev cli ";
  EXPECT_EQ(command.substr(0, start.size()), start);
  command = "SUBSTEP_SCENES=\"" SUBSTEP_SOURCE_DIR "/scenes\" \"" SUBSTEP_PROGRAM "\" " +
            command.substr(start.size());
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string text;
  char buffer[4096];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) text += buffer;
  EXPECT_EQ(pclose(pipe), 0) << command;
  return text;
}

TEST(Command, GivesTheSameRun) {
  const std::vector<std::vector<std::pair<const char*, const char*>>> experiments = {
      {},
      {{"mode", "const"}, {"n", "7"}, {"integrator", "leapfrog"}},
      {{"solver", "pgs"}, {"iterations", "13"}, {"warm_start", "false"}, {"alpha", "0.0371"}},
      {{"mode", "capped"}, {"n_cap", "3"}, {"drift", "soft"}, {"policy", "substep"}}};
  for (const char* scene : {"swinging_box", "heavy_stack"}) {
    for (const auto& experiment : experiments) {
      Headless h;
      ASSERT_EQ(h.app->set("scene", scene), "");
      for (const auto& [key, value] : experiment) ASSERT_EQ(h.app->set(key, value), "") << key;
      for (int i = 0; i < 45; ++i) h.app->session.step();
      const std::string out = output_of(h.app->command());
      EXPECT_NE(out.find(hex_text(h.app->session.hash())), std::string::npos)
          << h.app->command() << "\n"
          << hex_text(h.app->session.hash()) << "\n"
          << out;
    }
  }
}
#endif

TEST(Command, NamesOnlyWhatDiffersFromTheScene) {
  Headless h;
  EXPECT_EQ(h.app->command(), "./dev cli run swinging_box");
  h.app->set("mode", "const");
  h.app->set("n", "99");
  h.app->set("n_max", "77");  // not read in this mode
  h.app->session.step();
  EXPECT_EQ(h.app->command(), "./dev cli run swinging_box --mode const --n 99 --frames 1");
}

TEST(Command, HoldsLoadAndSeed) {
  Headless h;
  h.app->open_link("scene=pendulum&load=2&seed=3");
  h.app->session.pause();
  EXPECT_EQ(h.app->command(), "./dev cli run pendulum --load 2 --seed 3");
}

// A user's scene is in the link as a whole: its load is a separate key and must not be applied
// twice.
TEST(Command, TheLoadOfAnOwnSceneIsNotInItsFileToo) {
  Headless h;
  ASSERT_TRUE(h.app->open_text(renamed(*shipped("pendulum"), "mine"), "mine.json"));
  const double mass = h.app->session.scene().bodies.back().mass;
  ASSERT_EQ(h.app->set("load", "2"), "");
  EXPECT_EQ(h.app->session.scene().bodies.back().mass, 2.0 * mass);
  EXPECT_EQ(h.app->link_scene().bodies.back().mass, mass);
  EXPECT_NE(h.app->link().find("load=2"), std::string::npos);
}

TEST(Command, NamesTheFileOfAnOwnScene) {
  Headless h;
  ASSERT_TRUE(h.app->open_text(renamed(*shipped("pendulum"), "mine"), "mine.json"));
  h.app->session.pause();
  EXPECT_EQ(h.app->command(), "./dev cli run mine.json");
}

TEST(SavedScene, StartsWhereTheRunIs) {
  for (const char* name : {"swinging_box", "bridge", "heavy_stack"}) {
    for (const char* integrator : {"euler", "leapfrog"}) {
      Headless h;
      Kept kept;
      kept.serve(*h.app);
      ASSERT_EQ(h.app->set("scene", name), "");
      ASSERT_EQ(h.app->set("integrator", integrator), "");
      ASSERT_EQ(h.app->set("mode", "adaptive"), "");
      for (int i = 0; i < 60; ++i) h.app->session.step();
      h.app->save_scene();
      ASSERT_EQ(kept.files.size(), 1U) << h.app->trouble.title;
      const auto& [file, text] = *kept.files.begin();
      EXPECT_EQ(file, std::string(name) + "_at_1000ms.json");

      const SceneResult read = read_scene(text);
      ASSERT_TRUE(read.scene) << to_string(read.problems.front());
      EXPECT_EQ(read.scene->settings, h.app->session.settings());
      Session goes_on(read.scene);
      const auto expect_the_same = [&] {
        const State& a = h.app->session.state();
        const State& b = goes_on.state();
        for (std::size_t i = 0; i < a.x.size(); ++i) {
          ASSERT_EQ(a.x[i], b.x[i]);
          ASSERT_EQ(a.q[i].coeffs(), b.q[i].coeffs());
          ASSERT_EQ(a.u[i], b.u[i]);
        }
      };
      expect_the_same();
      for (int i = 0; i < 15; ++i) {
        h.app->session.step();
        goes_on.step();
        expect_the_same();
      }
    }
  }
}

TEST(SavedScene, SavedRepeatedlyKeepsOneMark) {
  const auto scene = shipped("pendulum");
  Session session(scene);
  session.step();
  Scene saved = saved_scene(*scene, session.state(), session.settings());
  EXPECT_EQ(saved.name, "pendulum_at_17ms");
  saved = saved_scene(saved, session.state(), session.settings());
  EXPECT_EQ(saved.name, "pendulum_at_17ms");
  EXPECT_EQ(saved.title.find(", from"), saved.title.rfind(", from"));
}

TEST(SavedScene, AStateBeyondTheLimitsOfFilesIsReportedAndNotSaved) {
  Headless h;
  Kept kept;
  kept.serve(*h.app);
  Scene far = *shipped("pendulum");
  far.bodies.back().velocity.x() = 9.99e4;
  far.gravity.x() = 9e3;
  h.app->run(std::make_shared<Scene>(far));
  for (int i = 0; i < 60; ++i) h.app->session.step();
  h.app->save_scene();
  if (h.app->trouble.title.empty()) {  // the joint may restrain it: then the file is valid
    ASSERT_EQ(kept.files.size(), 1U);
    EXPECT_TRUE(read_scene(kept.files.begin()->second).scene);
  } else {
    EXPECT_TRUE(kept.files.empty());
  }
}

TEST(OwnScenes, AreKeptForTheNextVisit) {
  Kept kept;
  {
    Headless h;
    kept.serve(*h.app);
    ASSERT_TRUE(h.app->open_text(renamed(*shipped("pendulum"), "mine"), "mine.json"));
    ASSERT_TRUE(h.app->open_text(renamed(*shipped("bridge"), "other"), "other.json"));
  }
  Headless h;
  kept.serve(*h.app);
  EXPECT_FALSE(h.app->open("mine"));
  h.app->recall_scenes();
  ASSERT_TRUE(h.app->open("mine"));
  EXPECT_EQ(h.app->session.scene().bodies.size(), shipped("pendulum")->bodies.size());
  ASSERT_EQ(h.app->own.scenes().size(), 2U);
  EXPECT_EQ(h.app->own.scenes().front()->name, "other");
  EXPECT_TRUE(is_own(h.app->session.scene()));
}

TEST(OwnScenes, DoNotReplaceShippedOnes) {
  Headless h;
  const std::size_t count = h.app->library.scenes().size();
  Scene changed = *shipped("bridge");
  changed.frame = 0.01;
  ASSERT_TRUE(h.app->open_text(write_scene(changed), "bridge.json"));
  EXPECT_EQ(h.app->session.scene().name, "bridge_own");
  ASSERT_TRUE(h.app->open_text(write_scene(changed), "bridge.json"));
  EXPECT_EQ(h.app->library.scenes().size(), count + 1);
  ASSERT_TRUE(h.app->open("bridge"));
  EXPECT_EQ(h.app->session.scene().frame, shipped("bridge")->frame);
}

TEST(OwnScenes, AreLimitedInNumber) {
  Headless h;
  for (int i = 0; i < 12; ++i) {
    ASSERT_TRUE(h.app->open_text(renamed(*shipped("pendulum"), "mine" + std::to_string(i)), ""));
  }
  EXPECT_EQ(h.app->own.scenes().size(), OwnScenes::kMost);
  EXPECT_EQ(h.app->own.scenes().front()->name, "mine11");
}

TEST(OwnScenes, InvalidOnesAreSkipped) {
  const std::string sound = OwnScenes().text();
  for (const char* text : {"", "{", "7", "[1, null, {}]", "[\"no scene\"]", "\xff"}) {
    EXPECT_TRUE(OwnScenes::read(text).scenes().empty()) << text;
  }
  EXPECT_EQ(sound, "[]");
}

TEST(OpenText, HugeBinaryOrBrokenFilesLeaveTheRunUnchanged) {
  Headless h;
  for (int i = 0; i < 10; ++i) h.app->session.step();
  const auto hash = h.app->session.hash();
  const std::string huge(std::size_t{33} << 20U, ' ');
  const std::string deep(100000, '[');
  for (const std::string& text : {huge, deep, std::string("\x89PNG\r\n\x1a\n\0\0", 10),
                                  std::string(), std::string("{\"format\": \"substep-scene\"")}) {
    EXPECT_FALSE(h.app->open_text(text, "file.json"));
    EXPECT_EQ(h.app->trouble.title, "file.json was not loaded");
    ASSERT_FALSE(h.app->trouble.problems.empty());
    EXPECT_FALSE(h.app->trouble.problems.front().message.empty());
    EXPECT_LT(h.app->trouble.problems.front().message.size(), 500U);
    EXPECT_EQ(h.app->session.hash(), hash);
  }
}

TEST(OpenText, AModelOfAnotherFormatIsImported) {
  Headless h;
  const std::string model =
      "<mujoco model='arm'><worldbody><body><joint armature='1'/><geom "
      "size='0.1'/></body></worldbody>"
      "</mujoco>";
  ASSERT_TRUE(h.app->open_text(model, "arm.xml"));
  EXPECT_EQ(h.app->session.scene().name, "arm");
  EXPECT_EQ(h.app->notice.text,
            "arm.xml: 0 approximated, 1 left out: `substep import --report` lists them");
  ASSERT_FALSE(h.app->open_text("<mujoco>\n<", "broken.xml"));
  EXPECT_EQ(h.app->trouble.title, "broken.xml was not loaded");
  EXPECT_EQ(h.app->trouble.problems.front().pointer, "broken.xml:2");
}

TEST(OpenFile, AModelIsReadWithTheFilesBesideIt) {
  Headless h;
  ASSERT_TRUE(h.app->open_file(SUBSTEP_SOURCE_DIR "/tests/import/models/arm.xml"));
  EXPECT_EQ(h.app->session.scene().name, "arm_of_many_parts");
  ASSERT_TRUE(h.app->open_file(SUBSTEP_SOURCE_DIR "/scenes/pendulum.json"));
  EXPECT_EQ(h.app->session.scene().title, shipped("pendulum")->title);
  EXPECT_FALSE(h.app->open_file(SUBSTEP_SOURCE_DIR "/tests/import/models/none.xml"));
}

TEST(ShareMenu, OffersOnlyWhatTheHostSupports) {
  Headless h;
  h.app->session.pause();
  bool copied = false;
  h.app->host.copy_link = [&](const std::string&) { copied = true; };
  h.frames(2);
  // The button next to the last of the bar; the entries above it, at any height.
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const ImVec2 button(display.x - 72.0F, display.y - 40.0F);
  for (float y = button.y - 32.0F; y > button.y - 280.0F && !copied; y -= 12.0F) {
    h.click(button.x, button.y);
    h.frames(2);
    h.click(button.x - 20.0F, y);
    ImGui::ClosePopupsOverWindow(nullptr, false);
  }
  EXPECT_TRUE(copied);
}

TEST(Notice, DisappearsByItself) {
  Headless h;
  h.app->tell("Link copied");
  h.frames(2);
  EXPECT_GT(h.app->notice.left, 3.5);
  h.frames(300);
  EXPECT_LE(h.app->notice.left, 0.0);
}

}  // namespace
}  // namespace substep
