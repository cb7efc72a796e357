#pragma once
// A small scene file for mutation tests.

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/io/json.hpp"
#include "core/io/scene_reader.hpp"
#include "core/io/text_places.hpp"

namespace substep::test {

using List = std::vector<std::string>;

/// A small valid scene.
inline const std::string kGood = R"json({
  "format": "substep-scene",
  "version": 1,
  "name": "good",
  "title": "Good",
  "frame": 0.01,
  "effects": ["gravity", "joints", "contact", "friction"],
  "gravity": [0, -9.81, 0],
  "contact": {"compliance": 1e-9, "margin": 0.02},
  "settings": {"solver": "bpp", "alpha": 0.1, "n": 16, "probe": true},
  "criteria": {"joint_gap": 0.1, "track": "arm"},
  "bodies": [
    {"name": "floor", "static": true, "shape": {"type": "plane"}, "position": [0, 0, 0]},
    {"name": "arm", "shape": {"type": "box", "size": [1, 0.1, 0.1]}, "mass": 2,
     "inertia": [0.1, 0.2, 0.2], "position": [0, 3, 0], "orientation": [1, 0, 0, 0],
     "velocity": [0, 0, 0], "friction": 0.5},
    {"name": "ball", "shape": {"type": "sphere", "radius": 0.5}, "mass": 1, "position": [1, 3, 0]}
  ],
  "joints": [
    {"name": "hinge", "type": "hinge", "a": "arm", "b": "world", "anchor_a": [-0.5, 0, 0],
     "anchor_b": [-0.5, 3, 0], "axis_a": [0, 0, 1], "axis_b": [0, 0, 1]},
    {"name": "socket", "type": "ball", "a": "ball", "b": "arm", "anchor_a": [-0.5, 0, 0],
     "anchor_b": [0.5, 0, 0], "compliance": 1e-8}
  ]
})json";

/// The valid scene with one passage replaced.
inline std::string with(const std::string& passage, const std::string& replacement,
                        std::string text = kGood) {
  const std::size_t at = text.find(passage);
  EXPECT_NE(at, std::string::npos) << passage;
  if (at != std::string::npos) text.replace(at, passage.size(), replacement);
  return text;
}

/// Number of lines of a value in a text in which every value stands on a line of its own.
inline std::size_t lines_of(const Json& value) {
  if (!value.is_structured() || value.empty()) return 1;
  std::size_t lines = 2;
  for (const Json& item : value) lines += lines_of(item);
  return lines;
}

/// The place of a pointer in that text, or of the innermost value around it.
inline TextPlace place_by_counting(const Json& document, std::string pointer) {
  TextPlace place;
  const Json* at = &document;
  while (!pointer.empty()) {
    const std::string part = pointer.substr(0, pointer.find('/', 1));
    pointer.erase(0, part.size());
    if (!at->contains(Json::json_pointer(part))) break;
    const Json* inner = &at->at(Json::json_pointer(part));
    ++place.line;
    ++place.column;
    for (const Json& item : *at) {
      if (&item == inner) break;
      place.line += lines_of(item);
    }
    at = inner;
  }
  return place;
}

/// Every problem is found at its place: in the text, as another text with other line breaks. Of
/// very many problems the first ones, because each is counted from the start.
inline void expect_places(const std::string& text) {
  constexpr std::size_t kMost = 50;
  constexpr std::size_t kLongest = 1U << 20U;  // Json::parse: quadratic in the keys of an object
  if (text.size() > kLongest) return;
  const Json document = Json::parse(text, nullptr, false);
  if (document.is_discarded()) return;  // the parser gives the place, or a number has no value
  const std::string broken = document.dump(1);
  const Problems problems = read_scene(broken).problems;
  const std::vector<TextPlace> places = places_of(problems, broken);
  ASSERT_EQ(places.size(), problems.size());
  for (std::size_t i = 0; i < std::min(places.size(), kMost); ++i) {
    EXPECT_EQ(places[i], place_by_counting(document, problems[i].pointer))
        << to_string(problems[i]) << " is shown at line " << places[i].line << ", column "
        << places[i].column;
  }
}

inline List problems_of(const std::string& text) {
  expect_places(text);
  const SceneResult result = read_scene(text);
  List problems;
  for (const Problem& problem : result.problems) problems.push_back(to_string(problem));
  EXPECT_EQ(result.scene == nullptr, !problems.empty());
  return problems;
}

}  // namespace substep::test
