#pragma once
// Validates data passed by a program before use. Each problem gives the location and the allowed
// range, with the messages of the scene reader; ranges are those of scene_limits.hpp and
// setting_fields.hpp. Reports at most kMaxProblems.

#include <memory>
#include <optional>
#include <string>

#include "core/model/budget.hpp"
#include "core/model/grab.hpp"
#include "core/model/problem.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// All problems of a scene: those of check_values(), names and other texts with characters that
/// text_fault() refuses, and contradictions between its parts: no moving body, joints that start
/// open, redundant joints and contacts, disabled effects that the content requires. That names are
/// given and unique is not checked: only files refer to them.
Problems validate(const Scene& scene);

/// Settings outside their ranges, and enumerators that do not exist. Pointers begin with
/// "/settings".
Problems validate(const Settings& settings);

/// Checks a state of that scene: lists have one item per body, or are empty if allowed; numbers are
/// finite; orientations have length 1. Pointers begin with "/state".
Problems validate(const State& state, const Scene& scene);

/// Checks a grab: a moving body of that scene, and finite numbers. Pointers begin with "/grab".
Problems validate(const Grab& grab, const Scene& scene);

/// Checks a budget against kMemoryBudgetRange and kWorkBudgetRange. Pointers begin with "/budget".
Problems validate(const Budget& budget);

/// Only problems that prevent a run: numbers outside their ranges, invalid body indices, joints of
/// a body with itself, lists of the wrong length. A start inconsistent with its joints can run, and
/// so can a scene without moving bodies.
Problems check_values(const Scene& scene);

/// Whether check_values() finds nothing. What takes a scene in `sim`, `lab` and `io` refuses any
/// other, as a Simulator does: it returns its empty result, or that of a run which fails at once.
bool is_runnable(const Scene& scene);

/// Whether a state has an item for every body of the scene: pose, and both velocities.
bool fits(const State& state, const Scene& scene);

/// The reason to refuse a scene, or nothing: "the scene is invalid: bodies[1].mass: must be at
/// least 1e-30 (kg), not 0". @param scene may be null
std::optional<std::string> refusal_of(const Scene* scene);

/// The scene, or if it is null one that every run refuses. @return never null
std::shared_ptr<const Scene> not_null(std::shared_ptr<const Scene> scene);

}  // namespace substep
