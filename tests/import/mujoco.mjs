// MuJoCo as an oracle: what it reads from a model, and how the model moves.
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { dirname, join } from "node:path";
import { tmpdir } from "node:os";
import { execFileSync } from "node:child_process";

/** Node.js cannot resolve a package that is not installed: this says what to do. */
async function load() {
  try {
    return await (await import("@mujoco/mujoco")).default();
  } catch (error) {
    throw new Error("npm ci --prefix tests/import installs MuJoCo", { cause: error });
  }
}
let mujoco;

/** The text of a model with its includes in place. */
export function whole(path) {
  return readFileSync(path, "utf8").replace(/<include file="([^"]+)"\/>/g, (_, file) =>
    readFileSync(join(dirname(path), file), "utf8").replace(/<\/?mujocoinclude>/g, ""));
}

/**
 * Without meshes and textures from files: tiny spheres without mass stand in for the meshes.
 * @param text of an MJCF or URDF model
 */
export const withoutFiles = (text) => text
  .replace(/<(mesh|texture)\b[^>]*\bfile=[^>]*\/>/g, "")
  .replace(/<(visual|collision)>((?!<\/\1>)[^])*<mesh((?!<\/\1>)[^])*<\/\1>/g, "")
  .replace(/ texture="[^"]*"/g, "")
  .replace(/<geom\b[^>]*>/g, (geom) => (/vertex=/.test(text) ? geom : geom
    .replace(/type="mesh"/, 'type="sphere" size="0.001" mass="0"').replace(/\smesh="[^"]*"/, "")));

/** A URDF model without contact, and with joints whose bounds are far away. */
export const passiveUrdf = (text) =>
  text.replace(/<limit\b[^>]*>/g, '<limit effort="0" velocity="0" lower="-1000" upper="1000"/>')
    .replace("</robot>", '<mujoco><option><flag contact="disable"/></option></mujoco></robot>');

/** Without contact, limits, dry friction, equality, actuators, and what else is switched off. */
export function passive(text, ...others) {
  const flags = ["contact", "constraint", "limit", "frictionloss", "equality", "actuation", ...others]
    .map((flag) => `${flag}="disable"`).join(" ");
  return text.replace(/<mujoco( [^>]*)?>/, (tag) => `${tag}<option><flag ${flags}/></option>`);
}


/** R diag(moments) R^T, row-major. */
export function tensor(R, moments) {
  const t = [];
  for (let i = 0; i < 3; ++i) {
    for (let j = 0; j < 3; ++j) {
      t.push([0, 1, 2].reduce((sum, k) => sum + R[3 * i + k] * moments[k] * R[3 * j + k], 0));
    }
  }
  return t;
}

/** A rotation matrix, row-major, of a quaternion w, x, y, z. */
export function matrix([w, x, y, z]) {
  return [
    1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
    2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
    2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y),
  ];
}

/** Bodies that move as one: mass, centre and inertia about it in world axes. */
function combine(solids) {
  const mass = solids.reduce((sum, { mass: m }) => sum + m, 0);
  const centre = [0, 1, 2].map((i) => solids.reduce((sum, s) => sum + s.mass * s.centre[i], 0) / mass);
  const inertia = Array(9).fill(0);
  for (const solid of solids) {
    const d = solid.centre.map((x, i) => x - centre[i]);
    const square = d.reduce((sum, x) => sum + x * x, 0);
    for (let i = 0; i < 9; ++i) {
      const [row, column] = [Math.floor(i / 3), i % 3];
      inertia[i] += solid.inertia[i] +
        solid.mass * ((row === column ? square : 0) - d[row] * d[column]);
    }
  }
  return { mass, centre, inertia };
}

export class Oracle {
  /** @param key name of a keyframe to start in, or undefined */
  static async of(text, key) {
    mujoco ??= await load();
    return new Oracle(mujoco.MjModel.from_xml_string(text), key);
  }
  constructor(model, key) {
    this.model = model;
    this.data = new mujoco.MjData(model);
    if (key !== undefined) {
      const index = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_KEY.value, key);
      mujoco.mj_resetDataKeyframe(model, this.data, index);
    }
    mujoco.mj_forward(model, this.data);
  }
  /** Moving bodies in the order of the model, each with those that are fixed to it. */
  bodies() {
    const { model, data } = this;
    const groups = new Map();
    for (let i = 1; i < model.nbody; ++i) {
      const root = model.body_weldid[i];
      if (root === 0) continue;
      const R = [...data.ximat.slice(9 * i, 9 * i + 9)];
      const solid = {
        mass: model.body_mass[i],
        centre: [...data.xipos.slice(3 * i, 3 * i + 3)],
        inertia: tensor(R, model.body_inertia.slice(3 * i, 3 * i + 3)),
      };
      groups.set(root, [...(groups.get(root) ?? []), solid]);
    }
    return [...groups].map(([root, solids]) => ({
      ...combine(solids.filter(({ mass }) => mass > 0)),
    }));
  }
  /** Names of its bodies, but for the world. */
  bodyNames() {
    const kind = mujoco.mjtObj.mjOBJ_BODY.value;
    return Array.from({ length: this.model.nbody - 1 }, (_, i) => mujoco.mj_id2name(this.model, kind, i + 1));
  }
  /** @param integrator its name in MuJoCo, in capital letters */
  integrate(integrator) {
    this.model.opt.integrator = mujoco.mjtIntegrator[`mjINT_${integrator}`].value;
  }
  /** Begins again with this step [s]. */
  restart(step) {
    this.model.opt.timestep = step;
    mujoco.mj_resetData(this.model, this.data);
    mujoco.mj_forward(this.model, this.data);
  }
  /** @returns the largest speed of a coordinate in these seconds; infinite if MuJoCo gives up. */
  peakSpeed(seconds) {
    const { model, data } = this;
    let most = 0;
    for (const steps = Math.ceil(seconds / model.opt.timestep); most < 1e6;) {
      const time = data.time;
      mujoco.mj_step(model, data);
      if (data.time < time) return Infinity; // it has reset itself
      for (const speed of data.qvel) most = Math.max(most, Math.abs(speed));
      if (data.time >= (steps - 0.5) * model.opt.timestep) return most;
    }
    return Infinity;
  }
  /** Mean energies of every second of a run [J]; the model has the flag `energy`. */
  meanEnergies(step, seconds) {
    const means = [];
    this.restart(step);
    for (let second = 1; second <= seconds; ++second) {
      let [sum, count] = [0, 0];
      for (; this.data.time < second - 0.5 * step; ++count) {
        mujoco.mj_step(this.model, this.data);
        sum += this.data.energy[0] + this.data.energy[1];
      }
      means.push(sum / count);
    }
    return means;
  }
  /** Frees its memory. */
  free() {
    this.data.delete();
    this.model.delete();
  }
  /** Runge-Kutta of fourth order with these many steps a second. */
  advance(seconds, rate) {
    this.integrate("RK4");
    this.model.opt.timestep = 1 / rate;
    const steps = Math.round(seconds * rate);
    for (let i = 0; i < steps; ++i) mujoco.mj_step(this.model, this.data);
    // It starts again where it fails, for example where a stack of hinges loses a direction.
    if (Math.abs(this.data.time - seconds) > 0.5 / rate) throw new Error("MuJoCo failed");
    mujoco.mj_forward(this.model, this.data);
  }
}

/** Runs `work` with the path of a folder that is removed afterwards. */
export function inFolder(work) {
  const folder = mkdtempSync(join(tmpdir(), "substep-import-"));
  try {
    return work(folder);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

const zUp = ([x, y, z]) => [x, -z, y];

/** The moving bodies of a scene, with Z up, in the form of Oracle.bodies(). */
export function bodiesOfScene(scene) {
  return scene.bodies.filter((body) => !body.static).map((body) => {
    const R = matrix(body.orientation ?? [1, 0, 0, 0]);
    const rows = [0, 1, 2].map((i) => R.slice(3 * i, 3 * i + 3));
    const turned = [rows[0], rows[2].map((x) => -x), rows[1]].flat();
    const size = body.shape.size?.map((edge) => edge / 2);
    const solid = size === undefined
      ? Array(3).fill(0.4 * body.mass * body.shape.radius ** 2)
      : [0, 1, 2].map((i) => (body.mass / 3) * (size[(i + 1) % 3] ** 2 + size[(i + 2) % 3] ** 2));
    return {
      name: body.name,
      mass: body.mass,
      centre: zUp(body.position),
      velocity: zUp(body.velocity ?? [0, 0, 0]),
      inertia: tensor(turned, body.inertia ?? solid),
    };
  });
}

/** Centres of mass at the end of a run, Z up. */
export function run(program, scene, flags) {
  const text = execFileSync(program, ["run", scene, "--states", "-", "--seconds", "1", ...flags],
    { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"], maxBuffer: 1 << 28 });
  const [head, ...lines] = text.trim().split("\n").filter((line) => line.includes(","))
    .map((line) => line.split(","));
  const column = (name) => head.indexOf(name);
  const last = lines.at(-1)[column("time")];
  const centres = new Map();
  for (const line of lines.filter((fields) => fields[column("time")] === last)) {
    centres.set(line[column("body")], zUp(["x", "y", "z"].map((axis) => Number(line[column(axis)]))));
  }
  return centres;
}

export const relative = (a, b) => {
  const scale = Math.max(...b.map(Math.abs), 1e-300);
  return Math.max(...a.map((x, i) => Math.abs(x - b[i]))) / scale;
};
