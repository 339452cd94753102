// What recordings say of properties, and what happened where one is violated as a sequence diagram.
const VERDICTS = ["violated", "undecided", "never exercised", "held"];
const ROLES = ["activator", "trigger", "behaviour", "terminator"];
const ROLE_WORDS = { activator: "opens the scope", trigger: "trigger", behaviour: "behaviour", terminator: "closes the scope" };
const VERDICT_SIGNS = { violated: "✗", undecided: "?", "never exercised": "–", held: "✓" };
const RECORDINGS = D.verdicts.map((one) => ({
  name: text(one.name), configuration: text(one.configuration), clock: text(one.clock), messages: one.messages, begin: one.begin, end: one.end, more: one.more,
  properties: one.properties.map(([verdict, id, words, node, granted, at, reason, time, counts, messages]) => ({
    verdict: VERDICTS[verdict], rank: verdict, id: text(id) === text(words) ? "" : text(id), text: text(words), node: text(node), granted: granted === 1, place: place(at), reason: text(reason), time, counts,
    messages: messages.map(([role, topic, number, moment, values, publishers]) => ({ role: ROLES[role], topic: text(topic), number, time: moment, values: values.map(([name, value]) => `${text(name)} = ${text(value)}`), publishers: publishers.map(([name, where]) => ({ node: text(name), place: place(where) })) })),
  })),
}));

// Each verdict at its property: by its place, else by its text; what was asked of the recording alone stands for itself.
function joinVerdicts() {
  for (const one of PROPERTIES) one.verdicts = [];
  const at = new Map(PROPERTIES.map((one) => [`${one.place ? `${one.place.path}:${one.place.line}` : ""} ${one.text}`, one]));
  const said = new Map(PROPERTIES.map((one) => [one.text, one]));
  for (const recording of RECORDINGS)
    for (const each of recording.properties) {
      let one = at.get(`${each.place ? `${each.place.path}:${each.place.line}` : ""} ${each.text}`) || said.get(each.text);
      if (!one) {
        one = { index: PROPERTIES.length, kind: "asked", owner: "", granted: each.granted, id: each.id, title: "", description: "", text: each.text, place: each.place || { path: "", line: 0, text: "" }, until: 0, fault: "", topics: [], configurations: [], key: each.id || each.text, verdicts: [] };
        PROPERTIES.push(one);
        said.set(one.text, one);
      }
      one.verdicts.push({ ...each, recording });
    }
}

const worstVerdict = (one) => (one.verdicts.length ? Math.min(...one.verdicts.map((each) => each.rank)) : VERDICTS.length);
const verdictMark = (verdict) => h("span", { class: `verdict ${verdict.replace(" ", "-")}` }, `${VERDICT_SIGNS[verdict]} ${verdict}`);
const verdictCell = (one) => (one.verdicts.length ? [verdictMark(VERDICTS[worstVerdict(one)]), one.verdicts.length > 1 ? h("span", { class: "quiet" }, ` of ${one.verdicts.length}`) : ""] : h("span", { class: "quiet" }, "not asked"));
const after = (time, recording) => (time === null ? "" : recording.begin === null ? `${time.toFixed(3)} s` : `${time < recording.begin ? "−" : "+"}${Math.abs(time - recording.begin).toFixed(3)} s`);

function recordingsLine() {
  if (!RECORDINGS.length) return null;
  return h("div", { class: "recordings" }, RECORDINGS.map((one) => {
    const counts = VERDICTS.map((verdict) => [verdict, one.properties.filter((each) => each.verdict === verdict).length]).filter(([, number]) => number);
    return h("p", null, h("strong", null, one.name || "recording"), one.configuration ? [" of ", BY_CONFIGURATION.has(one.configuration) ? link("system", { configuration: one.configuration }, one.configuration) : one.configuration] : null,
      h("span", { class: "quiet" }, `: ${count(one.messages, "message")}${one.begin !== null && one.end !== null ? `, ${(one.end - one.begin).toFixed(3)} s` : ""}${one.clock ? `, by ${one.clock} time` : ""} · `), counts.map(([verdict, number]) => [verdictMark(verdict), ` ${number} `]), one.more ? ` and ${one.more} more` : "");
  }));
}

function verdictSection(one) {
  const [scopes, triggers, behaviours] = one.counts;
  const message = (each) => h("li", null, h("code", null, after(each.time, one.recording)), ` ${ROLE_WORDS[each.role]}: message ${each.number.toLocaleString("en")} on `, h("code", null, each.topic), each.values.length ? ` with ${each.values.join(", ")}` : "",
    each.publishers.length ? [", published by ", each.publishers.map((from, index) => [index ? ", " : "", from.node, from.place ? [" at ", whereIs(from.place)] : ""])] : "");
  return h("section", null, h("h3", null, verdictMark(one.verdict), ` by ${one.recording.name || "a recording"}`, one.node ? ` for ${one.node}` : ""), one.reason ? h("p", null, one.reason) : null,
    one.verdict === "violated" ? sequence(one) : null, one.messages.length ? h("ol", { class: "steps" }, one.messages.map(message)) : null,
    h("p", { class: "quiet" }, `scope opened ${count(scopes, "time")}, ${count(triggers, "trigger")}, ${count(behaviours, "time")} the behaviour`));
}

// Who receives a topic in the configuration that was recorded, if that is known.
function receivers(topic, configuration) {
  const one = BY_CONFIGURATION.get(configuration);
  const channel = one ? system(one.index).channels.get(`topics ${topic}`) : null;
  return channel ? [...new Set(channel.ends.filter((each) => !each.gives).map((each) => each.node.name))].sort(compare) : [];
}

const COLUMN = 148;
const STEP = 54;
const MOST_LIVES = 9;
const NOBODY = "(the recording)";

// Nodes as lines from top to bottom, messages as arrows in the order of time, and where the property is violated in red.
function sequence(one) {
  const rows = one.messages.map((each) => ({ ...each, from: each.publishers.length ? each.publishers[0].node : "(not known)", to: receivers(each.topic, one.recording.configuration) }));
  const lives = [...new Set(rows.flatMap((each) => [each.from, ...each.to.slice(0, 3)]))];
  if (rows.some((each) => !each.to.length)) lives.push(NOBODY);
  const shown = lives.slice(0, MOST_LIVES);
  const isLast = one.time !== null && !rows.some((each) => each.time === one.time);
  const [width, height] = [Math.max(2, shown.length) * COLUMN + 30, 70 + (rows.length + (isLast ? 1 : 0)) * STEP];
  const x = (name) => COLUMN * (shown.includes(name) ? shown.indexOf(name) : shown.length - 1) + COLUMN / 2;
  const drawn = [];
  shown.forEach((name) => drawn.push(s("line", { class: "life", x1: x(name), y1: 32, x2: x(name), y2: height - 8 }), s("rect", { class: "head", x: x(name) - 68, y: 6, width: 136, height: 26, rx: 4 }), s("text", { class: "life-name", x: x(name), y: 23 }, s("title", null, name), cut(name.length > 18 ? last(name) : name, 18))));
  rows.forEach((each, index) => {
    const y = 78 + index * STEP;
    const isRed = each.time === one.time;
    const [from, targets] = [x(each.from), (each.to.length ? each.to.slice(0, 3) : [NOBODY]).map(x)];
    for (const to of targets) {
      const way = to === from ? `M${from} ${y}h34v14h-28` : `M${from} ${y}H${to + (to > from ? -7 : 7)}`;
      const tip = to === from ? `M${from} ${y + 14}l8 -4v8z` : `M${to} ${y}l${to > from ? -8 : 8} -4v8z`;
      drawn.push(s("path", { class: isRed ? "message red" : "message", d: way }), s("path", { class: isRed ? "point red" : "point", d: tip }));
    }
    const left = Math.min(from, ...targets);
    const label = [after(each.time, one.recording), each.topic, ...each.values].filter(Boolean).join("  ");
    drawn.push(s("text", { class: isRed ? "said red" : "said", x: Math.min(left + 6, width - 170), y: y - 6 }, s("title", null, label), cut(label, Math.max(24, Math.floor((width - left - 12) / 6.2)))), s("text", { class: isRed ? "said red" : "said quiet", x: Math.min(left + 6, width - 170), y: y + (targets.includes(from) ? 28 : 14) }, isRed ? "✗ violated" : ROLE_WORDS[each.role]));
  });
  if (isLast) {
    const y = 70 + rows.length * STEP + 8;
    drawn.push(s("line", { class: "violation", x1: 8, y1: y, x2: width - 8, y2: y }), s("text", { class: "said red", x: 12, y: y + 16 }, `✗ violated ${after(one.time, one.recording)}`));
  }
  return h("figure", { class: "scroll", tabindex: "0" }, s("svg", { class: "sequence", width, height, viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `the ${count(rows.length, "message")} of the violation in the order of time, as the list below has them` }, drawn), lives.length > shown.length ? h("figcaption", { class: "quiet" }, `${lives.length - shown.length} more nodes are not drawn`) : null);
}
