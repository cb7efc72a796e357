#pragma once

#include <cstdint>
#include <string>

#include "core/model/scene.hpp"
#include "core/model/settings.hpp"

namespace substep {

/// One run that can be repeated anywhere: a scene, how it is stepped, how long, and which of its
/// starts. Its id, and its JSON, link and command-line forms are in core/io/experiment.hpp.
struct Experiment {
  std::string scene;             // name of the scene
  std::uint64_t scene_hash = 0;  // of what the scene holds, io's scene_hash
  Settings settings;
  double duration = 10.0;  // [s], > 0
  double load = 1.0;       // factor on the mass of the heaviest body, > 0 [-]
  int seed = 0;            // of the start's nudge

  friend bool operator==(const Experiment&, const Experiment&) = default;
};

/// The scene that an experiment starts from. Load 1 and seed 0 leave it as it stands.
/// A load scales mass and inertia of the heaviest body, and with it the energies that the verdict
/// goes by. A seed changes the velocity of every moving body by up to 1e-9 m/s along each axis, far
/// below every error that is measured: what then differs between seeds, rounding decides.
Scene start_of(const Scene& scene, double load, int seed);

/// Mass of the heaviest moving body over that of the lightest [-].
double mass_ratio(const Scene& scene);

/// Frames of a duration, rounded to whole ones.
std::int64_t frames_of(const Scene& scene, double duration);

/// The solver and what it is set to: "bpp", "pgs 25", "newton mean", "newton 2 mean" where its
/// steps are not the 25 of a scene that says nothing.
std::string solver_text(const Settings& settings);

/// What one curve of a picture shares: "bpp, adaptive per frame, euler". The parameter that runs
/// along the curve is left out.
std::string series_name(const Settings& settings);

/// The parameter that runs along the curve: "n" with 7, "alpha" with 0.1, "n_cap" with 4.
struct SeriesParameter {
  const char* name;
  double value;
};
SeriesParameter series_parameter(const Settings& settings);

}  // namespace substep
