// Which scenes are trees, and that their errors are measured against the exact motion.

#include <gtest/gtest.h>

#include <memory>

#include "core/lab/reference.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/unit/tree_scenes.hpp"

namespace substep::test {
namespace {

TEST(JointTree, OnlyTreesOfRigidJointsAreAccepted) {
  EXPECT_FALSE(JointTree::of(scenes::bridge())) << "contact";
  EXPECT_FALSE(JointTree::of(scenes::pendulum())) << "unequal moments, no gyroscopic effect";
  const Scene good = six_boxes();
  ASSERT_TRUE(JointTree::of(good));
  const auto refused = [&](const auto& change) {
    Scene scene = good;
    change(scene);
    return !JointTree::of(scene).has_value();
  };
  EXPECT_TRUE(refused([](Scene& s) { s.effects.contact = true; }));
  EXPECT_TRUE(refused([](Scene& s) { s.effects.gyroscopic = false; }));
  EXPECT_TRUE(refused([](Scene& s) {
    s.effects.external = true;
    s.bodies[3].force = {1.0, 0.0, 0.0};
  })) << "the equations have no applied force but gravity";
  EXPECT_TRUE(refused([](Scene& s) { s.effects.joints = false; }));
  EXPECT_TRUE(refused([](Scene& s) { s.regularisation = 1e-6; }));
  EXPECT_TRUE(refused([](Scene& s) { base(s.joints[2]).compliance = 1e-3; }));
  EXPECT_FALSE(refused([](Scene& s) { base(s.joints[2]).compliance = 1e-12; }));
  EXPECT_TRUE(refused([](Scene& s) { base(s.joints[2]).anchor_a.x() += 1e-8; })) << "open";
  EXPECT_TRUE(refused([](Scene& s) { s.bodies[3].velocity.x() += 1e-7; })) << "inconsistent";
  EXPECT_TRUE(refused([](Scene& s) { s.joints.push_back(s.joints[2]); })) << "twice the same";
  EXPECT_TRUE(refused([](Scene& s) { s.bodies[5].inertia.setConstant(1e-10); })) << "a point";
  EXPECT_TRUE(refused([](Scene& s) {
    BallJoint loop;
    loop.a = 5;
    loop.anchor_b = s.bodies[5].position;
    s.joints.emplace_back(loop);
  })) << "a loop through the world";
  EXPECT_TRUE(refused([](Scene& s) {
    BallJoint loop;
    loop.a = 5;
    loop.b = 2;
    loop.anchor_b =
        s.bodies[2].orientation.conjugate() * (s.bodies[5].position - s.bodies[2].position);
    s.joints.emplace_back(loop);
  })) << "a loop";
  EXPECT_FALSE(refused([](Scene& s) { s.joints.erase(s.joints.begin() + 3); })) << "two trees";
  Scene hinged = branching_tree();
  std::get<HingeJoint>(hinged.joints[1]).axis_b = Vec3(0.6, 0.0, 0.8);
  EXPECT_FALSE(JointTree::of(hinged)) << "axes that are not parallel";
}

TEST(Reference, TreesInSpaceAreExactAndSliced) {
  const auto scene = std::make_shared<const Scene>(scenes::whirling_chain());
  ReferenceRun run(scene, 1.0);
  int calls = 1;
  for (; run.advance(); ++calls) {
  }
  EXPECT_GE(calls, 60);
  const Reference& reference = run.reference();
  EXPECT_EQ(reference.source, "exact: minimal coordinates, 24 degrees of freedom");
  EXPECT_LT(reference.uncertainty, 2e-9);
  ASSERT_EQ(reference.track.size(), 61U);
  JointTree tree = tree_of(*scene);
  tree.advance(1.0);
  EXPECT_LT((reference.track.back() - tree.centre(7)).norm(), 1e-11);
}

}  // namespace
}  // namespace substep::test
