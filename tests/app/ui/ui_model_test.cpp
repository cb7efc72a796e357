// "My model": changes of a scene by hand, as changes of its text, and the panel that makes them.

#include <imgui_internal.h>

#include <random>
#include <string>
#include <vector>

#include "app/lab/model_edits.hpp"
#include "app/ui/model_actions.hpp"
#include "core/io/scene_writer.hpp"
#include "core/model/types_in_files.hpp"
#include "tests/app/ui/ui_fixture.hpp"
#include "tests/unit/scene_text.hpp"

namespace substep {
namespace {

using test::kGood;

std::shared_ptr<const Scene> scene_of_text(const std::string& text) {
  const SceneResult result = read_scene(text);
  for (const Problem& problem : result.problems)
    ADD_FAILURE() << to_string(problem) << '\n' << text;
  return result.scene;
}

/// The text and its scene, changed together.
struct Model {
  std::string text = new_scene_text("my_scene", "My scene");
  std::shared_ptr<const Scene> scene = scene_of_text(text);

  void take(const std::string& changed) {
    text = changed;
    scene = scene_of_text(text);
    ASSERT_NE(scene, nullptr);
  }
  void add(BodyPart part, const std::optional<Hold>& hold) {
    take(with_body(text, *scene, part, kWorld, hold));
  }
  [[nodiscard]] int last() const { return static_cast<int>(scene->bodies.size()) - 1; }
};

using Texts = std::pair<std::string, std::string>;

/// The bytes in which two texts differ, of the first and of the second.
Texts differing(const std::string& a, const std::string& b) {
  const TextChange change = difference(a, b);
  return {change.removed, change.inserted};
}

TEST(ModelEdits, ANewSceneHasAFloorAndNothingThatMoves) {
  const auto scene = scene_of_text(new_scene_text("my_scene", "My scene"));
  ASSERT_EQ(scene->bodies.size(), 1U);
  EXPECT_TRUE(scene->bodies[0].is_static);
  EXPECT_TRUE(scene->effects.gravity && scene->effects.contact && scene->effects.friction);
  EXPECT_EQ(scene->gravity, Vec3(0, -9.81, 0));
}

TEST(ModelEdits, ANumberAloneChangesInATextOfAnyFormat) {
  const std::string text =
      "{ \"bodies\":[ {\"mass\" :1.50,\"p\":[0,1 ,2], \"s\":\"a]\\\"\"}]\n, \"x\": {\"y\":[ ]}}";
  EXPECT_EQ(differing(text, with_value(text, "/bodies/0/mass", 2.5)), Texts("1.50", "2.5"));
  EXPECT_EQ(differing(text, with_value(text, "/bodies/0/p/1", -7.0)), Texts("1", "-7"));
  EXPECT_EQ(differing(text, with_value(text, "/bodies/0/p/2", 3.0)), Texts("2", "3"));
  EXPECT_EQ(with_value(text, "/bodies/0/s", "b").find("\"s\":\"b\"}]\n"), text.find("\"s\""));
  EXPECT_NE(with_value(text, "/x/y", Json::array({1.0})).find("\"y\":[1]}}"), std::string::npos);
  const Json added = Json::parse(with_value(text, "/x/z", true));
  EXPECT_EQ(added["x"]["z"], true);
  const Json removed = Json::parse(with_value(text, "/bodies/0/mass", nullptr));
  EXPECT_FALSE(removed["bodies"][0].contains("mass"));
  for (const char* absent : {"/none/a", "/bodies/7/mass", "/bodies/x/mass"}) {
    EXPECT_EQ(with_value(text, absent, 1.0), text) << absent;
  }
}

/// Every field of a scene.
std::vector<ModelField> all_fields(const Scene& scene) {
  std::vector<ModelField> all = fields_of_scene(scene);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    for (ModelField& field : fields_of_body(scene, static_cast<int>(i))) all.push_back(field);
  }
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    for (ModelField& field : fields_of_joint(scene, i)) all.push_back(field);
  }
  return all;
}

TEST(ModelEdits, EveryFieldShowsTheValueThatTheTextHas) {
  for (const char* name : {"bridge", "crank_rocker", "ragdoll_drop", "heavy_top"}) {
    const auto scene = shipped(name);
    const std::string text = write_scene(*scene);
    const std::vector<ModelField> fields = all_fields(*scene);
    const std::size_t stride = fields.size() / 60 + 1;
    for (std::size_t f = 0; f < fields.size(); f += stride) {
      const ModelField& field = fields[f];
      if (field.pointer.ends_with("orientation") || field.pointer.ends_with("inertia")) continue;
      std::string typed = text;
      for (std::size_t i = 0; i < field.values.size(); ++i) {
        typed = with_typed(typed, *scene, field, i, field.values[i]);
      }
      EXPECT_EQ(write_scene(*scene_of_text(typed)), text) << field.pointer;
    }
  }
}

TEST(ModelEdits, ATypedValueIsThatOfTheScene) {
  Model model;
  model.add(BodyPart::kLink, Hold{});
  const auto type = [&](const std::string& pointer, std::size_t part, const std::string& value) {
    for (const ModelField& field : all_fields(*model.scene)) {
      if (field.pointer == pointer) {
        return model.take(with_typed(model.text, *model.scene, field, part, value));
      }
    }
    FAIL() << pointer;
  };
  type("/bodies/1/mass", 0, "7.25");
  type("/bodies/1/shape/size", 1, "0.2");
  type("/bodies/1/velocity", 2, "-3");
  type("/bodies/1/restitution", 0, "0.5");
  type("/bodies/1/name", 0, "first \"link\"");
  type("/joints/0/compliance", 0, "1e-6");
  type("/gravity", 1, "-1.62");
  type("/frame", 0, "0.01");
  type("/title", 0, "On the moon");
  const Scene& scene = *model.scene;
  EXPECT_EQ(scene.bodies[1].mass, 7.25);
  EXPECT_EQ(std::get<Box>(scene.bodies[1].shape).half_extents.y(), 0.1);
  EXPECT_EQ(scene.bodies[1].velocity, Vec3(0, 0, -3));
  EXPECT_EQ(scene.bodies[1].restitution, 0.5);
  EXPECT_TRUE(scene.effects.restitution) << "the text lists the effects";
  EXPECT_EQ(scene.bodies[1].name, "first \"link\"");
  EXPECT_EQ(base(scene.joints[0]).a, 1);
  EXPECT_EQ(base(scene.joints[0]).compliance, 1e-6);
  EXPECT_EQ(scene.gravity, Vec3(0, -1.62, 0));
  EXPECT_EQ(scene.frame, 0.01);
  EXPECT_EQ(scene.title, "On the moon");
  type("/bodies/1/restitution", 0, "");
  EXPECT_EQ(model.scene->bodies[1].restitution, 0.0) << "nothing is the default";
  type("/bodies/1/inertia", 0, "0.2");
  EXPECT_EQ(model.scene->bodies[1].inertia.x(), 0.2);
  type("/bodies/1/inertia", 0, "");
  EXPECT_EQ(model.scene->bodies[1].inertia, solid_inertia(model.scene->bodies[1].shape, 7.25));
}

TEST(ModelEdits, AnOrientationIsTypedInDegrees) {
  Model model;
  model.add(BodyPart::kBox, std::nullopt);
  for (std::size_t i = 0; i < 3; ++i) {
    const char* typed[] = {"10", "-20", "60.5"};
    const ModelField field = fields_of_body(*model.scene, 1)[3];
    ASSERT_EQ(field.name, "orientation");
    model.take(with_typed(model.text, *model.scene, field, i, typed[i]));
  }
  const Vec3 turn = Vec3(10, -20, 60.5) * (EIGEN_PI / 180.0);
  const Eigen::Quaterniond expected(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  EXPECT_NEAR(model.scene->bodies[1].orientation.angularDistance(Quat(expected)), 0.0, 1e-6);
  EXPECT_EQ(fields_of_body(*model.scene, 1)[3].values,
            (std::vector<std::string>{"10", "-20", "60.5"}));
}

TEST(ModelEdits, WhatIsOutOfRangeHasTheMessageOfTheReader) {
  Model model;
  model.add(BodyPart::kLink, Hold{});
  const ModelField mass = fields_of_body(*model.scene, 1)[0];
  const auto message = [&](const std::string& typed) {
    const Problems problems =
        read_scene(with_typed(model.text, *model.scene, mass, 0, typed)).problems;
    return problems.empty() ? "" : to_string(problems.front());
  };
  EXPECT_EQ(message("-1"), "/bodies/1/mass: must be at least 1e-30 (kg), not -1");
  EXPECT_EQ(message("heavy"), "/bodies/1/mass: must be a number (kg), not \"heavy\"");
  EXPECT_EQ(message("1e999"), "/bodies/1/mass: must be a number (kg), not \"1e999\"");
  EXPECT_EQ(message(""), "/bodies/1/mass: missing");
}

/// Largest overlap of the bounding boxes of bodies that no joint connects, and of the floor [m].
double overlap_of(const Scene& scene) {
  double most = 0.0;
  const auto half = [](const Body& body) {
    return std::visit([&](const auto& s) { return s.bounds(body.orientation.toRotationMatrix()); },
                      body.shape);
  };
  for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
    const Body& a = scene.bodies[i];
    most = std::max(most, half(a).y() - a.position.y());
    for (std::size_t k = 1; k < i; ++k) {
      const auto ik = std::pair(static_cast<int>(i), static_cast<int>(k));
      const bool joined =
          std::any_of(scene.joints.begin(), scene.joints.end(), [&](const Joint& joint) {
            const auto ab = std::pair(base(joint).a, base(joint).b);
            return ab == ik || ab == std::pair(ik.second, ik.first);
          });
      if (joined) continue;
      const Vec3 gap =
          (a.position - scene.bodies[k].position).cwiseAbs() - half(a) - half(scene.bodies[k]);
      most = std::max(most, -gap.maxCoeff());
    }
  }
  return most;
}

TEST(ModelEdits, AddedBodiesAreJoinedEndToEndAndDoNotOverlap) {
  for (std::size_t type = 0; type < kTypes<Joint>.size(); ++type) {
    SCOPED_TRACE(kTypes<Joint>[type]);
    Model model;
    for (int i = 0; i < 5; ++i)
      model.add(BodyPart::kLink, Hold{i == 0 ? kWorld : model.last(), type});
    model.add(BodyPart::kBall, Hold{model.last(), type});
    ASSERT_EQ(model.scene->joints.size(), 6U);
    EXPECT_EQ(model.scene->bodies[5].name, "link_5");
    EXPECT_EQ(model.scene->bodies[6].name, "ball_1");
    EXPECT_LE(overlap_of(*model.scene), 1e-9);
    for (const Joint& joint : model.scene->joints) EXPECT_EQ(joint.index(), type);
    for (int i = 2; i <= 6; ++i) {  // in a line
      EXPECT_EQ(model.scene->bodies[index(i)].position.y(), model.scene->bodies[1].position.y());
      EXPECT_GT(model.scene->bodies[index(i)].position.x(),
                model.scene->bodies[index(i - 1)].position.x() + 0.3);
    }
  }
}

TEST(ModelEdits, FreeBodiesAreStackedOnTheFloor) {
  Model model;
  for (int i = 0; i < 6; ++i)
    model.add(i % 2 == 0 ? BodyPart::kBox : BodyPart::kBall, std::nullopt);
  EXPECT_TRUE(model.scene->joints.empty());
  EXPECT_LE(overlap_of(*model.scene), 0.0);
  EXPECT_LT(model.scene->bodies[6].position.y(), 3.0);
}

TEST(ModelEdits, ABodyIsDeletedWithItsJointsAndWhatTheCriteriaSayOfIt) {
  const auto scene = scene_of_text(kGood);
  for (int i = 0; i < static_cast<int>(scene->bodies.size()); ++i) {
    const auto after = scene_of_text(without_body(kGood, *scene, i));
    EXPECT_EQ(after->bodies.size(), scene->bodies.size() - 1);
    const auto held =
        std::count_if(scene->joints.begin(), scene->joints.end(),
                      [&](const Joint& j) { return base(j).a == i || base(j).b == i; });
    EXPECT_EQ(after->joints.size() + static_cast<std::size_t>(held), scene->joints.size());
    EXPECT_FALSE(scene->criteria.track == i && after->criteria.track);
  }
}

TEST(ModelEdits, TwoBodiesAreConnectedByEveryTypeOfJoint) {
  for (std::size_t type = 0; type < kTypes<Joint>.size(); ++type) {
    SCOPED_TRACE(kTypes<Joint>[type]);
    Model model;
    model.add(BodyPart::kBox, std::nullopt);
    model.take(with_copy(model.text, *model.scene, 1));
    model.take(with_joint(model.text, *model.scene, 1, 2, type));
    model.take(with_joint(model.text, *model.scene, kWorld, 2, type));
    model.take(with_joint(model.text, *model.scene, 0, 1, type));  // the floor does not move
    ASSERT_EQ(model.scene->joints.size(), 3U);
    EXPECT_EQ(base(model.scene->joints[2]).a, 1);
    EXPECT_EQ(base(model.scene->joints[2]).b, 0);
    Simulator simulator(model.scene);
    EXPECT_EQ(simulator.step().status, StepStatus::kOk);
    model.take(without_joint(model.text, 1));
    EXPECT_EQ(model.scene->joints.size(), 2U);
  }
}

TEST(ModelEdits, ABodyIsFixedAndReleased) {
  Model model;
  model.add(BodyPart::kBox, std::nullopt);
  model.take(with_motion(model.text, *model.scene, 1, false));
  EXPECT_TRUE(model.scene->bodies[1].is_static);
  model.take(with_motion(model.text, *model.scene, 1, true));
  EXPECT_FALSE(model.scene->bodies[1].is_static);
  EXPECT_EQ(model.scene->bodies[1].mass, 125.0);
}

// A chain of random actions on scenes of all kinds: each leaves a scene that is valid, or is
// refused with the text as it was, and all are undone to the same bytes.
TEST(ModelEdits, AThousandRandomChangesAreUndoneToTheSameBytes) {
  Headless h;
  for (const char* name : {"pendulum", "swinging_box", "newtons_cradle", "new"}) {
    SCOPED_TRACE(name);
    if (std::string(name) == "new") {
      ui::new_scene(*h.app, h.app->desk);
    } else {
      h.app->set("scene", name);
    }
    h.app->session.pause();
    ASSERT_NE(h.app->editor.by_hand(*h.app), nullptr);
    std::mt19937 random(3);
    std::vector<std::string> past{h.app->editor.text().text()};
    int refused = 0;
    for (int i = 0; i < 250; ++i) {
      const auto count = static_cast<unsigned>(h.app->session.scene().bodies.size());
      h.app->desk.selected = static_cast<int>(random() % (count + 1)) - 1;
      h.app->desk.model.joint_type = random() % kTypes<Joint>.size();
      const auto what = random() % 10;
      const std::string other = h.app->session.scene().bodies[random() % count].name;
      const std::vector<std::string> actions{"link",
                                             "ball",
                                             "box",
                                             "copy",
                                             count > 12 ? "delete" : "link",
                                             "connect:" + other,
                                             "static",
                                             "moves",
                                             "mass:" + std::to_string(random() % 100),
                                             "velocity:1,2,3"};
      ui::edit_model(*h.app, h.app->desk, actions[what]);
      const std::string& now = h.app->editor.text().text();
      ASSERT_TRUE(h.app->editor.text().problems().empty());
      EXPECT_FALSE(h.app->editor.text().changed()) << "it runs";
      if (now == past.back()) {
        ++refused;
        continue;
      }
      EXPECT_EQ(read_scene(now).problems.size(), 0U) << actions[what];
      past.push_back(now);
    }
    EXPECT_LT(refused, 150);
    while (past.size() > 1) {
      past.pop_back();
      ui::step_model(*h.app, h.app->desk, false);
      ASSERT_EQ(h.app->editor.text().text(), past.back());
    }
    EXPECT_EQ(h.app->session.scene().bodies.size(), read_scene(past[0]).scene->bodies.size());
  }
}

// In the window.

/// Scrolls the panel until a control is in sight, and presses it.
void press_in_panel(Headless& h, const std::string& label) {
  const ui::Handle* link = find_handle("selected body");
  const ui::Handle* wanted = find_handle(label);
  const float bottom = ImGui::GetIO().DisplaySize.y - 24.0F;
  for (int i = 0; i < 40 && (wanted == nullptr || wanted->max.y > bottom); ++i) {
    if (link == nullptr) link = find_handle("position y");
    ASSERT_NE(link, nullptr);
    ImGui::GetIO().AddMousePosEvent(link->min.x + 4.0F, bottom - 40.0F);
    ImGui::GetIO().AddMouseWheelEvent(0.0F, -1.0F);
    h.frames(4);
    wanted = find_handle(label);
  }
  h.press(label);
}

void type_in_field(Headless& h, const std::string& label, const char* text) {
  press_in_panel(h, label);
  h.type(text);
  h.press_key(ImGuiKey_Enter);
}

/// From the menu of scenes, by presses and keys alone.
void build_heavy_chain(Headless& h) {
  h.press("scene");
  h.press("New scene");
  h.frames(3);
  EXPECT_EQ(h.app->session.scene().bodies.size(), 1U);
  for (int i = 0; i < 5; ++i) h.press("Link");
  h.press("Ball");
  type_in_field(h, "mass", "1000");
}

TEST(ModelPanel, AChainOfFiveWithAHeavyBallIsBuiltFailsAndIsMendedAndItsLinkHasTheSameBits) {
  for (const auto& [width, height] : {std::pair{1280.0F, 720.0F}, {390.0F, 844.0F}}) {
    Headless h(width, height);
    build_heavy_chain(h);
    const Scene& scene = h.app->session.scene();
    ASSERT_EQ(scene.bodies.size(), 7U);
    ASSERT_EQ(scene.joints.size(), 6U);
    EXPECT_EQ(scene.bodies[6].mass, 1000.0);
    EXPECT_EQ(scene.bodies[6].name, "ball_1");
    EXPECT_EQ(h.app->desk.selected, 6);
    const auto run = [&h](int frames) {
      h.app->reset();
      for (int i = 0; i < frames && h.app->session.verdict().holds(); ++i) h.app->session.step();
      return h.app->session.verdict().holds();
    };
    h.app->set("mode", "none");
    EXPECT_FALSE(run(300)) << "one step per frame is too few";
    h.app->set("mode", "adaptive");
    EXPECT_TRUE(run(300));
    EXPECT_GT(h.app->session.report().n_substeps, 1);
    const std::uint64_t hash = h.app->session.hash();
    Headless other;
    other.app->open_link(h.app->link(), read_scene(write_scene(h.app->link_scene())));
    EXPECT_EQ(other.app->session.scene().bodies.size(), 7U);
    for (int i = 0; i < 300; ++i) other.app->session.step();
    EXPECT_EQ(other.app->session.hash(), hash);
  }
}

TEST(ModelPanel, AValueOutOfRangeStaysWithTheMessageOfTheReader) {
  Headless h;
  build_heavy_chain(h);
  const std::string before = h.app->editor.text().text();
  type_in_field(h, "mass", "-3");
  EXPECT_EQ(h.app->editor.text().text(), before);
  EXPECT_EQ(h.app->session.scene().bodies[6].mass, 1000.0);
  EXPECT_EQ(h.app->desk.model.message, "must be at least 1e-30 (kg), not -3");
  EXPECT_EQ(h.app->desk.model.refused_text, "-3") << "it can be mended";
  press_in_panel(h, "mass");
  EXPECT_STREQ(ImGui::GetCurrentContext()->InputTextState.TextA.Data, "-3");
  h.type("30");
  h.press_key(ImGuiKey_Enter);
  EXPECT_EQ(h.app->session.scene().bodies[6].mass, 30.0);
  EXPECT_EQ(h.app->desk.model.refused, "");
  EXPECT_EQ(h.app->desk.selected, 6);
}

TEST(ModelPanel, EscLeavesAFieldAndItsValue) {
  Headless h;
  build_heavy_chain(h);
  press_in_panel(h, "mass");
  h.type("7");
  h.press_key(ImGuiKey_Escape);
  EXPECT_EQ(h.app->session.scene().bodies[6].mass, 1000.0);
  EXPECT_EQ(h.app->desk.model.typing, "");
  EXPECT_EQ(h.app->desk.selected, 6) << "a second Esc selects nothing";
  h.press_key(ImGuiKey_Escape);
  EXPECT_EQ(h.app->desk.selected, -1);
}

TEST(ModelPanel, UndoAndDeleteHaveKeys) {
  Headless h;
  build_heavy_chain(h);
  h.press_key(ImGuiKey_Delete);
  EXPECT_EQ(h.app->session.scene().bodies.size(), 6U);
  EXPECT_EQ(h.app->session.scene().joints.size(), 5U);
  h.press_key(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(h.app->session.scene().bodies.size(), 7U);
  h.press_key(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(h.app->session.scene().bodies[6].mass, 10.0);
  h.press_key(ImGuiKey_Y, ImGuiMod_Ctrl);
  EXPECT_EQ(h.app->session.scene().bodies[6].mass, 1000.0);
}

TEST(ModelPanel, ABodyIsConnectedWithTheOneThatIsPressedNext) {
  Headless h;
  build_heavy_chain(h);
  h.press("Join");
  EXPECT_TRUE(h.app->desk.model.connecting);
  h.press("selected body");
  h.press("link_2");
  EXPECT_FALSE(h.app->desk.model.connecting);
  ASSERT_EQ(h.app->session.scene().joints.size(), 7U);
  EXPECT_EQ(base(h.app->session.scene().joints[6]).a, 6);
  EXPECT_EQ(base(h.app->session.scene().joints[6]).b, 2);
  EXPECT_EQ(h.app->desk.model.joint, 6);
}

TEST(ModelPanel, EditsKeepTheMethodAndRunTheSceneOfTheText) {
  Headless h;
  build_heavy_chain(h);
  h.app->set("mode", "const");
  h.app->set("n", "7");
  type_in_field(h, "mass", "500");
  EXPECT_EQ(h.app->session.settings().n, 7);
  EXPECT_EQ(h.app->session.settings().mode, Mode::kConst);
  EXPECT_EQ(read_scene(h.app->editor.text().text()).scene->bodies[6].mass, 500.0);
  h.app->set("panel", "editor");
  h.frames(2);
  h.app->editor.edit("{");
  h.frames(2);
  h.app->set("panel", "model");
  h.frames(3);
  EXPECT_EQ(find_handle("Link"), nullptr) << "the text has an error";
  h.press("Undo");
  EXPECT_NE(find_handle("Link"), nullptr);
  EXPECT_EQ(h.app->session.scene().bodies.size(), 7U);
}

TEST(ModelPanel, IsOpenedFromTheMenuTheKeyAndTheCardOfABody) {
  for (const auto& [width, height] : {std::pair{1280.0F, 720.0F}, {390.0F, 844.0F}}) {
    Headless h(width, height);
    h.type("m");
    h.frames(2);
    EXPECT_EQ(h.app->desk.tab, Tab::kModel);
    h.press("As text");
    h.frames(2);
    EXPECT_EQ(h.app->desk.tab, Tab::kText);
    h.press("By hand");
    h.frames(2);
    h.press("Close the text");
    h.frames(2);
    EXPECT_LT(h.app->desk.tab, Tab::kText);
    h.app->set("select", "box");
    h.frames(3);
    h.press("Edit by hand");
    h.frames(2);
    EXPECT_EQ(h.app->desk.tab, Tab::kModel);
    EXPECT_NE(find_handle("mass"), nullptr);
  }
}

TEST(ModelPanel, AFingersTargetsAreFarEnoughApart) {
  Headless h(390.0F, 844.0F);
  build_heavy_chain(h);
  h.frames(3);
  std::vector<const ui::Handle*> fields;
  for (const ui::Handle& handle : ui::handles()) {
    if (handle.label == "mass" || handle.label == "radius") {
      fields.push_back(&handle);
    }
  }
  ASSERT_GE(fields.size(), 2U);
  for (std::size_t i = 1; i < fields.size(); ++i) {
    EXPECT_GE(fields[i]->min.y - fields[i - 1]->min.y, 44.0F);
  }
}

// Each panel shows a scene in which nothing moves.
TEST(ModelPanel, AnEmptySceneHasAllPanels) {
  for (const auto& [width, height] : {std::pair{1280.0F, 720.0F}, {390.0F, 844.0F}}) {
    Headless h(width, height);
    h.app->set("edit", "new");
    h.app->session.play();
    for (const char* panel :
         {"controls", "plots", "why", "compare", "accuracy", "editor", "model"}) {
      h.app->set("panel", panel);
      h.frames(10);
    }
    h.app->set("level", "explore");
    h.app->set("panel", "controls");
    h.frames(10);
    EXPECT_TRUE(h.app->session.verdict().holds());
    EXPECT_GT(h.app->session.state().frame, 50);
    EXPECT_EQ(h.app->set("edit", "new"), "");
    EXPECT_EQ(h.app->session.scene().name, "my_scene") << "an empty one is enough";
    EXPECT_EQ(h.app->set("edit", "box;new"), "");
    EXPECT_EQ(h.app->session.scene().name, "my_scene_2");
  }
}

TEST(ModelPanel, ActionsByNameSayWhatIsWrong) {
  Headless h;
  EXPECT_EQ(h.app->set("edit", "copy"), "select a body first");
  h.app->set("select", "box");
  EXPECT_EQ(h.app->set("edit", "connect:nobody"), "no body is called 'nobody'");
  EXPECT_NE(h.app->set("edit", "weight:3").find("FIELD:VALUE"), std::string::npos);
  EXPECT_EQ(h.app->set("edit", "mass:-1"), "must be at least 1e-30 (kg), not -1");
  EXPECT_EQ(h.app->set("edit", "mass:12;velocity:1,2,3"), "");
  const Body& box = h.app->session.scene().bodies[static_cast<std::size_t>(h.app->desk.selected)];
  EXPECT_EQ(box.mass, 12.0);
  EXPECT_EQ(box.velocity, Vec3(1, 2, 3));
  EXPECT_EQ(box.name, "box");
}

// Each reads the whole text: 1,500 balls would stop the page for a minute.
TEST(ModelPanel, ALinkHasABoundedNumberOfActions) {
  Headless h;
  std::string actions = "new";
  for (int i = 0; i < 1500; ++i) actions += ";ball";
  EXPECT_EQ(
      h.app->set("edit", actions),
      "only the first 100 actions were taken: a link has at most 100, fewer in a scene with a "
      "long text");
  EXPECT_EQ(h.app->session.scene().bodies.size(), 100U);
}

}  // namespace
}  // namespace substep
