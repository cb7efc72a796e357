#include "tests/bench/scaling.hpp"

#include "scenes/generator/scenes.hpp"

namespace substep::bench {

std::vector<Growing> growing_scenes() {
  std::vector<Growing> out;
  const auto add = [&](const char* kind, int n, const Scene& scene, SolverKind solver) {
    const char* suffix = solver == SolverKind::kPgs ? "/pgs" : "";
    out.push_back({std::string(kind) + "/" + std::to_string(n) + suffix,
                   std::make_shared<const Scene>(scene), solver});
  };
  for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
    for (const int links : {25, 100, 400, 1600}) {
      scenes::RopeOptions rope;
      rope.n = links;
      add("rope", links, scenes::rope_of_n(rope), solver);
    }
  }
  for (const int layers : {2, 5, 10, 20, 40}) {
    scenes::HeavyStackOptions stack;
    stack.layers = layers;
    add("stack", layers, scenes::heavy_stack(stack), SolverKind::kBpp);
  }
  for (const int courses : {4, 7, 10}) {  // 330 to 2,300 contact points
    scenes::WallOptions wall;
    wall.courses = courses;
    wall.bricks = 2 * courses;
    add("wall", courses, scenes::wall(wall), SolverKind::kBpp);
  }
  return out;
}

}  // namespace substep::bench
