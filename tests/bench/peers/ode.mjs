// ODE: mainly its direct solver, with its Gauss-Seidel solver for comparison. The program is
// ode_peer.cpp.

import { foreignJoint } from "./scene.mjs";

export const title = "ODE";

export const cannotState = (scene) => foreignJoint(scene, ["ball", "hinge", "prismatic"]);

const direct = (erp, ...counts) => counts.map((substeps) => ({ substeps, solver: "direct", erp }));
const quick = (substeps, iterations) => ({ substeps, solver: "quick", iterations });

export const ladder = {
  swinging_box: [...direct(0.2, 6, 7, 8, 16), quick(8, 200)],
  bridge: [...direct(0.2, 8, 12, 16, 24), ...direct(0.8, 8), quick(16, 100)],
  in_space: [...direct(0.2, 2, 4, 8, 16, 32), ...direct(0.8, 2, 4), quick(16, 200)],
  energy: [
    ...direct(0.2, 4, 8, 16, 32, 64),
    ...[0.8, 1].flatMap((erp) => direct(erp, 4, 8, 16, 32, 64, 128, 256)),
    quick(16, 200),
  ],
  stack: [...direct(0.2, 1, 2, 4, 8, 16), ...direct(0.8, 1, 4, 16), quick(8, 200)],
};
