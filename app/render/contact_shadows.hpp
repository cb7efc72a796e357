#pragma once
// The ambient shadow of bodies on the floor: a body near the floor hides part of the sky from it.

#include <vector>

#include "app/lab/session.hpp"
#include "app/render/picture.hpp"

namespace substep {

/// One soft shadow for each body near the floor. Its footprint is that of the body's lowest part,
/// so that a leaning card is darkest at its lower edge; it is wider and fainter the higher the body
/// is. Shadows too faint to be seen are left out.
std::vector<SoftShadow> contact_shadows(const Scene& scene, const Poses& poses,
                                        const Ground& ground);

}  // namespace substep
