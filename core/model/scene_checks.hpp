#pragma once
// Consistency checks between the parts of a scene that are valid individually.

#include <vector>

#include "core/model/problem.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// Parts that are valid individually; checks that depend on an invalid part are skipped.
struct SoundParts {
  std::vector<bool> bodies;
  std::vector<bool> joints;
};

/// Checks that the two sides of every joint coincide at the start, within the failure gap.
void check_joint_starts(const Scene& scene, const SoundParts& sound, Problems& problems);

/// Checks for redundant rows: without compliance their forces are not unique.
void check_redundant_rows(const Scene& scene, const SoundParts& sound, Problems& problems);

/// Checks that every effect the content requires is enabled: otherwise joints, constant forces and
/// contact coefficients would be ignored.
void check_effects(const Scene& scene, Problems& problems);

}  // namespace substep
