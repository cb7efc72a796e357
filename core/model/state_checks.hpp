#pragma once
// Checks of data that refers to the bodies of a scene by index.

#include <optional>
#include <string>

#include "core/model/carried.hpp"
#include "core/model/grab.hpp"
#include "core/model/problem.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"

namespace substep {

/// The fault of an index into Scene::bodies, or nothing.
std::optional<std::string> body_fault(int body, const Scene& scene);

/// Checks the carried state of a saved run. @param pointer its location, such as "/carried"
void check_carried(const Carried& carried, const Scene& scene, const std::string& pointer,
                   Problems& problems);
void check_state(const State& state, const Scene& scene, Problems& problems);
void check_grab(const Grab& grab, const Scene& scene, Problems& problems);

}  // namespace substep
