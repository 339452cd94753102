// The frames of a configuration: the tree that they stand in, who broadcasts each, and where nodes are at odds.
const ORIGINS = { publisher: "static publisher", robot: "robot description", code: "code" };
const TF = new Set(["tf", "tf_static"]);

function transformsOf(made) {
  const index = CONFIGURATIONS[made.index].row.transforms;
  if (index < 0) return null;
  const [rows, frames, picture] = TABLES.transforms[index];
  const found = frames.map(([name, topic, circle], number) => ({ number, name: text(name), topic: text(topic), inCircle: circle === 1, said: [], children: [] }));
  for (const [child, parent, isStatic, isOdd, origin, node, at, what] of rows) {
    const one = { child: found[child], parent: parent < 0 ? null : found[parent], isStatic: isStatic === 1, isOdd: isOdd === 1, origin, node: text(node), place: place(at), what: text(what) };
    one.child.said.push(one);
    if (one.parent && !one.parent.children.includes(one.child)) one.parent.children.push(one.child);
  }
  for (const one of found) one.parents = [...new Set(one.said.map((each) => each.parent).filter(Boolean))];
  return { frames: found, picture };
}

// Nodes that publish on tf and of which no transform is known.
function silentBroadcasters(made, known) {
  const nodes = new Set(known ? known.frames.flatMap((one) => one.said.map((each) => each.node)) : []);
  return made.nodes.filter((one) => !nodes.has(one.name) && one.ends.some((each) => each.kind === "publishers" && TF.has(last(each.name))));
}

const hasTransforms = (one) => one.row.transforms >= 0;
const broadcastWords = (one) => [one.isStatic ? "static" : "dynamic", ORIGINS[one.origin]].join(", ");

function transformsView(parameters) {
  const list = CONFIGURATIONS.filter(hasTransforms);
  const most = (one) => TABLES.transforms[one.row.transforms][1].length;
  const which = BY_CONFIGURATION.get(parameters.configuration) || list.reduce((best, one) => (!best || most(one) > most(best) ? one : best), null) || chosenConfiguration("");
  const select = h("select", { "aria-label": "configuration", class: "wide-choice", onchange: () => { location.hash = address("transforms", { configuration: select.value }); } }, list.map((one) => h("option", { value: one.name }, `${one.name} (${count(most(one), "frame")})`)), which && !hasTransforms(which) ? h("option", { value: which.name }, `${which.name} (no frame)`) : null);
  if (!which) return { content: [h("h1", null, "Transforms"), h("p", null, "No node was found.")] };
  select.value = which.name;
  const chooserOf = h("label", { class: "choice" }, h("span", null, "configuration"), select);
  const made = system(which.index);
  const known = transformsOf(made);
  const silent = silentBroadcasters(made, known);
  const silentList = silent.length ? h("section", null, h("h3", null, `Broadcasters whose frames are not known (${silent.length})`), h("ul", { class: "plain-list" }, silent.map((one) => h("li", null, element(made, one.name), " ", h("span", { class: "quiet" }, `${one.package}/${one.type}`))))) : null;
  if (!known) return { content: [h("div", { class: "bar-of-filters" }, chooserOf), h("h1", null, "Transforms"), h("p", null, "No transform of this configuration is known."), silentList] };

  const detail = h("aside", { class: "detail", "aria-label": "frame", "aria-live": "polite" });
  const isOdd = (one) => one.inCircle || one.said.some((each) => each.isOdd);
  const odd = known.frames.filter(isOdd);
  const roots = known.frames.filter((one) => !one.parents.length);
  const sub = (one) => (one.said.length ? [...new Set(one.said.map((each) => `${each.isStatic ? "static" : "dynamic"}, ${isKnown(each.node) ? last(each.node) : ORIGINS[each.origin]}`))].join("; ") : "no parent known");
  const elements = known.picture ? known.frames.map((one) => ({ id: `f${one.number}`, isNode: true, what: "node", box: -1, rectangle: known.picture[1][one.number], title: one.name, sub: sub(one), lines: [], classes: [one.said.length ? "" : "root", isOdd(one) ? "red" : ""].filter(Boolean), tip: [one.name, ...one.said.map((each) => `${each.parent ? `in ${each.parent.name}, ` : ""}${each.what}`)].join("\n") })) : [];
  const picture = makePicture({ label: `frames of ${made.name}`, select: (id) => describe(id ? known.frames[Number(id.slice(1))] : null) });
  const names = new Set([...known.frames.map((one) => one.name), ...made.nodes.map((one) => one.name)]);
  const findings = FINDINGS.filter((one) => one.rule === "conflicting-transforms" && (one.state === "open" || one.state === "known") && texts(one.row[13]).every((name) => names.has(name)));

  function describe(one) {
    detail.classList.add("open");
    remember({ frame: one ? one.name : "" });
    clear(detail, one ? frameDetail(one) : wholeDetail());
  }
  const frameLink = (one, words) => h("button", { class: "plain linked", onclick: () => choose(one) }, words || one.name);
  const frameDetail = (one) => [
    h("h2", null, one.name, " ", h("span", { class: "quiet" }, one.topic === "/tf" ? "frame" : `frame on ${one.topic}`)),
    isOdd(one) ? h("p", { class: "warning" }, one.inCircle ? "It is its own ancestor: every lookup through this cycle fails." : one.parents.length > 1 ? `It has ${one.parents.length} parents: tf allows one.` : "Several nodes broadcast it, with different transforms.") : null,
    h("dl", null, row(one.parents.length > 1 ? "parents" : "parent", one.parents.map((each, index) => [index ? ", " : "", frameLink(each)])), row("children", one.children.map((each, index) => [index ? ", " : "", frameLink(each)])), row("path to the root", wayUp(one).length > 1 ? wayUp(one).map((each) => each.name).join(" → ") : "")),
    h("section", null, h("h3", null, `broadcast (${one.said.length})`), one.said.length ? h("ul", { class: "plain-list" }, one.said.map((each) => h("li", null, element(made, each.node), " ", h("span", { class: "quiet" }, broadcastWords(each)), each.isOdd ? h("span", { class: "remark" }, " conflict") : null, h("div", null, each.what, " ", whereIs(each.place)), frame(each.place, 0, 0, 2)))) : h("p", { class: "quiet" }, "No known node broadcasts it as a child: it is the root of its tree, or its parent is not known.")),
  ];
  const wholeDetail = () => [
    h("h2", null, breakable(made.name)),
    h("dl", null, row("frames", String(known.frames.length)), row(roots.length > 1 ? "roots" : "root", roots.map((one, index) => [index ? ", " : "", frameLink(one)])),
      ...Object.entries(ORIGINS).map(([key, words]) => row(`by ${words}`, String(known.frames.filter((one) => one.said.some((each) => each.origin === key)).length)))),
    roots.length > 1 ? h("p", { class: "quiet" }, `${roots.length} trees: what joins them may come from outside, or from a node whose frames are not known.`) : null,
    odd.length ? h("section", null, h("h3", null, `In conflict (${odd.length})`), h("ul", { class: "plain-list" }, odd.map((one) => h("li", null, frameLink(one), one.parents.length > 1 ? h("span", { class: "remark" }, ` ${one.parents.map((each) => each.name).join(", ")}`) : "")))) : null,
    findings.length ? h("section", null, h("h3", null, "Findings"), h("ul", { class: "plain-list" }, findings.map((one) => h("li", null, h("span", { class: `level ${one.level}` }, one.level), " ", link("findings", { id: one.id, state: "any" }, one.message))))) : null,
    silentList,
  ];
  function wayUp(one) {
    const way = [one];
    while (way[way.length - 1].parents.length && !way.includes(way[way.length - 1].parents[0])) way.push(way[way.length - 1].parents[0]);
    return way;
  }
  function choose(one) {
    picture.choose(`f${one.number}`, true);
    picture.centre(`f${one.number}`);
    describe(one);
  }
  const find = (words) => known.frames.filter((one) => words && one.name.toLowerCase().includes(words.toLowerCase())).sort((a, b) => a.name.length - b.name.length || compare(a.name, b.name) || Number(a.topic !== "/tf") - Number(b.topic !== "/tf"))[0];
  const rest = h("span", { class: "quiet", role: "status" });
  const stage = h("div", { class: "stage" }, known.picture ? picture.element : h("div", { class: "scroll list" }, h("ul", { class: "plain-list" }, known.frames.map((one) => h("li", null, frameLink(one))))));
  requestAnimationFrame(() => {
    if (known.picture) {
      picture.show({ size: known.picture[0], boxes: [], elements, edges: known.picture[2].map(([from, to, points]) => edgeOf(known.frames[from], known.frames[to], points)) });
      picture.told = (isWhole) => { rest.textContent = isWhole ? "" : "drag the picture for more of it"; };
      picture.begin(true);
    }
    const start = known.frames.find((one) => one.name === parameters.frame);
    if (start && known.picture) choose(start);
    else describe(start || null);
  });
  function edgeOf(parent, child, points) {
    const said = child.said.filter((each) => each.parent === parent);
    return { from: `f${parent.number}`, to: `f${child.number}`, channel: `f${child.number}`, points, classes: said.some((each) => each.isOdd) || (child.inCircle && parent.inCircle) ? ["red"] : [], tip: said.map((each) => each.what).join("\n") };
  }
  return {
    wide: true,
    escape: () => { picture.choose(null, true); describe(null); },
    content: [
      h("div", { class: "bar-of-filters" }, chooserOf, searchField("Search frames", "", (words) => { const one = find(words); if (one) choose(one); }), h("span", { class: "quiet", role: "status" }, `${count(known.frames.length, "frame")}, ${count(roots.length, "tree")}${odd.length ? `, ${odd.length} in conflict` : ""}`), link("system", { configuration: made.name }, "its system"), known.picture ? zoomButtons(picture) : null, rest),
      h("div", { class: "split system" }, stage, detail),
    ],
  };
}
