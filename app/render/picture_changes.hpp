#pragma once

#include "app/render/picture.hpp"

namespace substep {

/// Where a picture must be drawn anew once another was drawn: around what moved, with its shadow.
/// All of the picture's part where the camera, the light or the number of bodies differ.
Part changed_part(const Picture& before, const Picture& now);

}  // namespace substep
