#include "core/constraints/contact.hpp"
#include "core/collision/shape_pairs.hpp"
#include "core/constraints/moved_rows.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/unit/support.hpp"

namespace substep::test {
namespace {

void expect_formulas(const Scene& scene, Random& random) {
  const State state = initial_state(scene);
  const Rows rows = contact_rows(scene);
  expect_gradient(scene, state, rows);
  expect_stiffness(scene, state, rows, random);
}

// touch_shapes() calls touch() for every pair of shapes: without one it does not compile.
struct Unpaired {};
template <class A, class B>
concept Touching = requires(const Placed& at, const A& a, const B& b, ContactPoints& out) {
  touch(at, a, at, b, 0.0, out);
};

TEST(ShapePairs, APairWithoutContactPointsDoesNotCompile) {
  static_assert(Touching<Sphere, Plane> && Touching<Box, Plane>);
  static_assert(Touching<Sphere, Box> && Touching<Box, Sphere>);
  static_assert(!Touching<Unpaired, Plane> && !Touching<Unpaired, Unpaired>);
  static_assert(!Touching<Box, Unpaired> && !Touching<Unpaired, Box>);
}

// What pictures show of a shape touches its bounds.
TEST(Shapes, OutlinesFillTheirBounds) {
  EXPECT_FALSE(outline(Plane{}));
  Random random(9);
  for (const Shape& shape : {Shape(Sphere{0.4}), Shape(Box{{0.2, 0.5, 0.3}})}) {
    const RoundedBox solid = *outline(shape);
    EXPECT_EQ(solid.is_ball(), std::holds_alternative<Sphere>(shape));
    const Mat3 R = random_rotation(random).toRotationMatrix();
    const Vec3 inner = solid.half_extents.array() - solid.rounding;
    const Vec3 reach = R.cwiseAbs() * inner + Vec3::Constant(solid.rounding);
    std::visit([&](const auto& s) { EXPECT_LT((reach - s.bounds(R)).norm(), 1e-15); }, shape);
    EXPECT_NEAR(inner.norm() + solid.rounding, radius_around(shape), 1e-15);
  }
}

TEST(SphereSphere, GradientAndStiffnessMatchFiniteDifferences) {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    Scene scene = pair_of(moving(Sphere{0.4}), moving(Sphere{0.3}));
    scene.bodies[1].position = random_vector(random).normalized() * uniform(random, 0.5, 1.2);
    scene.bodies[1].orientation = random_rotation(random);
    expect_formulas(scene, random);
  }
}

TEST(SpherePlane, GradientAndStiffnessMatchFiniteDifferences) {
  Random random(2);
  for (int trial = 0; trial < 20; ++trial) {
    Scene scene = pair_of(moving(Sphere{0.4}), fixed(Plane{}));
    scene.bodies[1].orientation = random_rotation(random);
    scene.bodies[0].position = random_vector(random) * 0.3;
    expect_formulas(scene, random);
  }
}

// Over a face, an edge and a corner of a rotating box: three different distance fields.
TEST(SphereBox, GradientAndStiffnessMatchFiniteDifferences) {
  Random random(3);
  for (int outside = 1; outside <= 3; ++outside) {
    for (int trial = 0; trial < 20; ++trial) {
      Scene scene = pair_of(moving(Sphere{0.3}), moving(Box{Vec3{0.5, 0.4, 0.6}}, 3.0));
      Vec3 centre_B{0.1, -0.05, 0.2};
      for (int axis = 0; axis < outside; ++axis) {
        const double side = trial % 2 == 0 ? 1.0 : -1.0;
        centre_B[axis] = side * (std::get<Box>(scene.bodies[1].shape).half_extents[axis] +
                                 uniform(random, 0.1, 0.3));
      }
      scene.bodies[1].orientation = random_rotation(random);
      scene.bodies[1].position = random_vector(random);
      scene.bodies[0].position = scene.bodies[1].position + scene.bodies[1].orientation * centre_B;
      expect_formulas(scene, random);
    }
  }
}

TEST(SphereBox, ACentreInsideLeavesThroughTheNearestFace) {
  Scene scene = pair_of(moving(Sphere{0.1}), moving(Box{Vec3{0.5, 0.5, 0.5}}));
  scene.bodies[0].position = {0.1, 0.45, -0.2};
  Blocks blocks;
  contact_rows(scene)(initial_state(scene), blocks);
  ASSERT_EQ(blocks.size(), 1U);
  EXPECT_EQ(blocks.all()[0].n, Vec3(0.0, 1.0, 0.0));
  EXPECT_NEAR(blocks.all()[0].phi[0], -0.15, 1e-15);
}

TEST(BoxPlane, GradientAndStiffnessMatchFiniteDifferences) {
  Random random(4);
  for (int trial = 0; trial < 20; ++trial) {
    Scene scene = pair_of(moving(Box{Vec3{0.5, 0.2, 0.3}}, 2.0), fixed(Plane{}));
    scene.contact.margin = 5.0;  // all eight corners
    scene.bodies[0].position = random_vector(random);
    scene.bodies[0].orientation = random_rotation(random);
    scene.bodies[1].orientation = random_rotation(random);
    expect_formulas(scene, random);
  }
}

// A small box with all corners above the face of a large one: corner points, no clipped ones.
TEST(BoxBox, GradientAndStiffnessMatchFiniteDifferencesOnAFace) {
  Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    Scene scene =
        pair_of(moving(Box{Vec3{0.2, 0.1, 0.15}}, 2.0), moving(Box{Vec3{2.0, 0.5, 2.0}}, 5.0));
    const Quat tilt(Eigen::AngleAxisd(0.05, random_vector(random).normalized()));
    scene.bodies[1].orientation = random_rotation(random);
    scene.bodies[1].position = random_vector(random);
    scene.bodies[0].orientation = scene.bodies[1].orientation * tilt;
    scene.bodies[0].position =
        scene.bodies[1].position + scene.bodies[1].orientation * Vec3(0.3, 0.62, -0.4);
    expect_formulas(scene, random);
  }
}

// Faces that overhang each other on any side touch at the corners of their common part.
TEST(BoxBox, OverhangingFacesTouchInTheirCommonPart) {
  Random random(7);
  const Vec3 half[2] = {{0.3, 0.4, 0.5}, {0.35, 0.45, 0.55}};
  for (int trial = 0; trial < 48; ++trial) {
    const int axis = trial % 3;
    const double side = trial % 2 == 0 ? 1.0 : -1.0;
    Vec3 offset{trial % 4 < 2 ? 0.2 : -0.2, trial % 8 < 4 ? 0.25 : -0.25,
                trial % 16 < 8 ? 0.3 : -0.3};
    offset[axis] = side * (half[0][axis] + half[1][axis] - 0.001);
    Scene scene = pair_of(moving(Box{half[0]}), moving(Box{half[1]}));
    scene.contact.margin = 0.02;
    const Quat q = random_rotation(random);
    scene.bodies[0].orientation = scene.bodies[1].orientation = q;
    scene.bodies[0].position = q * offset;
    Blocks blocks;
    contact_rows(scene)(initial_state(scene), blocks);
    ASSERT_EQ(blocks.size(), 4U) << trial;
    unsigned found = 0;  // corners
    for (const Block& block : blocks.all()) {
      const Vec3 at = q.conjugate() *
                      (scene.bodies[static_cast<std::size_t>(block.body_a)].position + block.r_a);
      unsigned corner = 0;
      for (int along = 0, bit = 0; along < 3; ++along) {
        if (along == axis) continue;
        const double low = std::max(offset[along] - half[0][along], -half[1][along]);
        const double high = std::min(offset[along] + half[0][along], half[1][along]);
        const bool is_high = at[along] > 0.5 * (low + high);
        EXPECT_NEAR(at[along], is_high ? high : low, 1e-12) << trial;
        if (is_high) corner |= 1U << bit;
        ++bit;
      }
      found |= 1U << corner;
    }
    EXPECT_EQ(found, 15U) << trial;
  }
}

TEST(BoxBox, AFaceOnAFaceHasFourPointsInEveryArrangement) {
  Random random(6);
  for (int trial = 0; trial < 60; ++trial) {
    Scene scene = pair_of(moving(Box{Vec3{0.3, 0.4, 0.5}}), moving(Box{Vec3{0.35, 0.45, 0.55}}));
    const int axis = trial % 3;
    const double side = trial % 2 == 0 ? 1.0 : -1.0;
    Vec3 offset{0.02, -0.03, 0.01};
    offset[axis] = side * (std::get<Box>(scene.bodies[0].shape).half_extents[axis] +
                           std::get<Box>(scene.bodies[1].shape).half_extents[axis] - 0.001);
    scene.contact.margin = 0.02;
    scene.bodies[1].orientation = random_rotation(random);
    scene.bodies[0].orientation = scene.bodies[1].orientation;
    scene.bodies[0].position = scene.bodies[1].orientation * offset;
    Blocks blocks;
    contact_rows(scene)(initial_state(scene), blocks);
    ASSERT_EQ(blocks.size(), 4U);
    Vec3 n = Vec3::Zero();
    n[axis] = side;
    for (const Block& block : blocks.all()) {
      EXPECT_NEAR(block.phi[0], -0.001, 1e-12);
      EXPECT_LT((block.n * (block.a == 0 ? 1.0 : -1.0) - scene.bodies[1].orientation * n).norm(),
                1e-12);
    }
  }
}

TEST(BoxBox, FeaturesKeepTheirIdsWhileABoxSlides) {
  Scene scene = pair_of(moving(Box{Vec3{0.5, 0.5, 0.5}}), moving(Box{Vec3{1.0, 0.5, 1.0}}));
  scene.contact.margin = 0.02;
  const Rows rows = contact_rows(scene);
  std::vector<std::uint64_t> before;
  for (int step = 0; step <= 40; ++step) {
    scene.bodies[0].position = {0.55 + 0.01 * step, 1.0, 0.2};  // half of it overhangs
    Blocks blocks;
    rows(initial_state(scene), blocks);
    std::vector<std::uint64_t> ids;
    for (const Block& block : blocks.all()) ids.push_back(block.id);
    ASSERT_EQ(ids.size(), 4U);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      for (std::size_t j = i + 1; j < ids.size(); ++j) EXPECT_NE(ids[i], ids[j]);
    }
    if (step > 0) {
      EXPECT_EQ(ids, before);
    }
    before = ids;
  }
}

// Equal boxes exactly above each other: rounding must neither add nor rename corners.
TEST(BoxBox, FlushFacesHaveTheSameFourPointsDespiteRounding) {
  std::vector<std::uint64_t> first;
  for (const double yaw : {0.0, 1e-15, -1e-15}) {
    for (const double shift : {0.0, 1e-16, -1e-16}) {
      Scene scene = pair_of(moving(Box{Vec3{0.5, 0.5, 0.5}}), moving(Box{Vec3{0.5, 0.5, 0.5}}));
      scene.contact.margin = 0.02;
      scene.bodies[0].position = {shift, 1.0, -shift};
      scene.bodies[0].orientation = Quat(1.0, 0.0, 0.5 * yaw, 0.0);
      Blocks blocks;
      contact_rows(scene)(initial_state(scene), blocks);
      std::vector<std::uint64_t> ids;
      for (const Block& block : blocks.all()) ids.push_back(block.id);
      EXPECT_EQ(ids.size(), 4U) << yaw << " " << shift;
      if (first.empty()) first = ids;
      EXPECT_EQ(ids, first) << yaw << " " << shift;
    }
  }
}

/// Two long boxes that cross like an X, rotated by 45 degrees about their axes: edge over edge.
/// @param gap between the edges [m]
Scene crossed_boxes(double gap) {
  Scene scene =
      pair_of(moving(Box{Vec3{2.0, 0.3, 0.3}}, 2.0), moving(Box{Vec3{0.2, 0.2, 3.0}}, 5.0));
  const double eighth = 0.25 * std::acos(-1.0);
  scene.bodies[0].orientation = Quat(Eigen::AngleAxisd(eighth, Vec3::UnitX()));
  scene.bodies[1].orientation = Quat(Eigen::AngleAxisd(eighth, Vec3::UnitZ()));
  scene.bodies[0].position = {0.1, std::sqrt(2.0) * (0.3 + 0.2) + gap, -0.4};
  return scene;
}

TEST(BoxBox, CrossedEdgesTouchInOnePoint) {
  for (const double gap : {0.015, 0.0, -0.05}) {
    Scene scene = crossed_boxes(gap);
    scene.contact.margin = 0.02;
    Blocks blocks;
    contact_rows(scene)(initial_state(scene), blocks);
    ASSERT_EQ(blocks.size(), 1U) << gap;
    const Block& block = blocks.all()[0];
    EXPECT_NEAR(block.phi[0], gap, 1e-12);
    const double up = block.a == 0 ? 1.0 : -1.0;
    EXPECT_LT((up * block.n - Vec3::UnitY()).norm(), 1e-12);
    const Vec3& arm_upper = block.a == 0 ? block.r_a : block.r_b;
    EXPECT_NEAR(arm_upper.x(), -0.1, 1e-12) << "the lower box's edge runs at x = 0";
    EXPECT_NEAR(arm_upper.z(), 0.0, 1e-12) << "the upper box's edge runs through its middle";
  }
}

TEST(BoxBox, GradientMatchesFiniteDifferencesOnCrossedEdges) {
  Random random(7);
  for (int trial = 0; trial < 40; ++trial) {
    Scene scene = crossed_boxes(uniform(random, -0.05, 0.05));
    scene.bodies[0].orientation = Quat(Eigen::AngleAxisd(0.2, random_vector(random).normalized())) *
                                  scene.bodies[0].orientation;
    const Quat turn = random_rotation(random);
    for (Body& body : scene.bodies) {
      body.position = turn * body.position;
      body.orientation = turn * body.orientation;
    }
    const State state = initial_state(scene);
    const Rows rows = contact_rows(scene);
    Blocks blocks;
    rows(state, blocks);
    ASSERT_EQ(blocks.size(), 1U);
    expect_gradient(scene, state, rows);
  }
}

/// Largest gap over the fifteen axes, by brute force on the corners: an oracle for the penetration
/// depth of boxes.
double separation(const Scene& scene) {
  std::vector<Vec3> axes;
  std::vector<Vec3> corners[2];
  Mat3 R[2];
  for (std::size_t k = 0; k < 2; ++k) {
    const Body& body = scene.bodies[k];
    R[k] = body.orientation.toRotationMatrix();
    for (int i = 0; i < 3; ++i) axes.emplace_back(R[k].col(i));
    const Vec3& half = std::get<Box>(body.shape).half_extents;
    for (int c = 0; c < 8; ++c) {
      const Vec3 corner((c & 1) != 0 ? half.x() : -half.x(), (c & 2) != 0 ? half.y() : -half.y(),
                        (c & 4) != 0 ? half.z() : -half.z());
      corners[k].push_back(body.position + R[k] * corner);
    }
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) axes.emplace_back(R[0].col(i).cross(R[1].col(j)).normalized());
  }
  double best = -kUnbounded;
  for (const Vec3& axis : axes) {
    for (const double side : {1.0, -1.0}) {
      double lowest = kUnbounded;
      double highest = -kUnbounded;
      for (const Vec3& p : corners[0]) lowest = std::min(lowest, side * axis.dot(p));
      for (const Vec3& p : corners[1]) keep_largest(highest, side * axis.dot(p));
      keep_largest(best, lowest - highest);
    }
  }
  return best;
}

/// Random pairs of boxes that overlap by a depth between these must touch with it.
/// @return number of pairs with a single contact point
int expect_overlaps_touch(int trials, double least, double most) {
  Random random(8);
  int edges = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const Vec3 half_a{uniform(random, 0.1, 0.6), uniform(random, 0.1, 0.6),
                      uniform(random, 0.01, 0.6)};
    const Vec3 half_b{uniform(random, 0.1, 0.6), uniform(random, 0.01, 0.6),
                      uniform(random, 0.1, 0.6)};
    Scene scene = pair_of(moving(Box{half_a}), moving(Box{half_b}));
    scene.contact.margin = 0.02;
    scene.bodies[0].orientation = random_rotation(random);
    scene.bodies[1].orientation = random_rotation(random);
    // Move along a line until they overlap by that depth.
    const Vec3 away = random_vector(random).normalized();
    const double depth = uniform(random, least, most);
    double lo = 0.0;
    double hi = 3.0;
    for (int step = 0; step < 50; ++step) {
      const double middle = 0.5 * (lo + hi);
      scene.bodies[0].position = middle * away;
      (separation(scene) < -depth ? lo : hi) = middle;
    }
    Blocks blocks;
    contact_rows(scene)(initial_state(scene), blocks);
    EXPECT_GT(blocks.size(), 0U) << "trial " << trial;
    if (blocks.size() == 0) continue;
    double deepest = kUnbounded;
    for (const Block& block : blocks.all()) deepest = std::min(deepest, block.phi[0]);
    // Faces are preferred if edges are better by less than a tilt of 0.6 degrees.
    const auto mean = [](const Vec3& half) { return std::sqrt(half.maxCoeff() * half.minCoeff()); };
    const double length = std::min(mean(half_a), mean(half_b));
    EXPECT_GT(deepest, -depth - 1.2e-2 * length) << "trial " << trial;
    EXPECT_LT(deepest, 0.0) << "trial " << trial;
    if (blocks.size() == 1) ++edges;
  }
  return edges;
}

TEST(BoxBox, OverlappingBoxesTouchWithTheDepthOfTheOverlap) {
  constexpr int kTrials = repetitions(4000, 400);
  EXPECT_GT(expect_overlaps_touch(kTrials, 0.002, 0.02), kTrials / 20);
}

// The faces that are preferred can have no common point.
TEST(BoxBox, ShallowOverlapsTouch) { expect_overlaps_touch(repetitions(8000, 800), 1e-5, 2e-3); }

TEST(Contact, HasNoRowBeyondTheMargin) {
  for (const double gap : {0.019, 0.021}) {
    Scene scene = pair_of(moving(Sphere{0.5}), fixed(Plane{}));
    scene.contact.margin = 0.02;
    scene.bodies[0].position.y() = 0.5 + gap;
    Blocks blocks;
    contact_rows(scene)(initial_state(scene), blocks);
    EXPECT_EQ(blocks.size(), gap < 0.02 ? 1U : 0U);
  }
}

TEST(Contact, OnlyThePapersFormGivesASphereAngularStiffness) {
  Scene scene = pair_of(moving(Sphere{0.5}), fixed(Plane{}));
  scene.bodies[0].position.y() = 0.5;
  const State state = initial_state(scene);
  Blocks blocks;
  contact_rows(scene)(state, blocks);
  blocks.all()[0].lambda[0] = 10.0;
  StiffnessStage stage(scene);
  std::vector<Vec6> k;
  stage.evaluate(scene, blocks.all(), ContactTerms::kExact, whole(scene), rotations(state), k);
  EXPECT_EQ(k[0], Vec6::Zero());
  stage.evaluate(scene, blocks.all(), ContactTerms::kPaper, whole(scene), rotations(state), k);
  Vec6 expected;
  expected << 0.0, 0.0, 0.0, 5.0, 0.0, 5.0;  // [l][r] with l = 10 y, r = -0.5 y
  EXPECT_LT((k[0] - expected).norm(), 1e-14);
}

/// J^T lambda of one block on a body after both have moved: force, then torque about its centre.
Vec6 force_after(const Block& start, const Motion& a, const Motion& b, int body) {
  Blocks moved;
  moved.append() = start;
  move_rows(start, a, b, moved.all()[0]);
  return force_on(moved, body);
}

// K of contacts with friction, against central differences of the force of moved rows at the same
// multipliers: on a face, an edge and a corner of a box, on a sphere, and with a corner.
TEST(Friction, TheExactBlockIsTheDerivativeOfItsForce) {
  Random random(9);
  for (int trial = 0; trial < 60; ++trial) {
    const bool round = trial % 5 == 4;
    Scene scene = pair_of(trial % 5 == 3 ? moving(Box{Vec3{0.2, 0.1, 0.15}}) : moving(Sphere{0.4}),
                          round ? moving(Sphere{0.3}) : moving(Box{Vec3{0.5, 0.5, 0.5}}));
    scene.effects.friction = true;
    scene.contact.margin = 1.0;
    for (Body& body : scene.bodies) body.friction = 0.5;
    scene.bodies[0].orientation = random_rotation(random);
    scene.bodies[1].orientation = random_rotation(random);
    const Vec3 outside = trial % 5 == 1   ? Vec3(0.7, 0.8, 0.2)
                         : trial % 5 == 2 ? Vec3(0.7, 0.6, 0.8)
                                          : Vec3(0.1, 0.95, 0.2);
    scene.bodies[0].position = scene.bodies[1].orientation * outside;
    const State state = initial_state(scene);
    Blocks blocks;
    contact_rows(scene)(state, blocks);
    FrictionStage(scene).append(scene, rotations(state), blocks.all());
    ASSERT_GT(blocks.size(), 0U);
    Block& block = blocks.all()[0];
    ASSERT_EQ(block.rows, 3);
    for (int row = 0; row < 3; ++row) block.lambda[row] = uniform(random, 0.5, 2.0);
    StiffnessMatrix K;
    K.clear(2);
    contact_stiffness(block, ContactTerms::kExact, K);
    for (int col = 0; col < 2; ++col) {
      for (int dof = 0; dof < 6; ++dof) {
        const Motion plus = motion(Vec6::Unit(dof), kStep);
        const Motion minus = motion(Vec6::Unit(dof), -kStep);
        const auto after = [&](const Motion& of_col, int row) {
          const bool is_a = block.a == col;
          return force_after(block, is_a ? of_col : Motion{}, is_a ? Motion{} : of_col, row);
        };
        for (int row = 0; row < 2; ++row) {
          const Vec6 slope = (after(plus, row) - after(minus, row)) / (2.0 * kStep);
          EXPECT_LT((K.block(row, col).col(dof) - slope).norm(), kTolerance)
              << "trial " << trial << " K(" << row << "," << col << ") dof " << dof;
        }
      }
    }
  }
}

TEST(Friction, RowsAreTheRelativeSpeedAtTheContact) {
  Random random(7);
  for (int trial = 0; trial < 20; ++trial) {
    Scene scene = pair_of(moving(Sphere{0.4}), moving(Box{Vec3{0.5, 0.5, 0.5}}));
    scene.effects.friction = true;
    scene.bodies[0].friction = 0.5;
    scene.bodies[1].friction = 0.8;
    scene.bodies[1].orientation = random_rotation(random);
    scene.bodies[0].position = scene.bodies[1].orientation * Vec3(0.1, 0.9, 0.2);
    State state = initial_state(scene);
    for (Vec6& u : state.u) u << random_vector(random), random_vector(random);
    Blocks blocks;
    contact_rows(scene)(state, blocks);
    FrictionStage(scene).append(scene, rotations(state), blocks.all());
    ASSERT_EQ(blocks.size(), 1U);
    const Block& block = blocks.all()[0];
    ASSERT_EQ(block.rows, 3);
    EXPECT_NEAR(block.mu, std::sqrt(0.4), 1e-15);
    EXPECT_LT(std::abs(block.n.dot(block.t1)) + std::abs(block.n.dot(block.t2)) +
                  std::abs(block.t1.dot(block.t2)),
              1e-14);
    const Vec3 p_a = state.u[0].head<3>() + Vec3(state.u[0].tail<3>()).cross(block.r_a);
    const Vec3 p_b = state.u[1].head<3>() + Vec3(state.u[1].tail<3>()).cross(block.r_b);
    EXPECT_NEAR(speed_of(block, 1, state.u), block.t1.dot(p_a - p_b), 1e-14);
    EXPECT_NEAR(speed_of(block, 2, state.u), block.t2.dot(p_a - p_b), 1e-14);
    EXPECT_LT((state.x[0] + block.r_a - state.x[1] - block.r_b).norm(), 1e-15);
  }
}

}  // namespace
}  // namespace substep::test
