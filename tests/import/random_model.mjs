// Random MJCF models: trees of bodies with every kind of geom, orientation, joint, frame and default
// class, and settings of the compiler that change masses.

/** Numbers from 0 to 1 that are the same everywhere. @param seed from 1 */
function generator(seed) {
  let state = seed;
  return () => (state = (state * 48271) % 2147483647) / 2147483647;
}

/** @param seed from 1; @returns the text of a model */
export function randomModel(seed) {
  const random = generator(seed * 7919 + 13);
  for (let i = 0; i < 5; ++i) random();
  const between = (least, most) => (least + (most - least) * random()).toFixed(4);
  const one = (list) => list[Math.floor(random() * list.length)];
  const sometimes = (share, text) => (random() < share ? text() : "");
  const vector = (most) => [0, 0, 0].map(() => between(-most, most)).join(" ");
  const orientation = () => one([
    () => "",
    () => `quat="${between(-1, 1)} ${vector(1)}"`,
    () => `euler="${vector(90)}"`,
    () => `axisangle="${vector(1)} ${between(-90, 90)}"`,
    () => `xyaxes="${vector(1)} ${vector(1)}"`,
    () => `zaxis="${vector(1)}"`,
  ])();
  const size = () => between(0.02, 0.2);

  function geom() {
    const type = one(["sphere", "capsule", "cylinder", "ellipsoid", "box"]);
    const mass = one([() => "", () => `mass="${between(0.1, 2)}"`, () => `density="${between(100, 3000)}"`])();
    const group = sometimes(0.15, () => `group="${Math.floor(random() * 6)}"`);
    const place = type !== "sphere" && random() < 0.4
      ? `fromto="${vector(0.3)} ${vector(0.3)}" size="${size()}"`
      : `size="${size()} ${size()} ${size()}" pos="${vector(0.3)}" ${orientation()}`;
    const of = sometimes(0.3, () => `class="${one(["a", "b", "c"])}"`);
    return `<geom type="${type}" ${place} ${mass} ${group} ${of}/>`;
  }
  const joints = () => one([
    () => "",
    () => `<joint axis="${vector(1)}" pos="${vector(0.1)}" ref="${between(-50, 50)}"/>`,
    () => `<joint type="slide" axis="${vector(1)}" ref="${between(-1, 1)}"/>`,
    () => `<joint type="ball" pos="${vector(0.1)}"/>`,
    () => '<joint axis="1 0.1 0" pos="0.1 0 0"/><joint axis="0.2 1 0.3" pos="0.1 0 0"/>',
  ])();
  const moments = () => [0, 0, 0].map(() => between(1, 1.2)).join(" ");
  const inertial = () => one([
    () => "",
    () => `<inertial pos="${vector(0.2)}" mass="${between(0.5, 2)}" diaginertia="${moments()}" ${orientation()}/>`,
    () => `<inertial pos="${vector(0.2)}" mass="${between(0.5, 2)}" fullinertia="${moments()} ${vector(0.1)}"/>`,
  ])();
  const framed = (text) => (random() < 0.2
    ? `<frame pos="${vector(0.5)}" ${orientation()}>${text}</frame>` : text);
  function body(depth) {
    const below = depth < 3 ? Array.from({ length: Math.floor(random() * 3) }, () => body(depth + 1)) : [];
    const childclass = sometimes(0.3, () => `childclass="${one(["a", "b", "c"])}"`);
    return framed(`<body pos="${vector(1)}" ${orientation()} ${childclass}>${joints()}
      ${sometimes(0.4, inertial)}${framed(geom())}${sometimes(0.5, geom)}<geom size="0.05"/>
      ${below.join("\n")}</body>`);
  }
  const sequence = [0, 0, 0].map(() => one([..."xyzXYZ"])).join("");
  const compiler = one(["", 'settotalmass="7"', 'boundmass="0.4"', 'inertiafromgeom="true"',
    'balanceinertia="true" boundinertia="0.01"']);
  return `<mujoco><compiler eulerseq="${sequence}" inertiagrouprange="0 ${one([3, 5])}" ${compiler}/>
    <default><geom density="${between(500, 2000)}"/>
      <default class="a"><geom density="${between(500, 2000)}" ${one(["", 'euler="10 20 30"'])}/>
        <default class="b"><geom mass="${between(0.2, 1)}"/></default></default>
      <default class="c"><geom density="${between(100, 900)}" quat="1 0.1 0.2 0.3"/></default></default>
    <worldbody><body><freejoint/><geom size="0.1"/></body>${body(0)}${body(0)}</worldbody></mujoco>`;
}
