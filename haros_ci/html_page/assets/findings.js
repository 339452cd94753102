// The findings: a table that is searched, sorted and filtered, and one of them with its code, its ways and its rule.
const FILTERS = ["level", "state", "tool", "rule", "package"];

function findingsView(parameters) {
  const wanted = { q: "", level: "", state: "", tool: "", rule: "", package: "", path: "", tag: "", configuration: "", sort: "level-up", ...parameters };
  const inConfiguration = new Map();
  const detail = h("aside", { class: "detail", "aria-label": "finding", "aria-live": "polite" });
  const total = h("span", { class: "quiet", role: "status" });
  const states = [...new Set(FINDINGS.map((one) => one.state))].sort(compare);
  // What is open is shown unless something else is asked for.
  if (!wanted.state && !wanted.id && states.includes("open")) wanted.state = "open";
  const [key, direction] = wanted.sort.split("-");
  const sort = { column: key, down: direction === "down" };
  const columns = [
    { key: "level", title: "level", width: "5.5rem", compare: (a, b) => a.rank - b.rank, cell: (one) => h("span", { class: `level ${one.level}` }, one.level) },
    { key: "place", title: "place", width: "minmax(9rem, 2fr)", class: "path", compare: (a, b) => compare(a.place.path, b.place.path) || a.place.line - b.place.line, cell: (one) => h("span", { title: one.place.text }, h("bdi", null, one.place.text)) },
    { key: "message", title: "message", width: "minmax(12rem, 4fr)", compare: (a, b) => compare(a.message, b.message), cell: (one) => one.message },
    { key: "rule", title: "rule", width: "minmax(7rem, 1.3fr)", compare: (a, b) => compare(a.full, b.full), cell: (one) => h("span", { title: one.full }, one.full) },
    { key: "package", title: "package", width: "minmax(5rem, 1fr)", compare: (a, b) => compare(a.package, b.package), cell: (one) => one.package },
    { key: "state", title: "state", width: "5rem", compare: (a, b) => compare(a.state, b.state), cell: (one) => one.state },
  ];

  const matches = (one) => {
    for (const name of FILTERS) if (wanted[name] && wanted[name] !== "any" && one[name === "rule" ? "full" : name] !== wanted[name]) return false;
    if (wanted.path && !one.place.path.startsWith(wanted.path)) return false;
    if (wanted.tag && !(wanted.tag.startsWith("not ") ? !tagsOf(one).includes(wanted.tag.slice(4)) : tagsOf(one).includes(wanted.tag))) return false;
    if (wanted.configuration && !about(wanted.configuration).has(one)) return false;
    return words.every((word) => haystack(one).includes(word));
  };
  const about = (name) => inConfiguration.get(name) || inConfiguration.set(name, findingsAbout(name)).get(name);
  let words = [];
  const haystack = (one) => (one.haystack ??= `${one.message} ${one.place.path} ${one.full} ${one.package} ${texts(one.row[13]).join(" ")}`.toLowerCase());

  const table = virtualTable({
    label: "findings", columns, rows: [], sort,
    sorted: (column, down) => { remember({ sort: `${column}-${down ? "down" : "up"}` }); show(); },
    select: (one) => { remember({ id: one.id }); clear(detail, findingDetail(one, () => { clear(detail); detail.classList.remove("open"); remember({ id: "" }); })); detail.classList.add("open"); detail.scrollTop = 0; },
  });

  const ordered = table.order(FINDINGS);
  function refresh() {
    words = wanted.q.toLowerCase().split(/\s+/).filter(Boolean);
    const list = ordered.filter(matches);
    table.set(list, true);
    total.textContent = `${list.length.toLocaleString("en")} of ${count(FINDINGS.length, "finding")}`;
    return list;
  }
  const change = (name) => (value) => { wanted[name] = value; remember({ [name]: value, id: "" }); refresh(); };
  const values = (name, key) => [["", `any ${name}`], ...grouped(FINDINGS, (one) => one[key || name] || "").filter(([value]) => value).map(([value, list]) => [value, `${value} (${list.length})`])];
  const tags = tagCounts();
  const list = refresh();
  const start = wanted.id ? BY_ID.get(wanted.id) : null;
  if (start) requestAnimationFrame(() => table.chooseRow(table.has(start) ? start : list[0], table.has(start)));
  const pathField = h("input", { type: "text", value: wanted.path, placeholder: "src/…", "aria-label": "path begins with" });
  pathField.addEventListener("input", later(() => change("path")(pathField.value), 80));
  return {
    wide: true,
    escape: () => { clear(detail); detail.classList.remove("open"); remember({ id: "" }); },
    content: [
      h("div", { class: "bar-of-filters" },
        searchField("Search findings", wanted.q, change("q")),
        chooser("level", [["", "any level"], ...LEVELS.map((one) => [one, one])], wanted.level, change("level")),
        chooser("state", [["any", "any state"], ...states.map((one) => [one, one])], wanted.state || "any", change("state")),
        chooser("tool", values("tool"), wanted.tool, change("tool")), chooser("rule", values("rule", "full"), wanted.rule, change("rule")),
        chooser("package", values("package"), wanted.package, change("package")),
        tags.length ? chooser("tag", [["", "any tag"], ...tags.map(([name, number]) => [name, `${name} (${number})`]), ...tags.map(([name]) => [`not ${name}`, `not ${name}`])], wanted.tag, change("tag")) : null,
        CONFIGURATIONS.length ? chooser("configuration", [["", "any configuration"], ...CONFIGURATIONS.filter((one) => one.launch.length || one.name === wanted.configuration).map((one) => [one.name, one.name])], wanted.configuration, change("configuration")) : null,
        h("label", { class: "choice" }, h("span", null, "path"), pathField), total),
      h("div", { class: "split" }, table.element, detail),
    ],
  };
}

const STATE_WORDS = { open: "to be looked at; in a run with a base revision, new", known: "was there at the base revision, or is in the baseline", gone: "was there at the base revision and is no more", suppressed: "silenced by a comment or the project file", counted: "only counted, by the settings" };

const tagsOf = (one) => { const rule = RULES.get(one.full); return rule ? (rule.words ??= texts(rule.tags)) : []; };

// The tags of the rules that have findings, with how many, the most frequent first.
function tagCounts() {
  const found = new Map();
  for (const one of FINDINGS) for (const tag of tagsOf(one)) found.set(tag, (found.get(tag) || 0) + 1);
  return [...found].sort((a, b) => b[1] - a[1] || compare(a[0], b[0]));
}

// What is said of a configuration: by its name, or about names that are all in it.
function findingsAbout(name) {
  const one = BY_CONFIGURATION.get(name);
  if (!one) return new Set();
  return new Set([...system(one.index).findings.values()].flat().concat(FINDINGS.filter((each) => text(each.row[17]) === name)));
}

// Lines of source, with what is meant in them marked.
function frame(at, endLine, endColumn, around) {
  if (!at || !at.line) return null;
  const until = Math.min(Math.max(at.line, endLine || 0), at.line + 12);
  const shown = lines(at.path, at.line - around, until + around);
  if (!shown.length) return null;
  return h("pre", { class: "code", tabindex: "0" }, shown.map(([number, line]) => {
    const inside = number >= at.line && number <= until;
    const from = number === at.line && at.column ? at.column - 1 : 0;
    const letters = [...line];
    const to = number === (endLine || at.line) && endColumn ? endColumn - 1 : letters.length;
    const content = inside && at.column && from < letters.length && to > from ? [letters.slice(0, from).join(""), h("mark", null, letters.slice(from, to).join("")), letters.slice(to).join("")] : line;
    return h("span", { class: inside ? "line meant" : "line" }, h("span", { class: "number" }, String(number).padStart(5), inside ? " ▶ " : "   "), content, "\n");
  }));
}

function steps(list, title, ordered) {
  if (!list.length) return null;
  return h("details", { open: list.length < 8 }, h("summary", null, `${title} (${list.length})`), h(ordered ? "ol" : "ul", { class: "steps" }, list.map((one) =>
    h("li", null, one.text ? `${one.text} – ` : "", whereIs(one.place), frame(one.place, 0, 0, 1)))));
}

function asMarkdown(one, detail) {
  const shown = lines(one.place.path, one.place.line - 2, one.place.line + 2).map(([number, line]) => `${number}  ${line}`).join("\n");
  return [`**${one.level}** ${one.place.text}: ${one.message} [${one.full}]`, shown ? `\n~~~\n${shown}\n~~~` : "", ...detail.related.map((each) => `- ${each.text} ${each.place ? each.place.text : ""}`)].filter(Boolean).join("\n");
}

function suppression(one) {
  const comment = /\.(py)$/.test(one.place.path) ? "#" : /\.(xml|launch|urdf|xacro|sdf)$/.test(one.place.path) ? "<!--" : /\.(c|cc|cpp|cxx|h|hh|hpp|hxx)$/.test(one.place.path) ? "//" : "#";
  return `${comment} haros: ignore[${one.full}] reason${comment === "<!--" ? " -->" : ""}`;
}

const nameSets = new Map();

// The names of nodes and of what connects them in a configuration.
function namesIn(index) {
  if (!nameSets.has(index)) {
    const found = new Set();
    for (const one of CONFIGURATIONS[index].row.nodes) {
      const row = TABLES.nodes[one];
      found.add(text(row[0]));
      for (const each of row[14]) if (CHANNELS[D.kinds[TABLES.ends[each][0]]]) found.add(text(TABLES.ends[each][1]));
    }
    nameSets.set(index, found);
  }
  return nameSets.get(index);
}

// The configuration that has the most of these names, "" for none.
function configurationWith(names) {
  let [best, most] = ["", 0];
  for (const one of names.length ? CONFIGURATIONS : []) {
    const has = names.filter((name) => namesIn(one.index).has(name)).length;
    if (has > most) [best, most] = [one.name, has];
  }
  return best;
}

function findingDetail(one, close) {
  const detail = more(one);
  const rule = RULES.get(one.full);
  const markdownButton = h("button", { onclick: () => copy(asMarkdown(one, detail), markdownButton) }, "Copy as Markdown");
  const placeButton = h("button", { onclick: () => copy(one.place.text, placeButton) }, "Copy place");
  const configuration = BY_CONFIGURATION.has(detail.graph) ? detail.graph : configurationWith(detail.subject);
  const known = configuration ? namesIn(BY_CONFIGURATION.get(configuration).index) : new Set();
  return [
    h("div", { class: "detail-head" }, h("span", { class: `level ${one.level}` }, one.level), " ", h("strong", null, one.full), h("button", { class: "close", "aria-label": "close", onclick: close }, "✕")),
    h("p", { class: "message" }, one.message),
    h("p", null, whereIs(one.place), detail.scope ? [" in ", h("code", null, detail.scope)] : null),
    frame(one.place, one.endLine, one.endColumn, 3),
    h("div", { class: "buttons" }, markdownButton, placeButton, link("findings", { id: one.id, state: "any" }, "Link to this finding")),
    h("dl", null,
      h("dt", null, "state"), h("dd", null, one.state, detail.reason ? `: ${detail.reason}` : STATE_WORDS[one.state] ? ` (${STATE_WORDS[one.state]})` : "", detail.suppressions.length ? ` (${detail.suppressions.join("; ")})` : ""),
      detail.value !== null ? [h("dt", null, "value"), h("dd", null, `${detail.value}${detail.limit !== null ? `, limit ${detail.limit}` : ""}`)] : null,
      detail.subject.length ? [h("dt", null, "about"), h("dd", null, detail.subject.map((name, index) => [index ? ", " : "", known.has(name) ? link("system", { configuration, element: name }, name) : name]), configuration ? [" in ", link("system", { configuration }, breakable(configuration))] : null)] : null,
      detail.also.length ? [h("dt", null, "also reported as"), h("dd", null, detail.also.join(", "))] : null,
      detail.fixes.length ? [h("dt", null, "check --fix can"), h("dd", null, detail.fixes.join("; "))] : null),
    steps(detail.flow, "How it comes to this", true), steps(detail.related, "Related places", false), steps(detail.copies, "The same in copies of the file", false),
    rule ? h("details", { open: true }, h("summary", null, "The rule"), h("p", null, text(rule.summary)), h("div", { class: "page-of-rule" }, markdown(rule.help)), text(rule.address) ? h("p", { class: "quiet" }, h("code", null, text(rule.address))) : null) : null,
    h("details", null, h("summary", null, "How to suppress it"), h("p", null, "On the line, or the line before, with the reason:"), h("pre", { tabindex: "0" }, suppression(one)), h("p", null, "For the project, in .haros-ci.yaml:"), h("pre", { tabindex: "0" }, `ignore: ["${one.full}"]`)),
  ];
}
