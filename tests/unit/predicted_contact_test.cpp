// Contacts that are detected once and moved along with their bodies.

#include <set>

#include "core/math/turn.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/unit/support.hpp"

namespace substep::test {
namespace {

/// Free flight of one sub-step as in integrate(), gravity first.
State flown(const Scene& scene, const State& state, double time) {
  State out = state;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].is_static) continue;
    out.x[i] += time * (state.u[i].head<3>() + time * scene.gravity);
    const Vec3 half = 0.5 * time * state.u[i].tail<3>();
    out.q[i] = (Quat(1.0, half.x(), half.y(), half.z()) * state.q[i]).normalized();
  }
  return out;
}

std::set<std::pair<int, int>> pairs_of(const Blocks& blocks) {
  std::set<std::pair<int, int>> pairs;
  for (const Block& block : blocks.all()) pairs.insert(std::minmax(block.body_a, block.body_b));
  return pairs;
}

TEST(PredictedContacts, HaveEveryPairThatWillTouch) {
  Random random(11);
  const double ahead = 1.0 / 30.0;
  std::size_t new_pairs = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Scene scene;
    scene.effects.contact = scene.effects.gravity = true;
    scene.bodies.push_back(fixed(Plane{}));
    for (int i = 0; i < 16; ++i) {
      Body body = i % 2 == 0 ? moving(Sphere{0.1}) : moving(Box{Vec3{0.1, 0.2, 0.05}});
      if (i % 8 == 7) body = fixed(Box{Vec3{0.1, 0.2, 0.05}});
      body.position = random_vector(random) + Vec3::UnitY();
      body.orientation = random_rotation(random);
      if (!body.is_static) body.velocity = 20.0 * random_vector(random);
      if (!body.is_static) body.angular_velocity = 20.0 * random_vector(random);
      scene.bodies.push_back(body);
    }
    const State start = initial_state(scene);
    ContactStage stage(scene);
    const Part all = whole(scene);
    ASSERT_TRUE(stage.predict(scene, all, start, rotations(start), ahead));
    Blocks before;
    contact_rows(scene)(start, before);
    for (int k = 0; k <= 8; ++k) {
      const State now = flown(scene, start, ahead * k / 8.0);
      Blocks fresh;
      contact_rows(scene)(now, fresh);
      Blocks carried;
      ASSERT_TRUE(stage.append_predicted(scene, all, now, rotations(now), ahead / 8.0, carried));
      const auto predicted = pairs_of(carried);
      for (const auto& pair : pairs_of(fresh)) {
        EXPECT_TRUE(predicted.contains(pair))
            << trial << ": " << pair.first << " and " << pair.second << " at " << k;
      }
      new_pairs += fresh.size() > before.size() ? fresh.size() - before.size() : 0;
    }
  }
  EXPECT_GT(new_pairs, 100U) << "and some of them are new";
}

/// Largest difference between a moved contact row and a newly detected one.
struct ContactDifference {
  double phi = 0.0;  // [m]
  double J = 0.0;
  double H = 0.0;  // [1/m]
};
ContactDifference after_a_motion(const Body& a, const Body& b, double by, Random& random) {
  const Scene scene = pair_of(a, b);
  State state = initial_state(scene);
  ContactStage stage(scene);
  const Part all = whole(scene);
  EXPECT_TRUE(stage.predict(scene, all, state, rotations(state), 0.01));
  for (std::size_t i = 0; i < 2; ++i) {
    if (scene.bodies[i].is_static) continue;
    state.x[i] += by * random_vector(random);
    const Vec3 half = by * random_vector(random);
    state.q[i] = (Quat(1.0, half.x(), half.y(), half.z()) * state.q[i]).normalized();
  }
  Blocks carried;
  EXPECT_TRUE(stage.append_predicted(scene, all, state, rotations(state), 0.01, carried));
  Blocks fresh;
  contact_rows(scene)(state, fresh);
  ContactDifference worst;
  EXPECT_EQ(fresh.size(), carried.size());
  for (std::size_t k = 0; k < std::min(fresh.size(), carried.size()); ++k) {
    const Block& x = fresh.all()[k];
    const Block& y = carried.all()[k];
    EXPECT_EQ(x.id, y.id);
    EXPECT_EQ(y.rows, 1);
    keep_largest(worst.phi, std::abs(x.phi[0] - y.phi[0]));
    keep_largest(worst.H, (x.H - y.H).norm());
    for (int j = 0; j < 6; ++j) {
      worst.J = std::max(
          {worst.J, std::abs(x.J_a[0][j] - y.J_a[0][j]), std::abs(x.J_b[0][j] - y.J_b[0][j])});
    }
  }
  return worst;
}

TEST(CarriedContacts, OnPlanesMatchNewlyDetectedOnes) {
  Random random(12);
  for (const Shape& shape : {Shape(Sphere{0.3}), Shape(Box{Vec3{0.2, 0.3, 0.1}})}) {
    Body body = moving(shape);
    body.position = {0.3, 0.5, -0.2};
    for (int trial = 0; trial < 20; ++trial) {
      body.orientation = random_rotation(random);
      const ContactDifference d = after_a_motion(body, fixed(Plane{}), 0.1, random);
      EXPECT_LT(d.phi, 1e-14);
      EXPECT_LT(d.J, 1e-14);
    }
  }
}

// The prediction is of second order: the errors of phi, J and H are cubic, quadratic and linear in
// the distance moved.
TEST(CarriedContacts, OfSpheresAreOfSecondOrder) {
  for (const double by : {1e-2, 1e-3}) {
    Random random(13);
    for (int trial = 0; trial < 20; ++trial) {
      Body a = moving(Sphere{0.3});
      Body b = moving(Sphere{0.2});
      b.position = 0.7 * random_vector(random).normalized();
      const ContactDifference d = after_a_motion(a, b, by, random);
      EXPECT_LT(d.phi, 30.0 * by * by * by);
      EXPECT_LT(d.J, 30.0 * by * by);
      EXPECT_LT(d.H, 30.0 * by);
    }
  }
}

TEST(CarriedContacts, RotateTheirCurvatureWithTheBody) {
  Random random(14);
  Body box = fixed(Box{Vec3{0.2, 0.2, 2.0}});
  box.is_static = false;
  box.mass = 1.0;
  box.inertia = Vec3::Ones();
  Body ball = moving(Sphere{0.3});
  ball.position = {0.5, 0.5, 0.1};  // beyond an edge
  for (int trial = 0; trial < 20; ++trial) {
    EXPECT_LT(after_a_motion(ball, box, 1e-3, random).H, 0.05);
  }
}

}  // namespace
}  // namespace substep::test
