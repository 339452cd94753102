// What was looked at, what was found, and where to go on.
const LANGUAGE_NAMES = { cpp: "C++", python: "Python", launch: "launch files (XML)", yaml: "YAML", interface: "interfaces", cmake: "CMake" };

function figure(number, label, view, parameters) {
  const shown = typeof number === "number" ? number.toLocaleString("en") : number;
  const content = [h("span", { class: "figure-number" }, shown), h("span", { class: "figure-label" }, label)];
  return view ? h("a", { class: "figure", href: address(view, parameters) }, content) : h("div", { class: "figure" }, content);
}

function bar(share, classes) {
  const inner = s("rect", { x: 0, y: 0, width: Math.max(0, Math.min(100, share * 100)), height: 8, class: classes || "fill" });
  return s("svg", { class: "bar", viewBox: "0 0 100 8", preserveAspectRatio: "none", "aria-hidden": "true" }, s("rect", { x: 0, y: 0, width: 100, height: 8, class: "ground" }), inner);
}

const percent = (part, whole) => (whole ? `${((100 * part) / whole).toFixed(1)} %` : "–");

function overview() {
  const shown = FINDINGS.filter((one) => one.state === "open");
  const levels = LEVELS.map((level) => shown.filter((one) => one.level === level).length);
  const known = FINDINGS.filter((one) => one.state === "known").length;
  const gone = FINDINGS.filter((one) => one.state === "gone").length;
  const set = FINDINGS.filter((one) => one.state === "suppressed").length;
  const launched = CONFIGURATIONS.filter((one) => one.launch.length);
  const lineSums = D.languages.map((_, index) => D.packages.reduce((sum, one) => sum + one.lines[index], 0));
  const allLines = lineSums.reduce((sum, one) => sum + one, 0);
  const summary = D.summary;
  const at = [text(summary.branch), text(summary.revision), text(summary.date)].filter(Boolean).join(" · ");
  const isCompared = summary.compared >= 0;
  const programs = programRows().length;
  return [
    h("h1", null, text(D.name)),
    h("p", { class: "lead" }, text(summary.headline), text(summary.known) ? `; ${text(summary.known)}` : "", "."),
    at ? h("p", { class: "quiet" }, at, isCompared ? ` · compared with ${revision(text(summary.compared))}` : "") : null,
    text(summary.no_baseline) ? h("p", { class: "warning" }, text(summary.no_baseline)) : null,
    texts(D.left_out).map((one) => h("p", { class: "warning" }, one)),
    h("div", { class: "figures" },
      figure(levels[0], levels[0] === 1 ? "error" : "errors", "findings", { level: "error" }), figure(levels[1], levels[1] === 1 ? "warning" : "warnings", "findings", { level: "warning" }),
      figure(levels[2], levels[2] === 1 ? "note" : "notes", "findings", { level: "note" }), known ? figure(known, "known", "findings", { state: "known" }) : null,
      gone ? figure(gone, "gone", "findings", { state: "gone" }) : null, set ? figure(set, "suppressed", "findings", { state: "suppressed" }) : null,
      figure(D.packages.length, D.packages.length === 1 ? "package" : "packages", "packages"), figure(programs, programs === 1 ? "program that is a node" : "programs that are nodes", programs ? "programs" : null), figure(CONFIGURATIONS.length, CONFIGURATIONS.length === 1 ? "configuration" : "configurations", "system"),
      figure(D.launch_files, D.launch_files === 1 ? "launch file" : "launch files", "launch"), figure(D.interfaces.length, D.interfaces.length === 1 ? "interface defined here" : "interfaces defined here", "interfaces"),
      PROPERTIES.length ? figure(PROPERTIES.length, PROPERTIES.length === 1 ? "property" : "properties", "properties") : null, RECORDINGS.length ? figure(PROPERTIES.filter((one) => VERDICTS[worstVerdict(one)] === "violated").length, "violated by recordings", "properties", { sort: "verdict-up" }) : null,
      D.changes ? figure(D.changes.rows.length, D.changes.rows.length === 1 ? "change to the system" : "changes to the system", "changes") : null),
    h("div", { class: "cards" },
      h("section", { class: "card" }, h("h2", null, "Findings by tool"), byTool(shown)),
      h("section", { class: "card" }, h("h2", null, "Findings by package"), byPackage(shown)),
      h("section", { class: "card" }, h("h2", null, "Rules with the most findings"), byRule(shown)),
      h("section", { class: "card" }, h("h2", null, "Lines by language"),
        smallTable(["language", "lines", ""], D.languages.map((one, index) => [link("packages", { sort: one }, LANGUAGE_NAMES[one]), lineSums[index], bar(lineSums[index] / (allLines || 1))]).filter((row) => row[1]), "lines by language"))),
    D.history.length ? qualityOverTime() : null,
    h("section", { class: "card" }, h("h2", null, "Configurations of launch files"), launched.length ? configurationTable(launched) : h("p", null, "No launch file starts a node that is known here.")),
    h("section", { class: "card" }, h("h2", null, "About this run"), h("p", null, text(summary.covered)),
      summary.notes.length ? h("details", null, h("summary", null, `${count(summary.notes.length + summary.more_notes, "note")} of the run`), h("ul", { class: "notes" }, summary.notes.map(([rank, message, tool, path, line]) =>
        h("li", null, h("span", { class: `level ${LEVELS[rank]}` }, LEVELS[rank]), " ", text(tool) ? `${text(tool)}: ` : "", text(path) ? `${text(path)}${line ? `:${line}` : ""}: ` : "", text(message))),
        summary.more_notes ? h("li", null, `and ${summary.more_notes} more`) : null)) : null),
  ];
}

function grouped(list, key) {
  const found = new Map();
  for (const one of list) (found.get(key(one)) || found.set(key(one), []).get(key(one))).push(one);
  return [...found].sort((a, b) => b[1].length - a[1].length || compare(a[0], b[0]));
}

const some = (list, level, parameters) => {
  const number = list.filter((one) => one.level === level).length;
  return number ? link("findings", { ...parameters, level }, number.toLocaleString("en")) : "";
};

function byTool(list) {
  if (!list.length) return h("p", null, "None.");
  return smallTable(["tool", ...LEVELS], grouped(list, (one) => one.tool).map(([tool, found]) => [link("findings", { tool }, tool), ...LEVELS.map((level) => some(found, level, { tool }))]), "findings by tool and level");
}

function byPackage(list) {
  if (!list.length) return h("p", null, "None.");
  const groups = grouped(list, (one) => one.package || "(no package)");
  const most = groups[0][1].length;
  const rows = groups.slice(0, 12).map(([name, found]) => [name === "(no package)" ? name : link("findings", { package: name }, breakable(name)), name === "(no package)" ? found.length : link("findings", { package: name }, found.length.toLocaleString("en")), bar(found.length / most)]);
  return [smallTable(["package", "findings", ""], rows, "findings by package"), groups.length > 12 ? h("p", { class: "quiet" }, link("packages", { sort: "findings" }, `all ${groups.length}`)) : null];
}

function byRule(list) {
  if (!list.length) return h("p", null, "None.");
  const groups = grouped(list, (one) => one.full);
  const most = groups[0][1].length;
  return smallTable(["rule", "findings", ""], groups.slice(0, 12).map(([rule, found]) => [link("findings", { rule }, breakable(rule)), link("findings", { rule }, found.length.toLocaleString("en")), bar(found.length / most)]), "findings by rule");
}

function configurationTable(list) {
  const rows = list.map((one) => {
    const [unknown, all] = one.row.unknown;
    return [link("system", { configuration: one.name }, breakable(one.name)), link("system", { configuration: one.name }, one.row.nodes.length.toLocaleString("en")), link("parameters", { configuration: one.name }, one.row.parameters.length.toLocaleString("en")), all, percent(unknown, all), bar(all ? unknown / all : 0, "fill unknown")];
  });
  return smallTable(["configuration", "nodes", "parameters set", "endpoints", "names not known", ""], rows, "configurations");
}
