// What is near an element, what it reaches and what it depends on; a node is taken to pass on all that it receives.
const nodeId = (one) => `n${one.index}`;
const channelId = (one) => `c ${one.key}`;

// From each element to those that it gives to, and back; only what is shown.
function neighbours(made, shown) {
  const out = new Map();
  const into = new Map();
  const add = (map, from, to) => (map.get(from) || map.set(from, new Set()).get(from)).add(to);
  for (const channel of made.channels.values()) {
    if (!shown(channel)) continue;
    for (const each of channel.ends) {
      const [from, to] = each.gives ? [nodeId(each.node), channelId(channel)] : [channelId(channel), nodeId(each.node)];
      add(out, from, to);
      add(into, to, from);
    }
  }
  return { out, into };
}

// Every element that can be reached along *next*, with the number of steps to it, up to *most* steps, and not through *wall*.
function reached(start, next, most, wall) {
  const found = new Map([[start, 0]]);
  let edge = [start];
  for (let step = 1; edge.length && step <= most; step++) {
    const ahead = [];
    for (const from of edge)
      for (const to of (from !== wall && next.get(from)) || []) {
        if (found.has(to)) continue;
        found.set(to, step);
        ahead.push(to);
      }
    edge = ahead;
  }
  return found;
}

// The levels of what is looked at around *start*: negative is before it, positive behind.
function levels(made, shown, start, way, hops) {
  const { out, into } = neighbours(made, shown);
  const found = new Map();
  if (way !== "before") for (const [id, step] of reached(start, out, hops)) found.set(id, step);
  if (way !== "behind") for (const [id, step] of reached(start, into, hops)) if (!found.has(id) || step < found.get(id)) found.set(id, -step);
  if (way === "around" && hops < Infinity) grow(found, out, into, hops);
  return found;
}

// What lies on a way from *start* to *goal*, by the steps from the start; nothing if there is no way.
function between(made, shown, start, goal) {
  const { out, into } = neighbours(made, shown);
  const back = reached(goal, into, Infinity, start);
  return back.has(start) ? new Map([...reached(start, out, Infinity, goal)].filter(([id]) => back.has(id))) : new Map([[start, 0], [goal, 1]]);
}

// All within so many steps whatever their direction: what gives to a neighbour stands left of it.
function grow(found, out, into, hops) {
  const steps = new Map([...found].map(([id, level]) => [id, Math.abs(level)]));
  const edge = [...steps].sort((a, b) => a[1] - b[1]).map(([id]) => id);
  for (let at = 0; at < edge.length; at++) {
    const id = edge[at];
    if (steps.get(id) >= hops) continue;
    for (const [next, sign] of [[out, 1], [into, -1]])
      for (const to of next.get(id) || []) {
        if (steps.has(to)) continue;
        steps.set(to, steps.get(id) + 1);
        found.set(to, found.get(id) + sign);
        edge.push(to);
      }
  }
}

// Edges that lead back reach around their elements: room for them at both sides.
function roomForLoops(made, places, size) {
  const isBack = (from, to) => places.has(from) && places.has(to) && places.get(to)[0] <= places.get(from)[0] + places.get(from)[2];
  const loops = [...made.channels.values()].some((channel) => channel.ends.some((each) => (each.gives ? isBack(nodeId(each.node), channelId(channel)) : isBack(channelId(channel), nodeId(each.node)))));
  if (!loops) return;
  for (const one of places.values()) one[0] += 50;
  size[0] += 100;
  size[1] += 30;
}

// Places in columns by level, each ordered by its neighbours in the column before.
function columns(found, size, next) {
  const byLevel = new Map();
  for (const [id, level] of found) (byLevel.get(level) || byLevel.set(level, []).get(level)).push(id);
  const places = new Map();
  const ordered = [...byLevel.keys()].sort((a, b) => a - b);
  const inOrder = [...ordered].sort((a, b) => Math.abs(a) - Math.abs(b));
  const middle = new Map();
  for (const level of inOrder) {
    const ids = byLevel.get(level).sort(compare);
    const weight = new Map(ids.map((id, index) => {
      const near = [...(next.out.get(id) || []), ...(next.into.get(id) || [])].filter((one) => middle.has(one) && found.get(one) !== level);
      return [id, near.length ? near.reduce((sum, one) => sum + middle.get(one), 0) / near.length : index * 30];
    }));
    ids.sort((a, b) => weight.get(a) - weight.get(b) || compare(a, b));
    const tall = ids.reduce((sum, id) => sum + size(id)[1] + 12, 0);
    let y = -tall / 2;
    for (const id of ids) {
      places.set(id, [0, y, ...size(id)]);
      middle.set(id, y + size(id)[1] / 2);
      y += size(id)[1] + 12;
    }
  }
  let x = 20;
  for (const level of ordered) {
    const wide = Math.max(...byLevel.get(level).map((id) => size(id)[0]));
    for (const id of byLevel.get(level)) places.get(id)[0] = x + (wide - size(id)[0]) / 2;
    x += wide + 70;
  }
  const least = Math.min(...[...places.values()].map((one) => one[1])) - 20;
  let most = 0;
  for (const one of places.values()) {
    one[1] -= least;
    most = Math.max(most, one[1] + one[3]);
  }
  return { places, size: [x - 50, most + 20] };
}
