// What is known of a node or of what connects nodes, beside the picture.
const sourceWords = { source: "the source", launch: "a launch file", hint: "the project file", "known-node": "data on nodes outside the workspace", "exact-tier": "libclang" };

const whereIs = (at) => (at ? h("code", null, at.text) : "");
const conditionList = (list) => (list.length ? h("ul", { class: "conditions" }, list.map((one) => h("li", null, h("code", null, condition(one)), " at ", whereIs(one.place)))) : null);
const unknownList = (list) => (list.length ? h("ul", { class: "unknowns" }, list.map((one) => h("li", null, h("strong", null, `${one.field} not known: `), one.reason, one.place ? [" at ", whereIs(one.place)] : ""))) : null);
const row = (name, ...value) => (value.flat().some((one) => one !== null && one !== "" && one !== undefined) ? [h("dt", null, name), h("dd", null, value)] : null);
const element = (made, name, words) => link("system", { configuration: made.name, with: made.variant, element: name }, words || name);

function findingsOf(made, name) {
  const found = made.findings.get(name) || [];
  if (!found.length) return null;
  return h("section", null, h("h3", null, "Findings"), h("ul", { class: "plain-list" }, found.map((one) => h("li", null, h("span", { class: `level ${one.level}` }, one.level), " ", link("findings", { id: one.id, state: "any" }, one.message)))));
}

function nodeDetail(made, one) {
  const own = made.parameters.filter((each) => each.name.startsWith(`${one.name}/`));
  const kinds = D.kinds.filter((kind) => CHANNELS[kind]);
  return [
    h("h2", null, one.name),
    h("dl", null,
      row("program", `${one.package}/${one.type}`), row("kind", one.kind), row("class", one.class), row("container", one.container ? element(made, one.container) : ""), row("arguments", one.args ? h("code", null, one.args) : ""),
      row("started at", whereIs(one.place)), row("known from", sourceWords[one.source] || ""), row("there if", one.presence ? h("code", null, one.presence) : ""), row("conditions", conditionList(one.conditions)),
      row("remappings", one.remaps.length ? h("ul", { class: "plain-list" }, one.remaps.map(([from, to]) => h("li", null, h("code", null, `${from} → ${to}`)))) : "")),
    unknownList(one.unknowns), findingsOf(made, one.name),
    kinds.map((kind) => {
      const ends = one.ends.filter((each) => each.kind === kind && !each.implicit);
      return ends.length ? h("section", null, h("h3", null, `${WORDS[kind]} (${ends.length})`), h("ul", { class: "plain-list ends" }, ends.map((each) => endItem(made, each)))) : null;
    }),
    parameterSection(one, own),
    implicitSection(one),
  ];
}

function implicitSection(one) {
  const ends = one.ends.filter((each) => each.implicit);
  return ends.length ? h("details", null, h("summary", null, `made by the client library (${ends.length})`), h("ul", { class: "plain-list" }, ends.map((each) => h("li", null, `${WORDS[each.kind]} ${each.name}`, each.type ? ` (${each.type})` : "")))) : null;
}

function endItem(made, each) {
  const marks = [each.ruledOut ? "not made as things are" : "", each.latched ? "latched" : "", each.queue !== null && each.queue !== undefined ? `queue ${each.queue}` : "", qosWords(each.qos)].filter(Boolean);
  return h("li", { class: each.ruledOut ? "ruled-out" : null }, element(made, each.name), each.type ? h("span", { class: "type" }, ` ${each.type}`) : h("span", { class: "type unknown" }, " type not known"),
    each.original && each.original !== each.name ? h("span", { class: "quiet" }, ` remapped from ${each.original}`) : null, marks.length ? h("span", { class: "quiet" }, ` · ${marks.join(", ")}`) : null,
    each.place ? [" ", whereIs(each.place)] : null, conditionList(each.conditions), unknownList(each.unknowns));
}

const qosWords = (qos) => (qos ? Object.entries(qos).map(([name, value]) => `${name} ${value}`).join(", ") : "");

function parameterSection(one, own) {
  const read = one.ends.filter((each) => !CHANNELS[each.kind] && !each.implicit);
  const set = new Map(own.map((each) => [each.name, each]));
  const rows = read.map((each) => {
    const given = set.get(each.name);
    set.delete(each.name);
    const value = each.kind === "parameters" ? each.value : given ? given.value : each.value;
    return [last(each.name) === each.name ? each.name : each.name.replace(`${one.name}/`, ""), value ?? each.value ?? "?", given && (given.origin || given.place) ? whereIs(given.origin || given.place) : each.default !== null ? "default in the code" : "", `${WORDS[each.kind]}${each.place ? ` at ${each.place.text}` : ""}`];
  });
  for (const each of set.values()) rows.push([each.name.replace(`${one.name}/`, ""), each.value ?? "?", whereIs(each.origin || each.place), one.source === "known-node" || one.unknowns.length ? "no reader known" : "no reader seen"]);
  return rows.length ? h("details", { open: rows.length < 12 }, h("summary", null, `parameters (${rows.length})`), smallTable(["name", "value", "set at", "read"], rows, `parameters of ${one.name}`)) : null;
}

function channelDetail(made, channel) {
  const word = { topics: "topic", services: "service", actions: "action" }[channel.what];
  const offered = channel.ends.filter((each) => each.offers);
  const taken = channel.ends.filter((each) => !each.offers);
  const names = { topics: ["publishers", "subscribers"], services: ["servers", "clients"], actions: ["servers", "clients"] }[channel.what];
  return [
    h("h2", null, channel.name, " ", h("span", { class: "quiet" }, word)),
    h("dl", null, row(channel.types.length > 1 ? "types" : "type", channel.types.length ? channel.types.map((one, index) => [index ? ", " : "", h("code", null, one)]) : "not known"), row("there if", channel.conditional ? "a condition holds (see below)" : "")),
    channel.problems.map((one) => h("p", { class: "warning" }, `${one[0].toUpperCase()}${one.slice(1)}.`)),
    isKnown(channel.name) ? null : candidates(made, channel), findingsOf(made, channel.name),
    [[names[0], offered], [names[1], taken]].map(([title, list]) => h("section", null, h("h3", null, `${title} (${list.length})`), list.length ? h("ul", { class: "plain-list ends" }, list.map(({ node: one, end: each }) =>
      h("li", null, element(made, one.name), each.type && channel.types.length > 1 ? ` ${each.type}` : "", each.qos || each.latched || each.queue !== null ? h("span", { class: "quiet" }, ` · ${[qosWords(each.qos), each.latched ? "latched" : "", each.queue !== null ? `queue ${each.queue}` : ""].filter(Boolean).join(", ")}`) : null, each.place ? [" ", whereIs(each.place)] : null,
        conditionList([...one.conditions, ...each.conditions]), unknownList(each.unknowns)))) : h("p", { class: "quiet" }, "none in this configuration"))),
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
