// The frame around the views: the address decides which is shown.
const VIEWS = {
  overview: ["Overview", () => ({ content: overview() })],
  findings: ["Findings", findingsView],
  system: ["System", systemView],
  programs: ["Programs", programsView],
  launch: ["Launch", launchView],
  parameters: ["Parameters", parametersView],
  transforms: ["Transforms", transformsView],
  properties: ["Properties", propertiesView],
  packages: ["Packages", packagesView],
  interfaces: ["Interfaces", interfacesView],
  metrics: ["Metrics", metricsView],
  changes: ["Changes", changesView],
};
const offered = Object.keys(VIEWS).filter((name) => (!D.only || name === D.only) && (name !== "changes" || D.changes) && (name !== "programs" || CONFIGURATIONS.some((one) => one.row.nodes.length)) && (name !== "metrics" || D.metrics.length) && (name !== "launch" || CONFIGURATIONS.some((one) => one.launch.length)) && (name !== "properties" || PROPERTIES.length || RECORDINGS.length) && (name !== "transforms" || CONFIGURATIONS.some(hasTransforms)));

const main = h("main", { id: "main", tabindex: "-1" });
const navigation = h("nav", { "aria-label": "views" }, offered.map((name) => h("a", { href: name, "data-view": name }, VIEWS[name][0])));
let escape = null;

// Why a page has no such view.
const ABSENT = { changes: "it was made without a base revision (--base)", programs: "no node was found", metrics: "nothing was measured", launch: "no launch file starts a node that is known here", properties: "the project states no property in HPL, and no recording was given (--verdicts)", transforms: "no transform is known" };
const absent = (view) => (VIEWS[view] && !offered.includes(view) ? h("p", { class: "warning" }, `This page has no ${VIEWS[view][0]}: ${D.only ? "it shows a change alone" : ABSENT[view]}.`) : null);

function show() {
  const { view, parameters } = current();
  const name = offered.includes(view) ? view : offered[0];
  for (const one of navigation.children) {
    if (one.dataset.view === name) one.setAttribute("aria-current", "page");
    else one.removeAttribute("aria-current");
  }
  printing.length = 0;
  const made = VIEWS[name][1](parameters);
  escape = made.escape || null;
  main.className = made.wide ? "wide" : "";
  clear(main, absent(view), made.content);
  main.scrollTop = 0;
}

function keys(event) {
  const isTyping = event.target.matches && event.target.matches("input, select, textarea");
  if (event.key === "/" && !isTyping && !event.ctrlKey && !event.metaKey) {
    const field = main.querySelector("input.search");
    if (!field) return;
    event.preventDefault();
    field.focus();
    field.select();
  } else if (event.key === "Escape") {
    if (isTyping) event.target.blur();
    if (escape) escape();
  }
}

document.getElementById("page").replaceChildren(
  h("a", { class: "skip", href: "main", onclick: (event) => { event.preventDefault(); main.focus(); } }, "Skip to the content"),
  h("header", null, h("span", { class: "brand" }, "haros-ci"), navigation, h("span", { class: "quiet version" }, `${text(D.name)} · ${D.tool}`)),
  main,
);
// On paper there are no filters to see, so it is said what is shown.
function printTitle() {
  const { view, parameters } = current();
  const said = Object.entries(parameters).filter(([key, value]) => value && !["folded", "sort", "id"].includes(key)).map(([key, value]) => `${key === "q" ? "search" : key}: ${value}`);
  const configuration = main.querySelector("select.wide-choice");
  if (configuration && !parameters.configuration) said.unshift(configuration.value);
  return h("p", { class: "print-title" }, [text(D.name), VIEWS[offered.includes(view) ? view : offered[0]][0], ...said].join(" · "));
}
window.addEventListener("beforeprint", () => { main.prepend(printTitle()); for (const [before] of printing) before(); });
window.addEventListener("afterprint", () => { for (const one of main.querySelectorAll(".print-title")) one.remove(); for (const [, after] of printing) after(); });
window.addEventListener("hashchange", show);
document.addEventListener("keydown", keys);
show();
