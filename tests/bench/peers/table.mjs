// The tables of the peer bench, as text.

/** Headings of the columns after the cost, and the members of an entry that they show. */
const kColumns = {
  swinging_box: { "off at 3 s mm": "error", "joint gap mm": "other" },
  in_space: { "largest off mm": "error", "joint gap mm": "other" },
  bridge: { "joint gap mm": "error", "ball sinks mm": "other" },
  stack: { "penetration mm": "error", "box moved mm": "other" },
  energy: {
    "energy %": "error",
    "rises by %": "rise",
    "at the end %": "drift",
    "off in 1 s mm": "other",
    "joint gap mm": "gap",
  },
};

const settingText = (setting) =>
  Object.entries(setting)
    .map(([name, value]) => `${name} ${value}`)
    .join(", ");

/** Metres as millimetres, with three digits. */
function millimetres(x) {
  const mm = 1e3 * x;
  if (mm > 0 && mm < 1e-3) return mm.toExponential(1);
  return mm >= 100 ? mm.toFixed(0) : String(Number(mm.toPrecision(3)));
}

/** A share as a percentage, with three digits. */
const percent = (x) => String(Number((100 * x).toPrecision(3)));

/** The error of an entry with its unit. */
const errorText = ({ kind, error }) =>
  kind === "energy" ? `${percent(error)} %` : `${millimetres(error)} mm`;

const row = ([name, ...cells], last = "") =>
  [name.padEnd(20), ...cells.map((cell) => cell.padStart(13)), last].join("  ");

function timedRow(entry) {
  const spread = `${entry.least.toPrecision(3)}..${entry.most.toPrecision(3)}`;
  const cells = Object.entries(kColumns[entry.kind]).map(([heading, member]) =>
    (heading.endsWith("%") ? percent : millimetres)(entry[member]),
  );
  return row(
    [entry.engine.title, entry.ms.toPrecision(3), ...cells],
    `${settingText(entry.setting)}  [${spread} ms]`,
  );
}

/** Settings that hold, cheapest first within an engine, then those that were not run or fail. */
export function sceneLines({ title, kind }, entries, best) {
  const lines = ["", title, row(["engine", "ms per frame", ...Object.keys(kColumns[kind])], "setting")];
  const engines = [...new Set(entries.map(({ engine }) => engine))];
  for (const engine of engines) {
    const own = best.filter((entry) => entry.engine === engine).sort((a, b) => a.ms - b.ms);
    lines.push(...own.map(timedRow));
    const tried = entries.some((entry) => entry.engine === engine && !entry.lacking);
    if (!tried) lines.push(row([engine.title, "skipped"]));
    else if (own.length === 0) lines.push(row([engine.title, "none holds"]));
  }
  for (const engine of engines) {
    const failed = entries.filter((entry) => entry.engine === engine && entry.failure);
    for (const { setting, failure, lacking } of failed) {
      const how = lacking ? "skipped" : "fails";
      lines.push(`  ${how}: ${engine.title}, ${settingText(setting)}: ${lacking ?? failure}`);
    }
  }
  return lines;
}

/** Newton's method has its own integration; null if an engine has only one integrator. */
function integrator({ engine, setting }) {
  if (setting.forces) return `newton, forces ${setting.forces}`;
  if (setting.integrator) return setting.integrator;
  if (setting.preset === "steady") return "leapfrog";
  return engine.ours ? "euler" : null;
}

const kAlike = 1.01; // ratio of errors that count as equal

/** The best integrator of every engine that has several: the least error, the cheapest among equals. */
export function integratorLines(entries, best) {
  const engines = [...new Set(best.map(({ engine }) => engine))];
  return engines.flatMap((engine) => {
    const own = (list) => list.filter((entry) => entry.engine === engine);
    const tried = new Set(own(entries).filter(({ lacking }) => !lacking).map(integrator));
    if (tried.size < 2) return [];
    const least = Math.min(...own(best).map(({ error }) => error));
    const alike = own(best).filter(({ error }) => error <= kAlike * least);
    const [first] = alike.sort((a, b) => a.ms - b.ms);
    const cost = `${errorText(first)} at ${first.ms.toPrecision(3)} ms`;
    return [`  ${engine.title}: ${integrator(first)} is the best of: ${[...tried].join("; ")}: ${cost}`];
  });
}

const platform = ({ engine }) => engine.title.split(", ").at(-1);

/** Our cheapest setting on the platform of a peer, at an error no larger than the peer's. */
function answer(best, peer) {
  return best
    .filter((entry) => entry.engine.ours && platform(entry) === platform(peer))
    .filter((entry) => entry.error <= peer.error)
    .sort((a, b) => a.ms - b.ms)[0];
}

function aimText(aim, least) {
  if (!aim) return "";
  const verdict = least >= aim ? "reached" : `missed by a factor of ${(aim / least).toFixed(1)}`;
  return `; aim ${aim}: ${verdict}`;
}

/** For every timed setting of a peer: its cost relative to ours at an error no larger. */
export function factorLines({ aim }, best) {
  const peers = best.filter(({ engine }) => !engine.ours);
  const pairs = peers.map((peer) => ({ peer, ours: answer(best, peer) }));
  const lines = pairs.map(({ peer, ours }) => {
    const verdict = ours
      ? `${(peer.ms / ours.ms).toFixed(1)} times our cost (${settingText(ours.setting)})`
      : "more accurate than we are at any setting tried";
    const cost = `${errorText(peer)}, ${peer.ms.toPrecision(3)} ms`;
    return `  ${peer.engine.title} at ${cost}: ${verdict}`;
  });
  for (const name of new Set(peers.map(platform))) {
    const here = pairs.filter(({ peer }) => platform(peer) === name);
    const answered = here.filter(({ ours }) => ours);
    if (answered.length < here.length) {
      lines.push(`  ${name}: more accurate than we are: ${here.length - answered.length} settings`);
    }
    if (answered.length === 0) continue;
    const least = Math.min(...answered.map(({ peer, ours }) => peer.ms / ours.ms));
    const times = `${least.toFixed(1)} times our cost`;
    lines.push(`  ${name}: the others take at least ${times}${aimText(aim, least)}`);
  }
  return lines;
}
