// Prints a line per case with the work of 60 frames: the same on every build.
//   work_units FOLDER_OF_SCENES [EACH_K-TH]

#include <cinttypes>
#include <cstdio>

#include "tests/reference/golden_cases.hpp"

int main(int argc, char** argv) {
  using namespace substep;
  return golden::for_every_case(argc, argv, [](golden::Case& c) {
    std::int64_t substeps = 0;
    std::int64_t visits = 0;
    SolverWork sum;
    for (int i = 0; i < 60; ++i) {
      const FrameReport report = c.simulator.step();
      substeps += report.n_substeps;
      sum.row_updates += report.work.row_updates;
      sum.factorisations += report.work.factorisations;
      sum.pivots += report.work.pivots;
      sum.flops += report.work.flops;
      visits += report.visits;
    }
    std::printf("%s %" PRId64 " %" PRId64 " %" PRId64 " %" PRId64 " %" PRId64 " %" PRId64 "\n",
                c.name.c_str(), substeps, sum.row_updates, sum.factorisations, sum.pivots,
                sum.flops, visits);
  });
}
