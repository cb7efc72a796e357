#pragma once
// What must hold between the parts of a scene, each part being right by itself.

#include <vector>

#include "core/io/problem.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// Which parts could be read: what hangs on a broken part is not looked at.
struct SoundParts {
  std::vector<bool> bodies;
  std::vector<bool> joints;
};

/// The two sides of every joint coincide at the start, to the gap that counts as a failure.
void check_joint_starts(const Scene& scene, const SoundParts& sound, Problems& problems);

/// Every joint of a sound scene agrees with its poses and velocities, within the tolerances of
/// sim/joint_starts.hpp. A scene that continues a saved run is not checked.
void check_refused(const Scene& scene, Problems& problems);

/// Rows that say the same twice have no unique forces: without compliance the answer is NaN.
void check_redundant_rows(const Scene& scene, const SoundParts& sound, Problems& problems);

}  // namespace substep
