// The cases of substep_bench under Node.js, where Google Benchmark is not at hand: the best of some
// rounds of one second each, so that other programs disturb it least.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>

#include "tests/bench/cases.hpp"

namespace {

using namespace substep;

double now() {
  const auto time = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(time).count();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: substep_bench FOLDER_OF_SCENES\n");
    return 2;
  }
  std::printf("%-22s %14s %12s\n", "Benchmark", "per_substep", "allocations");
  for (const bench::Case& c : bench::kCases) {
    bench::Loop loop(argv[1], c, Mode::kConst);
    loop.leave_out_measures();
    for (int i = 0; i < 60; ++i) loop.step();  // scratch has its size, the code is compiled
    double best = std::numeric_limits<double>::infinity();
    double substeps_in_all = 0.0;
    const std::int64_t before = loop.allocated();
    for (int round = 0; round < 3; ++round) {
      double substeps = 0.0;
      const double start = now();
      double end = start;
      while (end - start < 1.0) {
        substeps += loop.step().n_substeps;
        end = now();
      }
      best = std::min(best, (end - start) / substeps);
      substeps_in_all += substeps;
    }
    std::printf("%-22s %11.2f us %12g\n", bench::name_of_case(c).c_str(), 1e6 * best,
                static_cast<double>(loop.allocated() - before) / substeps_in_all);
  }
  return 0;
}
