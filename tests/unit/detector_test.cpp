// Pairs of bodies found by the detector, for all shapes.

#include "tests/unit/support.hpp"

namespace substep::test {
namespace {

TEST(Detector, BodiesOfOneGroupAndJoinedBodiesDoNotTouch) {
  Scene scene = pair_of(moving(Sphere{0.5}), moving(Sphere{0.5}));
  scene.bodies[1].position.x() = 0.9;
  const auto points = [](const Scene& s) {
    Blocks blocks;
    contact_rows(s)(initial_state(s), blocks);
    return blocks.size();
  };
  EXPECT_EQ(points(scene), 1U);
  Scene grouped = scene;
  grouped.bodies[0].collision_group = grouped.bodies[1].collision_group = 3;
  EXPECT_EQ(points(grouped), 0U);
  Scene joined = scene;
  BallJoint joint;
  joint.a = 1;
  joint.b = 0;
  joined.joints.push_back(joint);
  EXPECT_EQ(points(joined), 0U);
  Scene ghost = scene;
  ghost.bodies[0].collides = false;
  EXPECT_EQ(points(ghost), 0U);
}

TEST(Detector, FindsThePairsOfAnExhaustiveSearch) {
  Random random(8);
  for (int trial = 0; trial < 50; ++trial) {
    Scene scene;
    scene.effects.contact = true;
    for (int i = 0; i < 30; ++i) {
      Body body = i % 2 == 0 ? moving(Sphere{0.3}) : moving(Box{Vec3{0.2, 0.3, 0.1}});
      body.position = 1.5 * random_vector(random);
      body.orientation = random_rotation(random);
      scene.bodies.push_back(body);
    }
    const State state = initial_state(scene);
    Blocks all;
    contact_rows(scene)(state, all);
    std::size_t alone = 0;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      for (std::size_t j = i + 1; j < scene.bodies.size(); ++j) {
        const Scene two = [&] {
          Scene s = pair_of(scene.bodies[i], scene.bodies[j]);
          s.contact.margin = scene.contact.margin;
          return s;
        }();
        Blocks blocks;
        contact_rows(two)(initial_state(two), blocks);
        alone += blocks.size();
      }
    }
    EXPECT_EQ(all.size(), alone);
  }
}

// Data cached between sub-steps must not change the result: bodies drift, rotate, jump or stay.
TEST(Detector, FindsTheSamePairsWithoutItsCache) {
  Random random(9);
  for (int trial = 0; trial < 20; ++trial) {
    Scene scene;
    scene.effects.contact = true;
    scene.bodies.push_back(fixed(Plane{}));
    for (int i = 0; i < 24; ++i) {
      Body body = i % 2 == 0 ? moving(Sphere{0.3}) : moving(Box{Vec3{0.2, 0.5, 0.1}});
      body.position = Vec3{1.5, i % 3 == 0 ? 0.4 : 1.5, 0.5}.cwiseProduct(random_vector(random));
      body.orientation = random_rotation(random);
      scene.bodies.push_back(body);
    }
    State state = initial_state(scene);
    const Rows kept = contact_rows(scene);
    std::size_t found = 0;
    for (int step = 0; step < 60; ++step) {
      const double far = step % 20 == 19 ? 2.0 : 0.02;
      for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
        if (uniform(random) < 0.0) continue;
        state.x[i] += far * random_vector(random);
        const Vec3 turn = far * random_vector(random);
        state.q[i] = (Quat(1.0, turn.x(), turn.y(), turn.z()) * state.q[i]).normalized();
      }
      Blocks with;
      Blocks without;
      kept(state, with);
      contact_rows(scene)(state, without);
      ASSERT_EQ(with.size(), without.size()) << trial << ", " << step;
      for (std::size_t i = 0; i < with.size(); ++i) {
        EXPECT_EQ(with.all()[i].id, without.all()[i].id);
        EXPECT_EQ(with.all()[i].phi[0], without.all()[i].phi[0]);
      }
      found += with.size();
    }
    EXPECT_GT(found, 100U);
  }
}

}  // namespace
}  // namespace substep::test
