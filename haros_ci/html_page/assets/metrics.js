// How the values of each metric lie, and what is beyond its limits.
function metricsView(parameters) {
  const list = D.metrics;
  if (!list.length) return { content: [h("h1", null, "Metrics"), h("p", null, "Nothing was measured.")] };
  const nameOf = (one) => `${one.level} ${one.metric}`;
  const chosen = list.find((one) => nameOf(one) === parameters.metric) || list.find((one) => nameOf(one) === "function cyclomatic-complexity") || list[0];
  const beyond = (one) => one.limits.reduce((most, [, , , crossed]) => Math.max(most, crossed), 0);
  const rows = list.map((one) => [link("metrics", { metric: nameOf(one) }, one.metric), one.level, one.count, one.limits.map(([, limit, lowest]) => `${lowest ? "≥" : "≤"} ${limit}`).join(", "), beyond(one), one.worst.length ? one.worst[0][0] : ""]);
  return {
    content: [
      h("h1", null, "Metrics"),
      h("div", { class: "columns" },
        h("section", { class: "card" }, h("h2", null, `${chosen.metric} of ${chosen.level === "class" ? "classes" : `${chosen.level}s`}`), histogram(chosen), chosen.limits.length ? h("ul", { class: "plain-list" }, chosen.limits.map(([rule, limit, lowest, crossed]) => h("li", null, `${text(rule)}: ${lowest ? "at least" : "at most"} ${limit}; ${crossed.toLocaleString("en")} of ${chosen.count.toLocaleString("en")} beyond`))) : null,
          h("h3", null, `The ${chosen.worst.length} furthest out`), smallTable(["value", chosen.level, "place", "package"], chosen.worst.map(([value, at, name, pkg]) => [value, text(name), whereIs(place(at)), text(pkg)]), "furthest out")),
        h("section", { class: "card" }, h("h2", null, "All metrics"), smallTable(["metric", "of", "values", "limits", "beyond", "furthest"], rows, "all metrics"))),
    ],
  };
}

function histogram(one) {
  const [width, height] = [560, 190];
  const most = Math.max(...one.bars.map(([, , number]) => number));
  const wide = (width - 46) / one.bars.length;
  // The square root keeps the few large values in sight beside the many small ones.
  const tall = (number) => (number ? Math.max(2, Math.sqrt(number / most) * (height - 40)) : 0);
  const least = one.bars[0][0];
  const span = one.bars[one.bars.length - 1][1] - least || 1;
  return h("figure", null, s("svg", { class: "histogram", viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `distribution of ${one.metric}` },
    one.bars.map(([from, to, number], index) => s("g", {}, s("rect", { class: "column", x: 40 + index * wide + 1, y: height - 24 - tall(number), width: Math.max(1, wide - 2), height: tall(number) }), s("title", {}, `${from} to ${to}: ${number}`))),
    one.limits.map(([rule, limit, lowest]) => { const x = 40 + ((Number(limit) + (lowest ? 0 : 1) - least) / span) * (width - 46); return x > 40 && x < width ? s("g", {}, s("line", { class: "limit", x1: x, x2: x, y1: 8, y2: height - 24 }), s("title", {}, text(rule))) : null; }),
    s("text", { x: 40, y: height - 8 }, String(least)), s("text", { x: width - 6, y: height - 8, "text-anchor": "end" }, String(one.bars[one.bars.length - 1][1])), s("text", { x: 36, y: 20, "text-anchor": "end" }, most.toLocaleString("en"))),
    h("figcaption", { class: "quiet" }, `${count(one.count, "value")}; heights are square roots, lines are limits`));
}
