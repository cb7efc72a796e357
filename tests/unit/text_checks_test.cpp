// Characters of names and other texts: refused when read or built, escaped when printed.

#include "core/model/text_checks.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/io/json.hpp"
#include "core/model/scene_builder.hpp"
#include "core/model/validate.hpp"
#include "tests/unit/scene_text.hpp"

namespace substep {
namespace {

struct Odd {
  const char* bytes;
  const char* escape;   // as a JSON string
  const char* visible;  // when printed
  const char* fault;
};

// One character of each kind, between two letters.
const std::vector<Odd> kOdd = {
    {"\x1b", "\\u001b", "\\x1b", "a control character (U+001B)"},
    {"\n", "\\n", "\\x0a", "a control character (U+000A)"},
    {"\x7f", "\\u007f", "\\x7f", "a control character (U+007F)"},
    {"\xc2\x80", "\\u0080", "\\xc2\\x80", "a control character (U+0080)"},
    {"\xc2\x85", "\\u0085", "\\xc2\\x85", "a control character (U+0085)"},
    {"\xc2\x9b", "\\u009b", "\\xc2\\x9b", "a control character (U+009B)"},
    {"\xc2\x9f", "\\u009f", "\\xc2\\x9f", "a control character (U+009F)"},
    {"\xc2\xad", "\\u00ad", "\\xc2\\xad", "an invisible character (U+00AD)"},
    {"\xd8\x9c", "\\u061c", "\\xd8\\x9c", "a control of the direction of writing (U+061C)"},
    {"\xe2\x80\x8b", "\\u200b", "\\xe2\\x80\\x8b", "an invisible character (U+200B)"},
    {"\xe2\x80\x8d", "\\u200d", "\\xe2\\x80\\x8d", "an invisible character (U+200D)"},
    {"\xe2\x80\x8f", "\\u200f", "\\xe2\\x80\\x8f",
     "a control of the direction of writing (U+200F)"},
    {"\xe2\x80\xa8", "\\u2028", "\\xe2\\x80\\xa8", "a line separator (U+2028)"},
    {"\xe2\x80\xa9", "\\u2029", "\\xe2\\x80\\xa9", "a line separator (U+2029)"},
    {"\xe2\x80\xaa", "\\u202a", "\\xe2\\x80\\xaa",
     "a control of the direction of writing (U+202A)"},
    {"\xe2\x80\xae", "\\u202e", "\\xe2\\x80\\xae",
     "a control of the direction of writing (U+202E)"},
    {"\xe2\x81\xa6", "\\u2066", "\\xe2\\x81\\xa6",
     "a control of the direction of writing (U+2066)"},
    {"\xe2\x81\xa9", "\\u2069", "\\xe2\\x81\\xa9",
     "a control of the direction of writing (U+2069)"},
    {"\xef\xbb\xbf", "\\ufeff", "\\xef\\xbb\\xbf", "an invisible character (U+FEFF)"},
    {"\xf3\xa0\x81\x81", "\\udb40\\udc41", "\\xf3\\xa0\\x81\\x81",
     "an invisible character (U+E0041)"},
};

std::string between(const char* middle) { return "a" + std::string(middle) + "b"; }

TEST(TextChecks, RefuseAndEscapeWhatIsNotVisible) {
  for (const Odd& odd : kOdd) {
    const std::string text = between(odd.bytes);
    EXPECT_EQ(text_fault(text), " has " + std::string(odd.fault));
    EXPECT_EQ(visible_text(text), between(odd.visible));
    EXPECT_EQ(visible_text(visible_text(text)), between(odd.visible)) << "escaped only once";
  }
}

TEST(TextChecks, AllowWhatPeopleWrite) {
  for (const char* text :
       {"", "pendulum",
        "Pendel, Gr\xc3\xb6\xc3\x9f"
        "e \xc3\x97 2",
        "\xe6\x8c\xaf\xe3\x82\x8a\xe5\xad\x90", "\xd7\x9e\xd7\x98\xd7\x95\xd7\x98\xd7\x9c\xd7\xaa",
        "\xf0\x9f\xaa\x80",
        "\xd9\x85\xdb\x8c\xe2\x80\x8c\xd8\xae\xd9\x88\xd8\xa7\xd9\x87\xd9\x85",  // U+200C
        "\xf0\x9f\x91\xa9\xe2\x80\x8d\xf0\x9f\x94\xac",
        "no\xc2\xa0"
        "break"}) {  // U+200D
    EXPECT_EQ(text_fault(text), std::nullopt) << text;
    EXPECT_EQ(visible_text(text), text);
  }
}

TEST(TextChecks, RefuseAndEscapeInvalidUtf8) {
  for (const char* bytes : {"\x80", "\xc2", "\xc0\x9b", "\xe0\x82\x9b", "\xed\xa0\x80",
                            "\xf4\x90\x80\x80", "\xf8\x88\x80\x80\x80", "\xe2\x80"}) {
    const std::string text = between(bytes);
    EXPECT_EQ(text_fault(text), " is not valid UTF-8");
    EXPECT_EQ(text_fault(visible_text(text)), std::nullopt);
  }
}

TEST(TextChecks, AreThoseOfTheSceneReader) {
  for (const Odd& odd : kOdd) {
    const std::string text = "\"" + between(odd.escape) + "\"";
    for (const char* key : {"title", "group", "description", "look_for"}) {
      Json json = Json::parse(test::kGood);
      json[key] = Json::parse(text);
      const test::List found = test::problems_of(json.dump());
      ASSERT_EQ(found.size(), 1U) << key << text;
      EXPECT_TRUE(found[0].starts_with("/" + std::string(key) + ": \"a")) << found[0];
      EXPECT_TRUE(found[0].ends_with(std::string("has ") + odd.fault)) << found[0];
      EXPECT_EQ(text_fault(found[0]), std::nullopt) << "the message itself is harmless";
    }
    for (const char* list : {"bodies", "joints"}) {
      Json json = Json::parse(test::kGood);
      json[list].back()["name"] = Json::parse(text);
      const std::string place =
          "/" + std::string(list) + "/" + std::to_string(json[list].size() - 1) + "/name: \"a";
      const test::List found = test::problems_of(json.dump());
      ASSERT_FALSE(found.empty()) << list << text;
      EXPECT_TRUE(found[0].starts_with(place)) << found[0];
      EXPECT_TRUE(found[0].ends_with(std::string("has ") + odd.fault)) << found[0];
    }
  }
}

TEST(TextChecks, AreThoseOfScenesBuiltInCode) {
  const auto problem = [](auto change) {
    SceneBuilder builder("built");
    const int ball = builder.add_body(Sphere{0.1}, 1.0, {0, 1, 0});
    builder.add_ball_joint(ball, kWorld, {0, 2, 0});
    change(builder);
    const Problems problems = validate(*builder.build());
    return problems.size() == 1 ? to_code(problems[0]) : std::to_string(problems.size());
  };
  for (const Odd& odd : kOdd) {
    const std::string text = between(odd.bytes);
    const std::string fault = ": \"" + between(odd.visible) + "\" has " + std::string(odd.fault);
    EXPECT_EQ(problem([&](SceneBuilder& b) { b.scene().name = text; }), "name" + fault);
    EXPECT_EQ(problem([&](SceneBuilder& b) { b.scene().title = text; }), "title" + fault);
    EXPECT_EQ(problem([&](SceneBuilder& b) { b.scene().group = text; }), "group" + fault);
    EXPECT_EQ(problem([&](SceneBuilder& b) { b.body(0).name = text; }), "bodies[0].name" + fault);
    EXPECT_EQ(problem([&](SceneBuilder& b) { b.joint(0).name = text; }), "joints[0].name" + fault);
  }
}

}  // namespace
}  // namespace substep
