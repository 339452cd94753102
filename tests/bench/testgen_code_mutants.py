# SPDX-License-Identifier: Apache-2.0
"""Mutants of the code of two nodes of Fictibot: how many of them the generated tests of true properties kill, and how long that takes.

    python tests/bench/testgen_fictibot.py TUTORIALS WORK build         # once; see there for what it needs
    python tests/bench/testgen_code_mutants.py WORK [--most 20] [--examples 30] [--jobs 2] [--only multiplex] [--alone] [--show]

A mutant is one change of the sources as the exercises leave them: a relational operator, a constant, a connective, an operand left out, a condition
negated, a statement deleted, a topic in the place of another. The mutants of each node are taken at even distances from all that there are, built by the
compiler commands that CMake has written, laid over the workspace by a prefix of catkin's, and tested by the same files, which end at the first failure.
A mutant that does not build is not counted.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parent))
from testgen_fictibot import ASSUMED, MULTIPLEX, ROOT, SAFETY, TRUE, project


@dataclass(frozen=True)
class Node:
    """A *target* of a *package* that one *source* is mutated of, and the launch file of its tests."""

    key: str
    source: str
    launch: str
    topics: tuple[tuple[str, str], ...]
    pause: float

    @property
    def package(self) -> str:
        return self.key.partition("/")[0]

    @property
    def target(self) -> str:
        return self.key.partition("/")[2]


NODES = (
    Node(
        SAFETY, "safety_controller.cpp", "fictibot_safety_controller/launch/quick.launch", (("bumper", "wheel"), ("cmd_stop", "stop")), 0.3
    ),
    Node(
        MULTIPLEX, "trichannel_multiplex.cpp", "fictibot_multiplex/launch/alone.launch",
        (("high_cmd_vel", "normal_cmd_vel"), ("normal_cmd_stop", "low_cmd_stop"), ("low_cmd_vel", "high_cmd_vel")), 0.0,
    ),
)  # fmt: skip
#: Beside the properties of the specification study: what the multiplexer lets through on its lower channels, and what it says of it.
MORE = {
    SAFETY: (),
    MULTIPLEX: (
        "until (/high_cmd_vel or /high_cmd_stop): /normal_cmd_stop causes /cmd_stop within 250 ms",
        "until (/high_cmd_vel or /high_cmd_stop): /normal_cmd_vel causes /state {data = 0} within 250 ms",
        "until (/high_cmd_vel or /high_cmd_stop): /normal_cmd_stop causes /state {data = 0} within 250 ms",
        "until (/high_cmd_vel or /high_cmd_stop or /normal_cmd_vel or /normal_cmd_stop): /low_cmd_vel as C causes /cmd_vel {linear = @C.linear} within 250 ms",
        "globally: /high_cmd_stop causes /state {data = 1} within 250 ms",
        "globally: /cmd_vel requires (/high_cmd_vel or /normal_cmd_vel or /low_cmd_vel) within 250 ms",
        "globally: /state {data = 0} requires (/normal_cmd_vel or /normal_cmd_stop) within 250 ms",
        "globally: /state {data = 0} forbids /state {data = -1} within 800 ms",
    ),
}


@dataclass(frozen=True)
class Mutant:
    """One change: its *operator*, the line, what stood there, what stands there now, and the whole *text*."""

    operator: str
    line: int
    old: str
    new: str
    text: str


def mutants(text: str, topics: tuple[tuple[str, str], ...]) -> Iterator[Mutant]:
    """All mutants of a source, from its first function on, in the order of its text."""
    found = sorted(_changes(text, topics), key=lambda item: (item[1], item[2], item[0]))
    begin = text.index("(ros::NodeHandle& n, double hz)")
    seen = set()
    for operator, start, end, new in found:
        made = text[:start] + new + text[end:]
        if start >= begin and made not in seen:
            seen.add(made)
            yield Mutant(operator, text.count("\n", 0, start) + 1, text[start:end].strip(), new.strip(), made)


def _changes(text: str, topics: tuple[tuple[str, str], ...]) -> Iterator[tuple[str, int, int, str]]:  # noqa: C901 - one branch for each kind of change
    """Operator, begin and end of what is replaced, and by what."""
    code = re.sub(r"//[^\n]*", lambda match: " " * len(match[0]), text)
    for match in re.finditer(r" (<=|<|>=|>|==|!=) ", code):
        for other in {"<=": ("<", ">"), "<": ("<=", ">="), "==": ("!=",), "!=": ("==",), ">": (">=",), ">=": (">",)}[
            match[1]
        ]:
            yield "relation", match.start(1), match.end(1), other
    for match in re.finditer(r"(?<![\w.\"])(\d+)(?:\.(\d))?(?![\w.\"])", code):
        if re.search(r"subscribe\(|advertise<", code[code.rfind("\n", 0, match.start()) : match.start()]):
            continue  # the size of a queue: no property of few messages is about it
        for step in (1, -1):
            if match[2] is not None:
                yield "constant", match.start(), match.end(), f"{int(match[1]) + step}.0"
            elif int(match[1]) > 1:
                yield "constant", match.start(), match.end(), str(int(match[1]) + step)
    for match in re.finditer(r"if \(([^()]*)\)\s", code):
        yield "negation", match.start(1), match.end(1), f"!({match[1]})"
        parts = match[1].split(" || ")
        if len(parts) > 1:
            yield "connective", match.start(1), match.end(1), match[1].replace(" || ", " && ", 1)
            for number in range(len(parts)):
                yield "operand", match.start(1), match.end(1), " || ".join(parts[:number] + parts[number + 1 :])
    for match in re.finditer(
        r"(?m)^ +(?!return|std_msgs|fictibot_msgs)[\w.>-]+(?: -?= [^;\n]*|\([^;\n]*\)|--|)(?<!else);$", code
    ):
        yield "deletion", match.start(), match.end(), ""
    for match in re.finditer(r"\{ return; \}", code):
        yield "deletion", match.start(), match.end(), "{}"
    names = ("HIGH_PRIORITY", "NORMAL_PRIORITY", "LOW_PRIORITY")
    for match in re.finditer("|".join(names), code):
        yield "value", match.start(), match.end(), names[(names.index(match[0]) + 1) % 3]
    for one, other in topics:
        for match in re.finditer(rf'"{one}"', code):
            yield "topic", match.start(), match.end(), f'"{other}"'


def build(space: Path, node: Node, folder: Path, mutant: Mutant) -> bool:
    """Make *folder* a prefix of catkin with the program of a mutant; False if it does not compile."""
    program = folder / "lib" / node.package / node.target
    program.parent.mkdir(parents=True)
    (folder / ".catkin").write_text("")
    source = folder / node.source
    source.write_text(mutant.text)
    made = space / "build" / node.package / "CMakeFiles" / f"{node.target}.dir"
    flags = dict(re.findall(r"(?m)^(CXX_\w+) = ?(.*)$", (made / "flags.make").read_text()))
    options = " ".join(flags.get(name, "") for name in ("CXX_DEFINES", "CXX_INCLUDES", "CXX_FLAGS"))
    link = (made / "link.txt").read_text().strip()
    link = re.sub(rf"\S*/src/{re.escape(node.source)}\.o", f"{folder}/mutant.o", link)
    link = re.sub(r" -o \S+", f" -o {program}", link)
    for command in (f"c++ {options} -o {folder}/mutant.o -c {source}", link):
        if subprocess.run(
            ["sh", "-c", command], cwd=made.parents[1], capture_output=True, start_new_session=True
        ).returncode:
            return False
    return True


def generated(space: Path, node: Node, folder: Path) -> int:
    """Write the tests of the true properties; how many there are."""
    properties = (*TRUE[node.key], *MORE[node.key])
    project(
        space, node.launch, node.key, {f"true_{n:02}": text for n, text in enumerate(properties, 1)}, ASSUMED[node.key]
    )
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    if node.pause:
        (folder / "hooks.py").write_text(f"import time\n\n\ndef reset(system):\n    time.sleep({node.pause})\n")
    command = [sys.executable, "-m", "haros_ci", "testgen", str(folder), str(space / "src"), "--no-cache"]
    subprocess.run(command, check=True, env={**os.environ, "PYTHONPATH": str(ROOT)}, stdout=subprocess.DEVNULL)
    return len(properties)


def tested(space: Path, folder: Path, examples: int, over: Path | None = None) -> tuple[list[dict[str, Any]], str]:
    """A line of the report for each test up to the first failure, and what pytest has said. *over* is laid over the workspace."""
    report = (over or folder) / "report.jsonl"
    report.unlink(missing_ok=True)
    env = {**os.environ, "PROPERTY_TESTS_REPORT": str(report), "PROPERTY_TESTS_EXAMPLES": str(examples)}
    line = f'. {space}/devel/setup.sh && CMAKE_PREFIX_PATH={f"{over}:" if over else ""}$CMAKE_PREFIX_PATH && exec "$@"'
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", str(folder)]
    done = subprocess.run(
        ["sh", "-c", line, "sh", *command], env=env, cwd=folder, capture_output=True, text=True, start_new_session=True
    )
    lines = [json.loads(text) for text in report.read_text().splitlines()] if report.exists() else []
    return lines, done.stdout + done.stderr


def verdict(lines: list[dict[str, Any]], properties: int) -> str:
    """``killed``, ``flaky``, ``survived``, or ``died`` where the system could not be started at all."""
    results = [line["result"] for line in lines]
    if "failed" in results:
        return "killed"
    if "error" in results:
        return "does not start"
    if "flaky" in results:
        return "flaky"
    return "survived" if len(results) == properties else "no answer"


def study(work: Path, node: Node, most: int, examples: int, jobs: int, alone: bool) -> dict[str, Any]:
    """Build and test *most* mutants of a node, *jobs* at a time."""
    space = work / "fixed"
    text = (space / "src" / node.package / "src" / node.source).read_text()
    every = list(mutants(text, node.topics))
    chosen = [every[number * len(every) // most] for number in range(min(most, len(every)))]
    folder = work / f"code_mutants_{node.target}"
    properties = generated(space, node, folder / "tests")
    shutil.rmtree(folder / "built", ignore_errors=True)
    if not alone:
        lines, output = tested(space, folder / "tests", examples)
        _say(node, "original", verdict(lines, properties), 0.0, lines)
        if [line["result"] for line in lines] != ["passed"] * properties:
            print(output[-3000:], flush=True)

    def row(number: int, mutant: Mutant) -> dict[str, Any] | None:
        over = folder / "built" / str(number)
        if not build(space, node, over, mutant):
            _say(node, _name(mutant), "does not build", 0.0, [])
            return None
        began = time.monotonic()
        lines, output = tested(space, folder / "tests", examples, over)
        seconds, found = time.monotonic() - began, verdict(lines, properties)
        _say(node, _name(mutant), found, seconds, lines)
        (over / "output.txt").write_text(output)
        return {"verdict": found, "seconds": seconds, "examples": sum(line["examples"] for line in lines)}

    with ThreadPoolExecutor(jobs) as pool:
        rows = [made for made in pool.map(row, range(len(chosen)), chosen) if made is not None]
    return {"node": node.key, "made": len(every), "rows": rows}


def _name(mutant: Mutant) -> str:
    return f"line {mutant.line}, {mutant.operator}: {' '.join(mutant.old.split())} -> {' '.join(mutant.new.split()) or 'nothing'}"


def _say(node: Node, what: str, found: str, seconds: float, lines: list[dict[str, Any]]) -> None:
    by = next((line["property"] for line in lines if line["result"] in ("failed", "flaky", "error")), "")
    count = sum(line["examples"] for line in lines)
    print(f"{node.target} | {what} | {found} | {seconds:.1f} s | {count} examples | {by}", flush=True)


def table(found: list[dict[str, Any]]) -> None:
    print(
        "\n| node | mutants made | tested | killed | flaky | survived | share killed | s for a killed one | for a survivor |"
    )
    print("|---|---|---|---|---|---|---|---|---|")
    for item in found:
        rows = item["rows"]
        count = {
            name: [row["seconds"] for row in rows if row["verdict"] == name]
            for name in {row["verdict"] for row in rows}
        }
        dead = [*count.get("killed", ()), *count.get("does not start", ())]
        alive = count.get("survived", ())
        times = " | ".join(f"{statistics.median(times):.1f}" if times else "" for times in (dead, alive))
        print(
            f"| {item['node']} | {item['made']} | {len(rows)} | {len(dead)} | {len(count.get('flaky', ()))} | {len(alive)} "
            f"| {len(dead) / max(1, len(rows)):.0%} | {times} |"
        )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("work", type=Path)
    parser.add_argument("--most", type=int, default=20, help="mutants of each node")
    parser.add_argument("--examples", type=int, default=30)
    parser.add_argument("--jobs", type=int, default=2, help="mutants at a time")
    parser.add_argument("--alone", action="store_true", help="without the original, of which all properties must hold")
    parser.add_argument("--only", default="", metavar="NODE", help="the node with this in its name")
    parser.add_argument("--show", action="store_true", help="print all mutants; nothing is built")
    flags = parser.parse_args()
    work = flags.work.resolve()
    found = []
    for node in NODES:
        if flags.only not in node.key:
            continue
        if flags.show:
            text = (work / "fixed/src" / node.package / "src" / node.source).read_text()
            for mutant in mutants(text, node.topics):
                print(node.target, _name(mutant))
        else:
            found.append(study(work, node, flags.most, flags.examples, flags.jobs, flags.alone))
    if not flags.show:
        table(found)


if __name__ == "__main__":
    main()
