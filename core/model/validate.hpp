#pragma once
// What is wrong with data that a program hands over, before anything reads it. Each problem names
// its place and the allowed range, in the words of the scene reader; ranges are those of
// scene_limits.hpp and setting_fields.hpp. Reports at most kMaxProblems.

#include "core/model/budget.hpp"
#include "core/model/grab.hpp"
#include "core/model/problem.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// All that is wrong with a scene: what check_values() finds, and where its parts contradict each
/// other: no body moves, joints that start open, joints and contacts that hold the same twice,
/// effects that are off although the content asks for them. Names and other texts are not looked
/// at: only files refer to them.
Problems validate(const Scene& scene);

/// Settings outside their ranges, and enumerators that do not exist. Pointers begin with
/// "/settings".
Problems validate(const Settings& settings);

/// A state of that scene: lists with one item for every body, or left out where that is allowed;
/// numbers that are finite; orientations of length 1. Pointers begin with "/state".
Problems validate(const State& state, const Scene& scene);

/// A hand on a moving body of that scene, with finite numbers. Pointers begin with "/grab".
Problems validate(const Grab& grab, const Scene& scene);

/// A budget within kMemoryBudgetRange and kWorkBudgetRange. Pointers begin with "/budget".
Problems validate(const Budget& budget);

/// Only what a run must not be given: numbers outside their ranges, indices that no body has,
/// joints of a body with itself, lists of the wrong length. A start that contradicts its joints can
/// be run, and so can a scene in which nothing moves.
Problems check_values(const Scene& scene);

}  // namespace substep
