#pragma once
// The figures and claims of Giles and Andrews (MIG '24), one function per card. If the run is
// cancelled, the result is meaningless.

#include <string>
#include <vector>

#include "core/io/json.hpp"

namespace substep::cli {

/// A figure or claim of the paper and our result.
struct Card {
  std::string title;
  std::string paper;    // the paper's statement
  std::string here;     // our result
  std::string why;      // reason for a difference
  std::string command;  // command line that reproduces it
  enum class Outcome { kAgrees, kDiffers, kFails } outcome = Outcome::kFails;
  std::vector<Json> charts;  // chart_json
};

// reproduction_figures.cpp
Card substeps_over_time(int jobs);  // Fig. 2
Card energy_over_time(int jobs);    // Fig. 3
Card heavy_stack(int jobs);         // Fig. 4

// reproduction_claims.cpp
Card explosion(int jobs);
Card alpha_law(int jobs);
Card gauss_seidel(int jobs);
Card bridge(int jobs);
Card taller_stack(int jobs);
Card capped(int jobs);

}  // namespace substep::cli
