// Level of detail of bodies: by their size on the screen and by their number.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "app/render/camera.hpp"
#include "app/render/detail.hpp"
#include "app/render/rounded_box.hpp"

namespace substep {
namespace {

// Looks along -z at the origin. @param distance [m]
Picture seen_from(double distance) {
  OrbitCamera camera;
  Camera at;
  at.eye = {0.0, 0.0, distance};
  at.target = Vec3::Zero();
  camera.place(at, 0.0);
  const ViewRect view{0, 0, 1280, 720};
  Picture picture;
  picture.view_projection = camera.view_projection(view, 1280, 720).cast<float>();
  return picture;
}

Instance ball(double radius, double z = 0.0) {
  Instance i;
  i.position = {0.0F, 0.0F, static_cast<float>(z)};
  const auto r = static_cast<float>(radius);
  i.rounding = r;
  i.half_extents = {r, r, r};
  return i;
}

std::size_t level_of(const DetailedBodies& bodies) {
  std::size_t level = 0;
  while (bodies.balls.at(level).empty()) ++level;
  return level;
}

// The largest distance of a triangle of a ball's mesh from the sphere's surface, inside.
double depth_of(const RoundedBoxMesh& mesh) {
  double deepest = 0.0;
  const auto at = [&](std::size_t i) {
    const auto& n = mesh.vertices[mesh.indices[i]].normal;
    return Eigen::Vector3d(n[0], n[1], n[2]);
  };
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d a = at(i + k);
      const Eigen::Vector3d b = at(i + (k + 1) % 3);
      deepest = std::max(deepest, 1.0 - (0.5 * (a + b)).norm());
    }
  }
  return deepest;
}

TEST(Detail, OutlineErrorMatchesTheMesh) {
  for (const int segments : kBallSegments) {
    const RoundedBoxMesh mesh = rounded_box(segments, segments == 0);
    EXPECT_EQ(mesh.vertices.size(), static_cast<std::size_t>(vertices_of(segments, false)));
    if (segments == 0) continue;
    EXPECT_GE(depth_of(mesh), 0.6 * outline_error(segments)) << segments;
    EXPECT_LE(depth_of(mesh), outline_error(segments)) << segments;
  }
  EXPECT_EQ(rounded_box(0, true).indices.size(), 36U);
}

TEST(Detail, BodiesLargeOnTheScreenAreFine) {
  DetailedBodies bodies;
  std::size_t last = kBallSegments.size() - 1;
  for (const double distance : {4.0, 40.0, 400.0, 4000.0}) {
    const Picture picture = seen_from(distance);
    const std::vector<Instance> one{ball(1.0)};
    bodies.choose({}, one, {&picture, 1280, 720, 0.5, 100000});
    const std::size_t level = level_of(bodies);
    if (distance == 4.0) {
      EXPECT_EQ(level, last);
    }
    EXPECT_LE(level, last) << distance;
    last = level;
  }
  EXPECT_EQ(last, 0U);
}

TEST(Detail, ManyBodiesAreCoarserThanOne) {
  const Picture picture = seen_from(4.0);
  DetailedBodies bodies;
  const std::vector<Instance> many(600, ball(1.0));
  bodies.choose({}, many, {&picture, 1280, 720, 0.5, 100000});
  EXPECT_LE(bodies.vertices(), 100000U);
  // Large balls are never drawn as cubes, even if level 1 exceeds the limit of vertices.
  const std::vector<Instance> more(20000, ball(1.0));
  bodies.choose({}, more, {&picture, 1280, 720, 0.5, 100000});
  EXPECT_EQ(bodies.balls[1].size(), more.size());
}

TEST(Detail, DrawsOneSpeckPerPixel) {
  const Picture picture = seen_from(20.0);
  DetailedBodies bodies;
  std::vector<Instance> dust;
  for (int i = 0; i < 1000; ++i) {
    dust.push_back(ball(1e-4));
    dust.back().position[0] = 1e-4F * static_cast<float>(i);  // 0.1 m: a few pixels
  }
  bodies.choose({}, dust, {&picture, 1280, 720, 0.5, 1000000});
  EXPECT_GE(bodies.balls[0].size(), 2U);
  EXPECT_LE(bodies.balls[0].size(), 12U);
}

TEST(Detail, TheNearestIsDrawnFirst) {
  const Picture picture = seen_from(20.0);
  DetailedBodies bodies;
  std::vector<Instance> heap;
  for (int i = 0; i < 100; ++i) heap.push_back(ball(1.0, 0.05 * ((37 * i) % 100)));
  bodies.choose({}, heap, {&picture, 1280, 720, 0.5, 100000});
  std::size_t seen = 0;
  for (const auto& level : bodies.balls) {
    EXPECT_TRUE(std::is_sorted(level.begin(), level.end(), [](const auto& a, const auto& b) {
      return a.position[2] > b.position[2];
    }));
    seen += level.size();
  }
  EXPECT_EQ(seen, heap.size());
}

}  // namespace
}  // namespace substep
