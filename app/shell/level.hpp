#pragma once

namespace substep {

struct Lab;

/// Whether a run differs from its scene's own in what only the Lab shows.
bool needs_lab(const Lab& lab);

}  // namespace substep
