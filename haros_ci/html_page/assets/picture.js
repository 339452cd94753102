// A picture of elements at given places: it can be moved and enlarged, and boxes fold into one element with bundled edges.
const FOLDED = [190, 46];
const LINE = 15;
const HEAD = 38;
// A picture that does not begin as a whole begins at this scale.
const READABLE = 0.6;

function outline(what, [x, y, width, height]) {
  if (what === "services") return `M${x + 9} ${y}H${x + width}L${x + width - 9} ${y + height}H${x}Z`;
  const middle = y + height / 2;
  return `M${x + 10} ${y}H${x + width - 10}L${x + width} ${middle}L${x + width - 10} ${y + height}H${x + 10}L${x} ${middle}Z`;
}

function shape(what, rectangle) {
  const [x, y, width, height] = rectangle;
  if (what === "services" || what === "actions") return s("path", { class: "shape", d: outline(what, rectangle) });
  return s("rect", { class: "shape", x, y, width, height, rx: what === "topics" ? height / 2 : 4 });
}

// What fits into so many px; of a name that does not, its end, which tells it from others.
function fitted(words, width, character) {
  const most = Math.max(4, Math.floor((width - 14) / (character || 6.5)));
  const sign = /^[+−~] (?=\/)/.test(words) ? words.slice(0, 2) : "";
  return words.startsWith("/", sign.length) && words.length > most ? `${sign}…${words.slice(words.length - most + 1 + sign.length)}` : cut(words, most);
}

function curve(from, to, bend) {
  const start = [from[0] + from[2], from[1] + from[3] / 2];
  const goal = [to[0], to[1] + to[3] / 2];
  if (goal[0] > start[0]) {
    const reach = Math.max(24, (goal[0] - start[0]) / 2);
    return `M${start[0]} ${start[1]}C${start[0] + reach} ${start[1]} ${goal[0] - reach} ${goal[1]} ${goal[0]} ${goal[1]}`;
  }
  const below = Math.max(from[1] + from[3], to[1] + to[3]) + 18 + (bend || 0);
  return `M${start[0]} ${start[1]}C${start[0] + 60} ${start[1]} ${start[0] + 60} ${below} ${(start[0] + goal[0]) / 2} ${below}S${goal[0] - 60} ${goal[1]} ${goal[0]} ${goal[1]}`;
}

function polyline(points) {
  let made = `M${points[0]} ${points[1]}`;
  for (let at = 2; at < points.length; at += 2) made += `L${points[at]} ${points[at + 1]}`;
  return made;
}

// Room for nodes that are taller than the layout knew: what is below moves down with all of its row, so that nothing overlaps and the order stays.
function stretched(scene) {
  const cuts = []; // [height from which on things move, by how much], ascending
  const down = (y) => y + cuts.reduce((sum, [at, more]) => (at <= y ? sum + more : sum), 0);
  const nodes = scene.elements.filter((one) => one.tall).sort((a, b) => a.rectangle[1] + a.rectangle[3] - b.rectangle[1] - b.rectangle[3]);
  for (const one of nodes) {
    const [, y, , height] = one.rectangle;
    const missing = one.tall - (down(y + height) - down(y));
    if (missing > 0) cuts.push([y + height, missing]);
  }
  if (!cuts.length) return scene;
  const between = ([x, y, width, height]) => [x, down(y), width, down(y + height) - down(y)];
  return {
    ...scene, size: [scene.size[0], down(scene.size[1])],
    boxes: scene.boxes.map((one) => ({ ...one, rectangle: between(one.rectangle) })),
    elements: scene.elements.map((one) => { const [x, y, width, height] = one.rectangle; return { ...one, rectangle: [x, down(y), width, one.tall || height] }; }),
    edges: scene.edges.map((one) => ({ ...one, points: one.points.map((value, at) => (at % 2 ? down(value) : value)) })),
  };
}

// A map of one axis that takes away what is empty of it: of stretches without anything in *taken*, a list of [from, to], *most* are left.
function squeezed(taken, most) {
  const merged = [];
  for (const [from, to] of taken.sort((a, b) => a[0] - b[0])) {
    const before = merged[merged.length - 1];
    if (before && from <= before[1]) before[1] = Math.max(before[1], to);
    else merged.push([from, to]);
  }
  const gaps = [];
  for (let at = 0; at < merged.length; at++) {
    const [from, to] = [at ? merged[at - 1][1] : 0, merged[at][0]];
    if (to - from > (at ? most : 14)) gaps.push([from, to, at ? most : 14]);
  }
  if (merged.length) gaps.push([merged[merged.length - 1][1], Infinity, 14]);
  return (value) => gaps.reduce((sum, [from, to, left]) => (value <= from ? sum : to === Infinity ? sum - Math.max(0, value - from - left) : sum - (Math.min(value, to) - from) * (1 - left / (to - from))), value);
}

function makePicture({ label, select, folded, pick }) {
  const view = { x: 0, y: 0, scale: 1 };
  // Whether all of it is in sight: then it stays so when its room changes.
  let isFitted = false;
  let isBegun = false;
  let isAlways = false;
  const layer = s("g", {});
  const arrow = (id, kind) => s("marker", { id, class: kind, viewBox: "0 0 8 8", refX: 7, refY: 4, markerWidth: 9, markerHeight: 9, markerUnits: "userSpaceOnUse", orient: "auto" }, s("path", { d: "M0 0.5L7.5 4L0 7.5Z" }));
  const svg = s("svg", { class: "picture", role: "application", tabindex: "0", "aria-label": label }, s("defs", {}, arrow("arrow", "tip"), arrow("arrow-strong", "tip strong")), layer);
  let scene = { size: [1, 1], boxes: [], elements: [], edges: [] };
  let closed = new Set();
  const drawn = new Map();
  let paths = [];
  let chosen = null;
  // Edges that were clicked, and elements that belong together without an edge.
  let picked = null;
  let together = null;
  const moved = new Map();
  const edgeKey = (one) => `${one.from}>${one.to}`;

  const place = (fitted) => {
    isFitted = fitted === true;
    layer.setAttribute("transform", `translate(${view.x} ${view.y}) scale(${view.scale})`);
  };
  const around = (box) => (box < 0 ? [] : [box, ...around(scene.boxes[box].parent)]);
  // Where scene coordinates are drawn: a large picture with folded boxes is squeezed, so that what is left of it can be read; what is left of what stays there.
  let across = (x) => x;
  let down = (y) => y;
  let isSqueezed = false;
  const outermost = (box) => around(box).filter((one) => closed.has(one)).pop();

  function rectangleOf(id) {
    const box = representative(id);
    if (box !== undefined) return foldedRectangle(scene.boxes[box]);
    const { rectangle: [x, y, width, height], drawnAt, shownAt } = elementOf(id);
    return drawnAt ? [shownAt[0] + x - drawnAt[0], shownAt[1] + y - drawnAt[1], width, height] : [across(x), down(y), width, height];
  }

  let byId = new Map();
  const elementOf = (id) => byId.get(id);
  const representative = (id) => outermost(elementOf(id).box);

  function squeeze() {
    isSqueezed = closed.size > 0 && scaleToFit(scene.size) < 0.45;
    [across, down] = [(x) => x, (y) => y];
    if (!isSqueezed) return;
    const left = scene.elements.filter((one) => representative(one.id) === undefined).map((one) => one.rectangle);
    const outer = scene.boxes.map((box, index) => ({ box, index })).filter(({ box }) => outermost(box.parent) === undefined);
    const folded = outer.filter(({ index }) => closed.has(index)).map(({ box }) => middleOf(box));
    const heads = outer.filter(({ index }) => !closed.has(index)).map(({ box: { rectangle: [x, y] } }) => [x, y, 1, 20]);
    across = squeezed([...left, ...folded].map(([x, , width]) => [x, x + width]), 60);
    down = squeezed([...left, ...folded, ...heads].map(([, y, , height]) => [y, y + height]), 24);
  }

  function draw() {
    drawn.clear();
    paths = [];
    squeeze();
    for (const one of scene.elements) one.drawnAt = null;
    const boxes = [];
    scene.boxes.forEach((box, index) => {
      const outer = outermost(box.parent);
      if (outer !== undefined) return;
      const isClosed = closed.has(index);
      const [x, y, width, height] = boxRectangle(index);
      const scale = isClosed ? foldedScale(box) : 1;
      const inside = isClosed ? scene.elements.filter((one) => around(one.box).includes(index) && one.isNode).length : 0;
      const title = isClosed ? `${box.label} (${count(inside, "node")})` : box.label;
      const flip = () => fold(index, !isClosed);
      boxes.push(s("g", { class: `box ${box.kind}${isClosed ? " closed" : ""}` },
        s("rect", { class: "shape", x, y, width, height, rx: 6 }),
        s("g", { class: "handle", tabindex: "0", role: "button", "aria-expanded": String(!isClosed), "aria-label": `${isClosed ? "Unfold" : "Fold"} ${box.kind} ${box.label}`, onclick: (event) => { event.stopPropagation(); flip(); }, onkeydown: (event) => { if (event.key === "Enter" || event.key === " ") { event.preventDefault(); event.stopPropagation(); flip(); } } },
          s("rect", { class: "grip", x, y, width, height: isClosed ? height : 20, rx: 6 }),
          s("text", { x: x + 8 * scale, y: isClosed ? y + height / 2 + 4 * scale : y + 14, "font-size": 11.5 * scale }, `${isClosed ? "▸" : "▾"} ${fitted(`${box.kind === "container" ? "container " : ""}${title}`, width / scale - 10, isClosed ? 7.4 : 6.9)}`),
          s("title", {}, `${box.kind} ${box.label}: ${isClosed ? "unfold" : "fold"}`))));
    });
    const elements = [];
    for (const one of scene.elements) {
      if (representative(one.id) !== undefined) continue;
      const [x, y, width, height] = rectangleOf(one.id);
      [one.drawnAt, one.shownAt] = [one.rectangle.slice(0, 2), [x, y]];
      const group = s("g", { class: `element ${one.what} ${one.classes.join(" ")}`, "data-id": one.id });
      group.append(shape(one.what, [x, y, width, height]), s("title", {}, one.tip));
      if (one.isNode) {
        const top = one.isCentred ? y + (height - HEAD) / 2 : y;
        group.append(s("text", { class: "name", x: x + width / 2, y: top + 16 }, fitted(one.title, width, 7.4)), s("text", { class: "sub", x: x + width / 2, y: top + 30 }, fitted(one.sub, width * 1.12)));
        one.lines.forEach((each, number) => group.append(s("text", { class: `own ${each.classes || ""}`, x: x + 8, y: y + HEAD + 8 + number * LINE, "data-id": each.id }, fitted(each.text, width * 1.1))));
      } else group.append(s("text", { class: "name", x: x + width / 2, y: y + 16 }, fitted(one.title, width - 14)));
      drawn.set(one.id, group);
      elements.push(group);
    }
    clear(layer, boxes.filter((one) => !one.classList.contains("closed")), edges(), boxes.filter((one) => one.classList.contains("closed")), elements);
    remark();
    place(isFitted);
  }

  // In the middle of where the box was, the larger the larger the box: it must be read where the whole is small.
  function foldedRectangle(box) {
    if (isSqueezed) {
      const [x, y, width, height] = middleOf(box);
      return [across(x), down(y), width, height];
    }
    const [x, y, width, height] = box.rectangle;
    const scale = foldedScale(box);
    const [w, tall] = [Math.min(FOLDED[0] * scale, width), Math.min(FOLDED[1] * scale, height)];
    return [x + (width - w) / 2, y + (height - tall) / 2, w, tall];
  }

  const middleOf = ({ rectangle: [x, y, width, height] }) => { const [w, tall] = [Math.min(FOLDED[0] * 1.3, width), Math.min(FOLDED[1], height)]; return [x + (width - w) / 2, y + (height - tall) / 2, w, tall]; };

  function boxRectangle(index) {
    if (closed.has(index)) return foldedRectangle(scene.boxes[index]);
    const [x, y, width, height] = scene.boxes[index].rectangle;
    return [across(x), down(y), across(x + width) - across(x), down(y + height) - down(y)];
  }

  const foldedScale = ({ rectangle: [, , width, height] }) => isSqueezed ? 1 : Math.min(5, Math.max(1, 0.45 * Math.min(width / FOLDED[0], height / FOLDED[1])));

  function edges() {
    const bundles = new Map();
    for (const one of scene.edges) {
      const [from, to] = [representative(one.from), representative(one.to)];
      if (from !== undefined && from === to) continue;
      const key = from === undefined && to === undefined ? `${one.from} ${one.to}` : `${from ?? one.from} > ${to ?? one.to}`;
      if (!bundles.has(key)) bundles.set(key, { ...one, from, to, ends: [one.from, one.to], members: [] });
      bundles.get(key).members.push(one);
    }
    const made = [];
    for (const bundle of bundles.values()) {
      const isBundle = bundle.from !== undefined || bundle.to !== undefined;
      const [from, to] = bundle.ends.map(rectangleOf);
      const path = !isBundle && bundle.points.length > 3 ? polyline(bundle.points.map((value, at) => (at % 2 ? down(value) : across(value)))) : curve(from, to, bundle.members.length);
      const conditional = bundle.members.every((one) => one.classes.includes("conditional"));
      const classes = isBundle ? ["bundle", conditional ? "conditional" : "", ...new Set(bundle.members.flatMap((one) => one.classes.filter((name) => name === "red")))] : bundle.classes;
      const many = bundle.members.length;
      const element = s("g", { class: `edge ${classes.join(" ")}` },
        s("path", { class: "hit", d: path }), s("path", { class: "line", d: path, "marker-end": "url(#arrow)", "stroke-width": isBundle && many > 1 ? Math.min(6, 1 + Math.log2(many)) : null }),
        s("title", {}, bundle.members.slice(0, 12).map((one) => one.tip).join("\n") + (many > 12 ? `\nand ${many - 12} more` : "")));
      if (isBundle && many > 1) element.append(s("text", { class: "many", "font-size": 11 * Math.max(1, ...[bundle.from, bundle.to].filter((one) => one !== undefined).map((one) => foldedScale(scene.boxes[one]))), x: (from[0] + from[2] + to[0]) / 2, y: (from[1] + to[1] + from[3]) / 2 - 4 }, `×${many}`));
      paths.push({ element, members: bundle.members, bundle });
      element.addEventListener("click", (event) => { event.stopPropagation(); if (pick) { mark(null, bundle.members); pick(bundle.members); } else choose(bundle.members[0].channel); intoSight(svg); });
      made.push(element);
    }
    return made;
  }

  // Mark an element with its edges, or some edges, or some elements.
  function mark(id, edges, elements) {
    chosen = id;
    picked = edges ? new Set(edges.map(edgeKey)) : null;
    together = elements || null;
    remark();
  }

  function remark() {
    const near = new Set(together || [chosen]);
    for (const { element, members } of paths) {
      const touches = picked ? members.some((one) => picked.has(edgeKey(one))) : chosen !== null && members.some((one) => one.from === chosen || one.to === chosen);
      element.classList.toggle("chosen", touches);
      element.querySelector(".line").setAttribute("marker-end", touches ? "url(#arrow-strong)" : "url(#arrow)");
      if (touches) for (const one of members) near.add(one.from).add(one.to);
    }
    const isOne = (chosen !== null && drawn.has(chosen)) || picked !== null || together !== null;
    layer.classList.toggle("has-choice", isOne && !scene.isPart);
    for (const [id, element] of drawn) {
      element.classList.toggle("chosen", id === chosen || Boolean(together && together.has(id)));
      element.classList.toggle("near", near.has(id));
    }
  }

  function choose(id, quiet) {
    mark(id);
    if (!quiet) select(id);
  }

  function fold(index, isClosed) {
    const [before, was] = [boxRectangle(index), isSqueezed];
    if (isClosed) closed.add(index);
    else closed.delete(index);
    draw();
    // What was clicked stays under the pointer where the picture is squeezed.
    if (was || isSqueezed) {
      const after = boxRectangle(index);
      view.x += (before[0] - after[0]) * view.scale;
      view.y += (before[1] - after[1]) * view.scale;
      place();
    }
    if (folded) folded([...closed].map((one) => scene.boxes[one].label));
  }

  const scaleToFit = ([width, height]) => Math.min(1.3, Math.max(0.05, Math.min((svg.clientWidth || 900) / width, (svg.clientHeight || 600) / height)));

  function fit() {
    isBegun = false;
    const [width, height] = [across(scene.size[0]), down(scene.size[1])];
    const [w, tall] = [svg.clientWidth || 900, svg.clientHeight || 600];
    view.scale = scaleToFit([width, height]);
    view.x = Math.max(0, (w - width * view.scale) / 2);
    view.y = Math.max(0, (tall - height * view.scale) / 2);
    place(true);
  }

  // As a whole where that can be read. In a narrow window, or where *always*, from the left, as large as names need; the rest is dragged to.
  function begin(always) {
    fit();
    isBegun = true;
    isAlways = always === true;
    const [w, tall] = [svg.clientWidth, svg.clientHeight];
    const isWhole = !w || (!isAlways && window.innerWidth > 800) || view.scale >= READABLE;
    if (!isWhole) {
      view.scale = READABLE;
      view.x = 0;
      view.y = (tall - down(scene.size[1]) * view.scale) / 2;
      const first = [...byId.keys()].map(rectangleOf).sort((one, other) => one[0] - other[0])[0];
      const middle = first ? (first[1] + first[3] / 2) * view.scale : 0;
      if (first && (view.y + middle < 0 || view.y + middle > tall)) view.y = tall / 2 - middle; // something is in sight
      place(true);
    }
    if (made.told) made.told(isWhole);
  }

  function centre(id, scale) {
    if (!byId.has(id)) return;
    const [x, y, width, height] = rectangleOf(id);
    view.scale = Math.max(view.scale, scale || 0.8);
    view.x = svg.clientWidth / 2 - (x + width / 2) * view.scale;
    view.y = svg.clientHeight / 2 - (y + height / 2) * view.scale;
    place();
  }

  function zoom(factor, at) {
    const [x, y] = at || [svg.clientWidth / 2, svg.clientHeight / 2];
    const scale = Math.min(4, Math.max(0.04, view.scale * factor));
    view.x = x - ((x - view.x) * scale) / view.scale;
    view.y = y - ((y - view.y) * scale) / view.scale;
    view.scale = scale;
    place();
  }

  // Put an element elsewhere; its edges follow.
  function shift(id, dx, dy) {
    const one = byId.get(id);
    const [x, y] = moved.get(id) || [0, 0];
    moved.set(id, [x + dx, y + dy]);
    moveTo(one, dx, dy);
    const [left, top] = one.drawnAt;
    drawn.get(id).setAttribute("transform", `translate(${one.rectangle[0] - left} ${one.rectangle[1] - top})`);
    for (const { element, members, bundle } of paths) {
      if (!members.some((each) => each.from === id || each.to === id)) continue;
      const path = curve(...bundle.ends.map(rectangleOf), bundle.members.length);
      for (const each of element.querySelectorAll("path")) each.setAttribute("d", path);
    }
  }

  function moveTo(one, dx, dy) {
    one.rectangle = [one.rectangle[0] + dx, one.rectangle[1] + dy, one.rectangle[2], one.rectangle[3]];
    for (const each of scene.edges) if (each.from === one.id || each.to === one.id) each.points = [];
    scene.size = [Math.max(scene.size[0], one.rectangle[0] + one.rectangle[2] + 14), Math.max(scene.size[1], one.rectangle[1] + one.rectangle[3] + 14)];
  }

  svg.addEventListener("dblclick", () => {
    if (!moved.size || scene.isPart) return;
    moved.clear();
    show(given[0], given[1]);
  });
  svg.addEventListener("wheel", (event) => {
    event.preventDefault();
    const corner = svg.getBoundingClientRect();
    zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), [event.clientX - corner.left, event.clientY - corner.top]);
  }, { passive: false });
  let drag = null;
  let wasDragged = false;
  svg.addEventListener("pointerdown", (event) => {
    wasDragged = false;
    const element = event.target.closest ? event.target.closest(".element") : null;
    if (event.button === 0) drag = { x: event.clientX, y: event.clientY, moved: false, id: element && byId.has(element.dataset.id) ? element.dataset.id : null };
  });
  svg.addEventListener("pointermove", (event) => {
    if (!drag) return;
    const [dx, dy] = [event.clientX - drag.x, event.clientY - drag.y];
    if (!drag.moved && Math.abs(dx) + Math.abs(dy) < 4) return;
    if (!drag.moved) svg.setPointerCapture(event.pointerId);
    drag = { x: event.clientX, y: event.clientY, moved: true, id: drag.id };
    if (drag.id !== null) {
      shift(drag.id, dx / view.scale, dy / view.scale);
      return;
    }
    view.x += dx;
    view.y += dy;
    place();
  });
  const release = (event) => {
    wasDragged = Boolean(drag && drag.moved);
    drag = null;
    if (event.type === "pointerup" && svg.hasPointerCapture(event.pointerId)) svg.releasePointerCapture(event.pointerId);
  };
  svg.addEventListener("pointerup", release);
  svg.addEventListener("pointercancel", release);
  svg.addEventListener("click", (event) => {
    const hit = event.target.closest ? event.target.closest("[data-id]") : null;
    if (wasDragged) return;
    choose(hit ? hit.dataset.id : null);
    if (hit) intoSight(svg);
  });
  svg.addEventListener("keydown", (event) => {
    const moves = { ArrowLeft: [60, 0], ArrowRight: [-60, 0], ArrowUp: [0, 60], ArrowDown: [0, -60] };
    if (moves[event.key]) {
      view.x += moves[event.key][0];
      view.y += moves[event.key][1];
      place();
    } else if (event.key === "+" || event.key === "=") zoom(1.25);
    else if (event.key === "-") zoom(0.8);
    else if (event.key === "0") fit();
    else return;
    event.preventDefault();
  });

  // On paper all of it is shown, as large as the paper is wide.
  whenPrinted(() => {
    const [width, height] = [across(scene.size[0]), down(scene.size[1])];
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    layer.removeAttribute("transform");
  }, () => { svg.removeAttribute("viewBox"); place(isFitted); });

  new ResizeObserver(() => { if (isFitted && svg.clientWidth) { if (isBegun) begin(isAlways); else fit(); } }).observe(svg);

  let given = [];
  function show(next, closedLabels) {
    given = [next, closedLabels];
    scene = { ...stretched(next) };
    scene.elements = scene.elements.map((one) => ({ ...one }));
    scene.edges = scene.edges.map((one) => ({ ...one }));
    byId = new Map(scene.elements.map((one) => [one.id, one]));
    closed = new Set(scene.boxes.map((one, index) => index).filter((index) => closedLabels && closedLabels.includes(scene.boxes[index].label)));
    if (!scene.isPart) for (const [id, [dx, dy]] of moved) if (byId.has(id)) moveTo(byId.get(id), dx, dy);
    [chosen, picked, together] = [null, null, null];
    draw();
  }

  const made = {
    element: svg, fit, begin, told: null, zoom, centre, choose, fold, show, mark,
    // Whether its names cannot be read where all of it is in sight.
    get isTiny() { return scaleToFit(scene.size) < 0.35; },
    // Fold what is no box around most of the picture; whether anything is.
    foldMost() {
      const nodes = scene.elements.filter((one) => one.isNode);
      const most = scene.boxes.map((_, index) => index).filter((index) => nodes.filter((one) => around(one.box).includes(index)).length * 3 < nodes.length * 2);
      closed = new Set(most);
      if (!most.length) return false;
      draw();
      fit();
      return true;
    },
    // Open what an element is folded into.
    reveal(id) {
      const boxes = byId.has(id) ? around(byId.get(id).box).filter((one) => closed.has(one)) : [];
      for (const one of boxes) closed.delete(one);
      if (boxes.length) draw();
      if (boxes.length && folded) folded([...closed].map((one) => scene.boxes[one].label));
    },
    foldAll(isClosed) {
      closed = new Set(isClosed ? scene.boxes.keys() : []);
      draw();
      if (isSqueezed || !isClosed) fit();
      if (folded) folded([...closed].map((one) => scene.boxes[one].label));
    },
    has: (id) => byId.has(id),
    get boxes() { return scene.boxes.length; },
    get edges() { return scene.edges; },
  };
  return made;
}
