// One run of a scene by ODE, natively: its direct solver (Lemke's method on the dense matrix of all
// constraints) or its Gauss-Seidel one, in double precision.
//
// Settings: substeps, solver (direct or quick), iterations (of quick), erp (the share of an error
// corrected in a step), cfm (softness of constraints, per step).

#include <ode/ode.h>

#include <cmath>
#include <cstdarg>
#include <string>

#include "tests/bench/peers/peer_run.hpp"

namespace {

using namespace substep;

struct OdeSettings {
  int substeps = 1;
  bool direct = true;
  int iterations = 20;
  double erp = 0.2;
  double cfm = 1e-10;

  explicit OdeSettings(const bench::PeerArguments& arguments) {
    for (const auto& [name, value] : arguments.settings) {
      if (name == "substeps") {
        substeps = std::stoi(value);
      } else if (name == "solver" && (value == "direct" || value == "quick")) {
        direct = value == "direct";
      } else if (name == "iterations") {
        iterations = std::stoi(value);
      } else if (name == "erp") {
        erp = std::stod(value);
      } else if (name == "cfm") {
        cfm = std::stod(value);
      } else {
        bench::refuse("ODE has no setting " + name + "=" + value);
      }
    }
  }
};

void place(dGeomID geom, const Body& body) {
  const Quat& q = body.orientation;
  const dQuaternion turned{q.w(), q.x(), q.y(), q.z()};
  dGeomSetPosition(geom, body.position.x(), body.position.y(), body.position.z());
  dGeomSetQuaternion(geom, turned);
}

class World {
 public:
  explicit World(const bench::PeerArguments& arguments)
      : scene_(arguments.scene),
        settings_(arguments),
        world_(dWorldCreate()),
        space_(dSimpleSpaceCreate(nullptr)),
        contacts_(dJointGroupCreate(0)) {
    const Vec3& g = scene_->gravity;
    dWorldSetGravity(world_, g.x(), g.y(), g.z());
    dWorldSetERP(world_, settings_.erp);
    dWorldSetCFM(world_, settings_.cfm);
    dWorldSetAutoDisableFlag(world_, 0);
    dWorldSetDamping(world_, 0.0, 0.0);
    dWorldSetQuickStepNumIterations(world_, settings_.iterations);
    for (const Body& body : scene_->bodies) add(body);
    for (const Joint& joint : scene_->joints) {
      std::visit([this](const auto& j) { add(j); }, joint);
    }
  }

  World(const World&) = delete;
  World& operator=(const World&) = delete;

  ~World() {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }

  [[nodiscard]] int steps() const { return settings_.substeps; }

  void step() {
    const double dt = scene_->frame / settings_.substeps;
    if (scene_->effects.contact) dSpaceCollide(space_, this, &World::near);
    if (settings_.direct) {
      dWorldStep(world_, dt);
    } else {
      dWorldQuickStep(world_, dt);
    }
    dJointGroupEmpty(contacts_);
  }

  void poses(bench::PeerFrame& frame) const {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (!bodies_[i]) {
        frame.x.push_back(scene_->bodies[i].position);
        frame.q.push_back(scene_->bodies[i].orientation);
        continue;
      }
      const dReal* x = dBodyGetPosition(bodies_[i]);
      const dReal* q = dBodyGetQuaternion(bodies_[i]);
      frame.x.emplace_back(x[0], x[1], x[2]);
      frame.q.emplace_back(q[0], q[1], q[2], q[3]);
    }
  }

  /// Semi-implicit Euler: a velocity is that of the middle of the step that ends at the pose.
  [[nodiscard]] static double lag() { return 0.5; }

  void velocities(bench::PeerFrame& frame) const {
    for (const dBodyID body : bodies_) {
      const dReal none[3] = {};
      const dReal* v = body ? dBodyGetLinearVel(body) : none;
      const dReal* w = body ? dBodyGetAngularVel(body) : none;
      frame.v.emplace_back(v[0], v[1], v[2]);
      frame.w.emplace_back(w[0], w[1], w[2]);
    }
  }

 private:
  void add(const Body& body) {
    const dBodyID id = body.is_static ? nullptr : create(body);
    bodies_.push_back(id);
    const dGeomID geom = std::visit([&](const auto& s) { return create(s, body); }, body.shape);
    dGeomSetData(geom, const_cast<Body*>(&body));
    if (id) {
      dGeomSetBody(geom, id);
    } else if (!std::holds_alternative<Plane>(body.shape)) {
      place(geom, body);
    }
  }

  dBodyID create(const Body& body) {
    const dBodyID id = dBodyCreate(world_);
    dMass mass;
    dMassSetParameters(&mass, body.mass, 0.0, 0.0, 0.0, body.inertia.x(), body.inertia.y(),
                       body.inertia.z(), 0.0, 0.0, 0.0);
    dBodySetMass(id, &mass);
    const Quat& q = body.orientation;
    const dQuaternion turned{q.w(), q.x(), q.y(), q.z()};
    dBodySetPosition(id, body.position.x(), body.position.y(), body.position.z());
    dBodySetQuaternion(id, turned);
    dBodySetLinearVel(id, body.velocity.x(), body.velocity.y(), body.velocity.z());
    const Vec3& w = body.angular_velocity;
    dBodySetAngularVel(id, w.x(), w.y(), w.z());
    dBodySetGyroscopicMode(id, scene_->effects.gyroscopic ? 1 : 0);
    return id;
  }

  dGeomID create(const Sphere& sphere, const Body&) { return dCreateSphere(space_, sphere.radius); }
  dGeomID create(const Box& box, const Body&) {
    const Vec3 size = 2.0 * box.half_extents;
    return dCreateBox(space_, size.x(), size.y(), size.z());
  }
  dGeomID create(const Plane&, const Body& body) {
    const Vec3 n = body.orientation * Vec3::UnitY();
    return dCreatePlane(space_, n.x(), n.y(), n.z(), n.dot(body.position));
  }

  [[nodiscard]] dBodyID body(int i) const {
    return i < 0 ? nullptr : bodies_[static_cast<std::size_t>(i)];
  }

  [[nodiscard]] const Body& described(int i) const {
    return scene_->bodies[static_cast<std::size_t>(i)];
  }

  [[nodiscard]] Vec3 anchor_W(const JointBase& joint) const {
    const Body& a = described(joint.a);
    return a.position + a.orientation * joint.anchor_a;
  }

  void add(const BallJoint& joint) {
    const dJointID id = dJointCreateBall(world_, nullptr);
    dJointAttach(id, body(joint.a), body(joint.b));
    const Vec3 at = anchor_W(joint);
    dJointSetBallAnchor(id, at.x(), at.y(), at.z());
  }

  void add(const HingeJoint& joint) {
    const dJointID id = dJointCreateHinge(world_, nullptr);
    dJointAttach(id, body(joint.a), body(joint.b));
    const Vec3 at = anchor_W(joint);
    const Vec3 axis = described(joint.a).orientation * joint.axis_a;
    dJointSetHingeAnchor(id, at.x(), at.y(), at.z());
    dJointSetHingeAxis(id, axis.x(), axis.y(), axis.z());
  }

  /// ODE's slider has no anchor: it keeps the relative orientation, and the distance across the
  /// axis, that the bodies have now.
  void add(const PrismaticJoint& joint) {
    const dJointID id = dJointCreateSlider(world_, nullptr);
    dJointAttach(id, body(joint.a), body(joint.b));
    const Vec3 axis = described(joint.a).orientation * joint.axis_a;
    dJointSetSliderAxis(id, axis.x(), axis.y(), axis.z());
  }

  /// A type that is not written here: ode.mjs does not list it, and its scenes are not run.
  template <class Other>
  void add(const Other& joint) {
    bench::refuse(std::string("ODE has no ") + Other::kType + " joint (" + joint.name + ")");
  }

  static void near(void* data, dGeomID geom_a, dGeomID geom_b) {
    static_cast<World*>(data)->touch(geom_a, geom_b);
  }

  void touch(dGeomID geom_a, dGeomID geom_b) {
    const dBodyID a = dGeomGetBody(geom_a);
    const dBodyID b = dGeomGetBody(geom_b);
    if (!a && !b) return;
    const auto& one = *static_cast<const Body*>(dGeomGetData(geom_a));
    const auto& two = *static_cast<const Body*>(dGeomGetData(geom_b));
    if (one.collision_group >= 0 && one.collision_group == two.collision_group) return;
    constexpr int kMost = 8;  // points of a pair
    dContact points[kMost] = {};
    const int count = dCollide(geom_a, geom_b, kMost, &points[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      points[i].surface.mode = dContactApprox1;
      points[i].surface.mu = std::sqrt(one.friction * two.friction);
      dJointAttach(dJointCreateContact(world_, contacts_, &points[i]), a, b);
    }
  }

  std::shared_ptr<const Scene> scene_;
  OdeSettings settings_;
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID contacts_;
  std::vector<dBodyID> bodies_;  // null where static
};

}  // namespace

int main(int argc, char** argv) {
  const bench::PeerArguments arguments = bench::read_peer_arguments(argc, argv);
  dInitODE();
  dSetMessageHandler([](int, const char*, va_list) {});  // of its LCP, a line a failed pivot
  {
    World thrown_away(arguments);
    bench::simulate(thrown_away, arguments.warm_up);
  }
  World world(arguments);
  bench::print(bench::simulate(world, arguments.frames));
  return 0;
}
