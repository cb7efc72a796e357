// Chains of soft joints in space, with unequal moments, against the classical Runge-Kutta method.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/math/across.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/placed.hpp"
#include "tests/support/run.hpp"
#include "tests/unit/support.hpp"

namespace substep::test {
namespace {

/// Joins the last two bodies, or the last one to the world, where they meet: closed at the start.
Joint soft_joint(Random& random, const Scene& scene, std::size_t kind, int a, int b,
                 const Vec3& at) {
  const auto local = [&](int body, const Vec3& v) -> Vec3 {
    return body == kWorld ? v : scene.bodies[index(body)].orientation.conjugate() * v;
  };
  const auto anchor = [&](int body) -> Vec3 {
    return body == kWorld ? at : local(body, at - scene.bodies[index(body)].position);
  };
  const Vec3 axis = random_vector(random).normalized();
  Vec3 side;
  Vec3 third;
  across(axis, side, third);
  Joint joint;
  if (kind == 1) {
    HingeJoint hinge;
    hinge.axis_a = local(a, axis);
    hinge.axis_b = local(b, axis);
    hinge.angular_compliance = uniform(random, 0.002, 0.01);
    joint = hinge;
  } else if (kind == 2 || kind == 3) {
    const auto fix = [&](auto oriented) {
      oriented.axis_a = local(a, axis);
      oriented.axis_b = local(b, axis);
      oriented.across_a = local(a, side);
      oriented.across_b = local(b, side);
      oriented.angular_compliance = uniform(random, 0.002, 0.01);
      joint = oriented;
    };
    kind == 2 ? fix(PrismaticJoint{}) : fix(WeldJoint{});
  } else if (kind == 4) {
    joint = DistanceJoint{};
  } else if (kind == 5) {
    UniversalJoint cross;
    cross.axis_a = local(a, axis);
    cross.axis_b = local(b, side);
    cross.angular_compliance = uniform(random, 0.002, 0.01);
    joint = cross;
  } else if (kind == 6) {
    CylindricalJoint cylinder;
    cylinder.axis_a = local(a, axis);
    cylinder.axis_b = local(b, axis);
    cylinder.angular_compliance = uniform(random, 0.002, 0.01);
    joint = cylinder;
  }
  base(joint).name = "joint " + std::to_string(a);
  base(joint).a = a;
  base(joint).b = b;
  base(joint).anchor_a = anchor(a);
  base(joint).anchor_b = anchor(b);
  if (auto* spring = std::get_if<DistanceJoint>(&joint)) {
    spring->length = 0.4;
    spring->anchor_b += local(b, 0.4 * axis);
  }
  base(joint).compliance = uniform(random, 2e-4, 1e-3);
  return joint;
}

/// Three boxes that hang from the world by three kinds of joints in a row: ball, hinge, slide,
/// weld, spring, universal, cylindrical.
Scene soft_chain(Random& random) {
  Scene scene;
  scene.frame = 1.0 / 60.0;
  scene.effects = {.gravity = true, .gyroscopic = true, .joints = true};
  scene.gravity = {0.0, -kGravity, 0.0};
  const auto first = static_cast<std::size_t>(uniform(random, 0.0, 7.0));
  Vec3 end = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    const Vec3 half{uniform(random, 0.2, 0.4), uniform(random, 0.1, 0.2),
                    uniform(random, 0.03, 0.06)};
    Body body = moving(Box{half}, uniform(random, 0.5, 2.0));
    body.orientation = random_rotation(random);
    const Vec3 arm = body.orientation * Vec3(half.x(), 0.0, 0.0);
    body.position = end + arm;
    scene.bodies.push_back(body);
    scene.joints.push_back(soft_joint(random, scene, (first + index(i)) % 7, i, i - 1, end));
    end += 2.0 * arm;
  }
  scene.criteria.track = 2;
  return scene;
}

void set_angular_compliance(Joint& joint, double compliance) {
  std::visit(
      [&](auto& of) {
        if constexpr (requires { of.angular_compliance; }) of.angular_compliance = compliance;
      },
      joint);
}

/// Two boxes in free flight with one joint, which starts closed and, if it is exact, at speeds that
/// keep it closed.
Scene free_pair(Random& random, std::size_t kind, bool soft) {
  Scene scene = soft_chain(random);
  scene.effects.gravity = false;
  scene.bodies.pop_back();
  scene.joints.clear();
  const Body& a = scene.bodies[0];
  const Vec3 end = a.position + a.orientation * Vec3(std::get<Box>(a.shape).half_extents.x(), 0, 0);
  scene.joints.push_back(soft_joint(random, scene, kind, 1, 0, end));
  Joint& joint = scene.joints[0];
  const Vec3 spin = 5.0 * random_vector(random);
  Vec3 relative = 2.0 * random_vector(random);  // bends a soft joint
  if (!soft) {
    base(joint).compliance = 0.0;
    set_angular_compliance(joint, 0.0);
    if (const auto* hinge = std::get_if<HingeJoint>(&joint)) {
      relative = 1.5 * (scene.bodies[1].orientation * hinge->axis_a);
    } else if (!std::holds_alternative<BallJoint>(joint)) {
      relative.setZero();
    }
  }
  for (Body& body : scene.bodies) {
    body.angular_velocity = spin;
    body.velocity = spin.cross(body.position);
  }
  scene.bodies[1].angular_velocity += relative;
  scene.bodies[1].velocity += relative.cross(scene.bodies[1].position - end);
  scene.criteria.track = 1;
  return scene;
}

/// Changes of the linear and the angular momentum in half a second, relative to their size.
std::pair<double, double> changes_of_momenta(const Scene& scene, Settings settings, int n) {
  settings.mode = Mode::kConst;
  settings.n = n;
  const auto momenta = [&](const State& state, const std::vector<Vec6>& u) {
    Vec6 sum = Vec6::Zero();
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const Body& body = scene.bodies[i];
      const Quat& q = state.q[i];
      sum.head<3>() += body.mass * u[i].head<3>();
      sum.tail<3>() += body.mass * state.x[i].cross(Vec3(u[i].head<3>())) +
                       q * body.inertia.cwiseProduct(q.conjugate() * Vec3(u[i].tail<3>()));
    }
    return sum;
  };
  const State start = initial_state(scene);
  const Vec6 before = momenta(start, start.u);
  const State end = run(scene, settings, 0.5, {}, false).end;
  const Vec6 change = momenta(end, end.u_synchronised) - before;
  return {change.head<3>().norm() / before.head<3>().norm(),
          change.tail<3>().norm() / before.tail<3>().norm()};
}

/// Positions after `seconds`: forces -phi/C along the rows, angular momentum in world axes.
std::vector<Vec3> by_runge_kutta(const Scene& scene, double seconds, int steps) {
  struct Motion {
    std::vector<Vec3> x, v, l;
    std::vector<Eigen::Vector4d> q;
  };
  const std::size_t n = scene.bodies.size();
  const Rows rows = joint_rows(scene);
  State state = initial_state(scene);
  Blocks blocks;
  const auto omega = [&](std::size_t i, const Vec3& l) -> Vec3 {
    const Quat& q = state.q[i];
    return q * Vec3((q.conjugate() * l).cwiseQuotient(scene.bodies[i].inertia));
  };
  const auto slope = [&](const Motion& at) {
    Motion out = at;
    for (std::size_t i = 0; i < n; ++i) {
      state.x[i] = at.x[i];
      state.q[i].coeffs() = at.q[i].normalized();
    }
    rows(state, blocks);
    for (Block& block : blocks.all()) {
      for (int row = 0; row < block.rows; ++row) {
        block.lambda[row] = -block.phi[row] / block.C[row];
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      const Vec6 force = force_on(blocks, static_cast<int>(i));
      const Vec3 w = omega(i, at.l[i]);
      out.x[i] = at.v[i];
      out.v[i] = force.head<3>() / scene.bodies[i].mass + scene.gravity;
      out.l[i] = force.tail<3>();
      Quat q;
      q.coeffs() = at.q[i];
      out.q[i] = 0.5 * (Quat(0.0, w.x(), w.y(), w.z()) * q).coeffs();
    }
    return out;
  };
  const auto moved_by = [&](const Motion& from, double h, const Motion& along) {
    Motion out = from;
    for (std::size_t i = 0; i < n; ++i) {
      out.x[i] += h * along.x[i];
      out.v[i] += h * along.v[i];
      out.l[i] += h * along.l[i];
      out.q[i] += h * along.q[i];
    }
    return out;
  };
  Motion at;
  for (std::size_t i = 0; i < n; ++i) {
    at.x.push_back(state.x[i]);
    at.q.push_back(state.q[i].coeffs());
    at.v.push_back(scene.bodies[i].velocity);
    const Vec3 w = scene.bodies[i].angular_velocity;
    const Quat& q = state.q[i];
    at.l.push_back(q * scene.bodies[i].inertia.cwiseProduct(q.conjugate() * w));
  }
  const double h = seconds / steps;
  for (int k = 0; k < steps; ++k) {
    const Motion k1 = slope(at);
    const Motion k2 = slope(moved_by(at, 0.5 * h, k1));
    const Motion k3 = slope(moved_by(at, 0.5 * h, k2));
    const Motion k4 = slope(moved_by(at, h, k3));
    at = moved_by(at, h / 6.0, k1);
    at = moved_by(at, h / 3.0, k2);
    at = moved_by(at, h / 3.0, k3);
    at = moved_by(at, h / 6.0, k4);
  }
  return at.x;
}

double error_of(const Scene& scene, Settings settings, int n, double seconds,
                const std::vector<Vec3>& expected) {
  settings.mode = Mode::kConst;
  settings.n = n;
  const State end = run(scene, settings, seconds, {}, false).end;
  double error = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    keep_largest(error, (end.x[i] - expected[i]).norm());
  }
  return error;
}

struct Method {
  const char* name;
  Settings settings;
  double least_order;
};
std::vector<Method> methods() {
  return {{"leapfrog", {.integrator = Integrator::kLeapfrog}, 1.9},
          {"Störmer", {.integrator = Integrator::kStormer}, 3.6},
          {"mean",
           {.solver = SolverKind::kNewton,
            .forces = Forces::kMean,
            .integrator = Integrator::kLeapfrog},
           1.9},
          {"Numerov",
           {.solver = SolverKind::kNewton,
            .forces = Forces::kNumerov,
            .integrator = Integrator::kLeapfrog},
           1.9}};
}

TEST(SoftJoints, KeepTheOrderOfTheMethodInSpace) {
  constexpr double kSeconds = 0.5;
  constexpr double kRoundingOfPath = 1e-9;  // [m]
  Random random(3);
  for (int trial = 0; trial < 8; ++trial) {
    const Scene scene = soft_chain(random);
    const std::vector<Vec3> expected = by_runge_kutta(scene, kSeconds, 4000);
    ASSERT_LT((expected[2] - by_runge_kutta(scene, kSeconds, 2000)[2]).norm(), 1e-8);
    for (const Method& method : methods()) {
      const auto error = [&](int n) {
        return error_of(scene, method.settings, n, kSeconds, expected);
      };
      // Over four doublings.
      const double coarse = error(16);
      const double fine = error(256);
      EXPECT_LT(fine, coarse / std::pow(2.0, 4.0 * method.least_order) + kRoundingOfPath)
          << method.name << ", chain " << trial << ": " << coarse << " to " << fine;
    }
  }
}

// A given force of 256 sub-steps has a softness of 1e12 times the mobility.
TEST(SoftJoints, KeepTheLinearMomentumOfAPair) {
  std::vector<Method> all = methods();
  all.push_back({"default", substep::Settings{}, 0.0});
  all.push_back({"paper", {}, 0.0});
  for (const bool soft : {false, true}) {
    for (std::size_t kind = 0; kind < 7; ++kind) {
      Random random(4 + kind);
      const Scene scene = free_pair(random, kind, soft);
      for (const Method& method : all) {
        for (const int n : {1, 16, 256}) {
          EXPECT_LT(changes_of_momenta(scene, method.settings, n).first, 1e-13)
              << scene.joints[0].index() << (soft ? " soft, " : " exact, ") << method.name << ' '
              << n;
        }
      }
    }
  }
}

// With the default settings, exact joints keep the angular momentum to rounding too where a
// sub-step does not turn bodies too far: impulses act at points that coincide. Those of a soft
// joint act a gap apart, and bodies of Störmer's method move on different parabolas within a
// sub-step: to truncation.
TEST(SoftJoints, KeepTheAngularMomentumOfAPair) {
  for (std::size_t kind = 0; kind < 7; ++kind) {
    Random random(4 + kind);
    const Scene exact = free_pair(random, kind, false);
    for (const int n : {16, 64}) {
      EXPECT_LT(changes_of_momenta(exact, substep::Settings{}, n).second, 1e-13)
          << kind << ' ' << n;
    }
    const Scene soft = free_pair(random, kind, true);
    const Settings stormer{.integrator = Integrator::kStormer};
    EXPECT_LT(changes_of_momenta(soft, stormer, 4).second, 1e-3) << kind;
    EXPECT_LT(changes_of_momenta(soft, stormer, 256).second, 1e-10) << kind;
    EXPECT_LT(changes_of_momenta(soft, substep::Settings{}, 4).second, 1e-4) << kind;
    EXPECT_LT(changes_of_momenta(soft, substep::Settings{}, 256).second, 1e-8) << kind;
  }
}

// Their solve adds 1e-12 of an impulse. If it resisted the velocity, each sub-step would damp by as
// much: by 3e-8 of the energy here.
TEST(SoftJoints, GivenForcesDoNotDamp) {
  for (std::size_t kind = 0; kind < 7; ++kind) {
    Random random(4 + kind);
    Scene scene = free_pair(random, kind, true);
    base(scene.joints[0]).compliance = 0.01;  // a spring, whose energy counts
    set_angular_compliance(scene.joints[0], 0.2);
    const Settings settings{.mode = Mode::kConst, .n = 1024, .integrator = Integrator::kStormer};
    const Outcome of = run(scene, settings, 0.5, {}, false);
    EXPECT_NEAR(of.energy_end, of.energy_start, 2e-10 * of.energy_start) << kind;
  }
}

// A gram and a millimetre, two tonnes, inches.
TEST(SoftJoints, DoNotDependOnUnits) {
  Random random(5);
  for (int trial = 0; trial < 2; ++trial) {
    const Scene scene = soft_chain(random);
    for (const Method& method : methods()) {
      Settings settings = method.settings;
      settings.mode = Mode::kConst;
      settings.n = 16;
      const State expected = run(scene, settings, 0.5, {}, false).end;
      for (const auto& [mass, length] :
           {std::pair{1e3, 1e3}, std::pair{2e3, 1.0}, std::pair{2.2, 39.37}}) {
        Scene scaled = in_units(scene, mass, length);
        scaled.contact.margin = scene.contact.margin;  // of no contact; it has a largest value
        const State end = run(scaled, settings, 0.5, {}, false).end;
        EXPECT_LT((end.x[2] / length - expected.x[2]).norm(), 1e-9)
            << method.name << ": " << mass << ", " << length;
      }
    }
  }
}

// Rows of a ball joint are along the world's axes. Half of the joints are stiff: the blend into
// implicit Euler depends on the mobility of their rows.
TEST(SoftJoints, HaveNoPreferredDirection) {
  const Quat R(Eigen::AngleAxisd(1.3, Vec3(0.3, -0.5, 0.8).normalized()));
  Random random(6);
  for (int trial = 0; trial < 4; ++trial) {
    Scene scene = soft_chain(random);
    base(scene.joints[1]).compliance *= 1e-2;
    const Scene turned = transformed(scene, R, Vec3::Zero());
    std::vector<Method> all = methods();
    all.push_back({"default", substep::Settings{}, 0.0});
    for (const Method& method : all) {
      Settings settings = method.settings;
      const auto rates = [&](const Scene& of, State& end) {
        std::vector<double> r;
        end = run(
                  of, settings, 0.5,
                  [&](const Simulator&, const FrameReport& report) {
                    r.push_back(report.r_stiffness);
                  },
                  false)
                  .end;
        return r;
      };
      State here;
      State there;
      const std::vector<double> expected = rates(scene, here);
      const std::vector<double> found = rates(turned, there);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i], expected[i], 1e-9 * expected[i]) << method.name << ", frame " << i;
      }
      EXPECT_LT((there.x[2] - R * here.x[2]).norm(), 1e-9) << method.name << ", chain " << trial;
    }
  }
}

}  // namespace
}  // namespace substep::test
