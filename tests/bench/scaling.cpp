#include "tests/bench/scaling.hpp"

#include "core/model/scene_builder.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::bench {

namespace {

/// Rows of boxes, each box on two of the row below: n (n + 1)/2 of them.
Scene pyramid(int rows) {
  SceneBuilder builder("pyramid");
  builder.body(builder.add_fixed(Plane{}, Vec3::Zero())).friction = 0.6;
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < rows - row; ++i) {
      const Vec3 place{1.05 * (i + 0.5 * (row - rows)), 0.25 + 0.5 * row, 0.0};
      builder.body(builder.add_body(Box{{0.5, 0.25, 0.25}}, 1.0, place)).friction = 0.6;
    }
  }
  return *builder.build();
}

}  // namespace

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
  for (const int rows : {15, 30, 60}) add("pyramid", rows, pyramid(rows), SolverKind::kPgs);
  return out;
}

}  // namespace substep::bench
