// Jolt: Gauss-Seidel on impulses with warm starts, then position corrections; single precision.

import initJolt from "jolt-physics";
import { between, rotate } from "./rotation.mjs";
import { foreignJoint } from "./scene.mjs";

export const title = "Jolt";

const iterate = (velocity, position, ...counts) =>
  counts.map((steps) => ({ steps, velocity, position }));

export const ladder = {
  swinging_box: [...iterate(10, 2, 8, 16, 32)],
  bridge: [...iterate(10, 2, 4, 8, 16, 32)],
  stack: [...iterate(10, 2, 8, 32), ...iterate(200, 50, 8)],
  energy: [...iterate(10, 2, 4, 8, 16, 32, 64), ...iterate(40, 10, 8)],
  in_space: [...iterate(10, 2, 4, 8, 16, 32)],
};

export const cannotState = (scene) => foreignJoint(scene, ["ball", "hinge", "prismatic"]);

let Jolt;

/** Jolt's bindings copy their arguments: the object is created for a call and destroyed after it. */
function withTemporary(make, use) {
  const object = make();
  const result = use(object);
  Jolt.destroy(object);
  return result;
}

const vector = (v, use) => withTemporary(() => new Jolt.Vec3(...v), use);
const position = (v, use) => withTemporary(() => new Jolt.RVec3(...v), use);

/** Layer 0 is static, 1 moves, 2 + g is collision group g, which does not collide with itself. */
function layers(scene) {
  const groups = scene.bodies.map(({ group }) => group ?? -1);
  const count = 3 + Math.max(...groups);
  const of = (body) => (body.fixed ? 0 : 2 + (body.group ?? -1));
  const filter = new Jolt.ObjectLayerPairFilterTable(count);
  const broad = new Jolt.BroadPhaseLayerInterfaceTable(count, 1);
  const all = new Jolt.BroadPhaseLayer(0);
  for (let a = 0; a < count; ++a) {
    broad.MapObjectToBroadPhaseLayer(a, all);
    for (let b = a; b < count; ++b) {
      if (scene.collides && b > 0 && (a !== b || a === 1)) filter.EnableCollision(a, b);
    }
  }
  const settings = new Jolt.JoltSettings();
  settings.mObjectLayerPairFilter = filter;
  settings.mBroadPhaseLayerInterface = broad;
  settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(
    broad,
    1,
    filter,
    count,
  );
  return { settings, of };
}

function shape({ shape }) {
  if (shape.type === "sphere") return new Jolt.SphereShape(shape.radius);
  if (shape.type === "box") {
    return vector(shape.size.map((edge) => edge / 2), (half) => new Jolt.BoxShape(half, 0));
  }
  const up = new Jolt.Vec3(0, 1, 0);
  return new Jolt.PlaneShape(new Jolt.Plane(up, 0));
}

function massProperties(body) {
  const properties = new Jolt.MassProperties();
  properties.mMass = body.mass;
  vector(body.inertia, (diagonal) => {
    properties.mInertia = Jolt.Mat44.prototype.sScaleVec3(diagonal);
  });
  return properties;
}

function addBody(bodies, body, layer, gyroscopic) {
  const [w, x, y, z] = body.q;
  const settings = new Jolt.BodyCreationSettings(
    shape(body),
    new Jolt.RVec3(...body.x),
    new Jolt.Quat(x, y, z, w),
    body.fixed ? Jolt.EMotionType_Static : Jolt.EMotionType_Dynamic,
    layer,
  );
  settings.mFriction = body.friction;
  settings.mLinearDamping = 0;
  settings.mAngularDamping = 0;
  settings.mAllowSleeping = false;
  settings.mMaxAngularVelocity = 1e4;
  settings.mApplyGyroscopicForce = gyroscopic;
  if (!body.fixed) {
    settings.mOverrideMassProperties = Jolt.EOverrideMassProperties_MassAndInertiaProvided;
    settings.mMassPropertiesOverride = massProperties(body);
    vector(body.v, (v) => (settings.mLinearVelocity = v));
    vector(body.w, (v) => (settings.mAngularVelocity = v));
  }
  const rigid = bodies.CreateBody(settings);
  bodies.AddBody(rigid.GetID(), body.fixed ? Jolt.EActivation_DontActivate : Jolt.EActivation_Activate);
  Jolt.destroy(settings);
  return rigid;
}

function addJoint(system, joint, at) {
  const settings = {
    ball: () => new Jolt.PointConstraintSettings(),
    hinge: () => new Jolt.HingeConstraintSettings(),
    prismatic: () => new Jolt.SliderConstraintSettings(),
  }[joint.type]();
  settings.mSpace = Jolt.EConstraintSpace_LocalToBodyCOM;
  position(joint.anchorA, (x) => (settings.mPoint1 = x));
  position(joint.anchorB, (x) => (settings.mPoint2 = x));
  if (joint.type === "hinge") {
    const normal = (axis) => rotate(between([0, 0, 1], axis), [1, 0, 0]);
    vector(joint.axisA, (v) => (settings.mHingeAxis1 = v));
    vector(joint.axisB, (v) => (settings.mHingeAxis2 = v));
    vector(normal(joint.axisA), (v) => (settings.mNormalAxis1 = v));
    vector(normal(joint.axisB), (v) => (settings.mNormalAxis2 = v));
  } else if (joint.type === "prismatic") {
    settings.mAutoDetectPoint = false;
    vector(joint.axisA, (v) => (settings.mSliderAxis1 = v));
    vector(joint.axisB, (v) => (settings.mSliderAxis2 = v));
    vector(joint.acrossA, (v) => (settings.mNormalAxis1 = v));
    vector(joint.acrossB, (v) => (settings.mNormalAxis2 = v));
  }
  system.AddConstraint(settings.Create(at(joint.a), at(joint.b)));
  Jolt.destroy(settings);
}

function tune(system, scene, setting) {
  vector(scene.gravity, (g) => system.SetGravity(g));
  const physics = system.GetPhysicsSettings();
  physics.mNumVelocitySteps = setting.velocity;
  physics.mNumPositionSteps = setting.position;
  physics.mPenetrationSlop = 0; // [m]
  physics.mAllowSleeping = false;
  system.SetPhysicsSettings(physics);
}

export async function build(scene, setting) {
  Jolt ??= await initJolt();
  const { settings, of } = layers(scene);
  const jolt = new Jolt.JoltInterface(settings);
  Jolt.destroy(settings);
  const system = jolt.GetPhysicsSystem();
  tune(system, scene, setting);
  const bodies = system.GetBodyInterface();
  const rigid = scene.bodies.map((body) => addBody(bodies, body, of(body), scene.gyroscopic));
  const world = Jolt.Body.prototype.sFixedToWorld;
  for (const joint of scene.joints) addJoint(system, joint, (i) => (i < 0 ? world : rigid[i]));
  return {
    steps: setting.steps,
    step: () => jolt.Step(scene.frame / setting.steps, 1),
    poses() {
      return rigid.flatMap((body) => {
        const x = body.GetPosition();
        const values = [x.GetX(), x.GetY(), x.GetZ()];
        const q = body.GetRotation();
        return [...values, q.GetW(), q.GetX(), q.GetY(), q.GetZ()];
      });
    },
    lag: 0.5, // semi-implicit Euler: the velocity of the middle of the last step
    velocities() {
      return rigid.flatMap((body) => {
        const v = body.GetLinearVelocity();
        const values = [v.GetX(), v.GetY(), v.GetZ()];
        const w = body.GetAngularVelocity();
        return [...values, w.GetX(), w.GetY(), w.GetZ()];
      });
    },
    free: () => Jolt.destroy(jolt),
  };
}
