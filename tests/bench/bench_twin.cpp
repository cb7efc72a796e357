// The cases of substep_bench as a program that is the same everywhere: native, under Node.js and in
// a browser, where Google Benchmark is not available. The result is the best of some rounds, to
// exclude disturbances by other programs. Every round repeats the scene a whole number of times,
// which is always the same work.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

#include "tests/bench/cases.hpp"

namespace {

using namespace substep;

constexpr int kRounds = 2;      // after one that sizes the scratch memory
constexpr double kLeast = 0.5;  // of a round [s]

struct Cost {
  double frame = 0.0;        // [s]
  double substep = 0.0;      // [s]
  double allocations = 0.0;  // of a sub-step [-]
};

double now() {
  const auto time = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(time).count();
}

Cost round_of(bench::Loop& loop) {
  double substeps = 0.0;
  double frames = 0.0;
  double seconds = 0.0;
  const std::int64_t before = loop.allocated();
  const double start = now();
  while (seconds < kLeast) {
    for (int i = 0; i < bench::Loop::kFrames; ++i) substeps += loop.step().n_substeps;
    frames += bench::Loop::kFrames;
    seconds = now() - start;
  }
  return {seconds / frames, seconds / substeps,
          static_cast<double>(loop.allocated() - before) / substeps};
}

Cost cost_of(const char* folder, const bench::Case& c, Mode mode) {
  bench::Loop loop(folder, c, mode);
  loop.leave_out_measures();
  round_of(loop);
  Cost best = round_of(loop);
  for (int i = 1; i < kRounds; ++i) {
    const Cost cost = round_of(loop);
    best.frame = std::min(best.frame, cost.frame);
    best.substep = std::min(best.substep, cost.substep);
    best.allocations = std::max(best.allocations, cost.allocations);
  }
  return best;
}

void print(const std::string& name, double time, const char* of, double allocations) {
  std::printf("%-28s %8.4g %-15s %12g\n", name.c_str(), time, of, allocations);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: bench_twin FOLDER_OF_SCENES\n");
    return 2;
  }
  std::printf("%-28s %24s %12s\n", "Benchmark", "Time", "allocations");
  // A warm-up run: WebAssembly is optimised in the background for more than a second.
  cost_of(argv[1], bench::kCases.front(), Mode::kConst);
  for (const bench::Case& c : bench::kCases) {
    const Cost cost = cost_of(argv[1], c, Mode::kConst);
    print(bench::name_of_case(c), 1e6 * cost.substep, "us per sub-step", cost.allocations);
  }
  for (const bench::Case& c : bench::kCases) {
    if (c.solver != SolverKind::kBpp) continue;
    const Cost cost = cost_of(argv[1], c, Mode::kAdaptive);
    print(std::string(c.scene) + "/frame_alpha_0.1", 1e3 * cost.frame, "ms per frame",
          cost.allocations);
  }
  return 0;
}
