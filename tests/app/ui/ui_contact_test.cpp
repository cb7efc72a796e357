// The ambient shadow of bodies on the floor.
#include <gtest/gtest.h>

#include <cmath>

#include "app/render/contact_shadows.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

Vec3 vec(const Eigen::Vector3f& a) { return a.cast<double>(); }

// The shadows of one body on a floor at y = 0.
std::vector<SoftShadow> below(const Shape& shape, const Vec3& x, const Quat& q = Quat::Identity(),
                              const Ground& ground = {}) {
  Scene scene;
  Body body;
  body.shape = shape;
  scene.bodies.push_back(body);
  return contact_shadows(scene, {{x}, {q}}, ground);
}

Quat turned(double angle, const Vec3& axis) { return Quat(Eigen::AngleAxisd(angle, axis)); }

TEST(ContactShadow, OfARestingBallIsADiscBelowIt) {
  const auto shadows = below(Sphere{0.5}, {1.0, 0.5, -2.0});
  ASSERT_EQ(shadows.size(), 1U);
  EXPECT_LT((vec(shadows[0].centre) - Vec3(1.0, 0.0, -2.0)).norm(), 1e-6);
  EXPECT_EQ(shadows[0].round, 1.0F);
  EXPECT_FLOAT_EQ(shadows[0].strength, 1.0F);
  EXPECT_LT(shadows[0].half_u, 0.5F);
}

TEST(ContactShadow, IsFainterAndSofterWithHeightUntilThereIsNone) {
  const Box box{Vec3(0.5, 0.5, 0.5)};
  SoftShadow lower = below(box, {0.0, 0.5, 0.0}).at(0);
  for (const double height : {0.1, 0.3, 0.6}) {
    const SoftShadow higher = below(box, {0.0, 0.5 + height, 0.0}).at(0);
    EXPECT_LT(higher.strength, lower.strength);
    EXPECT_GT(higher.softness, lower.softness);
    lower = higher;
  }
  EXPECT_TRUE(below(box, {0.0, 5.0, 0.0}).empty());
  EXPECT_TRUE(below(box, {0.0, -2.0, 0.0}).empty()) << "fallen through the floor";
  EXPECT_TRUE(below(box, Vec3::Constant(std::nan(""))).empty());
}

TEST(ContactShadow, OfABoxIsItsFaceTurnedWithIt) {
  const SoftShadow s =
      below(Box{Vec3(0.8, 0.2, 0.3)}, {0.0, 0.2, 0.0}, turned(0.5, Vec3::UnitY())).at(0);
  EXPECT_NEAR(s.half_u, 0.8, 1e-6);
  EXPECT_NEAR(s.half_v, 0.3, 1e-6);
  EXPECT_NEAR(std::abs(vec(s.along).dot(Vec3(std::cos(0.5), 0.0, -std::sin(0.5)))), 1.0, 1e-6);
}

// A card of 1 m that leans at 30 degrees from the vertical, its lower edge at x = -0.25 m.
TEST(ContactShadow, OfALeaningCardIsAtItsLowerEdge) {
  const double lean = -0.5235987755982988;
  const SoftShadow s = below(Box{Vec3(0.01, 0.5, 0.3)}, {0.0, 0.5 * std::cos(lean), 0.0},
                             turned(lean, Vec3::UnitZ()))
                           .at(0);
  EXPECT_LT(s.centre[0], -0.1F);
  EXPECT_LT(std::min(s.half_u, s.half_v), 0.15F) << "not all of the card's projection, 0.25 m";
  EXPECT_NEAR(std::max(s.half_u, s.half_v), 0.3, 1e-6);
}

TEST(ContactShadow, LiesInASlopingFloor) {
  Ground slope;
  const Quat tilt = turned(0.4, Vec3::UnitZ());
  const Vec3 n = tilt * Vec3::UnitY();
  slope.origin = {0.0F, 1.0F, 0.0F};
  slope.normal = {static_cast<float>(n.x()), static_cast<float>(n.y()), static_cast<float>(n.z())};
  const Vec3 x = Vec3(0.0, 1.0, 0.0) + tilt * Vec3(0.7, 0.2, 0.0);
  const SoftShadow s = below(Box{Vec3(0.3, 0.2, 0.1)}, x, tilt, slope).at(0);
  EXPECT_NEAR(n.dot(vec(s.centre) - Vec3(0.0, 1.0, 0.0)), 0.0, 1e-6);
  EXPECT_NEAR(n.dot(vec(s.along)), 0.0, 1e-6);
  EXPECT_NEAR(s.half_u, 0.3, 1e-6);
}

TEST(ContactShadow, OnlyAPlaneOfTheSceneIsAFloor) {
  Headless h;
  h.app->open("wall");
  h.frames(2);
  EXPECT_TRUE(h.renderer->picture.ground.solid);
  EXPECT_FALSE(h.renderer->picture.contacts.empty());
  const Ground there = h.renderer->picture.ground;
  h.app->session.play();
  h.frames(60);
  EXPECT_EQ(h.renderer->picture.ground, there) << "it does not move with the bodies";
  h.app->open("free_fall");
  h.frames(2);
  EXPECT_FALSE(h.renderer->picture.ground.solid);
  EXPECT_TRUE(h.renderer->picture.contacts.empty());
}

}  // namespace
}  // namespace substep
