// What is known of a node or of what connects nodes, beside the picture.
const sourceWords = { source: "the source", launch: "a launch file", hint: "the project file", "known-node": "data on nodes outside the workspace", "exact-tier": "libclang" };

const CHANNEL_WORDS = { topics: "topic", services: "service", actions: "action" };
const whereIs = (at) => (at ? h("code", null, breakable(at.text)) : "");
const conditionList = (list) => (list.length ? h("ul", { class: "conditions" }, list.map((one) => h("li", null, h("code", null, condition(one)), " at ", whereIs(one.place)))) : null);
const unknownItems = (list) => h("ul", { class: "unknowns" }, list.map((one) => h("li", null, h("strong", null, `${one.field} not known: `), one.reason, one.place ? [" at ", whereIs(one.place)] : "")));
// Many reasons are one line until they are asked for.
const unknownList = (list) => (list.length > 3 ? h("details", { class: "unknown-reasons" }, h("summary", { class: "remark" }, `${count(list.length, "reason")} why not all is known`), unknownItems(list)) : list.length ? unknownItems(list) : null);
const row = (name, ...value) => (value.flat().some((one) => one !== null && one !== "" && one !== undefined) ? [h("dt", null, name), h("dd", null, value)] : null);
const element = (made, name, words) => link("system", { configuration: made.name, with: made.variant, element: name }, words || name);

function findingsOf(made, name) {
  const found = made.findings.get(name) || [];
  if (!found.length) return null;
  return h("section", null, h("h3", null, "Findings"), h("ul", { class: "plain-list" }, found.map((one) => h("li", null, h("span", { class: `level ${one.level}` }, one.level), " ", link("findings", { id: one.id, state: "any" }, one.message)))));
}

function nodeDetail(made, one) {
  const kinds = D.kinds.filter((kind) => CHANNELS[kind]);
  return [
    h("h2", null, breakable(one.name)),
    h("dl", null,
      row("program", `${one.package}/${one.type}`), row("kind", one.kind), row("class", one.class), row("container", one.container ? element(made, one.container) : ""), row("arguments", one.args ? h("code", null, one.args) : ""),
      row("started at", whereIs(one.place)), row("known from", sourceWords[one.source] || ""), row("present if", one.presence ? h("code", null, one.presence) : ""), row("conditions", conditionList(one.conditions)),
      row("remappings", one.remaps.length ? h("ul", { class: "plain-list" }, one.remaps.map(([from, to]) => h("li", null, h("code", null, `${from} → ${to}`)))) : "")),
    unknownList(one.unknowns), findingsOf(made, one.name),
    kinds.map((kind) => {
      const ends = one.ends.filter((each) => each.kind === kind && !each.implicit);
      return ends.length ? h("section", null, h("h3", null, `${WORDS[kind]} (${ends.length})`), h("ul", { class: "plain-list ends" }, ends.map((each) => endItem(made, one, each)))) : null;
    }),
    dependenceSection(made, one),
    parameterSection(made, one),
    implicitSection(one),
  ];
}

function implicitSection(one) {
  const ends = one.ends.filter((each) => each.implicit);
  return ends.length ? h("details", null, h("summary", null, `created by the client library (${ends.length})`), h("ul", { class: "plain-list" }, ends.map((each) => h("li", null, `${WORDS[each.kind]} ${each.name}`, each.type ? ` (${each.type})` : "")))) : null;
}

// How often a node publishes on a topic, in words, and a topic as a whole where only its name is given; "" where no rate was asked for.
const rateOf = (made, topic, one) => made.rates.get(one ? `${one} ${topic}` : topic) || "";
const rateWords = (rate) => (rate.startsWith("unknown") ? `rate ${rate}` : rate);

function endItem(made, one, each) {
  const marks = [each.kind === "publishers" ? rateWords(rateOf(made, each.name, one.name)) : "", each.ruledOut ? "not created: its condition is false" : "", each.latched ? "latched" : "", each.queue !== null && each.queue !== undefined && !each.qos ? `queue ${each.queue}` : "", qosWords(each.qos)].filter(Boolean);
  return h("li", { class: each.ruledOut ? "ruled-out" : null }, element(made, each.name), each.type ? h("span", { class: "type" }, ` ${each.type}`) : h("span", { class: "type unknown" }, " type not known"),
    each.original && each.original !== each.name ? h("span", { class: "quiet" }, ` remapped from ${each.original}`) : null, marks.length ? h("span", { class: "quiet" }, ` · ${marks.join(", ")}`) : null,
    each.place ? [" ", whereIs(each.place)] : null, conditionList(each.conditions), unknownList(each.unknowns));
}

// Whether a parameter is one of a node's own: /node:name in ROS 2, /node/name in ROS 1. And its name without the node's.
const isOwn = (name, one) => name.startsWith(one.name) && (name[one.name.length] === ":" || name[one.name.length] === "/");
const shortName = (name, one) => (isOwn(name, one) ? name.slice(one.name.length + 1) : name);
// Whether all readers of what is set for a node are known: not of one that is not followed in full, or whose ends come from data on nodes outside the workspace.
const isFollowed = (one) => one.ends.length > 0 && one.source !== "known-node" && !one.unknowns.some((each) => each.field === "endpoints") && !one.ends.some((each) => each.source === "known-node");
const valueWords = (value) => (value === null || value === undefined ? "?" : value === "" ? '""' : value);

// The parameters of a node: what it declares or reads and writes, and what is set for it, with value and origin.
function parametersOf(made, one) {
  if (one.parameterRows) return one.parameterRows;
  const own = made.parameters.filter((each) => isOwn(each.name, one));
  const given = new Map(made.parameters.map((each) => [each.name, each]));
  const rest = new Set(own);
  one.parameterRows = one.ends.filter((each) => !CHANNELS[each.kind] && !each.implicit).map((each) => {
    const set = given.get(each.name);
    rest.delete(set);
    const value = each.kind === "parameters" ? each.value : set ? set.value : each.kind === "setters" ? each.value : null;
    return { name: each.name, short: shortName(each.name, one), value: value ?? each.value ?? each.default, set, end: each };
  });
  for (const each of rest) one.parameterRows.push({ name: each.name, short: shortName(each.name, one), value: each.value, set: each, end: null });
  return one.parameterRows;
}

function parameterSection(made, one) {
  const rows = parametersOf(made, one).map(({ name, short, value, set, end: each }) => [element(made, name, short), valueWords(value), set && (set.origin || set.place) ? whereIs(set.origin || set.place) : each && each.default !== null ? "default in the code" : "",
    each ? `${WORDS[each.kind]}${each.place ? ` at ${each.place.text}` : ""}` : isFollowed(one) && !one.unknowns.length ? "no reader found" : "no reader known"]);
  return rows.length ? h("details", { open: rows.length < 12 }, h("summary", null, `parameters (${rows.length})`), smallTable(["name", "value", "set at", "read"], rows, `parameters of ${one.name}`)) : null;
}

// Every parameter of a configuration by name: who sets it, who declares or reads it, its value and default.
function parameterTable(made) {
  if (made.parameterTable) return made.parameterTable;
  const rows = new Map();
  const of = (name) => rows.get(name) || rows.set(name, { name, set: [], read: [], value: null, fallback: null }).get(name);
  for (const one of made.parameters) { const entry = of(one.name); entry.set.push(one); entry.value = one.value ?? "?"; }
  for (const one of made.nodes)
    for (const each of one.ends) {
      if (CHANNELS[each.kind] || each.implicit) continue;
      const entry = of(each.name);
      if (each.kind === "setters") entry.set.push({ place: each.place, origin: null, value: each.value, node: one });
      else { entry.read.push({ node: one, end: each }); if (each.default !== null) entry.fallback = each.default; if (each.kind === "parameters" && each.value !== null) entry.value ??= each.value; }
    }
  const owners = new Map(made.nodes.map((one) => [one.name, one]));
  const ownerOf = (name) => {
    const colon = name.indexOf(":");
    if (colon > 0 && owners.has(name.slice(0, colon))) return owners.get(name.slice(0, colon));
    for (let at = name.lastIndexOf("/"); at > 0; at = name.lastIndexOf("/", at - 1)) if (owners.has(name.slice(0, at))) return owners.get(name.slice(0, at));
    return null;
  };
  for (const one of rows.values()) {
    const owner = ownerOf(one.name);
    one.mark = !one.set.length && one.fallback === null && one.value === null ? "has no value" : !one.read.length ? (owner && made.nodes.every((each) => each.name !== owner.name || isFollowed(each)) ? "no reader found" : "no reader known") : "";
    one.setAt = one.set.map((each) => (each.origin || each.place ? (each.origin || each.place).text : each.node ? each.node.name : "")).filter(Boolean).join(", ");
    one.readBy = one.read.map((each) => each.node.name).join(", ");
    // The nodes that have to do with it: those that read or write it, or the one that it is set for.
    one.nodes = new Set([...one.read.map((each) => each.node), ...one.set.map((each) => each.node), owner].filter(Boolean));
  }
  made.parameterTable = new Map([...rows].sort((a, b) => compare(a[0], b[0])));
  return made.parameterTable;
}

function parameterDetail(made, one) {
  return [
    h("dl", null, row("value", one.value !== null ? h("code", null, one.value) : "none is set"), row("default", one.fallback !== null ? h("code", null, one.fallback) : ""), row("remark", one.mark)),
    h("section", null, h("h3", null, `set (${one.set.length})`), h("ul", { class: "plain-list" }, one.set.map((each) => h("li", null, h("code", null, each.value ?? "?"), " ", whereIs(each.origin || each.place), each.node ? [" by ", element(made, each.node.name)] : null, frame(each.origin || each.place, 0, 0, 1))))),
    h("section", null, h("h3", null, `declared or read (${one.read.length})`), h("ul", { class: "plain-list" }, one.read.map((each) => h("li", null, element(made, each.node.name), ` ${WORDS[each.end.kind]} `, each.end.type ? `${each.end.type} ` : "", whereIs(each.end.place), each.end.readOnly ? " read-only" : "", each.end.range.length ? ` range ${each.end.range.map((one) => one ?? "…").join(" ")}` : "", conditionList(each.end.conditions))))),
  ];
}

function channelDetail(made, channel) {
  const word = CHANNEL_WORDS[channel.what];
  const offered = channel.ends.filter((each) => each.offers);
  const taken = channel.ends.filter((each) => !each.offers);
  const names = { topics: ["publishers", "subscribers"], services: ["servers", "clients"], actions: ["servers", "clients"] }[channel.what];
  return [
    h("h2", null, breakable(channel.name), " ", h("span", { class: "quiet" }, word)),
    h("dl", null, row(channel.types.length > 1 ? "types" : "type", channel.types.length ? channel.types.map((one, index) => [index ? ", " : "", h("code", null, one)]) : "not known"), row("rate", channel.what === "topics" ? rateOf(made, channel.name) : ""), row("present if", channel.conditional ? "a condition holds (see below)" : "")),
    channel.problems.map((one) => h("p", { class: "warning" }, `${one[0].toUpperCase()}${one.slice(1)}.`)),
    isKnown(channel.name) ? null : candidates(made, channel), findingsOf(made, channel.name),
    [[names[0], offered], [names[1], taken]].map(([title, list]) => h("section", null, h("h3", null, `${title} (${list.length})`), list.length ? h("ul", { class: "plain-list ends" }, list.map(({ node: one, end: each }) =>
      h("li", null, element(made, one.name), each.type && channel.types.length > 1 ? ` ${each.type}` : "", each.qos || each.latched || each.queue !== null || rateOf(made, each.name, one.name) ? h("span", { class: "quiet" }, ` · ${[each.kind === "publishers" ? rateWords(rateOf(made, each.name, one.name)) : "", qosWords(each.qos), each.latched ? "latched" : "", each.queue !== null && !each.qos ? `queue ${each.queue}` : ""].filter(Boolean).join(", ")}`) : null, each.place ? [" ", whereIs(each.place)] : null,
        conditionList([...one.conditions, ...each.conditions]), unknownList(each.unknowns)))) : h("p", { class: "quiet" }, "none in this configuration"))),
    connectionSection(made, channel),
    channel.types.map((type) => typeDetail(type)),
  ];
}

function typeDetail(type) {
  const known = interfaceOf(type);
  if (!known) return null;
  const titles = { msg: [""], srv: ["request", "response"], action: ["goal", "result", "feedback"] }[known.kind] || [];
  return h("details", { open: true }, h("summary", null, type, " ", whereIs(known.place)), known.sections.map((fields, number) => [titles[number] ? h("h5", null, titles[number]) : null, h("pre", { tabindex: "0" }, fields.map(([kind, name, value]) => `${text(kind)} ${text(name)}${text(value) ? `=${text(value)}` : ""}`).join("\n") || "(empty)")]));
}

// Whether a name with unknown parts, each a "?", can be this one.
function canBe(pattern, name) {
  const parts = pattern.split("?");
  if (!name.startsWith(parts[0]) || name.length < pattern.length - parts.length + 1) return false;
  let at = parts[0].length;
  for (const part of parts.slice(1, -1)) {
    const found = name.indexOf(part, at);
    if (found < 0) return false;
    at = found + part.length;
  }
  const end = parts[parts.length - 1];
  return parts.length < 2 || (name.endsWith(end) && name.length - end.length >= at);
}

function candidates(made, channel) {
  const types = new Set(channel.types);
  const found = [...made.channels.values()].filter((one) => one.what === channel.what && isKnown(one.name) && !one.implicit && (!types.size || !one.types.length || one.types.some((type) => types.has(type))) && canBe(channel.name, one.name));
  return h("section", { class: "candidates" }, h("h3", null, "It may be"), found.length ? h("ul", { class: "plain-list" }, found.slice(0, 40).map((one) => h("li", null, element(made, one.name)))) : h("p", { class: "quiet" }, "nothing else of this configuration fits its name and type"), found.length > 40 ? h("p", null, `and ${found.length - 40} more`) : null);
}
