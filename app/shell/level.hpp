#pragma once

namespace substep {

struct Lab;

/// Whether a run differs from its scene in settings that only the Lab level shows.
bool needs_lab(const Lab& lab);

}  // namespace substep
