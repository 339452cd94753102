# SPDX-License-Identifier: Apache-2.0
"""Property-based tests of the nodes of Fictibot (haros_tutorials), built from source with the catkin of Debian: exercises and mutants.

    python tests/bench/testgen_fictibot.py TUTORIALS WORK build        # two workspaces: as shipped, and with the fixes of the exercises
    python tests/bench/testgen_fictibot.py TUTORIALS WORK exercises    # section 4 of the tutorial
    python tests/bench/testgen_fictibot.py TUTORIALS WORK mutants      # true properties of two nodes, and mutants of them

TUTORIALS is a checkout of github.com/git-afsantos/haros_tutorials, WORK a directory outside of it. It needs catkin, libroscpp-dev,
ros-message-generation, python3-rospy, python3-rosmaster and python3-roslaunch of Debian, and hypothesis and pytest for this Python.
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
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from haros_ci.behaviour.clauses import Reader
from haros_ci.behaviour.comparing import Compared, follows
from haros_ci.behaviour.deciding import Predicate
from haros_ci.behaviour.meaning import mistakes
from haros_ci.behaviour.parser import parse_property
from haros_ci.behaviour.text import canonical
from haros_ci.behaviour.tree import Binary, Event, Expression, Field, Literal, PatternKind, Property, Unary

SAFETY, CONTROL, MULTIPLEX = (
    f"fictibot_{name}/fictibot_{name}" for name in ("safety_controller", "random_controller", "multiplex")
)
EXERCISE_1 = "globally: /laser {data <= 32} causes /cmd_stop within 200 ms"
EXERCISE_2 = "globally: /bumper {left or center or right} causes /cmd_vel within 200 ms"
#: The node is deaf for a second after it has reacted (exercise 1.B): eleven turns of its loop, of which ten milliseconds more or less.
DEAF = "(/laser {data <= 64} or /bumper {left or center or right} or /wheel {left or right})"
#: Properties that hold: of the safety controller with the fix, and of the multiplexer.
TRUE = {
    SAFETY: (
        "globally: /laser {data <= 32} causes /cmd_stop within 250 ms",
        "globally: /laser {data in [33 to 64]} causes /cmd_vel {linear = 0.0 and angular = 0.0} within 250 ms",
        "globally: /bumper {left or center or right} causes /cmd_stop within 250 ms",
        "globally: /wheel {left or right} causes /cmd_stop within 250 ms",
        "globally: no /cmd_vel {linear != 0.0 or angular != 0.0}",
        "globally: /cmd_stop requires (/laser {data <= 32} or /bumper {left or center or right} or /wheel {left or right}) within 250 ms",
        "globally: /cmd_vel requires /laser {data in [33 to 64]} within 250 ms",
    ),
    MULTIPLEX: (
        "globally: /high_cmd_vel as C causes /cmd_vel {linear = @C.linear and angular = @C.angular} within 250 ms",
        "globally: /high_cmd_stop causes /cmd_stop within 250 ms",
        "globally: /high_cmd_vel causes /state {data = 1} within 250 ms",
        "globally: no /state {not data in [-1 to 1]}",
        "globally: /state {data = 1} forbids /state {data = 0} within 800 ms",
        "globally: /cmd_stop requires (/high_cmd_stop or /normal_cmd_stop or /low_cmd_stop) within 250 ms",
        "until (/high_cmd_vel or /high_cmd_stop): /normal_cmd_vel as C causes /cmd_vel {linear = @C.linear} within 250 ms",
        "until (/high_cmd_vel or /high_cmd_stop or /normal_cmd_vel or /normal_cmd_stop): /low_cmd_stop causes /cmd_stop within 250 ms",
    ),
}
ASSUMED = {SAFETY: (f"globally: {DEAF} forbids {DEAF} within 250 ms",), MULTIPLEX: ()}
PACKAGES = (
    "[fictibot_drivers, fictibot_random_controller, fictibot_safety_controller, fictibot_multiplex, fictibot_msgs]"
)


def built(tutorials: Path, work: Path) -> None:
    """Build the workspaces ``shipped`` and ``fixed`` below *work*."""
    work.mkdir(parents=True, exist_ok=True)
    for name in ("shipped", "fixed"):
        space = work / name
        shutil.rmtree(space, ignore_errors=True)
        for package in sorted((tutorials / "src").glob("fictibot_*")):
            shutil.copytree(package, space / "src" / package.name)
        launch = "<launch>{3}<node name='{0}' pkg='{1}' type='{2}'/></launch>"
        quick = "<param name='reaction_time' value='0.1'/>"
        package, kind = SAFETY.split("/")
        (space / "src" / package / "launch/quick.launch").write_text(launch.format("safety", package, kind, quick))
        package, kind = MULTIPLEX.split("/")
        (space / "src" / package / "launch/alone.launch").write_text(launch.format("plex", package, kind, ""))
        if name == "fixed":
            for exercise in ("sec2-code-quality/ex1", "sec4-behaviour/ex1"):
                _patch(space, (tutorials / "exercises" / f"{exercise}.diff").read_text())
            _answer_at_once(space / "src/fictibot_random_controller/src/random_controller.cpp")
        run = ["catkin_make", "-C", str(space), "-DPYTHON_EXECUTABLE=/usr/bin/python3"]
        with (work / f"{name}.log").open("w") as log:  # messages first: not every package says that it needs them
            for targets in (["fictibot_msgs_generate_messages_cpp", "fictibot_msgs_generate_messages_py"], []):
                subprocess.run([*run, *targets], check=True, stdout=log, stderr=subprocess.STDOUT)
        print(f"built {space}", flush=True)


def _patch(space: Path, diff: str) -> None:
    """What a diff of the tutorial does to sources; what it does to project files has line counts that patch refuses."""
    parts = [part for part in re.split(r"(?m)^(?=diff --git )", diff) if part.startswith("diff --git a/src/")]
    subprocess.run(["patch", "-p1", "-s"], cwd=space, check=True, input="".join(parts), text=True)


def _answer_at_once(path: Path) -> None:
    """The second remedy that the tutorial names for exercise 2: publish in the callback of the bumper, too."""
    text = path.read_text()
    begin = text.index("{", text.index("void RandomController::bumper_callback")) + 1
    answer = "\n    if (msg->left || msg->center || msg->right) { command_publisher_.publish(fictibot_msgs::VelocityCommand()); }"
    path.write_text(text[:begin] + answer + text[begin:])


def project(space: Path, launch: str, node: str, properties: dict[str, str], assumptions: tuple[str, ...]) -> None:
    """The project file of one configuration, with the properties of a node by their ids."""
    stated = "".join(f"        - |\n          # id: {key}\n          {text}\n" for key, text in properties.items())
    assumed = "".join(f"        - '{text}'\n" for text in assumptions)
    (space / "src/haros.yaml").write_text(
        f"packages: {PACKAGES}\nconfigurations:\n  one:\n    launch: [{launch}]\nnodes:\n  {node}:\n    hpl:\n"
        f"      properties:\n{stated}" + (f"      assumptions:\n{assumed}" if assumed else "")
    )


def tested(space: Path, folder: Path, examples: int, pause: float = 0.0) -> list[dict[str, Any]]:
    """What ``haros-ci testgen --run`` reports of the project file there, a line for each property."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    if pause:
        (folder / "hooks.py").write_text(f"import time\n\n\ndef reset(system):\n    time.sleep({pause})\n")
    report = folder / "report.jsonl"
    command = [
        sys.executable,
        "-m",
        "haros_ci",
        "testgen",
        str(folder),
        ".",
        "--run",
        "--no-cache",
        "--examples",
        str(examples),
    ]
    line = f'. {space}/devel/setup.sh && export PYTHONPATH={ROOT}:$PYTHONPATH && cd {space}/src && exec "$@"'
    env = {**os.environ, "PROPERTY_TESTS_REPORT": str(report)}
    with (folder / "output.txt").open("w") as output:
        subprocess.run(["sh", "-c", line, "sh", *command], env=env, stdout=output, stderr=subprocess.STDOUT)
    return [json.loads(text) for text in report.read_text().splitlines()] if report.exists() else []


def exercises(work: Path, examples: int) -> None:
    """Section 4: exercises 1.A, 1.B and 2, as shipped and with what remedies them."""
    one, two = (
        "fictibot_safety_controller/launch/standalone.launch",
        "fictibot_random_controller/launch/standalone.launch",
    )
    deaf = f"globally: {DEAF} forbids {DEAF} within 1.3 s"
    print("| exercise | node | assumption | result | examples | seconds | messages |\n|---|---|---|---|---|---|---|")
    for name, space, launch, node, text, assumed in (
        ("1.A", "shipped", one, SAFETY, EXERCISE_1, ()),
        ("1.B", "fixed", one, SAFETY, EXERCISE_1, ()),
        ("1.B", "fixed", one, SAFETY, EXERCISE_1, (deaf,)),
        ("2", "shipped", two, CONTROL, EXERCISE_2, ()),
        ("2", "fixed", two, CONTROL, EXERCISE_2, ()),
    ):
        project(work / space, launch, node, {"exercise": text}, assumed)
        (line,) = tested(work / space, work / f"tests_{name}_{space}_{len(assumed)}", examples)
        shown = json.dumps(line["messages"]) if line["result"] != "passed" else ""
        print(
            f"| {name} | {space} | {'yes' if assumed else ''} | {line['result']} | {line['examples']} | {line['seconds']} | {shown} |",
            flush=True,
        )


def mutants(text: str) -> Iterator[str]:
    """Specification mutants of a property: operators, numbers, conjuncts, predicates, patterns and bounds changed, one at a time. What follows of
    the property is none."""
    found = parse_property(text)
    made = dict.fromkeys(canonical(mutant) for mutant in _mutants(found))
    for mutant in map(parse_property, made):
        if not mistakes(mutant) and not follows(compared(mutant), compared(found)):
            yield canonical(mutant)


def compared(found: Property) -> Compared:
    return Compared(found, lambda event: Predicate(event.predicate, Reader(None, event.alias)))


def _mutants(found: Property) -> Iterator[Property]:
    pattern = found.pattern
    for role in ("behaviour", "trigger"):
        events: tuple[Event, ...] = getattr(pattern, role)
        for number, event in enumerate(events):
            for changed in _changed(event.predicate):
                row = (*events[:number], replace(event, predicate=changed), *events[number + 1 :])
                yield replace(found, pattern=replace(pattern, **{role: row}))
            if len(events) > 1:
                yield replace(found, pattern=replace(pattern, **{role: (*events[:number], *events[number + 1 :])}))
    if pattern.bound is not None and pattern.kind in (PatternKind.CAUSES, PatternKind.REQUIRES):
        yield replace(found, pattern=replace(pattern, bound=replace(pattern.bound, seconds=0.001)))
    if pattern.kind in (PatternKind.CAUSES, PatternKind.FORBIDS):
        other = PatternKind.FORBIDS if pattern.kind is PatternKind.CAUSES else PatternKind.CAUSES
        yield replace(found, pattern=replace(pattern, kind=other))


_OTHERS = {
    "=": ("!=", "<"),
    "!=": ("=",),
    "<=": ("<", ">", "="),
    "<": ("<=", ">"),
    ">": (">=", "<"),
    ">=": (">", "<"),
    "and": ("or",),
    "or": ("and",),
}


def _of_binary(part: Binary) -> Iterator[Expression | None]:
    for other in _OTHERS.get(part.operator, ()):
        yield replace(part, operator=other)
    if part.operator in ("and", "or"):
        yield from (part.left, part.right)
    yield from (replace(part, left=changed) for changed in _changed(part.left) if changed is not None)
    yield from (replace(part, right=changed) for changed in _changed(part.right) if changed is not None)


def _changed(part: Expression | None) -> Iterator[Expression | None]:
    """*part* with one thing in it changed."""
    match part:
        case Binary():
            yield from _of_binary(part)
        case Unary(operator="not", operand=operand):
            yield operand
            yield from (replace(part, operand=changed) for changed in _changed(operand))
        case Literal(value=bool() | str()):
            return
        case Literal(value=value):
            step = 1 if isinstance(value, int) else 0.5
            yield from (replace(part, written=str(value + by), value=value + by) for by in (step, -step))
        case Field(base=None, name="left" | "right" | "center"):
            yield Unary(part.at, "not", part)
        case _ if part is not None and hasattr(part, "low"):
            yield from (replace(part, low=changed) for changed in _changed(part.low))
            yield from (replace(part, high=changed) for changed in _changed(part.high))


def study(work: Path, examples: int, most: int, only: str) -> None:
    """The true properties, which must pass, and *most* mutants of each node, which should not."""
    rows = []
    for node, launch, pause in (
        (SAFETY, "fictibot_safety_controller/launch/quick.launch", 0.3),
        (MULTIPLEX, "fictibot_multiplex/launch/alone.launch", 0.0),
    ):
        if only not in node:
            continue
        every = [mutant for text in TRUE[node] for mutant in mutants(text)]
        chosen = [every[number * len(every) // most] for number in range(min(most, len(every)))]
        stated = {f"true_{number:02}": text for number, text in enumerate(TRUE[node], 1)}
        stated.update((f"mutant_{number:02}", text) for number, text in enumerate(chosen, 1))
        project(work / "fixed", launch, node, stated, ASSUMED[node])
        lines = tested(work / "fixed", work / f"study_{node.partition('/')[0]}", examples, pause)
        for line in lines:
            line["kind"] = "true" if "_true_" in line["test"] else "mutant"
            print(
                f"{line['result']:8} {line['kind']:7} {line['seconds']:7.1f} s {line['examples']:4} examples  {line['property']}",
                flush=True,
            )
        rows.append((node, len(every), lines))
    titles = "node|mutants made|tested|killed|flaky|survived|true ones passed|s for a killed one|examples for it|s for an example"
    print(f"\n| {titles.replace('|', ' | ')} |\n|{'---|' * (titles.count('|') + 1)}")
    for row in rows:
        print(_row(*row))


def _row(node: str, made: int, lines: list[dict[str, Any]]) -> str:
    """A line of the table."""
    true = [line["result"] for line in lines if line["kind"] == "true"]
    results = [line["result"] for line in lines if line["kind"] == "mutant"]
    dead = [line for line in lines if line["kind"] == "mutant" and line["result"] == "failed"]
    seconds, examples = (statistics.median(line[key] for line in dead) for key in ("seconds", "examples"))
    one = statistics.median(line["seconds"] / line["examples"] for line in lines if line["examples"])
    counts = " | ".join(str(results.count(result)) for result in ("failed", "flaky", "passed"))
    passed = f"{true.count('passed')} of {len(true)}"
    return f"| {node} | {made} | {len(results)} | {counts} | {passed} | {seconds:.1f} | {examples:.0f} | {one:.2f} |"


def speed(work: Path, examples: int) -> None:
    """One property of the multiplexer, without anything that brings its state back."""
    node, text = MULTIPLEX, TRUE[MULTIPLEX][1]
    project(work / "fixed", "fictibot_multiplex/launch/alone.launch", node, {"speed": text}, ())
    (line,) = tested(work / "fixed", work / "speed", examples)
    print(json.dumps(line, indent=2))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tutorials", type=Path)
    parser.add_argument("work", type=Path)
    parser.add_argument("what", choices=("build", "exercises", "mutants", "speed"))
    parser.add_argument("--examples", type=int, default=100)
    parser.add_argument("--most", type=int, default=20, help="mutants of each node")
    parser.add_argument(
        "--only", default="", metavar="NODE", help="of the two nodes of mutants the one with this in its name"
    )
    flags = parser.parse_args()
    if flags.what == "build":
        built(flags.tutorials.resolve(), flags.work.resolve())
    elif flags.what == "exercises":
        exercises(flags.work.resolve(), flags.examples)
    elif flags.what == "speed":
        speed(flags.work.resolve(), flags.examples)
    else:
        study(flags.work.resolve(), flags.examples, flags.most, flags.only)


if __name__ == "__main__":
    main()
