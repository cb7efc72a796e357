// Time and allocations of a sub-step with Google Benchmark: one iteration is one frame, the columns
// are of one sub-step.

#include <benchmark/benchmark.h>

#include "tests/bench/cases.hpp"

namespace {

using namespace substep;

void one_case(benchmark::State& state, const bench::Case& c) {
  bench::Loop loop(SUBSTEP_SOURCE_DIR "/scenes", c, Mode::kConst);
  for (int i = 0; i < 60; ++i) loop.step();  // scratch has its size, caches are warm
  double substeps = 0.0;
  const std::int64_t before = loop.allocated();
  for (auto _ : state) substeps += loop.step().n_substeps;
  state.counters["per_substep"] =
      benchmark::Counter(substeps, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["allocations"] = static_cast<double>(loop.allocated() - before) / substeps;
}

}  // namespace

int main(int argc, char** argv) {
  for (const bench::Case& c : bench::kCases) {
    benchmark::RegisterBenchmark(bench::name_of_case(c).c_str(), [c](benchmark::State& state) {
      one_case(state, c);
    })->Unit(benchmark::kMicrosecond);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
