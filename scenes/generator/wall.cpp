#include <string>

#include "scenes/generator/parts.hpp"
#include "scenes/generator/scenes.hpp"

namespace substep::scenes {
namespace {

constexpr double kBrickLength = 0.5;   // of a brick [m]
constexpr double kBrickHeight = 0.25;  // [m]
constexpr double kDepth = 0.25;        // [m]
constexpr double kDensity = 200.0;     // of a brick [kg/m^3]
constexpr double kBrickMu = 0.6;

void add_brick(double x, double y, double length, Scene& scene) {
  Body brick =
      solid("brick_" + std::to_string(scene.bodies.size() - 1), box(length, kBrickHeight, kDepth),
            kDensity * length * kBrickHeight * kDepth, {x, y, 0.0});
  brick.friction = kBrickMu;
  brick.color = scene.bodies.size() % 3 == 0 ? kBrickDark : kBrick;
  scene.bodies.push_back(brick);
}

}  // namespace

Scene wall(const WallOptions& options) {
  Scene scene = paper_scene();
  scene.name = "wall";
  scene.title = "Wall";
  scene.group = "playground";
  scene.description = "A wall of " + std::to_string(options.courses) +
                      " courses of dry bricks, and a ball of 150 kg that will hit it.";
  scene.look_for =
      "The ball hits the wall after half a second. Hundreds of contacts open and close; the number "
      "of sub-steps follows the largest force.";
  scene.effects = {.gravity = true, .gyroscopic = true, .contact = true, .friction = true};
  scene.criteria.duration = 5.0;
  add_ground(kBrickMu, 0.01, scene);
  const double width = options.bricks * kBrickLength;
  for (int course = 0; course < options.courses; ++course) {
    const double y = (course + 0.5) * kBrickHeight;
    if (course % 2 == 0) {
      for (int i = 0; i < options.bricks; ++i) {
        add_brick((i + 0.5) * kBrickLength - 0.5 * width, y, kBrickLength, scene);
      }
    } else {  // half a brick at either end: running bond
      add_brick(0.25 * kBrickLength - 0.5 * width, y, 0.5 * kBrickLength, scene);
      for (int i = 1; i < options.bricks; ++i) {
        add_brick(i * kBrickLength - 0.5 * width, y, kBrickLength, scene);
      }
      add_brick(0.5 * width - 0.25 * kBrickLength, y, 0.5 * kBrickLength, scene);
    }
  }
  const double height = options.courses * kBrickHeight;
  Body ball = solid("ball", Sphere{0.35}, 150.0, {-0.3, 0.55 * height + 0.6, 5.5});
  ball.velocity = {0.5, 1.5, -10.0};
  ball.friction = kBrickMu;
  ball.color = kIron;
  scene.criteria.track = static_cast<int>(scene.bodies.size());
  scene.bodies.push_back(ball);
  scene.camera.eye = {3.6, 2.2, 6.2};
  scene.camera.target = {0.0, 0.45 * height, 0.0};
  return scene;
}

}  // namespace substep::scenes
