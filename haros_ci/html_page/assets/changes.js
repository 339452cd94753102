// What the change does to the system: the table of haros-ci diff, and the part of the graph that it touches.
const SIGNS = { added: "+", removed: "−", changed: "~", renamed: "→" };

function changesView(parameters) {
  const found = D.changes;
  const summary = D.summary;
  const fresh = FINDINGS.filter((one) => one.state === "open").length;
  const gone = FINDINGS.filter((one) => one.state === "gone").length;
  const base = revision(text(summary.compared));
  const rows = found.rows.map(([what, action, title, names, old, before, after, nodes, programs, configurations, users, details, at]) => ({ what, action, title: text(title), names: texts(names), old: texts(old), before: before < 0 ? null : text(before), after: after < 0 ? null : text(after), nodes: texts(nodes), programs: texts(programs), configurations: texts(configurations), users: texts(users), details: texts(details), place: place(at) }));
  const filter = parameters.what || "";
  const kinds = [...new Set(rows.map((one) => one.what))];
  const shown = rows.filter((one) => !filter || one.what === filter);
  const several = (list, most) => list.slice(0, most).join(", ") + (list.length > most ? ` and ${list.length - most} more` : "");
  const where = (one) => { const configuration = one.configurations.find((name) => BY_CONFIGURATION.has(name)); return configuration ? [link("system", { configuration, element: one.nodes[0] || one.names[0] }, breakable(several(one.nodes.length ? one.nodes : one.programs, 3))), one.configurations.length > 1 ? ` (${count(one.configurations.length, "configuration")})` : ""] : breakable(several(one.nodes.length ? one.nodes : one.programs, 3)); };
  const table = smallTable(["", "change", "name", "before", "after", "nodes", "used by", "place"], shown.map((one) => [h("span", { class: `sign ${one.action}`, title: one.action }, SIGNS[one.action] || ""), one.title, [one.old.length ? `${several(one.old, 3)} → ` : "", breakable(several(one.names, 3))], one.before !== null ? h("code", null, breakable(cut(one.before, 160))) : "", one.after !== null ? h("code", null, breakable(cut(one.after, 160))) : "", where(one), breakable(several(one.users, 3)), whereIs(one.place)]), "changes");
  return {
    content: [
      h("h1", null, "Changes"), h("p", { class: "lead" }, found.headline >= 0 ? text(found.headline) : "No change to interfaces, nodes, topics, services, actions or parameters", base ? ` since ${base}` : "", "."),
      h("div", { class: "figures" }, figure(rows.length, "changes", "changes"), D.only ? null : figure(fresh, "new findings", "findings", { state: "open" }), gone ? figure(gone, "findings gone", "findings", { state: "gone" }) : null, found.not_known ? figure(found.not_known, "left out, as one side is not known") : null),
      found.picture ? h("section", { class: "card" }, h("h2", null, "The part of the graph that has changed"), changePicture(found.picture), h("p", { class: "quiet" }, "Green with + is added, red with − is removed, amber with ~ is changed; thin lines were there before.")) : null,
      rows.length ? h("section", { class: "card" }, h("h2", null, "All changes"), kinds.length > 1 ? chooser("kind", [["", "every kind"], ...kinds.map((one) => [one, one])], filter, (value) => { remember({ what: value }); show(); }) : null, table) : null,
    ],
  };
}

function changePicture(picture) {
  const state = (name) => (name ? [name] : []);
  const touched = (index, isNode) => { const list = picture.edges.filter(([node, channel]) => (isNode ? node : channel) === index); const states = [...new Set(list.map((one) => one[3]))]; return states.length === 1 ? states[0] : ""; };
  const elements = [
    ...picture.nodes.map(([name, own, ...rectangle], index) => ({ id: `n${index}`, isNode: true, what: "node", box: -1, rectangle, title: `${SIGNS[own] ? `${SIGNS[own]} ` : ""}${last(text(name))}`, sub: text(name), lines: [], classes: state(own), tip: text(name) })),
    ...picture.channels.map(([what, name, ...rectangle], index) => { const own = touched(index, false); return { id: `c${index}`, isNode: false, what, box: -1, rectangle, title: `${SIGNS[own] ? `${SIGNS[own]} ` : ""}${text(name)}`, lines: [], classes: state(own), tip: text(name) }; }),
  ];
  const edges = picture.edges.map(([node, channel, gives, own, points]) => ({ from: gives ? `n${node}` : `c${channel}`, to: gives ? `c${channel}` : `n${node}`, channel: `c${channel}`, points, classes: state(own), tip: own || "there before" }));
  const made = makePicture({ label: "what has changed", select: () => {} });
  made.show({ size: picture.size, boxes: [], elements, edges });
  const rest = h("p", { class: "quiet", role: "status" });
  made.told = (isWhole) => { rest.textContent = isWhole ? "" : "Drag the picture for more of it; the wheel shows all."; };
  requestAnimationFrame(() => made.begin(true));
  return [h("div", { class: "stage low" }, made.element), rest];
}
