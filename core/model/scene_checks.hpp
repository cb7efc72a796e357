#pragma once
// What must hold between the parts of a scene, each part being right by itself.

#include <vector>

#include "core/model/problem.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// Which parts are right by themselves: what hangs on a broken part is not looked at.
struct SoundParts {
  std::vector<bool> bodies;
  std::vector<bool> joints;
};

/// The two sides of every joint coincide at the start, to the gap that counts as a failure.
void check_joint_starts(const Scene& scene, const SoundParts& sound, Problems& problems);

/// Rows that say the same twice have no unique forces: without compliance the answer is NaN.
void check_redundant_rows(const Scene& scene, const SoundParts& sound, Problems& problems);

/// Joints, constant forces and coefficients of contacts have no effect unless Scene::effects says
/// so: an effect that the content asks for is on.
void check_effects(const Scene& scene, Problems& problems);

}  // namespace substep
