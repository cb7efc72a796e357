// Time of a frame of the interface without physics: 200 s of history visible, no rendering.

#include <benchmark/benchmark.h>

#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

constexpr int kFrames = 12000;  // 200 s

void one_frame(benchmark::State& state, const char* link, const char* panel) {
  Headless h(1280.0F, 720.0F);
  h.app->open_link(link);
  h.app->set("panel", panel);
  for (ui::PlotState& plot : h.app->desk.plots) plot.shown = true;
  for (int i = 0; i < kFrames; ++i) h.app->session.step();
  h.app->desk.time.span = 200.0;
  h.frames(3);
  for (auto _ : state) h.frames(1);
}

void plots(benchmark::State& s) { one_frame(s, "scene=swinging_box", "plots"); }
void compared_plots(benchmark::State& s) {
  one_frame(s, "scene=swinging_box&compare=mode:damping;alpha:0.4;integrator:leapfrog", "plots");
}
void why(benchmark::State& s) { one_frame(s, "scene=swinging_box", "why"); }

BENCHMARK(plots)->Unit(benchmark::kMillisecond);
BENCHMARK(compared_plots)->Unit(benchmark::kMillisecond);
BENCHMARK(why)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace substep
