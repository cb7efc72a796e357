#pragma once
// Small scenes and finite differences for the unit tests.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "core/constraints/contact_stage.hpp"
#include "core/constraints/joint_stage.hpp"
#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/solver/system.hpp"
#include "core/stepping/effective_mass.hpp"
#include "core/stepping/stiffness_bound.hpp"

namespace substep::test {

using Random = std::mt19937_64;

inline double uniform(Random& random, double lo = -1.0, double hi = 1.0) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}
inline Vec3 random_vector(Random& random) {
  return {uniform(random), uniform(random), uniform(random)};
}
inline Quat random_rotation(Random& random) {
  // Braces: arguments in parentheses are evaluated in an order that depends on the compiler.
  return Quat{uniform(random), uniform(random), uniform(random), uniform(random)}.normalized();
}

inline Body moving(const Shape& shape, double mass = 1.0) {
  Body body;
  body.shape = shape;
  body.mass = mass;
  body.inertia = solid_inertia(shape, mass);
  return body;
}
inline Body fixed(const Shape& shape) {
  Body body;
  body.shape = shape;
  body.is_static = true;
  body.mass = 0.0;
  return body;
}

/// The same joint without its axis.
inline BallJoint ball_of(const HingeJoint& hinge) {
  BallJoint ball;
  static_cast<JointBase&>(ball) = hinge;
  return ball;
}

inline Scene pair_of(const Body& a, const Body& b) {
  Scene scene;
  scene.effects.contact = true;
  scene.contact.margin = 1.0;  // the formulas do not depend on the gap of the surfaces
  scene.bodies = {a, b};
  return scene;
}

inline std::vector<Mat3> rotations(const State& state) {
  std::vector<Mat3> R;
  for (const Quat& q : state.q) R.push_back(q.toRotationMatrix());
  return R;
}

/// M^-1 of all bodies, world axes.
inline std::vector<InverseMass> inverse_masses(const Scene& scene, const State& state) {
  std::vector<InverseMass> out(scene.bodies.size());
  inverse_mass(inertia_inverses(scene), whole(scene), rotations(state), out);
  return out;
}

/// Moves one degree of freedom of a body: 0..2 translation, 3..5 rotation about the world axes.
inline State moved(const State& state, int body, int dof, double by) {
  State out = state;
  const auto i = static_cast<std::size_t>(body);
  if (dof < 3) {
    out.x[i][dof] += by;
  } else {
    Vec3 axis = Vec3::Zero();
    axis[dof - 3] = 1.0;
    out.q[i] = Quat(Eigen::AngleAxisd(by, axis)) * state.q[i];
  }
  return out;
}

/// Rows of a scene in a given state.
using Rows = std::function<void(const State&, Blocks&)>;

inline Rows joint_rows(const Scene& scene) {
  return [&scene, stage = JointStage(scene)](const State& state, Blocks& blocks) {
    blocks.clear();
    stage.append(whole(scene), state, rotations(state), blocks);
  };
}
inline Rows contact_rows(const Scene& scene) {
  auto stage = std::make_shared<ContactStage>(scene);
  return [&scene, stage](const State& state, Blocks& blocks) {
    blocks.clear();
    stage->detect_and_append(scene, whole(scene), state, rotations(state), blocks);
  };
}

/// Forces on a body: J^T lambda, force then torque about its centre.
inline Vec6 force_on(const Blocks& blocks, int body) {
  Vec6 force = Vec6::Zero();
  for (const Block& block : blocks.all()) {
    for (int row = 0; row < block.rows; ++row) {
      if (block.a == body) force += gradient(block, row, true) * block.lambda[row];
      if (block.b == body) force += gradient(block, row, false) * block.lambda[row];
    }
  }
  return force;
}

/// One row of J u.
inline double speed_of(const Block& block, int row, std::span<const Vec6> u) {
  double speeds[kMaxRows];
  row_speeds(block, u, speeds);
  return speeds[row];
}

constexpr double kStep = 1e-6;  // of the central differences [m or rad]
constexpr double kTolerance =
    3e-8;  // rounding 1e-16/1e-6 plus truncation 1e-12, on terms of order 10

/// J against central differences of phi, for every row and every degree of freedom of the moving
/// bodies.
inline void expect_gradient(const Scene& scene, const State& state, const Rows& rows) {
  Blocks at;
  Blocks plus;
  Blocks minus;
  rows(state, at);
  ASSERT_GT(at.size(), 0U);
  for (int body = 0; body < static_cast<int>(scene.bodies.size()); ++body) {
    if (scene.bodies[static_cast<std::size_t>(body)].is_static) continue;
    for (int dof = 0; dof < 6; ++dof) {
      rows(moved(state, body, dof, kStep), plus);
      rows(moved(state, body, dof, -kStep), minus);
      ASSERT_EQ(plus.size(), at.size());
      ASSERT_EQ(minus.size(), at.size());
      for (std::size_t i = 0; i < at.size(); ++i) {
        const Block& block = at.all()[i];
        ASSERT_EQ(plus.all()[i].id, block.id);
        for (int row = 0; row < block.rows; ++row) {
          const double slope = (plus.all()[i].phi[row] - minus.all()[i].phi[row]) / (2.0 * kStep);
          double J = 0.0;
          if (block.a == body) J = gradient(block, row, true)[dof];
          if (block.b == body) J = gradient(block, row, false)[dof];
          EXPECT_NEAR(J, slope, kTolerance) << "body " << body << " dof " << dof << " row " << row;
        }
      }
    }
  }
}

/// K against central differences of J^T lambda at constant lambda.
inline void expect_stiffness(const Scene& scene, const State& state, const Rows& rows,
                             Random& random) {
  Blocks at;
  rows(state, at);
  ASSERT_GT(at.size(), 0U);
  for (Block& block : at.all()) {
    for (int row = 0; row < block.rows; ++row) block.lambda[row] = uniform(random, 0.5, 2.0);
  }
  StiffnessMatrix stiffness;
  stiffness.clear(scene.bodies.size());
  for (const Block& block : at.all()) {
    if (block.is_contact()) {
      contact_stiffness(block, ContactTerms::kExact, stiffness);
    } else {
      with_joint_rows(block.kind, [&](auto joint) { joint.stiffness(block, stiffness); });
    }
  }
  const auto with_lambda = [&](const State& there, Blocks& blocks) {
    rows(there, blocks);
    ASSERT_EQ(blocks.size(), at.size());
    for (std::size_t i = 0; i < at.size(); ++i) {
      ASSERT_EQ(blocks.all()[i].id, at.all()[i].id);
      std::copy(at.all()[i].lambda, at.all()[i].lambda + kMaxRows, blocks.all()[i].lambda);
    }
  };
  const int bodies = static_cast<int>(scene.bodies.size());
  Blocks plus;
  Blocks minus;
  for (int col = 0; col < bodies; ++col) {
    if (scene.bodies[static_cast<std::size_t>(col)].is_static) continue;
    for (int dof = 0; dof < 6; ++dof) {
      with_lambda(moved(state, col, dof, kStep), plus);
      with_lambda(moved(state, col, dof, -kStep), minus);
      for (int row = 0; row < bodies; ++row) {
        if (scene.bodies[static_cast<std::size_t>(row)].is_static) continue;
        const Vec6 slope = (force_on(plus, row) - force_on(minus, row)) / (2.0 * kStep);
        const Vec6 K = stiffness.block(row, col).col(dof);
        for (int j = 0; j < 6; ++j) {
          EXPECT_NEAR(K[j], slope[j], kTolerance)
              << "K(" << row << "," << col << ") " << j << "," << dof;
        }
      }
    }
  }
}

}  // namespace substep::test
