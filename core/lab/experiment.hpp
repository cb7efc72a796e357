#pragma once

#include <cstdint>
#include <string>

#include "core/model/scene.hpp"
#include "core/model/settings.hpp"

namespace substep {

/// One reproducible run: scene, settings, duration and perturbation of the start. Its id, and its
/// JSON, link and command-line forms are in core/io/experiment.hpp.
struct Experiment {
  std::string scene;             // name of the scene
  std::uint64_t scene_hash = 0;  // of the scene's content: scene_hash() in core/io
  Settings settings;
  double duration = 10.0;  // [s], > 0
  double load = 1.0;       // factor on the mass of the heaviest body, > 0 [-]
  int seed = 0;            // of the initial perturbation

  friend bool operator==(const Experiment&, const Experiment&) = default;
};

/// The initial scene of an experiment, unchanged for load 1 and seed 0. A load scales mass and
/// inertia of the heaviest body, and the energies of the criteria. A seed perturbs the velocity of
/// every moving body by up to 1e-9 m/s per axis, far below all measured errors: differences between
/// seeds are then due to rounding. A scene that cannot run is unchanged.
Scene start_of(const Scene& scene, double load, int seed);

/// Mass of the heaviest moving body over that of the lightest [-].
double mass_ratio(const Scene& scene);

/// Number of frames of a duration, rounded; 0 if it is negative or no number.
std::int64_t frames_of(const Scene& scene, double duration);

/// The solver and its parameters: "bpp", "pgs 25", "newton mean", "newton 2 mean" if its steps are
/// not the default 25.
std::string solver_text(const Settings& settings);

/// Name of a curve: "bpp, adaptive per frame, euler", without the parameter that varies along it.
std::string series_name(const Settings& settings);

/// The parameter that varies along a curve: "n" with 7, "alpha" with 0.1, "n_cap" with 4.
struct SeriesParameter {
  const char* name;
  double value;
};
SeriesParameter series_parameter(const Settings& settings);

}  // namespace substep
