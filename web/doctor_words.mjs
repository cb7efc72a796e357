// A diagnosis as HTML. Names come from files: they are set as text.

const mostRows = 40; // of a table

/** A number with so many digits. */
export const digits = (value, count) => String(Number(value.toPrecision(count)));

/** "2.38 ms", or "no limit". @param step [s], or null */
export function stepText(step) {
  if (step === null || !Number.isFinite(step)) return "no limit";
  return step < 0.1 ? `${digits(1e3 * step, 3)} ms` : `${digits(step, 3)} s`;
}

/** An element. @param content texts and elements */
function make(tag, content = [], properties = {}) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...[content].flat());
  return element;
}

const sentence = (text) => (text === "" ? "" : `${text[0].toUpperCase()}${text.slice(1)}.`);

/**
 * The answer in one line, and its reason.
 * @param diagnosis null if there is none yet; it may be of another step
 * @param step that is asked [s]
 */
export function showAnswer(section, diagnosis, step) {
  const [verdict, reason] = [section.querySelector("h2"), section.querySelector("#reason")];
  const put = (element, text) => { if (element.textContent !== text) element.textContent = text; };
  section.className = "";
  if (diagnosis === null) {
    put(verdict, "");
    put(reason, "");
    return;
  }
  const { largest_step: limit, not_analysed: left } = diagnosis;
  const summary = limit !== null || left === 0 ? diagnosis.summary
    : `${left} bodies are in groups that are too large for the analysis; the others have no limit`;
  const isCurrent = diagnosis.step === step;
  const ratio = limit === null ? 0 : step / limit;
  const word = isCurrent ? diagnosis.verdict : ratio > 1 ? "fails" : ratio * 1.4 > 1 ? "holds narrowly" : "holds";
  section.className = word.replace(" ", "-");
  put(verdict, sentence(summary).replace(/(\d) (m?s)\b/g, "$1\u00a0$2")); // a number keeps its unit
  put(reason, `A step of ${stepText(step)} ${word}${limit === null ? ""
    : `: ${digits(ratio, 2)} times the limit`}.`);
}

/** @param columns {title, isNumber} @param rows of texts and elements */
function table(columns, rows) {
  const cell = (tag) => (text, i) => make(tag, text, columns[i].isNumber ? { className: "number" } : {});
  const head = columns.map(({ title }) => title);
  const shown = rows.slice(0, mostRows);
  const body = make("tbody", shown.map((row) => make("tr", row.map(cell("td")))));
  const whole = make("div", make("table", [make("thead", make("tr", head.map(cell("th")))), body]),
    { className: "scroll", tabIndex: 0 });
  return rows.length > mostRows
    ? [whole, make("p", `and ${rows.length - mostRows} more, in the JSON`, { className: "dim" })] : [whole];
}

const word = (title) => ({ title });
const number = (title) => ({ title, isNumber: true });

function findings(diagnosis) {
  const all = [...diagnosis.findings];
  if (diagnosis.not_analysed > 0) {
    all.push({ text: `${diagnosis.not_analysed} bodies are in groups that are too large and were not analysed` });
  }
  if (all.length === 0) return [];
  return [make("h2", "Findings"), make("ul", all.map(({ fails, text }) =>
    make("li", sentence(text), fails ? { className: "bad" } : {})))];
}

/** What takes part in the mode that fails first. */
function shares(diagnosis) {
  const groups = diagnosis.start.filter(({ step }) => step !== null).sort((a, b) => a.step - b.step);
  if (groups.length === 0) return [];
  const kinds = { drives: "drives and springs", joints: "geometric stiffness of joints",
    bodies: "bodies that move" };
  const items = Object.entries(kinds).flatMap(([kind, title]) => {
    const large = groups[0][kind].filter(({ share }) => share >= 0.01).slice(0, 4);
    if (large.length === 0) return [];
    return [make("li", `${title}: ${large.map(({ name, share }) =>
      `${name} ${digits(100 * share, 2)} %`).join(", ")}`)];
  });
  return items.length === 0 ? [] : [make("h2", "What fails first, at the start"), make("ul", items)];
}

function drives(diagnosis) {
  if (diagnosis.drives.length === 0) return [];
  const columns = [word("joint"), number("its limit alone"), number("all explicit"),
    number("damping implicit"), number("inertia"), number("armature to add")];
  if (diagnosis.held) columns.push(number("held"), number("by delay"));
  const rows = [...diagnosis.drives].sort((a, b) => (a.step ?? Infinity) - (b.step ?? Infinity))
    .map((drive) => [drive.joint, stepText(drive.step), stepText(drive.explicit_step),
      stepText(drive.implicit_damping_step), drive.inertia === null ? "" : digits(drive.inertia, 3),
      drive.armature_to_add > 0 ? digits(drive.armature_to_add, 3) : "none",
      ...(diagnosis.held ? [stepText(drive.held_step), stepText(drive.delay_step)] : [])]);
  return [make("h2", "Drives and springs"), ...table(columns, rows),
    make("p", "Inertia and armature in kg m² (hinges) or kg (slides). The armature is that for the asked "
      + "step with a margin of 1.4; several drives together may need more.", { className: "dim" })];
}

function runs(diagnosis, isWhole) {
  if (!isWhole) return [];
  const rows = diagnosis.runs.map(({ run, seconds, verdict, note }) =>
    [run, `${digits(seconds, 3)} s`, note ? `${verdict}. ${note}` : verdict]);
  return [make("h2", "Runs"), ...table([word("run"), number("length"), word("verdict")], rows)];
}

/** @param apply called with a remedy and its place in the list */
function remedies(diagnosis, isWhole, apply) {
  if (!isWhole || diagnosis.remedies.length === 0) return [];
  const button = (remedy, i) => (remedy.step === undefined && !remedy.changes_model ? ""
    : make("button", "Apply", { type: "button", onclick: () => apply(remedy, i),
      ariaLabel: `Apply ${remedy.text}` }));
  const rows = diagnosis.remedies.map((remedy, i) => [[remedy.text, button(remedy, i)], remedy.verdict,
    `${digits(remedy.cost, 2)} times`, `${digits(remedy.moved, 2)} m`]);
  return [make("h2", "Remedies, tried"),
    ...table([word("change"), word("verdict"), number("work"), number("off by")], rows),
    make("p", "Work: operations of the solver relative to the asked step. Off by: distance from a fine run "
      + "in the first second.", { className: "dim" })];
}

function settings(diagnosis) {
  if (diagnosis.settings.length === 0) return [];
  const rows = diagnosis.settings.map(({ title, setting, assumed }) =>
    [assumed ? `${title} (its drives: assumed)` : title, setting]);
  return [make("h2", "Settings, with a margin of 1.4"), ...table([word("engine"), word("at least")], rows)];
}

function importReport(imported) {
  if (!imported) return [];
  const list = (title, notes) => (notes.length === 0 ? []
    : [make("h3", title), make("ul", notes.slice(0, 200).map((note) => make("li", note)))]);
  const count = imported.approximated.length + imported.left_out.length;
  if (count === 0) return [];
  return [make("details", [make("summary", `Import: ${imported.approximated.length} approximated, `
    + `${imported.left_out.length} left out`), ...list("Approximated", imported.approximated),
  ...list("Left out", imported.left_out)])];
}

/**
 * All that is known. @param section its `model` is the report of the import, or null
 * @param isWhole whether the runs are in it  @param apply of remedies()
 */
export function showDetails(section, diagnosis, isWhole, apply) {
  const unfolded = section.querySelector("details")?.open ?? false;
  section.replaceChildren(...findings(diagnosis), ...shares(diagnosis), ...remedies(diagnosis, isWhole, apply),
    ...settings(diagnosis), ...drives(diagnosis), ...runs(diagnosis, isWhole), ...importReport(section.model));
  const details = section.querySelector("details");
  if (details) details.open = unfolded;
}
