#pragma once

namespace substep {

struct App;

/// How the window is arranged: kept from visit to visit.
/// Reads what the shell has kept; nothing happens where it keeps nothing.
void recall_arrangement(App& app);
/// Hands the arrangement to the shell where it has changed since.
void remember_arrangement(App& app);

}  // namespace substep
