#pragma once
// The runs whose bits and work must be the same in all builds.

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

#include "core/io/scene_reader.hpp"
#include "core/model/names.hpp"
#include "core/sim/simulator.hpp"

namespace substep::golden {

struct Case {
  std::string name;  // scene, mode and solver
  Simulator simulator;
};

inline constexpr const char* kScenes[] = {"swinging_box",
                                          "bridge",
                                          "heavy_stack",
                                          "heavy_stack_tall",
                                          "bouncing_balls",
                                          "card_house",
                                          "heavy_stack_stress",
                                          "heavy_stack_stress_tall",
                                          "free_fall",
                                          "pendulum",
                                          "ragdoll_drop",
                                          "sliding_box",
                                          "spinning_top",
                                          "wall",
                                          "wrecking_ball",
                                          "convoy",
                                          "swinging_box_authors",
                                          "bridge_authors",
                                          "heavy_stack_authors",
                                          "newtons_cradle",
                                          "spherical_pendulum",
                                          "heavy_top",
                                          "whirling_chain",
                                          "crank_rocker",
                                          "thrown_rope"};

/// A program that takes the folder of the scenes, and optionally k to run each k-th case only. It
/// runs every shipped scene: adaptive and with 16 sub-steps, with BPP and with PGS; the heaps with
/// islands, the stress stacks with refinements, the paper's contact scenes with small steps, and
/// the joint scenes with Störmer and with 6 sub-steps of the other solvers.
/// @return main()'s
inline int for_every_case(int argc, char** argv, const std::function<void(Case&)>& what) {
  const int each = argc == 3 ? std::atoi(argv[2]) : 1;
  if (argc < 2 || argc > 3 || each < 1) {
    std::fprintf(stderr, "usage: %s FOLDER_OF_SCENES [EACH_K-TH]\n", argv[0]);
    return 2;
  }
  int cases = 0;
  for (const char* name : kScenes) {
    const SceneResult read = read_scene_file(std::string(argv[1]) + "/" + name + ".json");
    for (const Problem& problem : read.problems) {
      std::fprintf(stderr, "%s: %s\n", name, to_string(problem).c_str());
    }
    if (!read.scene) return 2;
    const auto with = [&](const Settings& settings, std::string_view solver) {
      if (cases++ % each != 0) return;
      Case c{
          std::string(name) + " " + std::string(name_of(settings.mode)) + " " + std::string(solver),
          Simulator(read.scene)};
      c.simulator.set_settings(settings);
      what(c);
      std::fflush(stdout);
    };
    for (const Mode mode : {Mode::kAdaptive, Mode::kConst}) {
      for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
        Settings settings = own_settings(*read.scene);
        settings.islands = false;
        settings.mode = mode;
        settings.n = 16;
        settings.solver = solver;
        with(settings, name_of(solver));
      }
    }
    if (read.scene->group == "playground" && read.scene->effects.joints &&
        read.scene->effects.contact) {
      Settings islands = own_settings(*read.scene);
      islands.mode = Mode::kAdaptive;
      islands.islands = true;
      with(islands, "bpp_islands");
    }
    Settings settings = own_settings(*read.scene);
    settings.mode = Mode::kConst;
    if (read.scene->regularisation > 0.0) {
      Settings refined = settings;
      refined.n = 2;
      refined.refinements = 3;
      with(refined, "bpp_refined");
    }
    if (read.scene->group != "paper") continue;
    if (read.scene->effects.contact) {
      Settings small = settings;
      small.n = 8;
      small.solver = SolverKind::kPgs;
      small.share_iterations = true;
      small.detection = Detection::kFrame;
      with(small, "pgs_small_steps");
    }
    if (!read.scene->effects.joints) continue;
    if (!read.scene->effects.contact) {  // not applicable to contacts
      Settings stormer = settings;
      stormer.mode = Mode::kAdaptive;
      stormer.integrator = Integrator::kStormer;
      with(stormer, "bpp_stormer");
    }
    settings.n = 6;
    settings.iterations = 4;
    settings.solver = SolverKind::kXpbd;
    with(settings, "xpbd");
    settings.solver = SolverKind::kNewton;
    for (const Forces forces : {Forces::kEnd, Forces::kMean, Forces::kNumerov}) {
      if (forces == Forces::kNumerov && read.scene->effects.contact) continue;
      settings.forces = forces;
      with(settings, "newton_" + std::string(name_of(forces)));
    }
  }
  return 0;
}

}  // namespace substep::golden
