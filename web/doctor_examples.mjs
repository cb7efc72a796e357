// Models to try on the page of the step doctor.

const arm = `<mujoco model="arm_on_stiff_drives">
  <option timestep="0.002"/>
  <default><geom type="capsule" size="0.03"/></default>
  <worldbody>
    <body name="upper_arm" pos="0 0 1">
      <joint name="shoulder" axis="0 1 0"/>
      <geom fromto="0 0 0 0.4 0 0" mass="2"/>
      <body name="forearm" pos="0.4 0 0">
        <joint name="elbow" axis="0 1 0"/>
        <geom fromto="0 0 0 0.3 0 0" mass="1"/>
        <body name="hand" pos="0.3 0 0">
          <joint name="wrist" axis="0 1 0"/>
          <geom fromto="0 0 0 0.1 0 0" mass="0.2"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator>
    <position joint="shoulder" kp="4000" kv="60"/>
    <position joint="elbow" kp="2000" kv="30"/>
    <position joint="wrist" kp="1500" kv="2"/>
  </actuator>
</mujoco>
`;

/** A load on a chain of light links, each in the one above. */
function crane(count, length, mass, load) {
  let inner = "";
  for (let i = count; i > 0; --i) {
    const end = i === count
      ? `<geom type="sphere" size="0.12" mass="${load}" pos="0 0 ${-length - 0.12}"/>` : inner;
    inner = `<body name="link_${i}" pos="0 0 ${i === 1 ? 2 : -length}">
<joint name="joint_${i}" axis="0 1 0"/>
<geom type="capsule" size="0.02" fromto="0 0 0 0 0 ${-length}" mass="${mass}"/>
${end}
</body>`;
  }
  return `<mujoco model="load_on_a_chain">
<option timestep="0.01"/>
<worldbody>
${inner}
</worldbody>
</mujoco>
`;
}

const leg = `<?xml version="1.0"?>
<robot name="hanging_leg">
  <link name="frame"/>
  <link name="thigh"><inertial><origin xyz="0 0 -0.15"/><mass value="0.8"/>
    <inertia ixx="0.006" iyy="0.006" izz="0.0004" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><origin xyz="0 0 -0.15"/><geometry><box size="0.05 0.05 0.3"/></geometry></visual></link>
  <link name="shank"><inertial><origin xyz="0 0 -0.15"/><mass value="0.3"/>
    <inertia ixx="0.002" iyy="0.002" izz="0.0001" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><origin xyz="0 0 -0.15"/><geometry><box size="0.04 0.04 0.3"/></geometry></visual></link>
  <link name="load"><inertial><mass value="60"/>
    <inertia ixx="0.4" iyy="0.4" izz="0.4" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><geometry><box size="0.2 0.2 0.2"/></geometry></visual></link>
  <joint name="hip" type="revolute"><parent link="frame"/><child link="thigh"/><origin xyz="0 0 1"/>
    <axis xyz="0 1 0"/><limit lower="-2" upper="2" effort="100" velocity="10"/></joint>
  <joint name="knee" type="continuous"><parent link="thigh"/><child link="shank"/>
    <origin xyz="0 0 -0.3"/><axis xyz="0 1 0"/></joint>
  <joint name="ankle" type="continuous"><parent link="shank"/><child link="load"/>
    <origin xyz="0 0 -0.3"/><axis xyz="0 1 0"/></joint>
</robot>
`;

/** By the name in a link: {title, file, text}. */
export const examples = {
  crane: { title: "A load on a chain", file: "load_on_a_chain.xml", text: crane(5, 0.2, 0.2, 40) },
  arm: { title: "An arm on stiff drives", file: "arm.xml", text: arm },
  leg: { title: "A hanging leg (URDF)", file: "leg.urdf", text: leg },
};
