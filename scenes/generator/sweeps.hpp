#pragma once

#include <string_view>

namespace substep::scenes {

/// The sweep of a shipped scene (core/io/stored_sweep.hpp), "" where none is shipped.
/// `./dev sweeps` writes them, to scenes/sweeps.
std::string_view sweep_of(std::string_view scene);

}  // namespace substep::scenes
