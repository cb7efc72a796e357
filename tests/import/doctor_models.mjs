// Models in MJCF whose largest steps are known by trial: `substep doctor` foretells them.

const model = (name, option, worldbody, rest = "") => ({
  name,
  text: `<mujoco model="${name}"><compiler angle="radian"/><option ${option}>
  <flag contact="disable"/></option><worldbody>${worldbody}</worldbody>${rest}</mujoco>`,
});
const sphere = (mass, radius = 0.02, at = "0 0 0") =>
  `<geom type="sphere" size="${radius}" mass="${mass}" pos="${at}"/>`;
const rod = (length, mass, radius = 0.02) =>
  `<geom type="box" size="${length / 2} ${radius} ${radius}" mass="${mass}" pos="${length / 2} 0 0"/>`;

/** Bodies one in the other: `link(i)` is the content of the i-th, each at `step` from the one before. */
function nested(count, step, link) {
  let text = "";
  for (let i = count - 1; i >= 0; --i) {
    text = `<body name="link${i + 1}" pos="${i === 0 ? "0 0 0" : step}">${link(i)}${text}</body>`;
  }
  return text;
}

/** A chain that hangs in rest: spheres on ball joints at their upper ends. */
const hanging = (name, count, length, mass, load) => model(name, "", nested(count, `0 0 ${-length}`,
  (i) => `<joint type="ball"/>${sphere(i === count - 1 ? load : mass, 0.02, `0 0 ${-length}`)}`));

/**
 * Rods on ball joints, turned out of the vertical about two axes; each is free to spin about itself.
 * @param angle of the first one [degrees]
 */
const rods = (name, count, angle, load = 1) => model(name, "", nested(count, "0 0 -0.3", (i) =>
  `<joint type="ball"/><geom type="box" size="0.02 0.02 0.15" mass="${i === count - 1 ? load : 1}"
    pos="0 0 -0.15"/>`).replace('pos="0 0 0"',
  `pos="0 0 0" euler="${angle * Math.PI / 180} ${angle * Math.PI / 360} 0"`));

const position = (joint, kp, kv = 0) =>
  `<position joint="${joint}" kp="${kp}"${kv > 0 ? ` kv="${kv}"` : ""}/>`;
const actuators = (text) => `<actuator>${text}</actuator>`;

/** They rest or move slowly, so that the step of their linearisation is the limit. */
export const models = [
  hanging("chain of ten", 10, 0.1, 0.1, 0.1),
  hanging("load of 50 kg on a chain of ten", 10, 0.1, 0.1, 50),
  rods("five rods on ball joints", 5, 0),
  rods("eight rods on ball joints, displaced", 8, 5),
  rods("ten rods on ball joints with a load of 20 kg", 10, 0, 20),
  model("swing of a heavy load", "", nested(2, "0 0 -0.5", (i) => `<joint type="hinge" axis="0 1 0"/>
    ${sphere(i === 0 ? 0.05 : 20, 0.03, "0 0 -0.5")}`)),
  model("arm of five on stiff drives", "", nested(5, "0.3 0 0", (i) =>
    `<joint name="j${i}" type="hinge" axis="0 1 0"/>${rod(0.3, 0.5)}`),
  actuators([0, 1, 2, 3, 4].map((i) => position(`j${i}`, 1e5)).join(""))),
  model("arm of three on damped drives", "", nested(3, "0.3 0 0", (i) =>
    `<joint name="j${i}" type="hinge" axis="0 ${i === 1 ? "0 1" : "1 0"}"/>${rod(0.3, 1 / (i + 1))}`),
  actuators([0, 1, 2].map((i) => position(`j${i}`, 2000, 15)).join(""))),
  model("drive with damping on armature", "", `<body><joint name="j" type="hinge" axis="0 1 0"
    armature="0.02"/>${rod(0.2, 0.1)}</body>`, actuators(position("j", 500, 8))),
  model("wheel on a velocity drive", "", `<body><joint name="j" type="hinge" axis="0 1 0"/>
    ${sphere(0.5, 0.05)}</body>`, actuators('<velocity joint="j" kv="0.4"/>')),
  model("masses on springs", "", nested(4, "0 0 -0.2", () =>
    `<joint type="slide" axis="0 0 1" stiffness="3000"/>${sphere(0.3)}`)),
  model("damped springs", "", nested(3, "0.2 0 0", () =>
    `<joint type="hinge" axis="0 1 0" stiffness="80" damping="0.3"/>${rod(0.2, 0.2)}`)),
  // A beam of 40 kg on two chains of two links each: a loop.
  model("beam on two chains", "", `
    <body name="a1" pos="-0.5 0 0"><joint type="hinge" axis="0 1 0"/>${sphere(0.1, 0.02, "0 0 -0.3")}
      <body name="a2" pos="0 0 -0.3"><joint type="hinge" axis="0 1 0"/>${sphere(0.1, 0.02, "0 0 -0.3")}
        <body name="beam" pos="0 0 -0.3"><joint type="hinge" axis="0 1 0"/>
          <geom type="box" size="0.5 0.05 0.05" mass="40" pos="0.5 0 0"/></body></body></body>
    <body name="b1" pos="0.5 0 0"><joint type="hinge" axis="0 1 0"/>${sphere(0.1, 0.02, "0 0 -0.3")}
      <body name="b2" pos="0 0 -0.3"><joint type="hinge" axis="0 1 0"/>${sphere(0.1, 0.02, "0 0 -0.3")}
      </body></body>`,
  '<equality><connect body1="b2" body2="beam" anchor="0 0 -0.3"/></equality>'),
  // A parallelogram that a drive on its crank holds against a load.
  model("four-bar on a drive", "", `
    <body name="crank"><joint name="crank" type="hinge" axis="0 1 0"/>${rod(0.2, 0.2)}
      <body name="coupler" pos="0.2 0 0"><joint type="hinge" axis="0 1 0"/>
        <geom type="box" size="0.02 0.02 0.25" mass="2" pos="0 0 -0.25"/></body></body>
    <body name="rocker" pos="0 0 -0.5"><joint type="hinge" axis="0 1 0"/>${rod(0.2, 0.2)}</body>`,
  `<equality><connect body1="coupler" body2="rocker" anchor="0 0 -0.5"/></equality>
   ${actuators(position("crank", 4000, 20))}`),
  model("load at the end of a driven arm", "", `<body><joint name="shoulder" type="hinge" axis="0 1 0"/>
    ${rod(0.5, 1)}<body pos="0.5 0 0"><joint name="elbow" type="hinge" axis="0 1 0"/>${rod(0.4, 0.5)}
    <body pos="0.4 0 0"><joint type="ball"/>${sphere(15, 0.05, "0 0 -0.3")}</body></body></body>`,
  actuators(position("shoulder", 8000, 40) + position("elbow", 5000, 20))),
];

/** They swing from their start: the limit is that of their runs. */
export const moving = [
  rods("five rods on ball joints that swing", 5, 20),
  rods("eight rods on ball joints that swing", 8, 30),
  rods("ten rods on ball joints that swing", 10, 20),
];

/** They move so fast that MuJoCo's explicit gyroscopic and Coriolis forces raise their energy. */
export const fast = [
  rods("three rods on ball joints, fast", 3, 45),
  rods("five rods on ball joints, fast", 5, 45),
  rods("eight rods on ball joints, fast", 8, 45),
];
