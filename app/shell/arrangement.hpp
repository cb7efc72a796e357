#pragma once

namespace substep {

struct App;

/// The arrangement of the window, kept between visits. Restores the stored arrangement, if any.
void recall_arrangement(App& app);
/// Stores the arrangement if it has changed.
void remember_arrangement(App& app);

}  // namespace substep
