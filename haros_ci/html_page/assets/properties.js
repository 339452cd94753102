// The properties in HPL: what each says, about whom, where it stands, and what is wrong with it.
const PROPERTIES = D.properties.map((one, index) => ({
  index, kind: one.kind, owner: text(one.owner), granted: one.granted === 1, id: text(one.id), title: text(one.title), description: text(one.description), text: text(one.text),
  place: place(one.place), until: one.until, fault: text(one.fault), topics: one.topics.map(([topic, names]) => [text(topic), texts(names)]), configurations: texts(one.configurations),
}));
// What a link leads to: the id of the property, else its text, which stay when lines move.
for (const one of PROPERTIES) one.key = one.id || one.text;
joinVerdicts();

// Open and known findings at the lines of a property.
const findingsOn = (one) => FINDINGS.filter((each) => each.rule.startsWith("hpl-") && (each.state === "open" || each.state === "known") && each.place.path === one.place.path && each.place.line >= one.place.line && each.place.line <= one.until);
const aboutWords = (one) => (one.kind === "asked" ? "" : one.owner ? `${one.kind} ${one.owner}` : "the workspace");

function propertiesView(parameters) {
  const list = PROPERTIES.map((one) => ({ ...one, findings: findingsOn(one) }));
  const detail = h("aside", { class: "detail", "aria-label": "property", "aria-live": "polite" });
  const total = h("span", { class: "quiet", role: "status" });
  const close = () => { clear(detail); detail.classList.remove("open"); remember({ property: "" }); };
  const worst = (one) => (one.findings.length ? Math.min(...one.findings.map((each) => each.rank)) : LEVELS.length);
  const columns = [
    { key: "text", title: "property", width: "minmax(11rem, 5fr)", compare: (a, b) => compare(a.text, b.text), cell: (one) => h("code", { title: one.text }, one.text) },
    ...(list.some((one) => one.id || one.title) ? [{ key: "id", title: "id, title", width: "minmax(4.5rem, 1.5fr)", compare: (a, b) => compare(a.id || a.title, b.id || b.title), cell: (one) => [one.id, one.title].filter(Boolean).join(": ") }] : []),
    { key: "about", title: "about", width: "minmax(5rem, 2fr)", compare: (a, b) => compare(aboutWords(a), aboutWords(b)), cell: (one) => h("span", { title: aboutWords(one) }, aboutWords(one)) },
    { key: "kind", title: "kind", width: "6.5rem", compare: (a, b) => Number(a.granted) - Number(b.granted), cell: (one) => (one.kind === "asked" ? "asked of a recording" : one.fault ? h("span", { class: "remark" }, "not readable") : one.granted ? "assumption" : "promise") },
    ...(RECORDINGS.length ? [{ key: "verdict", title: "recordings", width: "minmax(8.6rem, 1.2fr)", compare: (a, b) => worstVerdict(a) - worstVerdict(b), cell: verdictCell }] : []),
    { key: "findings", title: "findings", width: "5rem", compare: (a, b) => worst(a) - worst(b) || b.findings.length - a.findings.length, cell: (one) => (one.findings.length ? h("span", { class: `level ${LEVELS[worst(one)]}` }, String(one.findings.length)) : "") },
    { key: "place", title: "place", width: "minmax(5rem, 1.5fr)", class: "path", compare: (a, b) => compare(a.place.path, b.place.path) || a.place.line - b.place.line, cell: (one) => h("span", { title: one.place.text }, h("bdi", null, one.place.text)) },
  ];
  const [key, direction] = (parameters.sort || (RECORDINGS.length ? "verdict-up" : "")).split("-");
  const table = virtualTable({ label: "properties", columns, rows: list, sort: { column: key, down: direction === "down" }, sorted: (column, down) => { remember({ sort: `${column}-${down ? "down" : "up"}` }); show(); },
    select: (one) => { remember({ property: one.key }); detail.classList.add("open"); clear(detail, propertyDetail(one, close)); detail.scrollTop = 0; } });
  const apply = (words) => {
    const wanted = words.toLowerCase();
    const found = table.order(list).filter((one) => `${one.text} ${one.id} ${one.title} ${one.owner} ${one.place.path}`.toLowerCase().includes(wanted));
    table.set(found, true);
    total.textContent = `${found.length.toLocaleString("en")} of ${list.length === 1 ? "1 property" : `${list.length.toLocaleString("en")} properties`}`;
  };
  apply(parameters.q || "");
  const start = list.find((one) => one.key === parameters.property);
  if (start) requestAnimationFrame(() => table.chooseRow(start, true));
  return { wide: true, escape: close, content: [recordingsLine(), h("div", { class: "bar-of-filters" }, searchField("Search properties", parameters.q || "", (words) => { remember({ q: words }); apply(words); }), total), h("div", { class: "split" }, table.element, detail)] };
}

function propertyDetail(one, close) {
  const configuration = one.configurations.find((name) => BY_CONFIGURATION.has(name));
  const topicItem = ([topic, names]) => h("li", null, h("code", null, topic), names.length ? [": ", names.map((name, index) => [index ? ", " : "", configuration ? link("system", { configuration, element: name }, name) : name])] : h("span", { class: "remark" }, " no end of it is known"));
  return [
    h("div", { class: "detail-head" }, h("strong", null, one.title || one.id || "property"), h("button", { class: "close", "aria-label": "close", onclick: close }, "✕")),
    h("pre", { tabindex: "0", class: "property" }, one.text),
    one.fault ? h("p", { class: "warning" }, `It cannot be read: ${one.fault}.`) : null,
    one.description ? h("p", null, one.description) : null,
    h("dl", null, row("id", one.id), row("about", aboutWords(one)), row("kind", one.kind === "asked" ? "asked of a recording alone" : one.granted ? "assumption: it is taken for granted" : "promise"), row("stands at", one.place.text ? whereIs(one.place) : ""),
      row("configurations", one.configurations.map((name, index) => [index ? ", " : "", BY_CONFIGURATION.has(name) ? link("system", { configuration: name }, name) : name]))),
    one.verdicts.map(verdictSection),
    one.findings.length ? h("section", null, h("h3", null, `Findings (${one.findings.length})`), h("ul", { class: "plain-list" }, one.findings.map((each) => h("li", null, h("span", { class: `level ${each.level}` }, each.level), " ", link("findings", { id: each.id, state: "any" }, each.message))))) : null,
    one.topics.length ? h("section", null, h("h3", null, "Topics"), h("ul", { class: "plain-list" }, one.topics.map(topicItem))) : null,
    frame(one.place, one.until, 0, 2),
  ];
}
