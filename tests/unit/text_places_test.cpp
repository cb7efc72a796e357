// The places of problems in a text. Those of all invalid scenes of the tests of the reader are
// checked in scene_text.hpp.

#include "core/io/text_places.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "core/io/json_text.hpp"
#include "core/io/scene_reader.hpp"

namespace substep {
namespace {

TextPlace place_of(const std::string& pointer, const std::string& text) {
  return places_of({{pointer, "is wrong"}}, text).front();
}

TEST(TextPlaces, OfMembersAndItems) {
  const std::string text = "\n{\n  \"a\": 1, \"b\": [\n    10,\n 20, {\"c\":\n3}]\n}\n";
  EXPECT_EQ(place_of("", text), (TextPlace{2, 1}));
  EXPECT_EQ(place_of("/a", text), (TextPlace{3, 3}));
  EXPECT_EQ(place_of("/b", text), (TextPlace{3, 11}));
  EXPECT_EQ(place_of("/b/0", text), (TextPlace{4, 5}));
  EXPECT_EQ(place_of("/b/1", text), (TextPlace{5, 2}));
  EXPECT_EQ(place_of("/b/2/c", text), (TextPlace{5, 7}));
}

TEST(TextPlaces, OfWhatIsMissingAreThoseAroundIt) {
  const std::string text = "{\n \"a\": {\n  \"b\": []\n }\n}";
  EXPECT_EQ(place_of("/x/y", text), (TextPlace{1, 1}));
  EXPECT_EQ(place_of("/a/x", text), (TextPlace{2, 2}));
  EXPECT_EQ(place_of("/a/b/0", text), (TextPlace{3, 3}));
}

TEST(TextPlaces, KeysMayHaveEscapesSlashesAndBrackets) {
  const std::string text = "{\"x\\\"]}\": 0,\n\"a/b~c\": 0,\n\"\\u00e9\": 0,\n\"\": 0}";
  EXPECT_EQ(place_of("/x\"]}", text), (TextPlace{1, 2}));
  EXPECT_EQ(place_of("/a~1b~0c", text), (TextPlace{2, 1}));
  EXPECT_EQ(place_of("/\u00e9", text), (TextPlace{3, 1}));
  EXPECT_EQ(place_of("/", text), (TextPlace{4, 1}));
}

// As the reader: the last one counts, and a key that occurs twice is a problem of that one.
TEST(TextPlaces, OfTwoMembersWithOneKeyTheLastCounts) {
  const std::string text = "{\"a\": {\"b\": 0},\n\"a\": {\n\"c\": 0}}";
  EXPECT_EQ(place_of("/a", text), (TextPlace{2, 1}));
  EXPECT_EQ(place_of("/a/c", text), (TextPlace{3, 1}));
  EXPECT_EQ(place_of("/a/b", text), (TextPlace{2, 1})) << "the first member is void";
}

TEST(TextPlaces, OfSyntaxErrorsAreThoseOfTheParser) {
  for (const std::string text : {"{\n  \"a\": tru\n}", "{\n\"a\" 1}", "[1,\n2", "{\n\n'a': 1}"}) {
    Problems problems;
    EXPECT_FALSE(parse_json(text, problems));
    ASSERT_EQ(problems.size(), 1U);
    const TextPlace place = places_of(problems, text).front();
    EXPECT_GT(place.line, 1U) << text;
    std::string message = problems[0].message;
    EXPECT_EQ(take_place(message), place);
    EXPECT_EQ(place_text(place) + message, problems[0].message);
  }
}

TEST(TextPlaces, AreTakenOnlyFromTheBeginningOfAMessage) {
  for (const std::string kept :
       {"must be 1", "line x, column 2: no", "line 1, column : no", "line 1 column 2: no",
        "no line 1, column 2: no", "line 1, column 2",
        "line 11111111111111111111, column 1: too far"}) {
    std::string message = kept;
    EXPECT_EQ(take_place(message), std::nullopt) << kept;
    EXPECT_EQ(message, kept);
  }
}

TEST(TextPlaces, AreBytesAndBack) {
  const std::string text = "ab\n\ncdé\n";
  for (std::size_t i = 0; i <= text.size(); ++i) {
    EXPECT_EQ(offset_of(text, place_at(text, i)), i);
  }
  EXPECT_EQ(offset_of(text, {1, 9}), 2U) << "the end of the line";
  EXPECT_EQ(offset_of(text, {9, 1}), text.size());
}

// Each takes milliseconds; a scan that begins again at every value would take hours.
TEST(TextPlaces, HostileTextsTakeLinearTime) {
  constexpr std::size_t kMany = 400'000;
  std::string twice = "{";
  for (std::size_t i = 0; i < kMany; ++i) twice += "\"a\":{\"b\":0},";
  twice += "\"a\":{\"b\":0}}";
  std::string deep(kMany, '[');
  std::string commas(kMany, ',');
  std::string quotes(kMany, '"');
  std::string closed = "{\"a\": 1" + std::string(kMany, '}');
  std::string lines(kMany, '\n');
  Problems problems(1000, {"/a/b/0/0/0/0/0", "is wrong"});
  for (const std::string& text : {twice, deep, commas, quotes, closed, lines}) {
    for (const TextPlace& place : places_of(problems, text)) {
      EXPECT_LE(place.line, kMany + 1);
    }
  }
  EXPECT_EQ(place_of("/a/b", twice), place_at(twice, twice.rfind("\"b\"")));
}

}  // namespace
}  // namespace substep
