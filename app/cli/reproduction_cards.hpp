#pragma once
// One function per card. If the run is cancelled, the result is meaningless.

#include "app/cli/reproduction.hpp"

namespace substep::cli {

// reproduction_figures.cpp
Card substeps_over_time(const Reproduction& options);  // Fig. 2
Card energy_over_time(const Reproduction& options);    // Fig. 3
Card heavy_stack(const Reproduction& options);         // Fig. 4

// reproduction_claims.cpp
Card explosion(const Reproduction& options);
Card alpha_law(const Reproduction& options);
Card gauss_seidel(const Reproduction& options);
Card bridge(const Reproduction& options);
Card taller_stack(const Reproduction& options);
Card capped(const Reproduction& options);

}  // namespace substep::cli
