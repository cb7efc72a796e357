#include "core/constraints/contact.hpp"
#include "core/constraints/joint_rows.hpp"
#include "core/constraints/turning_stiffness.hpp"
#include "tests/unit/support.hpp"

namespace substep::test {
namespace {

// Blocks of a joint are angular, those of an exact contact are full; one pair has both.
TEST(StiffnessMatrix, SumsBlocksOfBothKindsBeforeItTakesNorms) {
  Random random(10);
  const std::vector<Mat3> R{random_rotation(random).toRotationMatrix(),
                            random_rotation(random).toRotationMatrix()};
  for (int before = 0; before < 5; ++before) {  // angular blocks before the first whole one
    StiffnessMatrix K;
    K.clear(2);
    Eigen::Matrix<double, 12, 12> dense = Eigen::Matrix<double, 12, 12>::Zero();
    for (int n = 0; n < 8; ++n) {
      const int row = n / 2 % 2;
      const int col = n % 2;
      if (n < before || n % 3 == 0) {
        const Mat3 block = random_rotation(random).toRotationMatrix();
        K.add_angular(row, col, block);
        dense.block<3, 3>(6 * row + 3, 6 * col + 3) += block;
      } else {
        const Mat6 block = Mat6::Random();
        K.add(row, col, block);
        dense.block<6, 6>(6 * row, 6 * col) += block;
      }
    }
    // With unit masses and moments, each column has its plain norm.
    std::vector<Body> bodies(2);
    for (Body& body : bodies) {
      body.mass = 1.0;
      body.inertia = Vec3::Ones();
    }
    std::vector<Vec6> k(2);
    K.column_norms(std::vector{0, 1}, bodies, R, before % 2 == 0, k);
    for (int body = 0; body < 2; ++body) {
      for (int other = 0; other < 2; ++other) {
        EXPECT_LT((K.block(other, body) - dense.block<6, 6>(6 * other, 6 * body)).norm(), 1e-15);
      }
      for (int part = 0; part < 2; ++part) {
        const auto columns =
            dense.middleCols<3>(6 * body + 3 * part) * R[static_cast<std::size_t>(body)];
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(k[static_cast<std::size_t>(body)][3 * part + c], columns.col(c).norm(),
                      1e-14);
        }
      }
    }
  }
}

// Columns of M^-1/2 K M^-1/2, in any unit of length.
TEST(StiffnessMatrix, NormsDoNotDependOnTheUnitOfLength) {
  Random random(12);
  const std::vector<Mat3> R{random_rotation(random).toRotationMatrix(),
                            random_rotation(random).toRotationMatrix()};
  std::vector<Body> bodies(2);
  Mat6 blocks[2][2];
  for (int i = 0; i < 2; ++i) {
    bodies[index(i)].mass = uniform(random, 0.1, 10.0);
    bodies[index(i)].inertia = random_vector(random).cwiseAbs() + Vec3::Constant(0.1);
    for (int j = 0; j < 2; ++j) blocks[i][j] = Mat6::Random();
  }
  const auto norms = [&](double length) {  // of one metre
    StiffnessMatrix K;
    K.clear(2);
    Vec6 unit;
    unit << Vec3::Ones(), Vec3::Constant(length);
    std::vector<Body> scaled = bodies;
    for (Body& body : scaled) body.inertia *= length * length;
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) K.add(i, j, unit.asDiagonal() * blocks[i][j] * unit.asDiagonal());
    }
    std::vector<Vec6> k(2);
    K.column_norms(std::vector{0, 1}, scaled, R, true, k);
    for (int body = 0; body < 2; ++body) k[index(body)].tail<3>() /= length * length;
    return k;
  };
  for (int body = 0; body < 2; ++body) {
    const Vec6 in_metres = norms(1.0)[index(body)];
    EXPECT_LT((norms(1e3)[index(body)] - in_metres).norm(), 1e-12 * in_metres.norm());
    // The force by a rotation about one axis, of a body of little mass: it determines the norm.
    bodies[index(body)].mass *= 1e-12;
    const Vec3 force = blocks[body][body].topRightCorner<3, 3>() * R[index(body)].col(0);
    const double expected =
        std::sqrt(bodies[index(body)].inertia[0] / bodies[index(body)].mass) * force.norm();
    EXPECT_NEAR(norms(1.0)[index(body)][3], expected, 1e-5 * expected);
    bodies[index(body)].mass *= 1e12;
  }
}

// The part of K that Newton uses.
TEST(TurningStiffness, IsTheDiagonalOfTheFullMatrix) {
  Random random(11);
  for (int trial = 0; trial < 90; ++trial) {
    Block block;
    const std::size_t kind = index(trial) % (kJointKinds + 1);
    block.kind = kind == kJointKinds ? BlockKind::kContact : static_cast<BlockKind>(kind);
    block.a = trial % 5 == 3 ? -1 : 0;
    block.b = trial % 5 == 4 ? -1 : 1;
    for (Vec3* v : {&block.n, &block.rho, &block.r_a, &block.r_b, &block.arm_a, &block.axis,
                    &block.v1, &block.v2}) {
      *v = random_vector(random);
    }
    const Vec3 bent = random_vector(random);
    block.H = bent * bent.transpose();
    for (double& force : block.lambda) force = random_vector(random).x();
    StiffnessMatrix whole;
    whole.clear(2);
    if (block.is_contact()) {
      contact_stiffness(block, ContactTerms::kNormal, whole);
    } else {
      with_joint_rows(block.kind, [&](auto joint) { joint.stiffness(block, whole); });
    }
    std::vector<Mat3> turning(2, Mat3::Zero());
    add_turning_stiffness(block, turning);
    for (int body = 0; body < 2; ++body) {
      EXPECT_LT((turning[index(body)] - whole.angular(body)).norm(), 1e-14) << trial;
    }
    EXPECT_GT(turning[0].norm() + turning[1].norm(), 0.0) << trial;
  }
}

}  // namespace
}  // namespace substep::test
