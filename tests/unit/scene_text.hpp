#pragma once
// A small scene file for mutation tests.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/io/scene_reader.hpp"

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

inline List problems_of(const std::string& text) {
  const SceneResult result = read_scene(text);
  List problems;
  for (const Problem& problem : result.problems) problems.push_back(to_string(problem));
  EXPECT_EQ(result.scene == nullptr, !problems.empty());
  return problems;
}

}  // namespace substep::test
