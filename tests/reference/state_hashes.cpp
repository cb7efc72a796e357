// Prints a line per case with the hash of the state after 600 frames: the same on every build.
//   state_hashes FOLDER_OF_SCENES

#include <cinttypes>
#include <cstdio>
#include <string>

#include "core/io/scene_reader.hpp"
#include "core/model/names.hpp"
#include "core/model/state.hpp"
#include "core/sim/simulator.hpp"

namespace {

using namespace substep;

constexpr int kFrames = 600;

bool print_hashes(const std::string& folder, const char* name) {
  const SceneResult read = read_scene_file(folder + "/" + name + ".json");
  for (const Problem& problem : read.problems) {
    std::fprintf(stderr, "%s: %s\n", name, to_string(problem).c_str());
  }
  if (!read.scene) return false;
  for (const Mode mode : {Mode::kAdaptive, Mode::kConst}) {
    for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
      Settings settings = read.scene->settings;
      settings.mode = mode;
      settings.n = 16;
      settings.solver = solver;
      Simulator simulator(read.scene);
      simulator.set_settings(settings);
      for (int i = 0; i < kFrames; ++i) simulator.step();
      std::printf("%s %s %s %016" PRIx64 "\n", name, std::string(name_of(mode)).c_str(),
                  std::string(name_of(solver)).c_str(), state_hash(simulator.state()));
      std::fflush(stdout);
    }
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: state_hashes FOLDER_OF_SCENES\n");
    return 2;
  }
  for (const char* name : {"swinging_box", "bridge", "heavy_stack"}) {
    if (!print_hashes(argv[1], name)) return 2;
  }
  return 0;
}
