// The running system of one configuration: its picture, what is near an element, and what it reaches.
function configurationChooser(chosen, change, only) {
  const select = h("select", { "aria-label": "configuration", class: "wide-choice", onchange: () => change(select.value) });
  const groups = [["launch files", CONFIGURATIONS.filter((one) => one.launch.length)], ["single programs and libraries", only ? [] : CONFIGURATIONS.filter((one) => !one.launch.length)]];
  for (const [label, list] of groups) if (list.length) select.append(h("optgroup", { label }, list.map((one) => h("option", { value: one.name }, `${one.name} (${count(one.row.nodes.length, "node")})`))));
  select.value = chosen;
  return h("label", { class: "choice" }, h("span", null, "configuration"), select);
}

// The launch arguments under which other nodes run, if the model knows any.
function variantChooser(made) {
  const every = variantsOf(made.index);
  if (!every.length) return null;
  const change = ({ gone, come }) => [come.length ? `+${come.length}` : "", gone.length ? `−${gone.length}` : ""].filter(Boolean).join(" ");
  return chooser("arguments", [["", "as by default"], ...every.map((one) => [one.words, `${one.words} (${change(one)})`])], made.variant, (words) => { location.hash = address("system", { configuration: made.name, with: words }); });
}

// The named configuration, or the launch file with the most nodes.
function chosenConfiguration(name) {
  if (name && BY_CONFIGURATION.has(name)) return BY_CONFIGURATION.get(name);
  const launched = CONFIGURATIONS.filter((one) => one.launch.length);
  return (launched.length ? launched : CONFIGURATIONS).reduce((best, one) => (!best || one.row.nodes.length > best.row.nodes.length ? one : best), null);
}

const shownSwitches = new Set();
// Switches of what is part of no picture by default, besides those of names that nearly every node has.
const PARAMETERS = "parameters";

function systemView(parameters) {
  const which = chosenConfiguration(parameters.configuration);
  if (!which) return { content: [h("h1", null, "System"), h("p", null, "No node was found.")] };
  const made = system(which.index, parameters.with);
  const state = { element: parameters.element || "", hops: parameters.hops || "", way: parameters.way || "", to: parameters.to || "", node: parameters.node || "", by: parameters.by === "code" ? "code" : "", folded: (parameters.folded || "").split(" ").filter(Boolean) };
  const detail = h("aside", { class: "detail", "aria-label": "details", "aria-live": "polite" });
  const status = h("span", { class: "quiet", role: "status" });
  const picture = makePicture({ label: `nodes and topics of ${made.name}`, select: (id) => chooseId(id), pick: (edges) => chooseEdges(edges), folded: (labels) => { Object.assign(state, { folded: labels, isArranged: true }); if (!labels.length) status.textContent = howMany(); remember({ folded: labels.join(" ") }); } });
  const shown = (channel) => !channel.switch || shownSwitches.has(channel.switch);
  const idOf = (name) => { const one = made.nodes.find((each) => each.name === name); if (one) return nodeId(one); const channel = [...made.channels.values()].find((each) => each.name === name); return channel ? channelId(channel) : parameterTable(made).has(name) ? `p ${name}` : null; };
  const byId = (id) => (id === null ? null : id.startsWith("n") ? made.numbered.get(Number(id.slice(1))) : id.startsWith("p ") ? parameterTable(made).get(id.slice(2)) || null : made.channels.get(id.slice(2)) || null);

  const isRed = (name) => made.findings.has(name);
  const nodeElement = (one, rectangle, box, lines) => ({ id: nodeId(one), isNode: true, what: "node", box, rectangle, title: last(one.name), sub: one.package ? `${one.package}/${one.type}` : one.type, lines,
    classes: [one.conditions.length || one.presence ? "conditional" : "", isKnown(one.name) ? "" : "unknown", isRed(one.name) ? "red" : ""].filter(Boolean),
    tip: [one.name, `${one.package}/${one.type}`, ...one.conditions.map(condition), one.presence, isRed(one.name) ? count(made.findings.get(one.name).length, "finding") : ""].filter(Boolean).join("\n") });
  const channelElement = (channel, rectangle, box) => ({ id: channelId(channel), isNode: false, what: channel.what, box, rectangle, title: channel.name, lines: [],
    classes: [channel.conditional ? "conditional" : "", isKnown(channel.name) && channel.types.length ? "" : "unknown", isRed(channel.name) || channel.problems.length ? "red" : "", channel.switch ? "well-known" : ""].filter(Boolean),
    tip: [channel.name, channel.types.join(", ") || "type not known", ...channel.problems].join("\n") });
  const edgesOf = (channel) => {
    const found = new Map();
    for (const each of channel.ends) {
      const [from, to] = each.gives ? [nodeId(each.node), channelId(channel)] : [channelId(channel), nodeId(each.node)];
      const key = `${from}>${to}`;
      if (!found.has(key)) found.set(key, { from, to, channel: channelId(channel), points: [], list: [] });
      found.get(key).list.push(each);
    }
    for (const one of found.values()) {
      const conditional = one.list.every((each) => each.end.conditions.length || each.node.conditions.length || each.node.presence);
      one.classes = [conditional ? "conditional" : "", channel.problems.length ? "red" : "", one.list.every((each) => each.end.ruledOut) ? "ruled-out" : ""].filter(Boolean);
      one.tip = one.list.map((each) => [`${each.node.name} ${WORDS[each.end.kind]} ${channel.name}`, each.end.kind === "publishers" ? rateWords(rateOf(made, channel.name, each.node.name)) : "", qosWords(each.end.qos), ...each.end.conditions.map(condition)].filter(Boolean).join("; ")).join("\n");
    }
    return [...found.values()];
  };

  // What only one node has, as lines in it.
  function ownLines(one, most) {
    const own = one.channels.filter((channel) => !channel.switch && (!isKnown(channel.name) || new Set(channel.ends.map((each) => each.node)).size === 1) && !placed.has(channel.key));
    own.sort((a, b) => compare(Object.values(CHANNELS).indexOf(a.what), Object.values(CHANNELS).indexOf(b.what)) || compare(a.name, b.name));
    const listed = own.slice(0, most).map((channel) => ({ id: channelId(channel), text: `${channel.ends.some((each) => each.gives) ? "→" : "←"} ${channel.name}`, classes: [isKnown(channel.name) ? "" : "unknown", isRed(channel.name) ? "red" : ""].join(" ") }));
    if (own.length > most) listed.push({ id: nodeId(one), text: `and ${own.length - most} more` });
    return listed;
  }

  // Its parameters with their values, where they are asked for.
  function parameterLines(one, most) {
    if (!shownSwitches.has(PARAMETERS)) return [];
    const every = parametersOf(made, one);
    const listed = every.slice(0, most).map(({ name, short, value }) => ({ id: `p ${name}`, text: `${short} = ${valueWords(value)}`, classes: `parameter${isRed(name) ? " red" : ""}` }));
    if (every.length > most) listed.push({ id: nodeId(one), text: `and ${every.length - most} more parameters`, classes: "parameter" });
    return listed;
  }

  const linesOf = (one) => [...ownLines(one, 7), ...parameterLines(one, 12)];
  const heightOf = (lines) => HEAD + lines.length * LINE + (lines.length ? 4 : 0);
  const placed = new Map();

  function whole() {
    const [size, boxes, nodes, channels, edges] = made.picture;
    placed.clear();
    const keys = channels.map(([what, name]) => `${what} ${text(name)}`);
    keys.forEach((key) => placed.set(key, true));
    const visible = channels.map((_, index) => made.channels.has(keys[index]) && shown(made.channels.get(keys[index])));
    const added = made.nodes.filter((one) => one.isAdded);
    const more = addedChannels(added);
    for (const channel of more) placed.set(channel.key, true);
    const elements = made.nodes.filter((one) => !one.isAdded).map((one) => { const lines = linesOf(one); const made = nodeElement(one, nodes[one.index].slice(1), nodes[one.index][0], lines); return heightOf(lines) > made.rectangle[3] ? { ...made, tall: heightOf(lines) } : made; });
    const byKey = new Map();
    channels.forEach((row, index) => { if (visible[index]) { const channel = made.channels.get(keys[index]); elements.push(channelElement(channel, row.slice(4), row[3])); byKey.set(channelId(channel), edgesOf(channel)); } });
    const all = [];
    for (const [number, index, gives, points] of edges) {
      if (!visible[index]) continue;
      const id = `c ${keys[index]}`;
      const found = byKey.get(id).find((one) => (gives ? one.from === `n${number}` && one.to === id : one.to === `n${number}` && one.from === id));
      if (found) all.push({ ...found, points });
    }
    const [tall, below] = beneath(size, added, more);
    elements.push(...below);
    const isNew = new Set(added.map(nodeId));
    for (const edge of [...byKey.values()].flat()) if (isNew.has(edge.from) || isNew.has(edge.to)) all.push(edge);
    for (const channel of more) all.push(...edgesOf(channel));
    return { size: [size[0], tall], boxes: boxes.map(([kind, name, parent, ...rectangle]) => ({ kind, label: text(name), parent, rectangle })), elements, edges: all };
  }

  // What connects nodes of other arguments with others and is not in the picture.
  function addedChannels(added) {
    const found = new Set(added.flatMap((one) => one.channels).filter((channel) => shown(channel) && isKnown(channel.name) && !placed.has(channel.key) && new Set(channel.ends.map((each) => each.node)).size > 1));
    return [...found].sort((a, b) => compare(a.key, b.key));
  }

  // They stand in rows below the picture, so that nothing else moves.
  function beneath([width, height], added, more) {
    const wide = Math.max(width, 900);
    let [x, y, tall] = [14, height + 20, 0];
    const put = (w, high) => {
      if (x > 14 && x + w > wide) [x, y, tall] = [14, y + tall + 16, 0];
      const at = [x, y, w, high];
      [x, tall] = [x + w + 16, Math.max(tall, high)];
      return at;
    };
    const found = added.map((one) => { const lines = linesOf(one); return nodeElement(one, put(Math.min(280, Math.max(100, Math.max(last(one.name).length, one.type.length + one.package.length, ...lines.map((each) => each.text.length)) * 6.6 + 26)), heightOf(lines)), -1, lines); });
    if (found.length) [x, y, tall] = [14, y + tall + 16, 0];
    for (const channel of more) found.push(channelElement(channel, put(Math.min(280, Math.max(100, channel.name.length * 6.6 + 34)), 24), -1));
    return [found.length ? y + tall + 14 : height, found];
  }

  // Only what is near the chosen element, or what it reaches, in columns.
  function part(id) {
    placed.clear();
    // A hop goes from node to node; from a topic the first one is half as far.
    const hops = state.hops ? 2 * Number(state.hops) - (id.startsWith("n") ? 0 : 1) : Infinity;
    const start = byId(id);
    const isShared = (channel) => new Set(channel.ends.map((each) => each.node)).size > 1;
    // What only one node has stands in that node, unless it is asked for.
    const every = (channel) => channel === start || (shown(channel) && (isShared(channel) || (id.startsWith("n") && channel.ends[0].node === start)));
    const goal = state.way === "to" ? idOf(state.to) : null;
    const onWay = (channel) => channel === start || (goal !== null && channelId(channel) === goal) || (shown(channel) && isShared(channel));
    const byCode = !isByCode() ? null : goal !== null ? followedBetween(made, onWay, id, goal) : state.way === "behind" || state.way === "before" ? followed(made, every, id, state.way === "behind") : null;
    const found = byCode ? byCode.found : goal !== null ? between(made, onWay, id, goal) : levels(made, every, id, state.way || "around", hops);
    const tooMany = found.size > 900;
    if (tooMany) for (const one of [...found].sort((a, b) => Math.abs(a[1]) - Math.abs(b[1])).slice(900)) found.delete(one[0]);
    for (const one of found.keys()) if (!one.startsWith("n")) placed.set(byId(one).key, true);
    const own = new Map([...found.keys()].filter((one) => one.startsWith("n")).map((one) => [one, linesOf(byId(one))]));
    const size = (one) => {
      const item = byId(one);
      const inside = own.get(one) || [];
      const words = one.startsWith("n") ? Math.max(last(item.name).length, item.type.length, ...inside.map((each) => each.text.length)) : item.name.length;
      return [Math.min(280, Math.max(100, words * 6.6 + 34)), one.startsWith("n") ? heightOf(inside) : 24];
    };
    const { places, size: whole } = columns(found, size, neighbours(made, every));
    roomForLoops(made, places, whole);
    const elements = [...places].map(([one, rectangle]) => (one.startsWith("n") ? nodeElement(byId(one), rectangle, -1, own.get(one)) : channelElement(byId(one), rectangle, -1)));
    const edges = [...made.channels.values()].filter((channel) => places.has(channelId(channel))).flatMap(edgesOf).filter((one) => places.has(one.from) && places.has(one.to) && (!byCode || byCode.ways.has(`${one.from}>${one.to}`)));
    for (const one of byCode ? edges : []) if (!byCode.ways.get(`${one.from}>${one.to}`)) Object.assign(one, { classes: [...one.classes, "perhaps"], tip: `${one.tip}\nperhaps: the code does not tell all that causes it` });
    const isCut = goal !== null && goal !== id && !edges.length;
    status.textContent = isCut ? `There is no path from ${start.name} to ${state.to}.` : `${count(found.size, "element")}${tooMany ? " (the nearest)" : ""}${goal !== null ? ` on the paths to ${state.to}` : ""}`;
    return { size: whole, boxes: [], elements, edges, isPart: true };
  }

  // Whether traces follow what the code of nodes does, and not all that they receive.
  const isByCode = () => state.by === "code" && made.dependence.size > 0;

  const howMany = () => `${count(made.nodes.length, "node")}, ${count([...made.channels.values()].filter(shown).length, "topic")} and others`.replace("topics and others", "topics, services and actions shown").replace("topic and others", "topic, service or action shown");

  function draw() {
    const id = state.element ? idOf(state.element) : null;
    if (state.way === "to" && idOf(state.to) === null) state.way = "";
    const isPart = id !== null && !id.startsWith("p ") && (state.hops || state.way);
    back.hidden = !isPart;
    if (!isPart && !made.picture) {
      status.textContent = "Too large for a picture: choose an element of the list.";
      stage.replaceChildren(elementList());
      return;
    }
    stage.replaceChildren(picture.element);
    if (!isPart) status.textContent = howMany();
    picture.show(isPart ? part(id) : whole(), isPart ? [] : state.folded);
    // What is too large to be read at once begins folded.
    const isFolded = !isPart && !state.isArranged && !state.folded.length && id === null && picture.isTiny && picture.foldMost();
    if (isFolded) status.textContent += ": folded, as it is large; click a box to unfold it";
    const rest = h("span", null);
    status.append(rest);
    picture.told = (isWhole) => { rest.textContent = isWhole ? "" : "; drag the picture for more of it"; };
    foldButtons.hidden = isPart || picture.boxes === 0;
    picture.begin();
    const edges = id !== null && id.startsWith("c ") && state.node ? picture.edges.filter((one) => one.channel === id && one.list[0].node.name === state.node) : [];
    if (edges.length) picture.mark(null, edges);
    else choosePicture(id, !isPart && made.nodes.length > 12);
    if (state.element && id === null) status.textContent = `There is no ${state.element} in this configuration.`;
    if (parameters.configuration && parameters.configuration !== made.name) status.textContent = `There is no configuration ${parameters.configuration}.`;
    if (edges.length) describeEdge(edges[0]);
    else describe(id);
  }

  // Mark an element; of what stands as a line in a node, that node.
  function choosePicture(id, isCentred) {
    const item = byId(id);
    if (item && id.startsWith("p ")) {
      const ids = [...item.nodes].map(nodeId).filter(picture.has);
      if (ids.length) picture.mark(null, null, new Set(ids));
      if (ids.length && isCentred) picture.centre(ids[0]);
      return;
    }
    const at = item && !picture.has(id) && item.ends && item.what ? nodeId(item.ends[0].node) : id;
    if (at === null || !picture.has(at)) return;
    picture.reveal(at);
    picture.choose(at, true);
    if (isCentred) picture.centre(at);
  }

  const elementList = () => h("div", { class: "scroll list" }, h("ul", { class: "plain-list" }, made.nodes.map((one) => h("li", null, link("system", { configuration: made.name, with: made.variant, element: one.name, hops: 1 }, one.name)))));

  function describe(id) {
    const item = byId(id);
    detail.classList.toggle("open", Boolean(item));
    clear(detail, !item ? configurationDetail() : id.startsWith("p ") ? [h("h2", null, item.name, " ", h("span", { class: "quiet" }, "parameter")), parameterDetail(made, item), findingsOf(made, item.name), h("p", null, link("parameters", { configuration: made.name, q: item.name }, "all parameters"))] : [focusButtons(id), id.startsWith("n") ? nodeDetail(made, item) : channelDetail(made, item)]);
  }

  function describeEdge(edge) {
    const { node: one } = edge.list[0];
    Object.assign(state, { element: made.channels.get(edge.channel.slice(2)).name, node: one.name });
    remember({ element: state.element, node: state.node });
    detail.classList.add("open");
    clear(detail, edgeDetail(made, made.channels.get(edge.channel.slice(2)), one));
  }

  // An edge, or all that are drawn as one.
  function chooseEdges(edges) {
    if (edges.length === 1) { describeEdge(edges[0]); return; }
    detail.classList.add("open");
    clear(detail, bundleDetail(edges, (one) => { picture.mark(null, [one]); describeEdge(one); }));
  }

  function focusButtons(id) {
    const go = (change) => () => { Object.assign(state, { hops: "", way: "", to: "" }, change); remember({ hops: state.hops, way: state.way, to: state.to, element: byId(id).name, node: "" }); state.node = ""; draw(); };
    const button = (words, change, title) => { const on = state.hops === (change.hops || "") && state.way === (change.way || ""); return h("button", { onclick: go(change), "aria-pressed": String(on), title }, words); };
    return h("div", { class: "buttons", role: "group", "aria-label": "what is shown" }, button("whole system", {}, "everything"), button("1 hop", { hops: "1" }, "what it is connected with"), button("2 hops", { hops: "2" }), button("3 hops", { hops: "3" }),
      button("reaches →", { way: "behind" }, isByCode() ? "everything that its output can cause, as far as the code tells" : "everything that its output can reach; a node is assumed to pass on all that it receives"), button("← depends on", { way: "before" }, "everything that can reach it"), made.dependence.size ? toggle("as the code depends", isByCode(), (on) => { state.by = on ? "code" : ""; remember({ by: state.by }); if (state.way) draw(); }) : null, wayTo(id, go));
  }

  // From here to another element, such as from a sensor to an actuator.
  function wayTo(id, go) {
    const names = [...new Set([...made.nodes.map((one) => one.name), ...[...made.channels.values()].filter((one) => shown(one) && isKnown(one.name)).map((one) => one.name)])].sort(compare);
    const input = h("input", { type: "text", list: "goals", value: state.way === "to" ? state.to : "", placeholder: "node or topic", "aria-label": "show the paths to" });
    input.addEventListener("change", () => { if (idOf(input.value) !== null && idOf(input.value) !== id) go({ way: "to", to: input.value })(); else if (input.value) status.textContent = `There is no other ${input.value} in this configuration.`; });
    return h("label", { class: "choice" }, h("span", null, "path to"), input, h("datalist", { id: "goals" }, names.slice(0, 3000).map((name) => h("option", { value: name }))));
  }

  function chooseId(id) {
    const item = byId(id);
    Object.assign(state, { element: item ? item.name : "", node: "" });
    remember({ element: state.element, node: "" });
    describe(id);
    if (!item) picture.choose(null, true);
    if (item && id.startsWith("p ")) choosePicture(id, false);
  }

  function configurationDetail() {
    const every = [...made.channels.values()].filter((one) => !one.implicit);
    const unknown = every.filter((one) => !isKnown(one.name));
    const problems = new Set([...made.findings.values()].flat());
    return [
      h("h2", null, breakable(made.name)),
      h("dl", null, row("launch files", made.launch.length ? made.launch.join(", ") : "none: a program by itself"), row("arguments", made.arguments.length ? h("details", { open: made.arguments.length < 7 }, h("summary", null, count(made.arguments.length, "argument")), h("ul", { class: "plain-list" }, made.arguments.map(([name, value]) => h("li", null, h("code", null, `${name}:=${value}`))))) : ""),
        made.variant ? row("with", h("code", null, made.variant), h("p", { class: "quiet" }, "Nodes come and go; parameters and names are those of the default arguments.")) : null,
        row("nodes", String(made.nodes.length)), ...["topics", "services", "actions"].map((what) => row(what, String(every.filter((one) => one.what === what).length))),
        row("parameters set", made.parameters.length ? link("parameters", { configuration: made.name }, made.parameters.length.toLocaleString("en")) : "0"),
        row("remappings", String(made.nodes.reduce((sum, one) => sum + one.remaps.length, 0))),
        row("same name twice", made.twins.length ? made.twins.join(", ") : ""),
        row("conditional", String(made.nodes.filter((one) => one.conditions.length || one.presence).length), " nodes")),
      problems.size ? h("section", null, h("h3", null, `Findings (${problems.size})`), h("ul", { class: "plain-list" }, [...problems].slice(0, 60).map((one) => h("li", null, h("span", { class: `level ${one.level}` }, one.level), " ", link("findings", { id: one.id, state: "any" }, one.message), " ", texts(one.row[13]).map((name) => [element(made, name), " "]))))) : null,
      unknown.length ? h("section", null, h("h3", null, `Names not known (${unknown.length})`), h("ul", { class: "plain-list" }, unknown.slice(0, 60).map((one) => h("li", null, `${one.ends[0].node.name} ${WORDS[one.ends[0].end.kind]} `, h("button", { class: "plain linked", onclick: () => describe(channelId(one)) }, one.name))))) : null,
      made.others.length ? h("details", null, h("summary", null, `Under other launch arguments (${count(made.others.length, "node")})`), h("ul", { class: "plain-list" }, made.others.slice(0, 200).map((one) => h("li", null, one.node.name, " ", h("code", null, one.presence))))) : null,
      made.dependence.size ? null : h("p", { class: "quiet" }, "What causes what in a node, and traces that follow it, are here with ", h("code", null, "haros-ci report --dependence"), made.rates.size ? "." : [", rates with ", h("code", null, "--rates"), "."]),
      legend(),
    ];
  }

  function search(words) {
    const wanted = words.trim().toLowerCase();
    clear(results);
    if (!wanted) return;
    const found = [...made.nodes.map((one) => [one.name, "node"]), ...[...made.channels.values()].map((one) => [one.name, one.what.slice(0, -1)]), ...[...parameterTable(made).keys()].map((name) => [name, "parameter"])].filter(([name]) => name.toLowerCase().includes(wanted));
    found.sort((a, b) => a[0].toLowerCase().indexOf(wanted) - b[0].toLowerCase().indexOf(wanted) || a[0].length - b[0].length || compare(a[0], b[0]));
    const go = (name) => { clear(results); Object.assign(state, { element: name, node: "" }); remember({ element: name, node: "" }); const id = idOf(name); if ((state.hops || state.way) && !picture.has(id)) draw(); else { choosePicture(id, true); describe(id); } };
    clear(results, found.slice(0, 30).map(([name, kind]) => h("button", { class: "result", role: "option", onclick: () => go(name) }, h("bdi", null, name), " ", h("span", { class: "quiet" }, kind))), found.length ? null : h("p", { class: "quiet" }, "nothing of this name"));
  }

  const results = h("div", { class: "results", role: "listbox", "aria-label": "found" });
  const field = searchField("Search the system", "", search);
  field.addEventListener("keydown", (event) => {
    if (event.key === "Enter" && results.firstChild && results.firstChild.click) results.firstChild.click();
    if (event.key === "ArrowDown" && results.firstChild) { event.preventDefault(); results.firstChild.focus(); }
  });
  results.addEventListener("keydown", (event) => {
    const next = event.key === "ArrowDown" ? event.target.nextElementSibling : event.key === "ArrowUp" ? event.target.previousElementSibling || field : null;
    if (next) { event.preventDefault(); next.focus(); }
  });
  const back = h("button", { onclick: () => { Object.assign(state, { hops: "", way: "", to: "" }); remember({ hops: "", way: "", to: "" }); draw(); } }, "Whole system");
  const foldButtons = h("span", { class: "buttons" }, h("button", { onclick: () => picture.foldAll(true) }, "Fold all"), h("button", { onclick: () => picture.foldAll(false) }, "Unfold all"));
  const present = [...(made.nodes.some((one) => parametersOf(made, one).length) ? [PARAMETERS] : []), ...D.switches.filter((one) => [...made.channels.values()].some((channel) => channel.switch === one))];
  const stage = h("div", { class: "stage" });
  requestAnimationFrame(draw);
  return {
    wide: true,
    escape: () => { clear(results); if (state.hops || state.way) back.click(); else chooseId(null); },
    content: [
      h("div", { class: "bar-of-filters" }, configurationChooser(made.name, (name) => { location.hash = address("system", { configuration: name }); }), variantChooser(made), h("div", { class: "search-box" }, field, results),
        present.length ? h("fieldset", { class: "switches" }, h("legend", null, "also show"), present.map((one) => toggle(one, shownSwitches.has(one), (on) => { if (on) shownSwitches.add(one); else shownSwitches.delete(one); draw(); }))) : null,
        zoomButtons(picture), foldButtons, back, status),
      h("div", { class: "split system" }, stage, detail),
    ],
  };
}

function legend() {
  const one = (what, words, classes) => h("li", null, s("svg", { class: "picture legend", width: 64, height: 26, viewBox: "0 0 64 26", "aria-hidden": "true" }, s("g", { class: `element ${what} ${classes || ""}` }, shape(what, [2, 3, 60, 20]))), words);
  return h("details", { open: true }, h("summary", null, "Legend"), h("ul", { class: "legend-list" }, one("node", "node"), one("topics", "topic"), one("services", "service"), one("actions", "action"), one("node", "dashed: under a condition, or other launch arguments", "conditional"), one("topics", "dotted with ?: name or type not known", "unknown"), one("node", "red and bold: a finding is about it", "red")),
    h("p", { class: "quiet" }, "Arrows lead from a publisher or client to its topic, service or action, and from there to the subscriber or server. Lines in a node are topics and services that no other node has: → published or called, ← subscribed to or served. Click an arrow for its quality of service. Drag the picture or an element, wheel or + and − to zoom, 0 to fit, arrow keys to move."));
}
