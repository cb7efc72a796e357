#pragma once

#include <span>
#include <vector>

#include "app/render/picture.hpp"

namespace substep {

/// Where each picture must be drawn anew once others, as many, were drawn: around what moved, with
/// its shadow, and wherever a picture that lies below it is drawn. All of a picture's part where
/// the camera, the light or the number of bodies differ.
std::vector<Part> changed_parts(std::span<const Picture> before, std::span<const Picture> now);

}  // namespace substep
