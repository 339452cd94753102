// SPDX-License-Identifier: Apache-2.0
// Walks HAROS's visualizer over a folder of `haros-ci check --output haros-json=DIR`, in a browser without a window.
//
//   npm install playwright-core @sparticuz/chromium        (or have CHROMIUM name a browser)
//   node tests/bench/harosviz_check.mjs HAROSVIZ DIR [CONFIGURATIONS]
//
// HAROSVIZ is the directory harosviz of HAROS, DIR stands in for its data/. Every board is opened, every package, every page of
// issues, and each configuration (or the first CONFIGURATIONS of them); what it shows is held against the files. Parameters are drawn
// where that makes no graph beyond LARGEST, for whose layout the visualizer takes minutes (tooLarge counts the others). Prints what was
// shown; exit code 1 if a script failed, a file was asked for that is not there, or something shown is not what the files say.
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { extname, join, normalize } from "node:path";
import { pathToFileURL } from "node:url";

const LARGEST = 400;
const [viz, data, most = "1000000"] = process.argv.slice(2);
if (!viz || !data) {
  console.error("usage: node harosviz_check.mjs HAROSVIZ DIR [CONFIGURATIONS]");
  process.exit(2);
}
const local = createRequire(join(process.cwd(), "package.json")); // what was installed where this is run
const load = async (name) => {
  const module = await import(pathToFileURL(local.resolve(name)).href);
  return module.default ?? module;
};
const { chromium } = await load("playwright-core");

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".json": "application/json" };
const server = createServer((request, response) => {
  const path = normalize(decodeURIComponent(request.url.split("?")[0]));
  const file = path.startsWith("/data/") ? join(data, path.slice(6)) : join(viz, path === "/" ? "index.html" : path);
  try {
    const bytes = readFileSync(file);
    response.writeHead(200, { "Content-Type": TYPES[extname(file)] ?? "application/octet-stream" });
    response.end(bytes);
  } catch {
    response.writeHead(404).end();
  }
});
await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
const address = `http://127.0.0.1:${server.address().port}/`;

let own = { executablePath: process.env.CHROMIUM };
if (!own.executablePath) {
  const packed = await load("@sparticuz/chromium");
  own = { executablePath: await packed.executablePath(), args: packed.args };
}
const browser = await chromium.launch({ headless: true, ...own });
const page = await browser.newPage({ viewport: { width: 1400, height: 900 } });
const faults = [];
page.on("pageerror", (error) => faults.push(`script: ${error.message}`));
page.on("console", (said) => {
  if (said.type() === "error" && !/favicon/.test(said.location().url)) faults.push(`console: ${said.text()} ${said.location().url}`);
});
page.on("dialog", (dialog) => {
  faults.push(`dialog: ${dialog.message()}`);
  dialog.dismiss();
});
page.on("request", (request) => {
  if (!request.url().startsWith(address) && !request.url().startsWith("data:")) faults.push(`elsewhere: ${request.url()}`);
});

const read = (...parts) => JSON.parse(readFileSync(join(data, ...parts), "utf-8"));
const expect = (what, shown, said) => {
  if (String(shown) !== String(said)) faults.push(`${what}: shown ${shown}, the files say ${said}`);
};
const settled = () => page.waitForFunction(() => window.jQuery.active === 0 && window.jQuery("#preloader").is(":hidden"));
const count = (selector) => page.locator(selector).count();
const go = async (route) => {
  await page.evaluate((to) => { window.location.hash = to; }, route);
  await settled();
};
const choose = async (selector, value) => {
  await page.evaluate(([s, v]) => { window.jQuery(s).val(v).trigger("change"); }, [selector, value]);
  await settled();
};
const options = (selector) => page.$$eval(`${selector} option`, (all) => all.map((one) => one.textContent));
const press = (selector) => page.evaluate((s) => document.querySelector(s).dispatchEvent(new MouseEvent("click", { bubbles: true })), selector);
const text = (html) => page.evaluate((h) => new DOMParser().parseFromString(h, "text/html").body.textContent, html);

const issuesShown = async (issues) => {
  let seen = 0;
  for (let at = 0; at === 0 || at < issues.length; at += 25) {
    if (at > 0) await press("#issue-btn-page-right");
    const comments = await page.$$eval("#issue-explorer .issue", (all) => all.map((one) => one.querySelectorAll("p")[1].textContent));
    const said = issues.slice(at, at + 25);
    expect("issues on a page", comments.length, said.length);
    if (said.length) expect("the first comment", comments[0], await text(said[0].comment));
    seen += comments.length;
  }
  return seen;
};

await page.goto(address, { waitUntil: "load" });
await settled();
const projects = await options("#dashboard-project-select");
expect("projects", projects.length, read("projects.json").length);
const unused = await count("script"); // more of them later would have come from the data
for (const project of projects) {
  await go("dashboard");
  await choose("#dashboard-project-select", project);
  const summary = read(project, "summary.json");
  const badges = Object.fromEntries(await page.$$eval("#dashboard .item", (all) =>
    all.map((one) => [one.querySelector(".label").textContent, one.querySelector(".badge-empty").textContent.trim()])));
  expect("dashboard: packages", badges.Packages, summary.source.packages);
  expect("dashboard: issues", badges["Total issues"], summary.issues.total);
  expect("dashboard: configurations", badges.Configurations, summary.components.configurations);
  for (const metric of await page.$$eval("#dashboard-metric-select option", (all) => all.map((one) => one.value))) {
    await choose("#dashboard-metric-select", metric);
    const drawn = await page.$eval("#dashboard .chart path.line", (one) => one.getAttribute("d") ?? "");
    expect(`chart of ${metric}`, (drawn.match(/[ML]/g) ?? []).length, summary.history.timestamps.length);
  }
  console.log(`${project}: dashboard`, JSON.stringify(badges));

  await go("packages");
  const packages = read(project, "packages.json");
  const ids = new Set(packages.map((one) => one.id));
  expect("package graph: nodes", await count("#package-graph g.node:not(.hidden)"), packages.length);
  const arrows = packages.flatMap((one) => one.dependencies.filter((other) => ids.has(other))).length;
  expect("package graph: edges", await count("#package-graph path.edge:not(.hidden)"), arrows);
  for (let n = 0; n < packages.length; n++) {
    await page.evaluate((i) => document.querySelectorAll("#package-graph g.node")[i].dispatchEvent(new MouseEvent("click", { bubbles: true })), n);
    await press("#pkg-btn-info");
    const shown = await page.$eval("#pkg-info-modal .template-wrapper", (one) => one.textContent);
    if (!shown.includes(packages[n].id) || !shown.includes(await text(packages[n].description))) faults.push(`info of ${packages[n].id}: ${shown}`);
    await press("#pkg-info-modal .button-close");
  }
  console.log(`${project}: packages: ${packages.length} nodes, ${arrows} edges, ${packages.length} info boxes`);

  await go("issues/source");
  let issues = 0;
  for (const id of await options("#issue-package-select")) {
    await choose("#issue-package-select", id);
    issues += await issuesShown(read(project, "compliance", "source", `${id}.json`));
  }
  console.log(`${project}: issues of packages: ${issues}`);

  const rules = new Map(read(project, "rules.json").map((rule) => [rule.id, rule]));
  const [first] = packages.filter((one) => Object.keys(one.analysis.violations).length);
  if (first) {
    await choose("#issue-package-select", first.id);
    const every = read(project, "compliance", "source", `${first.id}.json`);
    const tag = every.flatMap((one) => rules.get(one.rule).tags)[0];
    if (tag) {
      await press("#issue-btn-filter");
      await page.evaluate((t) => {
        window.jQuery("#issue-filter-input").val(t).trigger(window.jQuery.Event("keyup", { keyCode: 13 }));
      }, await text(tag));
      await press("#issue-filter-modal .button-close");
      const left = every.filter((one) => rules.get(one.rule).tags.includes(tag));
      console.log(`${project}: ${first.id} filtered by ${tag}: ${await issuesShown(left)} of ${every.length}`);
      await press("#issue-btn-filter");
      await press("#issue-filter-modal .text-button");
      await press("#issue-filter-modal .button-close");
    }
  }

  const systems = read(project, "configurations.json");
  if (systems.length) await go("issues/runtime");
  let runtime = 0;
  for (const id of systems.length ? await options("#issue-config-select") : []) {
    await choose("#issue-config-select", id);
    runtime += await issuesShown(read(project, "compliance", "runtime", `${id}.json`));
  }
  await choose("#issue-type-select", "other");
  const others = await issuesShown(read(project, "compliance", "unknown.json"));
  expect("issues in all", issues + others + new Set(systems.flatMap((one) => read(project, "compliance", "runtime", `${one.id}.json`)
    .map((issue) => JSON.stringify([issue.rule, issue.comment, { ...issue.location, configuration: null }])))).size, summary.issues.total);
  console.log(`${project}: issues of configurations: ${runtime}, others: ${others}`);

  await go("models");
  expect("models", systems.length ? (await options("#ros-config-select")).length : 0, systems.length);
  const drawn = { configurations: 0, nodes: 0, edges: 0, parameters: 0, tooLarge: 0, highlights: 0, boxes: 0 };
  for (const system of systems.slice(0, Number(most))) {
    await choose("#ros-config-select", system.id);
    const resources = system.nodes.length + system.topics.length + system.services.length;
    const badge = await page.$$eval("#config-details .badge-empty", (all) => all.map((one) => one.textContent.trim()));
    expect(`${system.id}: summary`, badge.slice(0, 8), [system.launch.length, system.nodes.length, system.topics.length,
      system.services.length, system.parameters.length, system.remaps, system.collisions, system.queries.length]);
    drawn.configurations += 1;
    if (resources + system.parameters.length === 0) continue;
    expect(`${system.id}: graph`, await count("#config-graph g.node:not(.hidden)"), resources);
    drawn.nodes += resources;
    drawn.edges += await count("#config-graph path.edge:not(.hidden)");
    if (resources + system.parameters.length <= LARGEST) {
      await press("#config-btn-param");
      expect(`${system.id}: with parameters`, await count("#config-graph g.node:not(.hidden)"), resources + system.parameters.length);
      drawn.parameters += system.parameters.length;
      await press("#config-btn-param");
    } else {
      drawn.tooLarge += 1;
    }
    for (const query of system.queries) {
      await choose("#ros-query-select", String(query.qid));
      if ((await count("#config-graph .query-object")) === 0) faults.push(`${system.id}: nothing highlighted by ${query.rule}`);
      drawn.highlights += 1;
    }
    const box = async (n) => {
      await page.evaluate((i) => document.querySelectorAll("#config-graph g.node")[i].dispatchEvent(new MouseEvent("click", { bubbles: true })), n);
      await press("#config-btn-info");
      drawn.boxes += (await page.$eval("#config-info-modal .title", (one) => one.textContent)).length > 0 ? 1 : 0;
      await press("#config-info-modal .button-close");
      await page.evaluate((i) => document.querySelectorAll("#config-graph g.node")[i].dispatchEvent(new MouseEvent("click", { bubbles: true })), n);
    };
    for (let n = 0; n < Math.min(resources + system.parameters.length, 60); n++) await box(n);
  }
  console.log(`${project}: models`, JSON.stringify(drawn));
}
await go("help");
if (!(await page.$eval("#help-board", (one) => one.offsetHeight > 0 && one.textContent.includes("Maintainability")))) faults.push("help: not shown");
console.log("help: shown");
expect("scripts in the page", await count("script"), unused);
expect("pictures in the page", await count("img"), 0);
await browser.close();
server.close();
for (const fault of faults.slice(0, 50)) console.log(`FAULT ${fault}`);
console.log(`${faults.length} faults`);
process.exit(faults.length ? 1 : 0);
