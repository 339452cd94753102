// The data of the page as objects: rows are read when they are asked for.
const D = JSON.parse(document.getElementById("data").textContent);
const TABLES = { texts: [], places: [], conditions: [], unknowns: [], nodes: [], ends: [], parameters: [], qos: [], pictures: [], "rule names": [], transforms: [], dependence: [], causes: [], ...D.tables };
const LEVELS = ["error", "warning", "note"];
const CHANNELS = { publishers: "topics", subscribers: "topics", servers: "services", clients: "services", action_servers: "actions", action_clients: "actions" };
const GIVES = new Set(["publishers", "clients", "action_clients"]);
const OFFERS = new Set(["publishers", "servers", "action_servers"]);
const WORDS = { publishers: "publishes", subscribers: "subscribes to", servers: "serves", clients: "calls", action_servers: "serves action", action_clients: "calls action", getters: "reads", setters: "writes", parameters: "declares" };

const text = (index) => (index < 0 ? "" : TABLES.texts[index]);
const texts = (indexes) => indexes.map(text);

function place(index) {
  if (index < 0) return null;
  const [path, line, column] = TABLES.places[index];
  return { path: text(path), line, column, text: text(path) + (line ? `:${line}` : "") + (line && column ? `:${column}` : "") };
}

const conditions = (index) =>
  index < 0 ? [] : TABLES.conditions[index].map(([statement, condition, at]) => ({ statement: text(statement), condition: text(condition), place: place(at) }));
const unknowns = (index) =>
  index < 0 ? [] : TABLES.unknowns[index].map(([field, reason, at]) => ({ field: text(field), reason: text(reason), place: place(at) }));
const condition = (one) => (one.condition.startsWith(one.statement) ? one.condition : `${one.statement} ${one.condition}`.trim());

function end(index) {
  const [kind, name, original, type, bits, cond, at, source, unknown, first, second, third] = TABLES.ends[index];
  const made = {
    kind: D.kinds[kind], name: text(name), original: text(original), type: text(type), implicit: (bits & 1) > 0, ruledOut: (bits & 2) > 0,
    latched: (bits & 4) > 0, readOnly: (bits & 8) > 0, conditions: conditions(cond), place: place(at), source: D.sources[source] || "", unknowns: unknowns(unknown),
  };
  if (CHANNELS[made.kind]) {
    made.queue = first < 0 ? null : first;
    made.qos = second < 0 ? null : Object.fromEntries(TABLES.qos[second].map(([key, value]) => [key, text(value)]));
  } else {
    made.default = first < 0 ? null : text(first);
    made.value = second < 0 ? null : text(second);
    made.range = third || [];
  }
  return made;
}

function node(index) {
  const row = TABLES.nodes[index];
  return {
    name: text(row[0]), kind: row[1], package: text(row[2]), type: text(row[3]), class: text(row[4]), ros: row[5], container: text(row[6]),
    args: text(row[7]), remaps: row[8].map(([a, b]) => [text(a), text(b)]), conditions: conditions(row[9]), place: place(row[10]),
    source: D.sources[row[11]] || "", unknowns: unknowns(row[12]), presence: text(row[13]), ends: row[14].map(end),
  };
}

function parameter(index) {
  const row = TABLES.parameters[index];
  return {
    name: text(row[0]), type: text(row[1]), value: row[2] < 0 ? null : text(row[2]), conditions: conditions(row[3]), place: place(row[4]),
    origin: place(row[5]), source: D.sources[row[6]] || "", unknowns: unknowns(row[7]),
  };
}

const isKnown = (name) => name !== "" && !name.includes("?");

// The switch that shows a channel, "" for what is always shown.
function switchOf(channel) {
  return D.well_known[last(channel.name)] || (channel.implicit ? "parameter services" : "");
}

const CONFIGURATIONS = D.configurations.map((one, index) => ({ index, name: text(one.name), launch: texts(one.launch), row: one }));
const BY_CONFIGURATION = new Map(CONFIGURATIONS.map((one) => [one.name, one]));
const systems = new Map();

const variantsOf = (index) => CONFIGURATIONS[index].row.variants.map(([words, gone, come]) => ({ words: text(words), gone, come }));

// A configuration with its nodes and what connects them, under the arguments in these words if there are any; made once.
function system(index, words) {
  const variant = words ? variantsOf(index).find((one) => one.words === words) : null;
  const kept = `${index} ${variant ? words : ""}`;
  if (systems.has(kept)) return systems.get(kept);
  const { row, name, launch } = CONFIGURATIONS[index];
  // A node has the same number whatever the arguments are: the picture knows it by that.
  const nodes = row.nodes.map(node);
  nodes.forEach((one, number) => { one.index = number; });
  const others = row.others.map(([one, presence], number) => ({ node: Object.assign(node(one), { index: row.nodes.length + number, isAdded: true }), presence: text(presence) }));
  if (variant) {
    const gone = new Set(variant.gone);
    nodes.splice(0, nodes.length, ...nodes.filter((one) => !gone.has(one.index)), ...variant.come.map((number) => others[number].node));
  }
  const channels = new Map();
  nodes.forEach((one) => {
    const number = one.index;
    one.channels = [];
    one.ends.forEach((each, position) => {
      const what = CHANNELS[each.kind];
      if (!what) return;
      const key = isKnown(each.name) ? `${what} ${each.name}` : `${what} ${each.name} ${number}.${position}`;
      if (!channels.has(key)) channels.set(key, { key, what, name: each.name, ends: [] });
      const channel = channels.get(key);
      channel.ends.push({ node: one, end: each, gives: GIVES.has(each.kind), offers: OFFERS.has(each.kind) });
      one.channels.push(channel);
    });
    one.channels = [...new Set(one.channels)];
  });
  for (const channel of channels.values()) {
    channel.implicit = channel.ends.every((each) => each.end.implicit);
    channel.conditional = channel.ends.every((each) => each.end.conditions.length || each.node.conditions.length || each.node.presence);
    channel.types = [...new Set(channel.ends.map((each) => each.end.type).filter(isKnown))].sort(compare);
    channel.switch = switchOf(channel);
    const certain = channel.ends.filter(isCertain);
    const sure = [...new Set(certain.map((each) => each.end.type).filter(isKnown))].sort(compare);
    channel.problems = [...(sure.length > 1 ? [`different types: ${sure.join(", ")}`] : []), ...incompatible(certain, channel.ends, channel.what)];
  }
  const made = {
    index, name, launch, nodes, channels, parameters: row.parameters.map(parameter),
    arguments: row.arguments.map(([a, b]) => [text(a), text(b)]),
    others: others.filter((_, number) => !variant || !variant.come.includes(number)), variant: variant ? words : "", numbered: new Map(nodes.map((one) => [one.index, one])),
    picture: row.picture < 0 ? null : TABLES.pictures[row.picture], tree: row.tree,
    // Rates are those of the default arguments.
    rates: new Map(variant ? [] : [...row.rates.published.map(([one, topic, rate]) => [`${text(one)} ${text(topic)}`, text(rate)]), ...row.rates.topics.map(([topic, rate]) => [text(topic), text(rate)])]),
  };
  // What each node makes of its inputs, by its number; nothing where that was not asked for.
  made.dependence = new Map(row.dependence.map((one, number) => [number, one]).filter(([, one]) => one >= 0).map(([number, one]) => [number, dependenceRow(one)]));
  // Nodes that bear one name, and one is a topic's besides: HAROS calls these collisions.
  made.twins = [...new Set(nodes.filter((one, at) => isKnown(one.name) && nodes.findIndex((each) => each.name === one.name) !== at).map((one) => one.name))].sort(compare);
  made.findings = findingsIn(made);
  systems.set(kept, made);
  return made;
}

// Whether an end is there whatever the conditions and launch arguments are.
const isCertain = ({ node: one, end: each }) => !each.ruledOut && !each.conditions.length && !each.unknowns.length && !one.conditions.length && !one.presence;

const RULES = new Map(D.rules.map((one) => [`${text(one.tool)}:${text(one.id)}`, one]));

const FINDINGS = D.findings.map((row, index) => {
  const [tool, rule] = TABLES["rule names"][row[1]];
  return {
    index, id: row[0], tool: text(tool), rule: text(rule), full: `${text(tool)}:${text(rule)}`, level: LEVELS[row[2]], rank: row[2], state: row[3],
    message: text(row[4]), place: place(row[5]), endLine: row[6], endColumn: row[7], package: text(row[8]), row,
  };
});
const BY_ID = new Map(FINDINGS.map((one) => [one.id, one]));

// What only the details of a finding show.
function more(finding) {
  const row = finding.row;
  const near = (pairs) => pairs.map(([at, said]) => ({ place: place(at), text: text(said) }));
  return {
    scope: text(row[9]), reason: text(row[10]), value: row[11], limit: row[12], subject: texts(row[13]), also: texts(row[14]), related: near(row[15]),
    flow: near(row[16]), graph: text(row[17]), suppressions: texts(row[19]), fixes: texts(row[20]), copies: near(row[21]),
  };
}

// Open findings about names of a configuration, by name.
function findingsIn(made) {
  const names = new Set([...made.nodes.map((one) => one.name), ...[...made.channels.values()].map((one) => one.name)]);
  const found = new Map();
  for (const finding of FINDINGS) {
    if (finding.state !== "open" && finding.state !== "known") continue;
    const subject = texts(finding.row[13]);
    const graph = text(finding.row[17]);
    if (!subject.length || (graph && graph !== made.name) || !subject.some((name) => names.has(name))) continue;
    if (!graph && !subject.every((name) => names.has(name))) continue;
    for (const name of subject) found.set(name, [...(found.get(name) || []), finding]);
  }
  return found;
}

const FRAMES = new Map(D.frames.map(([path, runs]) => [text(path), runs]));

// The lines of a file from one to another that the page has: pairs of number and text.
function lines(path, from, to) {
  const found = [];
  for (const [first, run] of FRAMES.get(path) || [])
    for (let number = Math.max(first, from); number <= Math.min(to, first + run.length - 1); number++) found.push([number, run[number - first]]);
  return found;
}

const INTERFACES = new Map(D.interfaces.map(([name, kind, at, sections]) => [text(name), { name: text(name), kind, place: place(at), sections }]));
// pkg/msg/T and pkg/T are one.
const interfaceOf = (type) => INTERFACES.get(type) || INTERFACES.get(type.replace(/\/(msg|srv|action)\//, "/"));
