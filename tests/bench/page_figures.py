# SPDX-License-Identifier: Apache-2.0
"""Figures of pages of ``haros-ci report`` in a browser without a window: size, paint, search, fold, trace, edges, parameters, overlaps, crossings.

    python tests/bench/page_figures.py PAGE.html...

Milliseconds are from the event to the changed page, laid out, and in brackets of processor time of the page's thread until it is painted: the middle of five. Searches
have the 60 ms in them that the page waits for the next key. Other work on the machine adds to the first, and not to the second.
"""

from __future__ import annotations

import statistics
import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "html_page"))

from browser_kit import Page, browser

#: The time from an event to the change of the page that it makes, laid out.
TIMED = """
const done = arguments[0];
const start = performance.now();
const observer = new MutationObserver(() => { observer.disconnect(); document.body.getBoundingClientRect(); done(performance.now() - start); });
observer.observe(document.querySelector('main'), { subtree: true, childList: true });
WORK;
"""
OVERLAPS = """
const places = [...document.querySelectorAll('.stage .element > .shape')].map((one) => one.getBBox());
let found = 0;
places.forEach((a, n) => places.slice(0, n).forEach((b) => { if (a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height) found += 1; }));
return [places.length, found];
"""
#: Pairs of names of different elements that overlap, and pairs of lines that cross where they have no end in common.
TANGLES = """
document.querySelector('.stage .picture > g').removeAttribute('transform'); // shrunk texts are measured too large
const boxes = [...document.querySelectorAll('.stage .element')].map((one) => [...one.querySelectorAll('text')].map((each) => each.getBBox()));
let names = 0;
boxes.forEach((some, n) => boxes.slice(0, n).forEach((others) => { if (some.some((a) => others.some((b) => a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height))) names += 1; }));
const paths = [...document.querySelectorAll('.stage .edge .line')].map((one) => { const long = one.getTotalLength(); const found = []; const steps = Math.min(60, Math.max(2, Math.ceil(long / 40))); for (let at = 0; at <= steps; at++) found.push(one.getPointAtLength((long * at) / steps)); return found; });
const side = (a, b, c) => Math.sign((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
const near = (a, b) => Math.hypot(a.x - b.x, a.y - b.y) < 3;
let crossings = 0;
paths.forEach((one, n) => paths.slice(0, n).forEach((other) => {
  if (near(one[0], other[0]) || near(one.at(-1), other.at(-1))) return;
  for (let i = 1; i < one.length; i++) for (let j = 1; j < other.length; j++) if (side(one[i - 1], one[i], other[j - 1]) * side(one[i - 1], one[i], other[j]) < 0 && side(other[j - 1], other[j], one[i - 1]) * side(other[j - 1], other[j], one[i]) < 0) { crossings += 1; return; }
}));
return [names, crossings];
"""
SEARCH = "const field = document.querySelector('.search-box input'); field.value = 'cmd'; field.dispatchEvent(new Event('input'))"
FOLD = "[...document.querySelectorAll('button')].find((one) => one.textContent === 'Fold all').click()"
UNFOLD = "[...document.querySelectorAll('button')].find((one) => one.textContent === 'Unfold all').click()"
EDGE = "document.querySelector('.stage .edge').dispatchEvent(new MouseEvent('click', { bubbles: true }))"
PARAMETERS = "[...document.querySelectorAll('.switches label')].find((one) => one.textContent === 'parameters').click()"
TRACE = "[...document.querySelectorAll('.detail button')].find((one) => one.textContent.startsWith('reaches')).click()"
WHOLE = "[...document.querySelectorAll('button')].find((one) => one.textContent === 'Whole system').click()"
BUSIEST = """
let best = ['', 0];
const count = new Map();
document.querySelectorAll('.stage .edge title').forEach((one) => one.textContent.split('\\n').forEach((line) => { const name = (/publishes (\\S+?);?$/.exec(line.split(';')[0]) || [])[1]; if (name) { count.set(name, (count.get(name) || 0) + 1); if (count.get(name) > best[1]) best = [name, count.get(name)]; } }));
return best[0];
"""


def spent(driver: Any) -> float:
    """Milliseconds of processor time that the tasks of the page's thread have taken so far."""
    metrics = driver.execute_cdp_cmd("Performance.getMetrics", {})["metrics"]
    return float(next(one["value"] for one in metrics if one["name"] == "TaskDuration")) * 1000


def middle(page: Page, work: str, undo: str = "") -> tuple[float, float]:
    """Milliseconds from the event to the changed page, and of processor time until it is painted."""
    times, costs = [], []
    for _ in range(5):
        before = spent(page.driver)
        times.append(page.driver.execute_async_script(TIMED.replace("WORK", work)))
        page.settled(90)
        costs.append(spent(page.driver) - before)
        if undo:
            page.run(undo)
            page.settled()
    return float(statistics.median(times)), float(statistics.median(costs))


def figures(driver: Any, path: Path) -> str:
    driver.get("about:blank")
    driver.execute_cdp_cmd("Performance.disable", {})
    driver.execute_cdp_cmd("Performance.enable", {"timeDomain": "threadTicks"})
    page = Page(driver, path)
    page.settled()
    begun = spent(driver)
    page.settled(300)
    paint = page.run("return performance.getEntriesByName('first-contentful-paint')[0].startTime")
    page.go("system")
    page.settled(200)
    shown = page.run("return document.querySelectorAll('.stage .element').length")
    if page.run("return document.querySelectorAll('.box.closed').length"):
        page.run(UNFOLD)
        page.settled(100)
    elements, overlaps = page.run(OVERLAPS)
    edges = page.run("return document.querySelectorAll('.stage .edge').length")
    names, crossings = page.run(TANGLES)
    search = middle(page, SEARCH)
    fold = middle(page, FOLD, UNFOLD) if page.run("return document.querySelectorAll('.handle').length") else None
    edge = middle(page, EDGE) if edges else None
    parameters, crowded = None, 0
    if "parameters" in page.run(
        "return [...document.querySelectorAll('.switches label')].map((one) => one.textContent)"
    ):
        parameters = middle(page, PARAMETERS, PARAMETERS)
        page.run(PARAMETERS)
        page.settled(100)
        crowded = page.run(OVERLAPS)[1]
        page.run(PARAMETERS)
    name = page.run(BUSIEST)
    trace = None
    if name:
        page.go(f"system?element={name.replace('/', '%2F')}")
        page.settled(200)
        trace = middle(page, TRACE, WHOLE)
    page.go("findings")
    table = middle(page, SEARCH.replace(".search-box input", "input.search"))
    said = [
        f"{path.stat().st_size / 1e6:.1f} MB",
        f"{paint:.0f} ({begun:.0f})",
        f"{shown} of {elements}, {edges}",
        f"{overlaps}, {crowded}, {names}",
        f"{crossings}",
        *(
            f"{each[0]:.0f} ({each[1]:.0f})" if each is not None else "–"
            for each in (search, table, fold, trace, edge, parameters)
        ),
        str(len(page.complaints())),
    ]
    return f"| {path.stem} | {' | '.join(said)} |"


def main() -> None:
    print(
        "| page | size | first paint, ms | elements at first of all, edges | overlapping elements, with parameters, names | crossings | search, ms | search in findings, ms | fold all, ms | trace, ms | edge, ms | parameters, ms | complaints |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|---|---|---|")
    driver = next(made := browser())
    driver.set_script_timeout(180)
    for name in sys.argv[1:]:
        print(figures(driver, Path(name).resolve()), flush=True)
    made.close()


if __name__ == "__main__":
    main()
