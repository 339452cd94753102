// Quality of service of the two sides of a topic or service: whether they match, by the same rules as the checks (checking/compatibility.py).
const POLICIES = ["reliability", "durability", "deadline", "liveliness"];
const WEAKER = { reliability: "best_effort", durability: "volatile" };
const STRONGER = { reliability: "reliable", durability: "transient_local" };
const qosWord = (value) => String(value).replace(/_/g, " ");

// Every policy that the code sets, in words; "" where there is none, as in ROS 1.
function qosWords(qos) {
  if (!qos) return "";
  const word = (policy) => (qos[policy] === undefined ? `default ${policy}` : qos[policy] === "?" ? `unknown ${policy}` : qosWord(qos[policy]));
  const history = qos.history === "keep_last" && qos.depth !== undefined ? `keep last ${qos.depth === "?" ? "an unknown number" : qos.depth}` : word("history");
  const more = [["deadline", "deadline"], ["lifespan", "lifespan"], ["liveliness", "liveliness"], ["lease", "lease duration"]].filter(([policy]) => qos[policy] !== undefined);
  return [word("reliability"), word("durability"), history, ...more.map(([policy, name]) => `${name} ${qos[policy] === "?" ? "unknown" : qosWord(qos[policy])}${policy === "liveliness" || qos[policy] === "?" ? "" : " s"}`)].join(", ");
}

// A time that is not set has no end; what is not known may be as short or as long as it likes.
const isLonger = (offered, requested) => requested !== undefined && requested !== "?" && offered !== "?" && (offered === undefined || Number(offered) > Number(requested));
const mayBeLonger = (offered, requested) => isLonger(offered, requested) || requested === "?" || (offered === "?" && requested !== undefined);

// "no", "perhaps" where it depends on what is not known or on the middleware, or "yes": whether the offer keeps the two from being connected.
function refusal(policy, offer, request) {
  if (WEAKER[policy]) {
    const [offered, requested] = [offer[policy], request[policy]];
    if (offered === WEAKER[policy] && requested === STRONGER[policy]) return "yes";
    const isOpen = (value) => value === undefined || value === "?";
    return (offered === WEAKER[policy] || isOpen(offered)) && (requested === STRONGER[policy] || isOpen(requested)) && !(offered === undefined && requested === undefined) ? "perhaps" : "no";
  }
  if (policy === "deadline") return isLonger(offer.deadline, request.deadline) ? "yes" : mayBeLonger(offer.deadline, request.deadline) ? "perhaps" : "no";
  const [offered, requested] = [offer.liveliness ?? "automatic", request.liveliness ?? "automatic"];
  if ((requested === "manual_by_topic" && offered === "automatic") || isLonger(offer.lease, request.lease)) return "yes";
  return (requested === "?" && offered !== "manual_by_topic") || (offered === "?" && requested === "manual_by_topic") || mayBeLonger(offer.lease, request.lease) ? "perhaps" : "no";
}

const valueOf = (policy, qos) => {
  const time = (name, value) => (value === undefined ? `no ${name}` : value === "?" ? `an unknown ${name}` : `a ${name} of ${value} s`);
  if (policy === "deadline") return time("deadline", qos.deadline);
  if (policy === "liveliness") return `${qos.liveliness === "?" ? "unknown" : qosWord(qos.liveliness ?? "automatic")} liveliness with ${time("lease duration", qos.lease)}`;
  return qos[policy] === undefined ? `the middleware's default ${policy}` : qos[policy] === "?" ? `an unknown ${policy}` : qosWord(qos[policy]);
};

// What becomes of two ends of one topic or service: { kind: "matches", "fails", "open" or "" (ROS 1), words }.
function connection(giver, taker, what) {
  const [offer, request] = [giver.end.qos, taker.end.qos];
  if (isKnown(giver.end.type) && isKnown(taker.end.type) && giver.end.type !== taker.end.type) return { kind: "fails", words: `different types: ${giver.end.type} and ${taker.end.type}` };
  if (what === "actions" || (giver.node.ros === 1 && taker.node.ros === 1)) return { kind: "", words: "" };
  if (!offer || !request) return { kind: "open", words: `not known: the code of ${[offer ? null : giver.node.name, request ? null : taker.node.name].filter(Boolean).join(" and ")} does not tell its quality of service` };
  // Of a service each side offers and requests the same.
  const both = what === "services" ? [[offer, request], [request, offer]] : [[offer, request]];
  const said = (wanted) => POLICIES.filter((policy) => both.some(([one, other]) => refusal(policy, one, other) === wanted)).map((policy) => `${policy} (${valueOf(policy, offer)} offered, ${valueOf(policy, request)} requested)`);
  const failed = said("yes");
  if (failed.length) return { kind: "fails", words: `does not match: ${failed.join(", ")}` };
  const open = said("perhaps");
  return open.length ? { kind: "open", words: `not known: ${open.join(", ")}` } : { kind: "matches", words: "matches" };
}

const KINDS_OF_CONNECTION = { fails: "✕", open: "?", matches: "✓" };
const connectionWords = (found) => (found.kind ? h("span", { class: `connection ${found.kind}` }, `${KINDS_OF_CONNECTION[found.kind]} ${found.words}`) : h("span", { class: "quiet" }, "ROS 1 has none"));

// Every giver with every taker, those that do not match first.
function pairsOf(channel, only) {
  const givers = channel.ends.filter((one) => one.offers && (!only || only(one) || channel.ends.some((each) => !each.offers && only(each))));
  const found = [];
  for (const giver of givers)
    for (const taker of channel.ends) {
      if (taker.offers || (only && !only(giver) && !only(taker))) continue;
      found.push({ giver, taker, found: connection(giver, taker, channel.what) });
      if (found.length >= 4000) return found;
    }
  const rank = { fails: 0, open: 1, matches: 2, "": 3 };
  return found.sort((a, b) => rank[a.found.kind] - rank[b.found.kind] || compare(a.giver.node.name, b.giver.node.name) || compare(a.taker.node.name, b.taker.node.name));
}

// What keeps ends that are certainly there from each other, in sentences; as the checks, it is silent on ends that the workspace does not have.
function incompatible(ends, every, what) {
  const found = [];
  const isHere = ({ end: each }) => each.place && (each.source === "source" || each.source === "exact-tier");
  const explicit = ends.filter((one) => !one.end.implicit);
  for (const giver of explicit.filter((one) => one.offers))
    for (const taker of explicit.filter((one) => !one.offers)) {
      if (!(isHere(giver) || isHere(taker))) continue;
      const made = connection(giver, taker, what);
      if (made.kind !== "fails" || made.words.startsWith("different")) continue;
      // A node that makes another end in place of this one under a condition may be connected all the same.
      const hasTwin = (one, other) => every.some((each) => each !== one && each.node === one.node && each.offers === one.offers && each.end.conditions.length && (each.offers ? connection(each, other, what) : connection(other, each, what)).kind !== "fails");
      if (hasTwin(giver, taker) || hasTwin(taker, giver)) continue;
      found.push(`the quality of service of ${giver.node.name} and ${taker.node.name} ${made.words}`);
      if (found.length > 20) return found;
    }
  return found;
}

// The table of givers and takers of a topic or service, or of those of them that *only* holds for.
function connectionSection(made, channel, only) {
  const pairs = pairsOf(channel, only);
  if (!pairs.length || pairs.every((one) => !one.found.kind)) return null;
  const most = 30;
  const names = channel.what === "topics" ? ["publisher", "subscriber"] : ["server", "client"];
  const side = (one) => [element(made, one.node.name), h("div", { class: "quiet" }, one.end.qos ? qosWords(one.end.qos) : "not known"), one.end.conditions.length || one.node.conditions.length || one.node.presence ? h("div", { class: "quiet" }, "conditional") : null];
  return h("section", { class: "connections" }, h("h3", null, "Quality of service"), smallTable([...names, "connected"], pairs.slice(0, most).map((one) => [side(one.giver), side(one.taker), connectionWords(one.found)]), `quality of service on ${channel.name}`),
    pairs.length > most ? h("p", { class: "quiet" }, `and ${count(pairs.length - most, "pair")} more, of which ${pairs.slice(most).filter((one) => one.found.kind === "fails").length} do not match`) : null);
}

// What runs along an edge: the calls of the node that make this end, and with whom each is connected.
function edgeDetail(made, channel, one) {
  const own = channel.ends.filter((each) => each.node === one);
  const word = CHANNEL_WORDS[channel.what];
  return [
    h("h2", null, breakable(`${one.name} – ${channel.name}`), " ", h("span", { class: "quiet" }, "connection")),
    h("dl", null, row("node", element(made, one.name)), row(word, element(made, channel.name)), row("type", channel.types.length ? channel.types.map((type, index) => [index ? ", " : "", h("code", null, type)]) : "not known")),
    h("ul", { class: "plain-list ends" }, own.map(({ end: each }) => h("li", { class: each.ruledOut ? "ruled-out" : null }, `${WORDS[each.kind]} `, each.original && each.original !== each.name ? h("span", { class: "quiet" }, `remapped from ${each.original} `) : null, h("span", { class: "quiet" }, [each.kind === "publishers" ? rateWords(rateOf(made, channel.name, one.name)) : "", qosWords(each.qos), each.latched ? "latched" : "", each.queue !== null && each.queue !== undefined && !each.qos ? `queue ${each.queue}` : ""].filter(Boolean).join(", ")), " ", whereIs(each.place), conditionList([...one.conditions, ...each.conditions]), unknownList(each.unknowns)))),
    connectionSection(made, channel, (each) => each.node === one) || h("p", { class: "quiet" }, channel.what === "topics" && one.ros === 1 ? "ROS 1 has no quality of service: publisher and subscriber are connected if their types are the same." : `Nobody of this configuration is at the other side of this ${word}.`),
    channel.types.map((type) => typeDetail(type)),
  ];
}

// Several edges that are drawn as one between folded boxes.
function bundleDetail(members, describe) {
  const listed = members.slice(0, 200);
  return [h("h2", null, count(members.length, "connection")), h("ul", { class: "plain-list" }, listed.map((one) => h("li", null, h("button", { class: `plain linked${one.classes.includes("red") ? " red" : ""}`, onclick: () => describe(one) }, one.tip.split("\n")[0])))), members.length > listed.length ? h("p", { class: "quiet" }, `and ${members.length - listed.length} more`) : null];
}
