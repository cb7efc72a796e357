// Time and allocations of a sub-step with Google Benchmark: one iteration is one frame, the columns
// are of one sub-step.

#include <benchmark/benchmark.h>

#include "tests/bench/block_chain.hpp"
#include "tests/bench/cases.hpp"
#include "tests/bench/scaling.hpp"

namespace {

using namespace substep;

constexpr int kWarmUp = 60;  // frames: scratch memory is sized, caches are warm
constexpr int kTurn =
    20;  // frames of a growing scene: the same for every size, before a wall falls

benchmark::Counter per(double count) {
  return {count, benchmark::Counter::kIsRate | benchmark::Counter::kInvert};
}

void one_case(benchmark::State& state, const bench::Case& c) {
  bench::Loop loop(SUBSTEP_SOURCE_DIR "/scenes", c, Mode::kConst);
  loop.leave_out_measures();
  for (int i = 0; i < kWarmUp; ++i) loop.step();
  double substeps = 0.0;
  const std::int64_t before = loop.allocated();
  for (auto _ : state) substeps += loop.step().n_substeps;
  state.counters["per_substep"] = per(substeps);
  state.counters["allocations"] = static_cast<double>(loop.allocated() - before) / substeps;
}

void growing(benchmark::State& state, const bench::Growing& g) {
  Simulator simulator(g.scene);
  Settings settings = g.scene->settings;
  settings.mode = Mode::kConst;
  settings.n = 16;
  settings.solver = g.solver;
  simulator.set_settings(settings);
  simulator.set_measures({.energies = false, .errors = false, .stages = false});
  FrameReport report = simulator.step();
  const State start = simulator.state();
  int frame = 0;
  double substeps = 0.0;
  double flops = 0.0;
  for (auto _ : state) {
    if (frame++ % kTurn == 0) simulator.set_state(start);
    report = simulator.step();
    substeps += report.n_substeps;
    flops += static_cast<double>(report.work.flops);
  }
  state.counters["per_substep"] = per(substeps);
  state.counters["flops"] = flops / substeps;
  state.counters["rows"] = report.joint_rows + report.contact_rows + report.friction_rows;
}

// The baseline for a sub-step of the swinging box.
void chain_of_26_blocks(benchmark::State& state) {
  bench::BlockChain chain(26);
  for (auto _ : state) benchmark::DoNotOptimize(chain.factor_and_solve());
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::RegisterBenchmark("chain_of_26_blocks", chain_of_26_blocks)
      ->Unit(benchmark::kMicrosecond);
  for (const bench::Case& c : bench::kCases) {
    benchmark::RegisterBenchmark(bench::name_of_case(c).c_str(), [c](benchmark::State& state) {
      one_case(state, c);
    })->Unit(benchmark::kMicrosecond);
  }
  for (const bench::Growing& g : bench::growing_scenes()) {
    benchmark::RegisterBenchmark(g.name.c_str(), [g](benchmark::State& state) {
      growing(state, g);
    })->Unit(benchmark::kMicrosecond);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
