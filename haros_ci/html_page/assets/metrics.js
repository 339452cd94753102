// What each metric is; docs/metrics.md defines them.
const METRIC_WORDS = {
  "cyclomatic-complexity": "Independent paths through a function: one more than its branches. Of a file, the sum over its functions.", ploc: "Physical lines of code: without blank lines and comments.", sloc: "Source lines: all that are not blank.", lloc: "Logical lines of code: statements.", eloc: "Effective lines of code: those that are more than brackets.",
  comments: "Lines that hold a comment.", "comment-ratio": "The part of the lines that are not blank that hold a comment.", "halstead-volume": "Size in bits by Halstead: operators and operands, times the logarithm of how many distinct ones there are.", "halstead-bugs": "Bugs in a file as Halstead estimates them: the volume divided by 3,000.", "halstead-time": "Seconds to write a file as Halstead estimates them.",
  "maintainability-index": "0 to 100, the higher the better, from Halstead's volume, complexity, lines and comments.", "function-parameters": "Parameters that a function takes.", "function-calls": "Calls that a function makes.", "unique-function-calls": "Different functions that a function calls.", "nested-control": "How deep control structures stand within each other.", "static-path-count": "Paths through a function if loops run at most once.",
  coupling: "Other classes that a class uses.", "depth-in-tree": "Classes above a class, itself included.", "number-of-children": "Classes that derive from a class directly.", "weighted-methods": "The complexity of all methods of a class together.", "methods-available": "Public methods of a class.",
};

// How the values of each metric lie, and what is beyond its limits.
function metricsView(parameters) {
  const list = D.metrics;
  if (!list.length) return { content: [h("h1", null, "Metrics"), h("p", null, "Nothing was measured.")] };
  const nameOf = (one) => `${one.level} ${one.metric}`;
  const chosen = list.find((one) => nameOf(one) === parameters.metric) || list.find((one) => nameOf(one) === "function cyclomatic-complexity") || list[0];
  const beyond = (one) => one.limits.reduce((most, [, , , crossed]) => Math.max(most, crossed), 0);
  const rows = list.map((one) => [h("span", { class: "whole" }, link("metrics", { metric: nameOf(one) }, one.metric)), h("span", { class: "whole" }, one.level), one.count, one.limits.map(([, limit, lowest]) => `${lowest ? "≥" : "≤"} ${limit}`).join(", "), beyond(one), one.worst.length ? rounded(one.worst[0][0]) : ""]);
  return {
    content: [
      h("h1", null, "Metrics"),
      h("div", { class: "columns" },
        h("section", { class: "card" }, h("h2", null, `${chosen.metric} of ${chosen.level === "class" ? "classes" : `${chosen.level}s`}`), METRIC_WORDS[chosen.metric] ? h("p", null, METRIC_WORDS[chosen.metric]) : null, histogram(chosen), chosen.limits.length ? h("ul", { class: "plain-list" }, chosen.limits.map(([rule, limit, lowest, crossed]) => h("li", null, `${text(rule)}: ${lowest ? "at least" : "at most"} ${limit}; ${crossed.toLocaleString("en")} of ${chosen.count.toLocaleString("en")} are ${lowest ? "below" : "above"}`))) : null,
          h("h3", null, `The ${chosen.worst.length} worst values`), smallTable(["value", chosen.level, "place", "package"], chosen.worst.map(([value, at, name, pkg]) => [value, breakable(text(name)), whereIs(place(at)), breakable(text(pkg))]), "worst values")),
        h("section", { class: "card" }, h("h2", null, "All metrics"), smallTable(["metric", "of", "values", "limits", "beyond", "worst"], rows, "all metrics"))),
    ],
  };
}

// Thousands need no decimals.
const rounded = (value) => (Math.abs(value) >= 1000 ? Math.round(value) : value);

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
    h("figcaption", { class: "quiet" }, `${count(one.count, "value")}; bar heights are square roots of the counts, dashed lines are limits`));
}
