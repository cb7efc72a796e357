#include "tests/bench/cases.hpp"

#include <cstdio>
#include <cstdlib>

#include "core/io/scene_reader.hpp"
#include "core/model/names.hpp"
#include "tests/bench/allocations.hpp"

namespace substep::bench {

namespace {

constexpr int kSweeps = 25;

Simulator load(const std::string& folder, const Case& c, Mode mode) {
  const SceneResult read = read_scene_file(folder + "/" + c.scene + ".json");
  for (const Problem& problem : read.problems) {
    std::fprintf(stderr, "%s: %s\n", c.scene, to_string(problem).c_str());
  }
  if (!read.scene) std::exit(2);
  Settings settings = own_settings(*read.scene);
  settings.mode = mode;
  settings.n = 16;
  settings.alpha = 0.1;
  settings.solver = c.solver;
  settings.iterations = kSweeps;
  Simulator simulator(read.scene);
  simulator.set_settings(settings);
  return simulator;
}

}  // namespace

std::string name_of_case(const Case& c) {
  std::string name = std::string(c.scene) + "/" + std::string(name_of(c.solver));
  if (c.solver == SolverKind::kPgs) name += "_" + std::to_string(kSweeps);
  return name;
}

Loop::Loop(const std::string& folder, const Case& c, Mode mode)
    : simulator_(load(folder, c, mode)), start_(simulator_.state()) {}

void Loop::leave_out_measures() {
  simulator_.set_measures({.energies = false, .errors = false, .stages = false});
}

FrameReport Loop::step() {
  if (frame_ == kFrames) {
    simulator_.set_state(start_);
    frame_ = 0;
  }
  ++frame_;
  const std::int64_t before = allocations();
  const FrameReport report = simulator_.step();
  allocated_ += allocations() - before;
  return report;
}

}  // namespace substep::bench
