// Quality over time, from the commits that a folder of HAROS's data files has kept.
const MEASURED = [["findings", 3], ["findings against coding standards", 4], ["metrics beyond a limit", 5], ["lines of code", 1], ["lines of comments", 2], ["mean complexity of functions", 6], ["mean length of functions", 7]];
const when = (time) => time.replace(/^(\d+)-(\d+)-(\d+)-(\d+)-(\d+)$/, "$1-$2-$3 $4:$5");
const figureOf = (value) => value.toLocaleString("en", { maximumFractionDigits: 2 });

function qualityOverTime() {
  const body = h("div");
  const draw = (name) => {
    const [label, at] = MEASURED.find(([each]) => each === name) || MEASURED[0];
    const points = D.history.map((one) => [one[0], one[at]]);
    clear(body, points.length > 1 ? lineChart(label, points) : h("p", { class: "quiet" }, "There is one commit so far: a line needs two."),
      h("details", null, h("summary", null, count(points.length, "commit")), smallTable(["commit of", label], points.slice().reverse().map(([time, value]) => [when(time), figureOf(value)]), label)));
  };
  draw(MEASURED[0][0]);
  return h("section", { class: "card", id: "history" }, h("h2", null, "Quality over time"), chooser("shows", MEASURED.map(([name]) => [name, name]), MEASURED[0][0], draw), body);
}

// Values from the oldest to the newest commit, the same width for each: they are no clock.
function lineChart(label, points) {
  const [width, height, left] = [760, 190, 62];
  const values = points.map(([, value]) => value);
  const most = Math.max(...values, 0);
  const least = Math.min(...values, 0);
  const x = (index) => left + (index * (width - left - 12)) / (points.length - 1);
  const y = (value) => height - 28 - ((value - least) / (most - least || 1)) * (height - 46);
  const dots = points.length > 120 ? [] : points;
  return h("figure", null, s("svg", { class: "histogram chart", viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `${label}: ${figureOf(values[0])} to ${figureOf(values[values.length - 1])} over ${points.length} commits` },
    s("line", { class: "axis", x1: left, x2: width - 12, y1: y(least), y2: y(least) }),
    s("path", { class: "course", d: polyline(points.flatMap(([, value], index) => [x(index), y(value)])) }),
    dots.map(([time, value], index) => s("circle", { class: "point", cx: x(index), cy: y(value), r: 3.5 }, s("title", {}, `${when(time)}: ${figureOf(value)}`))),
    s("text", { x: left - 6, y: y(most) + 4, "text-anchor": "end" }, figureOf(most)), s("text", { x: left - 6, y: y(least) + 4, "text-anchor": "end" }, figureOf(least)),
    s("text", { x: left, y: height - 8 }, when(points[0][0])), s("text", { x: width - 12, y: height - 8, "text-anchor": "end" }, when(points[points.length - 1][0]))),
    h("figcaption", { class: "quiet" }, `${label}: ${figureOf(values[values.length - 1])} now, ${figureOf(values[0])} at first`));
}
