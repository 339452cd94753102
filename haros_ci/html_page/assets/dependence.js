// Which inputs of a node can cause which of its outputs, as haros-ci report --dependence has found it (docs/dependence.md).
const CAUSE_MEDIA = { subscription: "topics", service: "services", action: "actions" };
const dependenceRows = new Map();

// The row of a node: its inputs, and its outputs with their causes; made once.
function dependenceRow(index) {
  if (dependenceRows.has(index)) return dependenceRows.get(index);
  const [reason, inputs, outputs] = TABLES.dependence[index];
  const made = {
    reason: text(reason), inputs: inputs.map(([kind, name, at, why]) => ({ kind: text(kind), name: text(name), place: place(at), reason: text(why) })),
    outputs: outputs.map(([kind, name, isStart, why, causes]) => ({ kind: D.kinds[kind], what: CHANNELS[D.kinds[kind]], name: text(name), isStart: isStart === 1, reason: text(why), causes: causes.map(causeOf) })),
  };
  dependenceRows.set(index, made);
  return made;
}

function causeOf(index) {
  const [kind, name, how, isEach, state, reason, at, whens, path] = TABLES.causes[index];
  return {
    kind: text(kind), name: text(name), how, isEach: isEach === 1, state: texts(state), reason: text(reason), place: place(at),
    whens: whens.map(([words, isMet, reads, where]) => ({ text: text(words), isMet: isMet === 1, reads: texts(reads), place: place(where) })), path: path.map(([where, words]) => ({ place: place(where), text: text(words) })),
  };
}

// What a node may send because it got something on a channel: pairs of the id of another channel and whether that is certain. Of a node without a row, and of an
// input or an output that is not followed, it is everything.
function causedBy(made, one, from) {
  const row = made.dependence.get(one.index);
  const sent = one.channels.filter((channel) => channel.ends.some((each) => each.node === one && each.gives));
  if (!row) return sent.map((channel) => [channelId(channel), false]);
  const isInput = (each) => CAUSE_MEDIA[each.kind] === from.what && each.name === from.name;
  const input = row.inputs.find(isInput);
  return row.outputs.flatMap((output) => {
    const causes = output.causes.filter(isInput);
    if (!causes.length && input && !input.reason && !output.reason) return [];
    const isSure = causes.some((each) => each.how < 2);
    return sent.filter((channel) => channel.what === output.what && channel.name === output.name).map((channel) => [channelId(channel), isSure]);
  });
}

// The inputs of a node because of which it may send something, likewise.
function causesOf(made, one, to) {
  const inputs = one.channels.filter((channel) => channel.ends.some((each) => each.node === one && !each.gives));
  return inputs.flatMap((input) => causedBy(made, one, input).filter(([id]) => id === channelId(to)).map(([, isSure]) => [channelId(input), isSure]));
}

// What *start* reaches, or what reaches it, where nodes pass on what the code does: the level of each element, and the edges on the way, true for certain ones.
function followed(made, shown, start, isForward) {
  const found = new Map([[start, 0]]);
  const ways = new Map();
  const waiting = [];
  const [sign, gives] = isForward ? [1, true] : [-1, false];
  const note = (from, to, isSure) => { const key = isForward ? `${from}>${to}` : `${to}>${from}`; ways.set(key, ways.get(key) || isSure); };
  const enter = (id, level) => { if (!found.has(id)) found.set(id, sign * level); if (id.startsWith("c ")) waiting.push([id, level]); };
  const channelOf = (id) => { const one = made.channels.get(id.slice(2)); return one && shown(one) ? one : null; };
  if (start.startsWith("n")) for (const channel of made.numbered.get(Number(start.slice(1))).channels) {
    if (!shown(channel) || !channel.ends.some((each) => nodeId(each.node) === start && each.gives === gives)) continue;
    note(start, channelId(channel), true);
    enter(channelId(channel), 1);
  }
  else waiting.push([start, 0]);
  const seen = new Set();
  while (waiting.length) {
    const [id, level] = waiting.shift();
    if (seen.has(id)) continue;
    seen.add(id);
    const channel = channelOf(id);
    for (const each of channel ? channel.ends : []) {
      if (each.gives === gives) continue;
      const node = nodeId(each.node);
      note(id, node, true);
      enter(node, level + 1);
      for (const [next, isSure] of (isForward ? causedBy : causesOf)(made, each.node, channel)) {
        if (!channelOf(next)) continue;
        note(node, next, isSure);
        enter(next, level + 2);
      }
    }
  }
  return { found, ways };
}

// What lies on a way from *start* to *goal* in the same sense; nothing if there is none.
function followedBetween(made, shown, start, goal) {
  const [ahead, back] = [followed(made, shown, start, true), followed(made, shown, goal, false)];
  const ways = new Map([...ahead.ways].filter(([key]) => back.ways.has(key)).map(([key, isSure]) => [key, isSure && back.ways.get(key)]));
  const on = new Set([...ways.keys()].flatMap((key) => key.split(">")));
  return { found: on.has(start) && on.has(goal) ? new Map([...ahead.found].filter(([id]) => on.has(id))) : new Map([[start, 0], [goal, 1]]), ways };
}

const causeName = (cause) => (cause.name ? cause.name : cause.kind === "timer" ? "a timer" : cause.kind === "response" ? "the answer to a call" : cause.kind === "parameters" ? "a change of parameters" : cause.kind);

function causeItem(made, cause) {
  const marks = [cause.isEach ? "each time" : "", cause.state.length ? `through state ${cause.state.join(", ")}` : "", cause.reason ? `perhaps: ${cause.reason}` : ""].filter(Boolean);
  const whens = cause.whens.map((one) => h("li", null, one.isMet ? "" : "not ", h("code", null, one.text), one.reads.length ? h("span", { class: "quiet" }, ` asks for ${one.reads.join(", ")}`) : "", one.place ? [" at ", whereIs(one.place)] : ""));
  return h("li", null, cause.name ? element(made, cause.name) : [causeName(cause), " ", whereIs(cause.place)], marks.length ? h("span", { class: cause.how === 2 ? "remark" : "quiet" }, ` · ${marks.join(" · ")}`) : null,
    whens.length ? [h("div", { class: "quiet" }, "if"), h("ul", { class: "conditions" }, whens)] : null,
    cause.path.length ? h("details", null, h("summary", null, "how"), h("ol", { class: "steps" }, cause.path.map((one) => h("li", null, whereIs(one.place), ": ", one.text)))) : null);
}

// For each output of a node what can cause it, with conditions, and why others may.
function dependenceSection(made, one) {
  const row = made.dependence.get(one.index);
  if (!row || !(row.outputs.length || row.inputs.length)) return null;
  const used = new Set(row.outputs.flatMap((output) => output.causes.map((cause) => `${cause.kind} ${cause.name}`)));
  const isOpen = row.outputs.some((output) => output.reason);
  const idle = row.inputs.filter((input) => input.name && !used.has(`${input.kind} ${input.name}`));
  return h("section", { class: "dependence" }, h("h3", null, "What causes what"),
    row.outputs.map((output) => h("div", null, h("p", null, `${WORDS[output.kind]} `, element(made, output.name), " because of"), h("ul", { class: "plain-list ends causes" }, output.causes.map((cause) => causeItem(made, cause)),
      output.isStart ? h("li", null, "nothing that it gets: by itself, at its beginning or in a loop of its own") : null, output.reason ? h("li", { class: "remark" }, `? others may be causes: ${output.reason}`) : null,
      !output.causes.length && !output.isStart && !output.reason ? h("li", { class: "quiet" }, "nothing that the code shows") : null))),
    idle.length ? h("ul", { class: "plain-list" }, idle.map((input) => h("li", null, element(made, input.name), h("span", { class: input.reason || isOpen ? "remark" : "quiet" }, input.reason ? ` ? what it does is not known: ${input.reason}` : isOpen ? " causes none of these for certain" : " causes none of these")))) : null,
    row.reason ? h("p", { class: "remark" }, `It may have other inputs and outputs: ${row.reason}`) : null);
}
