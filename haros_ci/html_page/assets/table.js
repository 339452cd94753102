// A table of which only the rows in sight are in the page, so that any number of rows scrolls smoothly.
const ROW = 30;

// Rows that are printed.
const MOST_PRINTED = 1000;

function virtualTable({ columns, rows, select, label, sort, sorted }) {
  const state = { rows, chosen: -1, first: -1, last: -1 };
  const head = h("div", { class: "row head", role: "row" });
  const body = h("div", { class: "rows", role: "rowgroup" });
  const outer = h("div", { class: "table", role: "table", tabindex: "0", "aria-label": label }, head, body);
  const template = columns.map((one) => one.width).join(" ");
  // What the columns need at least is scrolled to, and never cut off.
  outer.style.setProperty("--least", `calc(${columns.map((one) => /^minmax\(([^,]+),/.exec(one.width)?.[1] || one.width).join(" + ")} + ${columns.length * 0.7 + 0.5}rem)`);
  head.style.gridTemplateColumns = template;
  columns.forEach((one, index) => {
    const mark = sort.column === one.key ? (sort.down ? " ▼" : " ▲") : "";
    const title = one.compare
      ? h("button", { class: "plain", onclick: () => sorted(one.key, sort.column === one.key ? !sort.down : Boolean(one.down)) }, one.title + mark)
      : one.title;
    head.append(h("div", { role: "columnheader", class: one.class, "data-column": index, "aria-sort": mark ? (sort.down ? "descending" : "ascending") : null }, title));
  });
  const order = (list) => {
    const column = columns.find((one) => one.key === sort.column && one.compare);
    if (!column) return list;
    const sign = sort.down ? -1 : 1;
    return list.map((row, index) => [row, index]).sort((a, b) => sign * column.compare(a[0], b[0]) || a[1] - b[1]).map(([row]) => row);
  };

  function draw(force) {
    const first = Math.max(0, Math.floor((outer.scrollTop - ROW) / ROW) - 8);
    const until = Math.min(state.rows.length, first + Math.ceil((outer.clientHeight || 900) / ROW) + 18);
    if (!force && first === state.first && until === state.last) return;
    [state.first, state.last] = [first, until];
    body.style.height = `${state.rows.length * ROW}px`;
    const made = [];
    for (let number = first; number < until; number++) {
      const row = state.rows[number];
      const line = h("div", { class: number === state.chosen ? "row chosen" : "row", role: "row", "data-number": number, "aria-rowindex": number + 2, "aria-selected": number === state.chosen ? "true" : null });
      line.style.gridTemplateColumns = template;
      line.style.top = `${number * ROW}px`;
      for (const one of columns) line.append(h("div", { role: "cell", class: one.class }, one.cell(row)));
      made.push(line);
    }
    clear(body, made);
  }

  function choose(number, tell) {
    if (!state.rows.length) return;
    state.chosen = Math.max(0, Math.min(number, state.rows.length - 1));
    const top = state.chosen * ROW;
    if (top < outer.scrollTop) outer.scrollTop = top;
    else if (top + 2 * ROW > outer.scrollTop + outer.clientHeight) outer.scrollTop = top + 2 * ROW - outer.clientHeight;
    draw(true);
    if (tell) select(state.rows[state.chosen]);
  }

  outer.addEventListener("scroll", () => draw(false), { passive: true });
  body.addEventListener("click", (event) => {
    const line = event.target.closest(".row");
    if (!line || event.target.closest("a,button")) return;
    choose(Number(line.dataset.number), true);
    intoSight(outer);
  });
  outer.addEventListener("keydown", (event) => {
    const page = Math.max(1, Math.floor(outer.clientHeight / ROW) - 2);
    const step = { ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page, Home: -Infinity, End: Infinity }[event.key];
    if (step === undefined || event.target.closest("button")) return;
    event.preventDefault();
    const at = step === -Infinity ? 0 : step === Infinity ? state.rows.length - 1 : state.chosen + step;
    choose(at, true);
  });
  const set = (list, isOrdered) => {
    state.rows = isOrdered ? list : order(list);
    state.chosen = -1;
    outer.setAttribute("aria-rowcount", state.rows.length + 1);
    outer.scrollTop = 0;
    draw(true);
  };
  set(rows);
  // On paper every row is there, with all of its text.
  const printed = h("div", { class: "printed" });
  whenPrinted(() => {
    const shown = state.rows.slice(0, MOST_PRINTED);
    clear(printed, smallTable(columns.map((one) => one.title), shown.map((row) => columns.map((one) => one.cell(row))), label), state.rows.length > shown.length ? h("p", null, `and ${count(state.rows.length - shown.length, "row")} more`) : null);
    outer.after(printed);
  }, () => printed.remove());
  requestAnimationFrame(() => draw(true));
  if (window.ResizeObserver) new ResizeObserver(() => draw(true)).observe(outer);
  return { element: outer, set, order, chooseRow: (row, tell) => choose(state.rows.indexOf(row), tell), has: (row) => state.rows.includes(row) };
}

const isFigure = (cell) => typeof cell === "number" || (cell instanceof Element ? /^[\d.,]+$/.test(cell.textContent) : /^(–|[\d.,]+ %)$/.test(cell));
const isNothing = (cell) => cell === "" || cell === null || cell === undefined;

// A plain table of few rows; columns of figures stand at the right, with their titles.
function smallTable(headers, rows, label) {
  const right = headers.map((_, at) => (rows.every((row) => isNothing(row[at]) || isFigure(row[at])) && rows.length ? "number" : null));
  return h("div", { class: "scroll" }, h("table", { "aria-label": label, class: headers.length > 3 ? "many" : null },
    h("thead", null, h("tr", null, headers.map((one, at) => h("th", { scope: "col", class: right[at] }, one)))),
    h("tbody", null, rows.map((row) => h("tr", null, row.map((cell, at) => h("td", { class: right[at] || (typeof cell === "number" ? "number" : null) }, typeof cell === "number" ? cell.toLocaleString("en") : cell)))))));
}
