// The programs that are nodes: in which configurations each runs, and under which names.
function programRows() {
  const found = new Map();
  for (const one of CONFIGURATIONS)
    for (const index of one.row.nodes) {
      const row = TABLES.nodes[index];
      const [name, of, type] = [text(row[0]), text(row[2]), text(row[3])];
      const key = `${of}/${type}`;
      const made = found.get(key) || found.set(key, { key, package: of, type, classes: new Set(), uses: [], names: new Set(), configurations: new Set(), ends: 0 }).get(key);
      made.uses.push({ configuration: one.name, name });
      made.names.add(name);
      if (row[4] >= 0) made.classes.add(text(row[4]));
      made.configurations.add(one.name);
      made.ends = Math.max(made.ends, row[14].filter((each) => CHANNELS[D.kinds[TABLES.ends[each][0]]] && !(TABLES.ends[each][4] & 1)).length);
    }
  return [...found.values()].sort((a, b) => Number(!isKnown(a.key)) - Number(!isKnown(b.key)) || compare(a.key, b.key));
}

function programsView(parameters) {
  const list = programRows();
  const detail = h("aside", { class: "detail", "aria-label": "program", "aria-live": "polite" });
  const total = h("span", { class: "quiet", role: "status" });
  const close = () => { clear(detail); detail.classList.remove("open"); remember({ program: "" }); };
  const names = (one) => [...one.names].sort(compare).join(", ");
  const columns = [
    { key: "program", title: "program", width: "minmax(9rem, 2fr)", compare: (a, b) => compare(a.type, b.type), cell: (one) => h("span", { title: one.key }, one.type) },
    { key: "package", title: "package", width: "minmax(7rem, 1.5fr)", compare: (a, b) => compare(a.package, b.package), cell: (one) => one.package },
    { key: "names", title: "nodes", width: "minmax(9rem, 3fr)", compare: (a, b) => compare(names(a), names(b)), cell: (one) => h("span", { title: names(one) }, names(one)) },
    { key: "configurations", title: "configurations", width: "8rem", class: "number", down: true, compare: (a, b) => a.configurations.size - b.configurations.size, cell: (one) => one.configurations.size.toLocaleString("en") },
    { key: "ends", title: "endpoints", width: "6rem", class: "number", down: true, compare: (a, b) => a.ends - b.ends, cell: (one) => one.ends.toLocaleString("en") },
  ];
  const [key, direction] = (parameters.sort || "").split("-");
  const table = virtualTable({ label: "programs", columns, rows: list, sort: { column: key, down: direction === "down" }, sorted: (column, down) => { remember({ sort: `${column}-${down ? "down" : "up"}` }); show(); },
    select: (one) => { remember({ program: one.key }); detail.classList.add("open"); clear(detail, programDetail(one, close)); detail.scrollTop = 0; } });
  const apply = (words) => {
    const wanted = words.toLowerCase();
    const found = table.order(list).filter((one) => `${one.key} ${names(one)}`.toLowerCase().includes(wanted));
    table.set(found, true);
    total.textContent = `${found.length.toLocaleString("en")} of ${count(list.length, "program")}`;
  };
  apply(parameters.q || "");
  const start = list.find((one) => one.key === parameters.program);
  if (start) requestAnimationFrame(() => table.chooseRow(start, true));
  return { wide: true, escape: close, content: [h("div", { class: "bar-of-filters" }, searchField("Search programs", parameters.q || "", (words) => { remember({ q: words }); apply(words); }), total), h("div", { class: "split" }, table.element, detail)] };
}

function programDetail(one, close) {
  const listed = one.uses.slice(0, 300);
  return [
    h("div", { class: "detail-head" }, h("strong", null, one.type), h("button", { class: "close", "aria-label": "close", onclick: close }, "✕")),
    h("dl", null, row("package", one.package ? link("packages", { package: one.package }, one.package) : ""), row(one.classes.size > 1 ? "classes" : "class", [...one.classes].filter((each) => each && each !== one.type).sort(compare).join(", "))),
    h("section", null, h("h3", null, `Runs as (${one.uses.length})`), h("ul", { class: "plain-list" }, listed.map((each) => h("li", null, link("system", { configuration: each.configuration, element: each.name }, each.name), " in ", link("system", { configuration: each.configuration }, each.configuration)))), one.uses.length > listed.length ? h("p", { class: "quiet" }, `and ${one.uses.length - listed.length} more`) : null),
  ];
}
