// The scene as text: history, problems by line, and the run that follows the text.

#include <imgui_internal.h>

#include <random>
#include <set>
#include <string>
#include <vector>

#include "core/io/scene_writer.hpp"
#include "tests/app/ui/ui_fixture.hpp"
#include "tests/unit/scene_text.hpp"

namespace substep {
namespace {

using test::kGood;
using test::with;

SceneText text_shown(const std::string& text) {
  SceneText scene_text;
  scene_text.show(text, nullptr);
  return scene_text;
}

/// Advances by the frames that a check may take.
void check_text(SceneText& text) {
  for (int i = 0; i < 10'000 && !text.checked(); ++i) text.advance(kFrame, kSlice);
  ASSERT_TRUE(text.checked());
}

/// A random text of letters, brackets, line breaks and characters of several bytes.
std::string random_letters(std::mt19937& random) {
  static const std::vector<std::string> kLetters{"a", "7", " ", "\n", "{", "\"", "é", "α", "🙂"};
  std::string text;
  const std::size_t count = random() % 3 == 0 ? random() % 40 : 1;
  for (std::size_t i = 0; i < count; ++i) text += kLetters[random() % kLetters.size()];
  return text;
}

/// The beginning of the character at or after a byte.
std::size_t whole_character(const std::string& text, std::size_t at) {
  while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0U) == 0x80U) ++at;
  return at;
}

std::string random_edit(std::string text, std::size_t& cursor, std::mt19937& random) {
  if (random() % 4 == 0) cursor = random() % (text.size() + 1);  // else at the last place
  cursor = whole_character(text, std::min(cursor, text.size()));
  const std::size_t longest = random() % 8 == 0 ? 60 : 1;
  const std::size_t end =
      whole_character(text, std::min(text.size(), cursor + random() % (longest + 1)));
  const std::string inserted = random() % 3 == 0 ? "" : random_letters(random);
  text.replace(cursor, end - cursor, inserted);
  cursor += inserted.size();
  return text;
}

TEST(SceneText, AThousandRandomEditsAreUndoneAndRedoneToTheSameBytes) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    std::mt19937 random(seed);
    SceneText text = text_shown(kGood);
    std::size_t cursor = 100;
    std::set<std::string> versions{kGood};
    for (int i = 0; i < 1000; ++i) {
      ASSERT_TRUE(text.edit(random_edit(text.text(), cursor, random)));
      versions.insert(text.text());
      if (random() % 10 == 0) text.advance(2.0, 0.0);  // a pause
    }
    const std::string last = text.text();
    int steps = 0;
    for (; text.undo() != nullptr; ++steps) EXPECT_TRUE(versions.contains(text.text())) << steps;
    EXPECT_GT(steps, 300);
    EXPECT_EQ(text.text(), kGood);
    for (; text.redo() != nullptr; --steps) EXPECT_TRUE(versions.contains(text.text())) << steps;
    EXPECT_EQ(steps, 0);
    EXPECT_EQ(text.text(), last);
  }
}

TEST(SceneText, UndoAndRedoInAnyOrderGiveTheTextsOfTheirPlace) {
  std::mt19937 random(7);
  SceneText text = text_shown(kGood);
  std::vector<std::string> past{kGood};  // the texts of the history, and
  std::size_t now = 0;                   // the current one
  for (int i = 0; i < 1000; ++i) {
    const auto what = random() % 3;
    if (what == 0 && text.undo() != nullptr) {
      --now;
    } else if (what == 1 && text.redo() != nullptr) {
      ++now;
    } else if (what == 2) {
      std::size_t cursor = random();
      const std::string after = random_edit(text.text(), cursor, random);
      if (after == text.text()) continue;
      text.advance(2.0, 0.0);  // each is a step of its own
      text.edit(after);
      past.resize(++now);
      past.push_back(after);
    }
    ASSERT_EQ(text.text(), past[now]) << i;
    EXPECT_EQ(text.can_undo(), now > 0);
    EXPECT_EQ(text.can_redo(), now + 1 < past.size());
  }
}

TEST(SceneText, AWordIsOneStep) {
  SceneText text = text_shown("{}");
  std::string typed = "{";
  for (const char c : std::string("one two")) text.edit((typed += c) + "}");
  text.undo();
  EXPECT_EQ(text.text(), "{one }");
  text.undo();
  EXPECT_EQ(text.text(), "{}");
  text.redo();
  for (const char* deleted : {"{one}", "{on}", "{o}"}) text.edit(deleted);
  text.undo();
  EXPECT_EQ(text.text(), "{one }");
}

TEST(TextHistory, ForgetsTheOldestStepsBeyondItsSize) {
  TextHistory history(1000);
  std::string text;
  std::set<std::string> versions{text};
  for (int i = 0; i < 100; ++i) {
    history.end_step();
    const std::string after = text + std::string(90, static_cast<char>('a' + i % 26));
    history.add(difference(text, after));
    text = after;
    versions.insert(text);
    EXPECT_LE(history.bytes(), 1000U);
  }
  int steps = 0;
  for (const TextChange* change = history.undo(); change != nullptr; change = history.undo()) {
    change->apply(text);
    ++steps;
  }
  EXPECT_EQ(steps, 11);
  EXPECT_EQ(text.size(), 89U * 90U);
  EXPECT_TRUE(versions.contains(text));
  history.add({0, "", std::string(2000, 'x')});
  EXPECT_FALSE(history.can_undo()) << "a step that is larger than all the history";
  EXPECT_EQ(history.bytes(), 0U);
}

struct WrongPassage {
  std::string passage;
  std::string replacement;
  std::string pointer;  // of the problem; "" for an error of syntax
};

TEST(SceneText, EveryKindOfErrorIsShownAtItsLine) {
  const std::vector<WrongPassage> all{
      {"\"mass\": 2", "\"mass\": -1", "/bodies/1/mass"},
      {"\"mass\": 2", "\"mass\": 1e999", "/bodies/1/mass"},
      {"\"mass\": 2", "\"mass\": \"2\"", "/bodies/1/mass"},
      {"\"mass\": 2", "\"mass\": 2, \"mass\": 3", "/bodies/1/mass"},
      {"\"mass\": 2", "\"massive\": 2", "/bodies/1/massive"},
      {"\"velocity\": [0, 0, 0]", "\"velocity\": [0, 1e9, 0]", "/bodies/1/velocity/1"},
      {"[1, 0.1, 0.1]", "[1, 0.1]", "/bodies/1/shape/size"},
      {"\"radius\": 0.5", "\"width\": 0.5", "/bodies/2/shape/width"},
      {"\"plane\"", "\"plan\"", "/bodies/0/shape/type"},
      {"\"name\": \"ball\"", "\"name\": \"arm\"", "/bodies/2/name"},
      {"\"b\": \"world\"", "\"b\": \"wrld\"", "/joints/0/b"},
      {"\"type\": \"hinge\"", "\"type\": \"henge\"", "/joints/0/type"},
      {"\"compliance\": 1e-8", "\"compliance\": -1", "/joints/1/compliance"},
      {"\"joint_gap\": 0.1", "\"joint_gap\": 0", "/criteria/joint_gap"},
      {"\"track\": \"arm\"", "\"track\": \"leg\"", "/criteria/track"},
      {"\"solver\": \"bpp\"", "\"solver\": \"bbp\"", "/settings/solver"},
      {"\"n\": 16", "\"n\": 1.5", "/settings/n"},
      {"\"gravity\", \"joints\"", "\"gravity\", \"jonts\"", "/effects/1"},
      {"\"frame\": 0.01", "\"frame\": 0", "/frame"},
      {"\"version\": 1", "\"version\": 3", "/version"},
      {"\"frame\": 0.01,", "\"frame\": 0.01", ""},
      {"\"frame\": 0.01,", "\"frame\": 0.01;", ""},
      {"\"mass\": 2", "\"mass\": two", ""},
      {"\"title\": \"Good\"", "\"title\": \"Good", ""},
  };
  for (const WrongPassage& wrong : all) {
    SCOPED_TRACE(wrong.replacement);
    SceneText text = text_shown(kGood);
    text.edit(with(wrong.passage, wrong.replacement));
    check_text(text);
    EXPECT_EQ(text.scene(), nullptr);
    const std::size_t line = place_at(kGood, kGood.find(wrong.passage)).line;
    const auto& problems = text.problems();
    const auto found = std::find_if(problems.begin(), problems.end(), [&](const auto& problem) {
      return problem.problem.pointer == wrong.pointer;
    });
    ASSERT_NE(found, problems.end());
    // A missing comma is found where the next line begins.
    const bool later = wrong.pointer.empty() && found->place.line == line + 1;
    EXPECT_EQ(found->place.line, later ? line + 1 : line) << to_string(found->problem);
    EXPECT_FALSE(found->problem.message.starts_with("line "));
    text.undo();
    check_text(text);
    EXPECT_TRUE(text.problems().empty());
    EXPECT_NE(text.scene(), nullptr);
    EXPECT_FALSE(text.changed());
  }
}

TEST(SceneText, AMisspeltKeyHasASuggestion) {
  SceneText text = text_shown(kGood);
  text.edit(with("\"mass\": 2", "\"mas\": 2"));
  check_text(text);
  ASSERT_EQ(text.problems().size(), 2U);
  EXPECT_EQ(text.problems()[0].problem.message, "missing");
  EXPECT_NE(text.problems()[1].problem.message.find("did you mean \"mass\"?"), std::string::npos);
}

TEST(SceneText, AValidEditIsAScene) {
  SceneText text = text_shown(kGood);
  text.edit(with("\"mass\": 2", "\"mass\": 3"));
  EXPECT_EQ(text.scene(), nullptr) << "not checked yet";
  check_text(text);
  ASSERT_NE(text.scene(), nullptr);
  EXPECT_EQ(text.scene()->bodies[1].mass, 3.0);
  EXPECT_TRUE(text.changed());
  text.mark_loaded();
  EXPECT_FALSE(text.changed());
  text.undo();
  EXPECT_TRUE(text.changed());
}

TEST(SceneText, FormattingKeepsTheContent) {
  SceneText text = text_shown("{\"b\":[1,2.50],\"a\":{\"x\":\"é\",\"y\":[[1],[2]],\"z\":{}}}");
  const auto formatted = text.formatted();
  ASSERT_TRUE(formatted);
  EXPECT_NE(formatted->find('\n'), std::string::npos);
  EXPECT_EQ(Json::parse(*formatted), Json::parse(text.text()));
  for (const char* bad : {"{", "{\"a\": 1, \"a\": 2}", "{\"a\": 1e999}", ""}) {
    EXPECT_FALSE(text_shown(bad).formatted()) << bad;
  }
}

/// A valid scene with many bodies: long enough to wait for a pause.
std::string long_text(std::size_t bodies) {
  Scene scene = *shipped("free_fall");
  scene.criteria = {};
  const Body body = scene.bodies.back();
  for (std::size_t i = 0; i < bodies; ++i) {
    Body& added = scene.bodies.emplace_back(body);
    added.name = "body_" + std::to_string(i);
    added.position.x() += 10.0 * static_cast<double>(i + 1);
  }
  return write_scene(scene);
}

TEST(SceneText, ALongTextIsCheckedAfterAPauseAndInSlices) {
  const std::string whole_text = long_text(2500);
  ASSERT_GT(whole_text.size(), SceneText::kQuick);
  ASSERT_LT(whole_text.size(), SceneText::kMost);
  SceneText text = text_shown("{}");
  text.edit(whole_text);
  for (double time = 0.0; time < SceneText::kPause - 2.0 * kFrame; time += kFrame) {
    text.advance(kFrame, 1.0);
    EXPECT_FALSE(text.checked());
  }
  int slices = 0;
  for (; !text.checked(); ++slices) text.advance(kFrame, 0.0);
  EXPECT_GT(slices, 4);
  EXPECT_NE(text.scene(), nullptr);
  text.edit(whole_text + " ");
  text.advance(1.0, 0.0);
  text.edit(whole_text);
  EXPECT_FALSE(text.checked()) << "the check begins again";
}

/// Texts that a reader, a scan or a field could choke on.
std::vector<std::string> hostile_texts() {
  constexpr std::size_t kMany = 500'000;
  const auto many = [](const std::string& part) {
    std::string text;
    while (text.size() < kMany) text += part;
    return text;
  };
  std::string noise;
  std::mt19937 random(11);
  for (std::size_t i = 0; i < kMany; ++i) noise += static_cast<char>(1 + random() % 255);
  return {many("["),
          many("{\"a\":"),
          "{\"bodies\":[" + many("[],") + "1]}",
          "{\"bodies\":[" + many("{},") + "{}]}",
          "{" + many("\"a\":1,") + "\"a\":1}",
          "{\"format\":\"substep-scene\",\"version\":1,\"bodies\":[" + many("1e999,") + "1]}",
          "{\"name\":\"" + many("x") + "\"}",
          many("\\"),
          many("\""),
          many("\n"),
          many("1"),
          many(","),
          many("{"),
          many("}"),
          std::string("{\"a\":\0}", 7),
          std::string(3, '\0'),
          "<xml>" + many("<a>"),
          noise,
          kGood + kGood,
          kGood.substr(0, kGood.size() - 1),
          "",
          " \n"};
}

TEST(SceneText, HostileTextsEndInProblems) {
  for (const std::string& hostile : hostile_texts()) {
    SceneText text = text_shown(kGood);
    ASSERT_TRUE(text.edit(hostile));
    check_text(text);
    EXPECT_EQ(text.scene(), nullptr);
    ASSERT_FALSE(text.problems().empty()) << hostile.substr(0, 40);
    EXPECT_LE(text.problems().size(), kMaxProblems + 1);
    for (const PlacedProblem& problem : text.problems()) {
      EXPECT_LE(offset_of(hostile, problem.place), hostile.size());
    }
    text.undo();
    EXPECT_EQ(text.text(), kGood);
  }
}

TEST(SceneText, ATextThatIsTooLongIsRefused) {
  SceneText text = text_shown(kGood);
  EXPECT_FALSE(text.edit(std::string(SceneText::kMost + 1, ' ')));
  EXPECT_EQ(text.text(), kGood);
  EXPECT_TRUE(text.checked());
  EXPECT_FALSE(text.can_undo());
}

// In the window.

void open_editor(Headless& h, const std::string& scene) {
  ASSERT_EQ(h.app->set("scene", scene), "");
  ASSERT_EQ(h.app->set("panel", "editor"), "");
  h.frames(3);
}

const std::string& editor_text(const Headless& h) { return h.app->editor.text().text(); }

/// The text with a passage replaced, as if it was typed, and the frames until it runs or not.
void replace_passage(Headless& h, const std::string& passage, const std::string& by) {
  ASSERT_TRUE(h.app->editor.edit(with(passage, by, editor_text(h))));
  h.frames(30);
}

double mass_of_body(const Headless& h, const std::string& name) {
  for (const Body& body : h.app->session.scene().bodies) {
    if (body.name == name) return body.mass;
  }
  return 0.0;
}

TEST(SceneEditor, AValidEditRunsFromItsStartAndAnInvalidOneDoesNot) {
  Headless h;
  open_editor(h, "swinging_box");
  h.app->session.play();
  h.frames(20);
  const auto before = h.app->session.shared_scene();
  replace_passage(h, "\"mass\": 1000", "\"mass\": -7");
  EXPECT_EQ(h.app->session.shared_scene(), before);
  EXPECT_GT(h.app->session.state().frame, 40) << "the run continues";
  ASSERT_FALSE(h.app->editor.text().problems().empty());
  EXPECT_EQ(h.app->trouble.title, "") << "no card while typing";
  replace_passage(h, "\"mass\": -7", "\"mass\": 700");
  EXPECT_EQ(mass_of_body(h, "box"), 700.0);
  EXPECT_TRUE(h.app->session.playing());
  EXPECT_LT(h.app->session.state().frame, 30) << "from its start";
  EXPECT_TRUE(is_own(h.app->session.loaded()));
  EXPECT_FALSE(h.app->editor.text().changed());
  h.app->editor.undo();
  h.frames(30);
  h.app->editor.undo();
  h.frames(30);
  EXPECT_EQ(mass_of_body(h, "box"), 1000.0);
}

TEST(SceneEditor, KeepsWhatTheTextDoesNotChange) {
  Headless h;
  open_editor(h, "swinging_box");
  h.app->set("mode", "none");
  h.app->set("alpha", "0.3");
  h.app->set("load", "2");
  h.app->set("compare", "mode:damping");
  h.app->view.camera.orbit(0.4, 0.1);
  h.app->view.camera.update(1.0, true);
  h.frames(2);
  const std::string view = h.app->view.camera.text();
  replace_passage(h, "\"gravity\": [0, -9.81, 0]", "\"gravity\": [0, -1.62, 0]");
  EXPECT_EQ(h.app->session.scene().gravity.y(), -1.62);
  EXPECT_EQ(h.app->session.settings().mode, Mode::kNone);
  EXPECT_EQ(h.app->session.settings().alpha, 0.3);
  EXPECT_EQ(h.app->load, 2.0);
  EXPECT_EQ(mass_of_body(h, "box"), 2000.0);
  ASSERT_TRUE(h.app->compare.open());
  EXPECT_EQ(h.app->compare.overrides().front(), (Overrides{{"mode", "damping"}}));
  EXPECT_EQ(h.app->view.camera.text(), view);
  replace_passage(h, "{\"preset\": \"paper\"}", "{\"preset\": \"paper\", \"alpha\": 0.05}");
  EXPECT_EQ(h.app->session.settings().alpha, 0.05) << "the text changed it";
  EXPECT_EQ(h.app->session.settings().mode, Mode::kNone);
}

TEST(SceneEditor, OneSceneOfOnesOwnHoldsTheEdits) {
  Headless h;
  int stored = 0;
  h.app->host.remember = [&](const std::string& k, const std::string&) {
    stored += k == "own_scenes" ? 1 : 0;
  };
  const auto own_names = [&] {
    std::vector<std::string> names;
    for (const auto& scene : h.app->library.scenes()) {
      if (is_own(*scene)) names.push_back(scene->name);
    }
    return names;
  };
  Scene other = *shipped("pendulum");
  other.name = "swing";
  other.title = "Another one";
  h.app->add_own(other);
  stored = 0;
  open_editor(h, "swinging_box");
  for (const char* mass : {"1", "12", "123"}) {
    replace_passage(h, "\"mass\": 1000", std::string("\"mass\": ") + mass);
    EXPECT_EQ(own_names().size(), 2U);
    replace_passage(h, std::string("\"mass\": ") + mass, "\"mass\": 1000");
  }
  EXPECT_EQ(stored, 0) << "it is stored after a pause";
  h.frames(60);
  EXPECT_EQ(stored, 1);
  // Names on the way to the whole one, one of which is taken.
  std::string before = "swinging_box";
  for (const char* name : {"s", "sw", "swi", "swin", "swing", "swingin"}) {
    replace_passage(h, "\"name\": \"" + before + "\"", std::string("\"name\": \"") + name + "\"");
    before = name;
  }
  EXPECT_EQ(h.app->library.find("swing")->title, "Another one");
  EXPECT_EQ(own_names().size(), 2U);
  EXPECT_NE(h.app->library.find("swingin"), nullptr);
  EXPECT_EQ(h.app->session.scene().name, "swingin");
  EXPECT_EQ(h.app->own.scenes().size(), 2U);
}

TEST(SceneEditor, ItsLinkAndFileReproduceTheRun) {
  Headless h;
  open_editor(h, "swinging_box");
  replace_passage(h, "\"mass\": 1000", "\"mass\": 500");
  int told = 0;
  h.app->host.link_changed = [&](const std::string&) { ++told; };
  h.frames(3);
  told = 0;
  replace_passage(h, "\"mass\": 500", "\"mass\": 640");
  EXPECT_EQ(told, 1) << "the scene has the same name, but another text";
  for (int i = 0; i < 40; ++i) h.app->session.step();
  const std::uint64_t hash = h.app->session.hash();
  // The page packs the text of this scene into the link.
  const std::string packed = write_scene(h.app->link_scene());
  const std::string link = h.app->link();
  std::string saved;
  h.app->host.save_file = [&](const std::string& name, const std::string& bytes) {
    EXPECT_EQ(name, "swinging_box.json");
    saved = bytes;
  };
  h.frames(2);
  h.press("Save");
  EXPECT_EQ(saved, editor_text(h));
  for (const std::string& text : {packed, saved}) {
    Headless other;
    other.app->open_link(link, read_scene(text));
    EXPECT_EQ(mass_of_body(other, "box"), 640.0);
    for (int i = 0; i < 40; ++i) other.app->session.step();
    EXPECT_EQ(other.app->session.hash(), hash);
  }
}

TEST(SceneEditor, TheTextFollowsTheRun) {
  Headless h;
  open_editor(h, "swinging_box");
  const std::string plain = editor_text(h);
  h.app->session.step();
  h.app->session.throw_ball({{0, 5, 5}, {0, 0, -5}, 0.5, 10.0});
  h.frames(2);
  EXPECT_NE(editor_text(h), plain);
  EXPECT_EQ(read_scene(editor_text(h)).scene->bodies.size(), h.app->session.scene().bodies.size());
  h.app->reset();
  h.frames(2);
  EXPECT_EQ(editor_text(h), plain);
  h.app->set("scene", "pendulum");
  h.frames(2);
  EXPECT_NE(editor_text(h).find("\"pendulum\""), std::string::npos);
  EXPECT_FALSE(h.app->editor.text().changed());
  EXPECT_EQ(read_scene(editor_text(h)).scene->name, "pendulum");
}

TEST(SceneEditor, AnEditOfARunWithABallStartsWithIt) {
  Headless h;
  open_editor(h, "swinging_box");
  h.app->set("load", "2");
  h.app->session.step();
  h.app->session.throw_ball({{0, 5, 5}, {0, 0, -5}, 0.5, 10.0});
  h.frames(2);
  const std::size_t bodies = h.app->session.scene().bodies.size();
  replace_passage(h, "\"mass\": 2000", "\"mass\": 2500");
  EXPECT_EQ(mass_of_body(h, "box"), 2500.0) << "the load is in the text already";
  EXPECT_EQ(h.app->session.scene().bodies.size(), bodies);
  EXPECT_EQ(h.app->load, 1.0);
}

TEST(SceneEditor, ChangesOnBothSidesAreNotLost) {
  for (const bool keep : {false, true}) {
    Headless h;
    open_editor(h, "swinging_box");
    replace_passage(h, "\"mass\": 1000", "\"mass\": oops");
    const std::string mine = editor_text(h);
    h.app->set("scene", "pendulum");
    h.frames(3);
    EXPECT_EQ(editor_text(h), mine);
    EXPECT_TRUE(h.app->editor.conflict());
    replace_passage(h, "oops", "900");
    EXPECT_EQ(h.app->session.scene().name, "pendulum") << "nothing runs unasked";
    h.press(keep ? "Keep this text" : "Show the run's scene");
    h.frames(30);
    EXPECT_FALSE(h.app->editor.conflict());
    if (keep) {
      EXPECT_EQ(mass_of_body(h, "box"), 900.0);
    } else {
      EXPECT_EQ(read_scene(editor_text(h)).scene->name, "pendulum");
      h.app->editor.undo();
      EXPECT_NE(editor_text(h).find("\"mass\": 900"), std::string::npos);
    }
  }
}

TEST(SceneEditor, WithoutApplyWhileTypingTheButtonRunsTheText) {
  Headless h;
  open_editor(h, "swinging_box");
  h.press("Apply while typing");
  replace_passage(h, "\"mass\": 1000", "\"mass\": 10");
  h.frames(60);
  EXPECT_EQ(mass_of_body(h, "box"), 1000.0);
  h.press("Apply");
  EXPECT_EQ(mass_of_body(h, "box"), 10.0);
}

TEST(SceneEditor, AHeavySceneWaitsForConfirmation) {
  Headless h;
  open_editor(h, "swinging_box");
  Scene scene = *shipped("swinging_box");
  scene.name = "heavy";
  scene.settings.mode = Mode::kConst;
  scene.settings.solver = SolverKind::kPgs;
  scene.settings.iterations = 400;
  scene.settings.n = 10000;
  h.app->editor.edit(write_scene(scene));
  h.frames(30);
  EXPECT_EQ(h.app->session.scene().name, "heavy");
  EXPECT_TRUE(h.app->held());
  EXPECT_FALSE(h.app->session.playing());
}

TEST(SceneEditor, HostileTextsLeaveTheRunAndTheWindow) {
  Headless h;
  open_editor(h, "pendulum");
  h.app->session.play();
  const std::string before = editor_text(h);
  for (const std::string& hostile : hostile_texts()) {
    const std::int64_t frame = h.app->session.state().frame;
    h.app->editor.edit(hostile);
    h.frames(40);
    EXPECT_EQ(h.app->session.scene().name, "pendulum");
    EXPECT_GT(h.app->session.state().frame, frame) << "the run continues";
    EXPECT_FALSE(h.app->editor.text().problems().empty());
    h.app->editor.undo();
    h.frames(3);
  }
  EXPECT_EQ(editor_text(h), before);
  EXPECT_TRUE(h.app->editor.text().problems().empty());
}

// Dear ImGui's text begins where the numbers say: a click at a marked line goes to this line.
TEST(SceneEditor, LinesAreMarkedWhereTheirTextIs) {
  for (const auto& [width, height] : {std::pair{1280.0F, 720.0F}, {390.0F, 844.0F}}) {
    Headless h(width, height);
    open_editor(h, "swinging_box");
    const std::string text = with("\"mass\": 1000", "\"mass\": -7", editor_text(h));
    const std::size_t line = place_at(text, text.find("\"mass\": -7")).line;
    replace_passage(h, "\"mass\": 1000", "\"mass\": -7");
    ASSERT_EQ(h.app->editor.text().problems().size(), 1U);
    EXPECT_EQ(h.app->editor.text().problems()[0].place.line, line);
    EXPECT_EQ(find_handle("marked line " + std::to_string(line)), nullptr) << "it is far below";
    h.press("Line " + std::to_string(line));
    h.frames(4);
    const auto& state = ImGui::GetCurrentContext()->InputTextState;
    EXPECT_EQ(place_at(text, static_cast<std::size_t>(state.Stb.cursor)).line, line);
    const ui::Handle* mark = find_handle("marked line " + std::to_string(line));
    ASSERT_NE(mark, nullptr) << "the field scrolls there";
    const ui::Handle* field = find_handle("scene text");
    ASSERT_NE(field, nullptr);
    const float s = ui::interface_scale(h.app->desk, ImGui::GetIO().DisplaySize);
    for (const float down : {0.1F, 0.9F}) {
      const float y = mark->min.y + down * (mark->max.y - mark->min.y);
      h.click(s * (field->min.x + 100.0F), s * y);
      EXPECT_EQ(place_at(text, static_cast<std::size_t>(state.Stb.cursor)).line, line);
      mark = find_handle("marked line " + std::to_string(line));
      ASSERT_NE(mark, nullptr);
      field = find_handle("scene text");
    }
  }
}

TEST(SceneEditor, TypingIsTextAndItsKeysAreItsOwn) {
  Headless h;
  open_editor(h, "swinging_box");
  EXPECT_FALSE(ImGui::GetIO().WantTextInput) << "a link does not take the keyboard";
  h.app->set("panel", "plots");
  h.frames(2);
  h.type("e");
  h.frames(3);
  ASSERT_EQ(h.app->desk.tab, Tab::kText);
  ASSERT_TRUE(ImGui::GetIO().WantTextInput);
  const std::string plain = editor_text(h);
  EXPECT_EQ(h.app->editor.text().changed(), false) << "the key is not typed";
  const std::size_t at = plain.find("\"mass\": 1000") + 8;
  h.app->desk.scene_text.go_to(at + 4);
  h.frames(2);
  const bool dark = h.app->desk.dark;
  h.press_key(ImGuiKey_Backspace);
  h.type("t");
  EXPECT_EQ(h.app->desk.dark, dark);
  EXPECT_EQ(editor_text(h).substr(at, 4), "100t");
  EXPECT_FALSE(h.app->editor.text().problems().empty());
  h.press_key(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(editor_text(h).substr(at, 4), "100,") << "one step";
  h.press_key(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(editor_text(h), plain);
  h.press_key(ImGuiKey_Y, ImGuiMod_Ctrl);
  h.press_key(ImGuiKey_Y, ImGuiMod_Ctrl);
  EXPECT_EQ(editor_text(h).substr(at, 4), "100t");
  h.type("\xf0\x9f\x99\x82");
  EXPECT_EQ(editor_text(h).substr(at + 4, 4), "\xf0\x9f\x99\x82") << "all of Unicode";
  h.press_key(ImGuiKey_Escape);
  EXPECT_FALSE(ImGui::GetIO().WantTextInput);
  EXPECT_EQ(editor_text(h).substr(at, 4), "100t") << "Esc leaves the field, and the text";
  h.type("e");
  EXPECT_NE(h.app->desk.tab, Tab::kText);
}

TEST(SceneEditor, ANewLineBeginsBelowTheOneBefore) {
  Headless h;
  open_editor(h, "swinging_box");
  const std::size_t at = editor_text(h).find("\"bodies\": [") + 11;
  h.app->desk.scene_text.go_to(at);
  h.frames(3);
  h.press_key(ImGuiKey_Enter);
  EXPECT_EQ(editor_text(h).substr(at, 6), "\n    \n");
  h.type("{");
  h.press_key(ImGuiKey_Enter);
  EXPECT_EQ(editor_text(h).substr(at, 14), "\n    {\n      \n");
}

TEST(SceneEditor, IsOpenedFromItsButtonAndFromTheMenu) {
  for (const auto& [width, height] : {std::pair{1280.0F, 720.0F}, {390.0F, 844.0F}}) {
    Headless h(width, height);
    h.press("Edit as text");
    h.frames(2);
    EXPECT_EQ(h.app->desk.tab, Tab::kText);
    EXPECT_NE(find_handle("scene text"), nullptr);
    h.press("Close the text");
    h.frames(2);
    EXPECT_EQ(find_handle("scene text"), nullptr);
    h.app->set("menu", "share");
    h.frames(4);
    const auto& all = ui::handles();
    // The button by the scene has the same name, but no words.
    const auto item = std::find_if(all.begin(), all.end(), [](const auto& x) {
      return x.label == "Edit as text" && x.max.x - x.min.x > 60.0F;
    });
    ASSERT_NE(item, all.end());
    const float s = ui::interface_scale(h.app->desk, ImGui::GetIO().DisplaySize);
    h.click(0.5F * s * (item->min.x + item->max.x), 0.5F * s * (item->min.y + item->max.y));
    EXPECT_EQ(h.app->desk.tab, Tab::kText);
  }
}

TEST(SceneEditor, FitsTheWindow) {
  for (const auto& [width, height] :
       {std::pair{1280.0F, 720.0F}, {1920.0F, 1080.0F}, {390.0F, 844.0F}, {844.0F, 390.0F}}) {
    Headless h(width, height);
    open_editor(h, "swinging_box");
    replace_passage(h, "\"mass\"", "\"mas\"");
    replace_passage(h, "\"shape\"", "\"shap\"");
    const ui::Handle* field = find_handle("scene text");
    ASSERT_NE(field, nullptr);
    EXPECT_GT(field->max.y - field->min.y, 90.0F) << width;
    for (const char* name :
         {"scene text", "Undo", "Redo", "Format", "Apply while typing", "Close the text"}) {
      const ui::Handle* handle = find_handle(name);
      ASSERT_NE(handle, nullptr) << name << " at " << width;
      EXPECT_LE(handle->max.x, width);
      EXPECT_LE(handle->max.y, height) << name << " at " << width;
    }
  }
}

TEST(SceneEditor, AVeryLargeSceneHasNoText) {
  Headless h;
  Scene scene = *read_scene(long_text(6000)).scene;
  scene.name = "crowd";
  h.app->open_text(write_scene(scene), "crowd.json");
  h.app->set("panel", "editor");
  h.frames(3);
  EXPECT_EQ(find_handle("scene text"), nullptr);
  EXPECT_NE(h.app->editor.too_long, "");
  h.app->set("scene", "pendulum");
  h.frames(3);
  EXPECT_NE(find_handle("scene text"), nullptr);
}

}  // namespace
}  // namespace substep
