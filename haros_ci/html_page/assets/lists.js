// Parameters, packages and interfaces as tables.
function parametersView(parameters) {
  const which = chosenConfiguration(parameters.configuration);
  if (!which) return { content: [h("h1", null, "Parameters"), h("p", null, "No node was found.")] };
  const made = system(which.index);
  const list = [...parameterTable(made).values()];
  const columns = [
    { key: "name", title: "name", width: "minmax(12rem, 3fr)", class: "path", compare: (a, b) => compare(a.name, b.name), cell: (one) => h("span", { title: one.name }, h("bdi", null, one.name)) },
    { key: "value", title: "value", width: "minmax(8rem, 1.5fr)", compare: (a, b) => compare(String(a.value ?? ""), String(b.value ?? "")), cell: (one) => (one.value !== null ? h("code", { title: one.value }, one.value) : one.fallback !== null ? h("span", { class: "quiet" }, `${one.fallback} (default)`) : "") },
    { key: "default", title: "default", width: "minmax(6rem, 1fr)", cell: (one) => one.fallback ?? "" },
    { key: "set", title: "set at", width: "minmax(10rem, 2fr)", class: "path", compare: (a, b) => compare(a.setAt, b.setAt), cell: (one) => h("span", { title: one.setAt }, h("bdi", null, one.setAt)) },
    { key: "read", title: "declared or read by", width: "minmax(9rem, 1.4fr)", class: "path", compare: (a, b) => compare(a.readBy, b.readBy), cell: (one) => h("span", { title: one.readBy }, h("bdi", null, one.readBy)) },
    { key: "mark", title: "remark", width: "9rem", compare: (a, b) => compare(a.mark, b.mark), cell: (one) => (one.mark ? h("span", { class: "remark" }, one.mark) : "") },
  ];
  const [key, direction] = (parameters.sort || "").split("-");
  const total = h("span", { class: "quiet", role: "status" });
  const detail = h("aside", { class: "detail", "aria-label": "parameter", "aria-live": "polite" });
  const close = () => { clear(detail); detail.classList.remove("open"); };
  const table = virtualTable({ label: "parameters", columns, rows: list, sort: { column: key, down: direction === "down" }, sorted: (column, down) => { remember({ sort: `${column}-${down ? "down" : "up"}` }); show(); },
    select: (one) => { detail.classList.add("open"); clear(detail, h("div", { class: "detail-head" }, h("strong", null, one.name), h("button", { class: "close", "aria-label": "close", onclick: close }, "✕")), parameterDetail(made, one)); } });
  const apply = (words) => { const wanted = words.toLowerCase(); const found = list.filter((one) => !wanted || `${one.name} ${one.value} ${one.setAt} ${one.readBy} ${one.mark}`.toLowerCase().includes(wanted)); table.set(found); total.textContent = `${found.length.toLocaleString("en")} of ${count(list.length, "parameter")}`; };
  apply(parameters.q || "");
  return { wide: true, escape: close, content: [h("div", { class: "bar-of-filters" }, configurationChooser(made.name, (name) => { location.hash = address("parameters", { configuration: name }); }), searchField("Search parameters", parameters.q || "", (words) => { remember({ q: words }); apply(words); }), total), h("div", { class: "split" }, table.element, detail)] };
}

function packagesView(parameters) {
  const found = grouped(FINDINGS.filter((one) => one.state === "open"), (one) => one.package);
  const findings = new Map(found.map(([name, list]) => [name, list.length]));
  const list = D.packages.map((one) => ({ name: text(one.name), path: text(one.path), version: text(one.version), build: text(one.build), files: one.files, lines: one.lines, all: one.lines.reduce((sum, each) => sum + each, 0), circle: one.circle, needs: one.needs.map(([name, kind, here]) => ({ name: text(name), kind, here: here === 1 })) }));
  const neededBy = new Map();
  for (const one of list) for (const each of one.needs) if (each.here) (neededBy.get(each.name) || neededBy.set(each.name, new Set()).get(each.name)).add(one.name);
  for (const one of list) { one.findings = findings.get(one.name) || 0; one.ratio = one.all ? (1000 * one.findings) / one.all : 0; one.inner = [...new Set(one.needs.filter((each) => each.here).map((each) => each.name))]; one.users = [...(neededBy.get(one.name) || [])].sort(compare); }
  const most = Math.max(1, ...list.map((one) => one.ratio));
  const number = (title, key, get, width) => ({ key, title, width: width || "5.5rem", class: "number", down: true, compare: (a, b) => get(a) - get(b), cell: (one) => (get(one) ? get(one).toLocaleString("en") : "") });
  const columns = [
    { key: "name", title: "package", width: "minmax(13rem, 2fr)", class: "path", compare: (a, b) => compare(a.name, b.name), cell: (one) => h("span", { title: `${one.name}: ${one.path}` }, h("bdi", null, one.name, one.circle >= 0 ? h("span", { class: "remark" }, ` cycle ${one.circle + 1}`) : "")) },
    number("files", "files", (one) => one.files, "4rem"), ...D.languages.map((name, index) => number(LANGUAGE_NAMES[name].replace(" files (XML)", ""), name, (one) => one.lines[index], name === "interface" ? "5rem" : "4.3rem")).filter((_, index) => list.some((one) => one.lines[index])),
    number("findings", "findings", (one) => one.findings, "4.6rem"), number("per 1,000 lines", "ratio", (one) => Number(one.ratio.toFixed(one.ratio < 0.1 ? 2 : 1)), "7.6rem"),
    { key: "bar", title: "", width: "4.2rem", cell: (one) => bar(one.ratio / most, "fill heat") }, number("depends on", "needs", (one) => one.inner.length, "6rem"), number("needed by", "users", (one) => one.users.length, "5.4rem"),
  ];
  const [key, direction] = (parameters.sort || "").split("-");
  const detail = h("aside", { class: "detail", "aria-label": "package", "aria-live": "polite" });
  const close = () => { clear(detail); detail.classList.remove("open"); remember({ package: "" }); };
  const names = (all) => all.map((name, index) => [index ? ", " : "", link("packages", { package: name }, name)]);
  const table = virtualTable({ label: "packages", columns, rows: list, sort: { column: key, down: key && direction !== "up" && key !== "name" }, sorted: (column, down) => { remember({ sort: `${column}-${down ? "down" : "up"}` }); show(); }, select: (one) => { remember({ package: one.name }); describe(one); } });
  function describe(one) {
    const circle = one.circle >= 0 ? list.filter((each) => each.circle === one.circle).map((each) => each.name) : [];
    detail.classList.add("open");
    clear(detail, h("div", { class: "detail-head" }, h("strong", null, one.name), h("button", { class: "close", "aria-label": "close", onclick: close }, "✕")),
      circle.length ? h("p", { class: "warning" }, "A dependency cycle, these need each other to be built: ", names(circle)) : null,
      h("dl", null, row("directory", h("code", null, one.path)), row("version", one.version), row("build type", one.build), row("findings", one.findings ? link("findings", { package: one.name }, String(one.findings)) : "0"), row("lines", D.languages.map((name, index) => (one.lines[index] ? `${LANGUAGE_NAMES[name]} ${one.lines[index].toLocaleString("en")}` : "")).filter(Boolean).join(", ")),
        row("depends on, in this workspace", names(one.inner)), row("needed by", names(one.users)), row("depends on, elsewhere", [...new Set(one.needs.filter((each) => !each.here).map((each) => each.name))].join(", "))));
  }
  const asPicture = parameters.as === "picture" && D.package_picture;
  const drawn = asPicture ? packagePicture(list, most, (one) => { if (one) { remember({ package: one.name }); describe(one); } else close(); }) : null;
  const find = (words) => list.filter((one) => !words || one.name.toLowerCase().includes(words.toLowerCase()));
  const apply = (words) => { if (!drawn) table.set(find(words)); else if (words && find(words).length) drawn.show(find(words).sort((a, b) => a.name.length - b.name.length)[0]); };
  const start = list.find((one) => one.name === parameters.package);
  if (start) requestAnimationFrame(() => { if (drawn) drawn.show(start); else { table.chooseRow(start, false); describe(start); } });
  const other = D.package_picture ? h("button", { onclick: () => { remember({ as: asPicture ? "" : "picture" }); show(); } }, asPicture ? "Table" : "Picture") : null;
  return { wide: true, escape: close, content: [h("div", { class: "bar-of-filters" }, searchField("Search packages", "", apply), other, drawn ? zoomButtons(drawn.picture) : null, h("span", { class: "quiet" }, count(list.length, "package"), drawn ? ": from what is built first to what is built last; dependencies that follow from others are left out. The taller, the more lines; the darker, the more findings per line" : "")), h("div", { class: "split" }, drawn ? h("div", { class: "stage" }, drawn.element) : table.element, detail)] };
}

// What packages need of each other, the warmer the more findings a package has for its lines.
function packagePicture(list, most, select) {
  const { size, places, edges } = D.package_picture;
  const heat = (one) => (one.findings ? Math.min(3, 1 + Math.floor((3 * one.ratio) / (most + 0.001))) : 0);
  const elements = list.map((one, index) => ({ id: `p${index}`, isNode: true, isCentred: true, what: "node", box: -1, rectangle: places[index], title: one.name, lines: [], sub: one.findings ? `${count(one.findings, "finding")}, ${count(one.all, "line")}` : count(one.all, "line"), classes: [`heat-${heat(one)}`, one.circle >= 0 ? "red" : ""].filter(Boolean), tip: [one.name, count(one.findings, "finding"), one.circle >= 0 ? `in cycle ${one.circle + 1}` : ""].filter(Boolean).join("\n") }));
  const made = makePicture({ label: "what packages need of each other", select: (id) => select(id ? list[Number(id.slice(1))] : null) });
  made.show({ size, boxes: [], elements, edges: edges.map(([from, to, points]) => ({ from: `p${from}`, to: `p${to}`, channel: `p${to}`, points, classes: [], tip: `${list[to].name} needs ${list[from].name}` })) });
  requestAnimationFrame(() => made.begin());
  return { element: made.element, picture: made, show: (one) => { const id = `p${list.indexOf(one)}`; made.choose(id); made.centre(id); } };
}

function interfacesView(parameters) {
  const uses = new Map();
  for (const one of CONFIGURATIONS)
    for (const index of one.row.nodes)
      for (const each of TABLES.nodes[index][14]) {
        const row = TABLES.ends[each];
        const kind = D.kinds[row[0]];
        if (!CHANNELS[kind] || row[3] < 0 || row[4] & 1) continue;
        const type = text(row[3]);
        const entry = uses.get(type) || uses.set(type, new Map()).get(type);
        const key = `${text(TABLES.nodes[index][0])} ${WORDS[kind]} ${text(row[1])}`;
        if (!entry.has(key)) entry.set(key, { node: text(TABLES.nodes[index][0]), kind, name: text(row[1]), configuration: one.name });
      }
  const names = new Set([...INTERFACES.keys(), ...[...uses.keys()].filter((type) => !interfaceOf(type))]);
  const usesOf = (name) => [...uses].filter(([type]) => type === name || (INTERFACES.has(name) && interfaceOf(type) === INTERFACES.get(name))).flatMap(([, found]) => [...found.values()]);
  const list = [...names].sort(compare).map((name) => ({ name, known: INTERFACES.get(name), uses: usesOf(name) }));
  for (const one of list) { one.kind = one.known ? one.known.kind : kindOf(one.uses[0]); one.gives = one.uses.filter((each) => OFFERS.has(each.kind)).length; one.takes = one.uses.length - one.gives; }
  const columns = [
    { key: "name", title: "interface", width: "minmax(14rem, 3fr)", compare: (a, b) => compare(a.name, b.name), cell: (one) => h("span", { title: one.name }, one.name) },
    { key: "kind", title: "kind", width: "6rem", compare: (a, b) => compare(a.kind, b.kind), cell: (one) => one.kind },
    { key: "here", title: "defined", width: "9rem", compare: (a, b) => Number(Boolean(b.known)) - Number(Boolean(a.known)), cell: (one) => (one.known ? "in the workspace" : "elsewhere") },
    { key: "gives", title: "offered by", width: "6rem", class: "number", down: true, compare: (a, b) => a.gives - b.gives, cell: (one) => one.gives || "" },
    { key: "takes", title: "used by", width: "6rem", class: "number", down: true, compare: (a, b) => a.takes - b.takes, cell: (one) => one.takes || "" },
  ];
  const [key, direction] = (parameters.sort || "").split("-");
  const detail = h("aside", { class: "detail", "aria-label": "interface", "aria-live": "polite" });
  const close = () => { clear(detail); detail.classList.remove("open"); };
  const table = virtualTable({ label: "interfaces", columns, rows: list, sort: { column: key, down: direction === "down" }, sorted: (column, down) => { remember({ sort: `${column}-${down ? "down" : "up"}` }); show(); },
    select: (one) => { detail.classList.add("open"); clear(detail, h("div", { class: "detail-head" }, h("strong", null, one.name), h("button", { class: "close", "aria-label": "close", onclick: close }, "✕")), one.known ? typeDetail(one.name) : h("p", { class: "quiet" }, "Its definition is not in the workspace."),
      h("h3", null, `offered or used (${one.uses.length})`), one.uses.length ? h("ul", { class: "plain-list" }, one.uses.slice(0, 300).map((each) => h("li", null, link("system", { configuration: each.configuration, element: each.node }, each.node), ` ${WORDS[each.kind]} `, link("system", { configuration: each.configuration, element: each.name }, each.name)))) : h("p", { class: "quiet" }, "by no node that is known here")); } });
  const apply = (words) => table.set(list.filter((one) => !words || one.name.toLowerCase().includes(words.toLowerCase())));
  return { wide: true, escape: close, content: [h("div", { class: "bar-of-filters" }, searchField("Search interfaces", "", apply), h("span", { class: "quiet" }, `${D.interfaces.length} defined here, ${list.length} in all`)), h("div", { class: "split" }, table.element, detail)] };
}

const kindOf = (use) => (use ? { topics: "msg", services: "srv", actions: "action" }[CHANNELS[use.kind]] : "");
