// The launch files of a configuration: what includes what, with which arguments, and what each starts.
function launchView(parameters) {
  const launched = CONFIGURATIONS.filter((one) => one.launch.length);
  const which = launched.find((one) => one.name === parameters.configuration) || chosenConfiguration(parameters.configuration);
  if (!which || !which.launch.length) return { content: [h("h1", null, "Launch files"), h("p", null, "No launch file starts a node that is known here.")] };
  const made = system(which.index);
  const { includes, declared } = made.tree;
  const rows = includes.map(([at, words, path, passed, presence, parent], index) => ({ index, place: place(at), words: text(words), path: text(path), passed: texts(passed), presence: text(presence), parent }));
  const nodesIn = new Map();
  for (const one of made.nodes) if (one.place) (nodesIn.get(one.place.path) || nodesIn.set(one.place.path, []).get(one.place.path)).push(one);
  const argumentsIn = new Map();
  for (const [at, name, value, choices] of declared) { const where = place(at); if (where) (argumentsIn.get(where.path) || argumentsIn.set(where.path, []).get(where.path)).push({ name: text(name), value: value < 0 ? null : text(value), choices: texts(choices), place: where }); }
  const times = new Map();
  for (const one of rows) if (one.path) times.set(one.path, (times.get(one.path) || 0) + 1);
  const given = new Map(made.arguments);

  function file(path, parent, depth) {
    const own = argumentsIn.get(path) || [];
    const starts = nodesIn.get(path) || [];
    const inner = rows.filter((one) => one.parent === parent && (parent >= 0 || made.launch.length === 1 || (one.place && one.place.path === path)));
    return [
      own.length ? h("details", null, h("summary", null, count(own.length, "argument")), smallTable(["argument", "default", "choices", "declared at"], own.map((one) => [one.name, depth === 0 && given.has(one.name) ? `${given.get(one.name)} (given)` : one.value === null ? "must be given" : one.value, one.choices.join(", "), whereIs(one.place)]), "arguments")) : null,
      starts.length ? h("details", { open: depth < 2 }, h("summary", null, `starts ${count(starts.length, "node")}`, times.get(path) > 1 ? ` (in all, as it is included ${times.get(path)} times)` : ""), h("ul", { class: "plain-list" }, starts.map((one) => h("li", { class: one.conditions.length || one.presence ? "conditional" : null }, element(made, one.name), ` ${one.package}/${one.type} `, whereIs(one.place), one.presence ? [" if ", h("code", null, one.presence)] : null, conditionList(one.conditions))))) : null,
      inner.length ? h("ul", { class: "tree" }, inner.map((one) => included(one, depth))) : null,
    ].filter(Boolean);
  }

  function included(one, depth) {
    const head = [h("strong", null, breakable(one.path || one.words)), one.path ? null : h("span", { class: "quiet" }, " (not in the workspace, or not known)"), one.presence ? [" if ", h("code", null, one.presence)] : null, " ", h("span", { class: "quiet" }, one.place ? breakable(one.place.text) : "")];
    const content = [one.passed.length ? h("p", { class: "quiet" }, `passes ${one.passed.join(", ")}`) : null, ...(depth < 20 ? file(one.path, one.index, depth + 1) : [])].filter(Boolean);
    return h("li", { class: one.presence ? "conditional" : null }, content.length ? h("details", { open: depth < 2 }, h("summary", null, head), content) : h("div", { class: "leaf" }, head));
  }

  const roots = made.launch.map((one) => ({ name: one, path: rootPath(one, [...nodesIn.keys(), ...argumentsIn.keys(), ...rows.filter((each) => each.parent < 0).map((each) => (each.place ? each.place.path : ""))]) }));
  return {
    content: [
      h("div", { class: "bar-of-filters" }, configurationChooser(made.name, (name) => { location.hash = address("launch", { configuration: name }); }, true), link("system", { configuration: made.name }, "its system")),
      h("h1", null, breakable(made.name)),
      made.arguments.length ? h("details", { open: made.arguments.length < 8 }, h("summary", null, `with ${count(made.arguments.length, "argument")}`), h("ul", { class: "plain-list" }, made.arguments.map(([name, value]) => h("li", null, h("code", null, `${name}:=${value}`))))) : null,
      roots.map((one) => h("section", { class: "card" }, roots.length > 1 || one.name !== made.name ? h("h2", null, breakable(one.name)) : null, file(one.path, -1, 0))),
      made.others.length ? h("section", { class: "card" }, h("h2", null, "Under other arguments"), h("ul", { class: "plain-list" }, made.others.slice(0, 300).map((one) => h("li", { class: "conditional" }, one.node.name, ` ${one.node.package}/${one.node.type} `, h("code", null, one.presence), " ", whereIs(one.node.place))))) : null,
    ],
  };
}

// The path of package/inner/file: the one that ends so.
function rootPath(name, paths) {
  const inner = name.slice(name.indexOf("/") + 1);
  return paths.find((path) => path === name || path.endsWith(`/${name}`)) || paths.find((path) => path.endsWith(`/${inner}`) || path === inner) || name;
}
