// Prints a line per case with the hash of the state after its frames: the same on every build.
//   state_hashes FOLDER_OF_SCENES [EACH_K-TH]

#include <cinttypes>
#include <cstdio>

#include "core/model/state.hpp"
#include "tests/reference/golden_cases.hpp"

int main(int argc, char** argv) {
  using namespace substep;
  constexpr int kFrames = 600;
  return golden::for_every_case(argc, argv, [](golden::Case& c) {
    for (int i = 0; i < kFrames; ++i) c.simulator.step();
    std::printf("%s %016" PRIx64 "\n", c.name.c_str(), state_hash(c.simulator.state()));
  });
}
