// Prints a line per case with the work of 60 frames: the same on every build.
//   work_units FOLDER_OF_SCENES

#include <cinttypes>
#include <cstdio>
#include <string>

#include "core/io/scene_reader.hpp"
#include "core/model/names.hpp"
#include "core/sim/simulator.hpp"

namespace {

using namespace substep;

constexpr int kFrames = 60;

bool print_work(const std::string& folder, const char* name) {
  const SceneResult read = read_scene_file(folder + "/" + name + ".json");
  if (!read.scene) return false;
  for (const Mode mode : {Mode::kAdaptive, Mode::kConst}) {
    for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
      Settings settings = read.scene->settings;
      settings.mode = mode;
      settings.n = 16;
      settings.solver = solver;
      Simulator simulator(read.scene);
      simulator.set_settings(settings);
      std::int64_t substeps = 0;
      SolverWork sum;
      for (int i = 0; i < kFrames; ++i) {
        const FrameReport report = simulator.step();
        substeps += report.n_substeps;
        sum.row_updates += report.work.row_updates;
        sum.factorisations += report.work.factorisations;
        sum.pivots += report.work.pivots;
        sum.flops += report.work.flops;
      }
      std::printf("%s %s %s %" PRId64 " %" PRId64 " %" PRId64 " %" PRId64 " %" PRId64 "\n", name,
                  std::string(name_of(mode)).c_str(), std::string(name_of(solver)).c_str(),
                  substeps, sum.row_updates, sum.factorisations, sum.pivots, sum.flops);
      std::fflush(stdout);
    }
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: work_units FOLDER_OF_SCENES\n");
    return 2;
  }
  for (const char* name : {"swinging_box", "bridge", "heavy_stack"}) {
    if (!print_work(argv[1], name)) return 2;
  }
  return 0;
}
