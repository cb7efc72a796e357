// A scene with poses and velocities that fit its joints, as a scene file:
// consistent_start SCENE.json. Engines differ in what they make of a start that does not fit, and
// reduced coordinates cannot state it.

#include <cstdio>

#include "core/io/scene_writer.hpp"
#include "core/sim/start.hpp"
#include "tests/bench/peers/peer_run.hpp"

int main(int argc, char** argv) {
  using namespace substep;
  if (argc != 2) bench::refuse("usage: consistent_start SCENE.json");
  const std::shared_ptr<const Scene> scene = with_start_of_run(bench::load(argv[1]));
  std::fputs(write_scene(*scene).c_str(), stdout);
  return 0;
}
