# SPDX-License-Identifier: Apache-2.0
"""Python launch files, changed at random, through the interpreter and the evaluation of what they describe.

    python tests/bench/launch_fuzz.py CHECKOUT... --seconds 60 --seed 1

Each round takes a launch file, changes a few of its tokens or of its syntax tree's nodes, interprets it and launches what
it gives, with its OpaqueFunctions. Checked: nothing is raised, no budget is overrun, no path that is asked for leaves its
root, and the process opens no file outside of the workspace, starts no program and connects to nothing (audit events).
The exit status is 1 if a check fails; the text that failed is printed with its round. --only ROUND does that one alone.
"""

from __future__ import annotations

import argparse
import ast
import copy
import faulthandler
import io
import random
import sys
import time
import tokenize
import traceback
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from haros_ci.analysis.architecture import ros2_launch
from haros_ci.launch.python.heap import SIZE, STEPS, Budget
from haros_ci.launch.python.interpret import interpret
from haros_ci.launch.ros2.evaluate import launch_system
from haros_ci.model.launch_actions import Description
from haros_ci.model.workspace import Workspace
from haros_ci.systems.link import Ros2Launch
from haros_ci.workspace.build import builds
from haros_ci.workspace.discover import discover

MARKERS = ("$(find-pkg-share ", "$(find-pkg-prefix ", "$(workspace ")
RAISED = "what this function returns is not known: "
#: What is put in: names of the library, values at the edge, paths that lead elsewhere.
PIECES = (
    *("0", "-1", "10**9", "2**200", "1e308", "''", "'a' * 10**6", "None", "True", "[]", "{}", "()", "...", "lambda: 0"),
    *("'..'", "'/etc/passwd'", "'../' * 40 + 'etc/passwd'", "'$(find-pkg-share ..)/x'", "'~'", "'\\x00'", "'\\ud800'"),
    *(
        "__file__",
        "__name__",
        "__builtins__",
        "__import__('os').listdir('/')",
        "globals()",
        "open('/etc/passwd').read()",
    ),
    *("os.path.dirname(__file__) + '/../../../../../etc/passwd'", "exec('x = 1')", "eval('1')", "super()", "self"),
    *("LaunchConfiguration('x')", "Node(package='p', executable='e')", "LaunchDescription([])", "GroupAction([])"),
    *("IncludeLaunchDescription(__file__)", "OpaqueFunction(function=generate_launch_description)", "f'{x!r:>{x}}'"),
    *("[x for x in x for x in x]", "{**x}", "[*x]", "(yield)", "(x := x)", "x[::-1]", "x.__class__.__mro__", "x @ x"),
    *("generate_launch_description()", "yaml.safe_load(open(x))", "get_package_share_directory('..')", "range(10**9)"),
)
STATEMENTS = (
    *(
        "while True:\n    pass",
        "for i in range(10**9):\n    x = [x, x]",
        "x = x + x",
        "def f(*a):\n    return f(f(*a))\nf()",
    ),
    *(
        "raise ValueError",
        "return",
        "assert False",
        "del x",
        "global x",
        "import os\nos.system('true')",
        "from . import x",
    ),
    *(
        "try:\n    x = 1 / 0\nexcept Exception as e:\n    x = e\nfinally:\n    y = 1",
        "with open('/etc/passwd') as f:\n    x = f.read()",
    ),
    *(
        "class A(A):\n    x = A",
        "x = y = [x]\nx.append(x)",
        "match x:\n    case [a, *b]:\n        x = b\n    case _:\n        x = 1",
    ),
)
KEYWORDS = (
    "if",
    "for",
    "in",
    "(",
    ")",
    "[",
    "]",
    ":",
    ",",
    "=",
    ".",
    "*",
    "**",
    "not",
    "return",
    "lambda",
    "-",
    "+",
    "@",
)


@dataclass
class Watch:
    """What the process does while *on*: files opened outside of *roots*, programs started, connections."""

    roots: tuple[str, ...]
    on: bool = False
    seen: list[str] = field(default_factory=list)

    def hook(self, event: str, args: tuple[Any, ...]) -> None:
        if not self.on:
            return
        if event in ("open", "os.listdir", "os.scandir"):
            path = args[0]
            # Python looks for the line of a syntax error in a file of the name that ast.parse gives it.
            if isinstance(path, int) or path == "<unknown>" or str(path).startswith(self.roots):
                return
        elif event not in (
            "subprocess.Popen",
            "os.system",
            "os.exec",
            "os.fork",
            "socket.connect",
            "os.remove",
            "os.rename",
        ):
            return
        self.seen.append(f"{event} {args[:1]}")


def tokens_of(text: str) -> list[tokenize.TokenInfo]:
    try:
        return list(tokenize.generate_tokens(io.StringIO(text).readline))
    except (tokenize.TokenError, SyntaxError, IndentationError):
        return []


def by_tokens(text: str, random_: random.Random, other: str) -> str:
    """*text* with one to five tokens left out, doubled, swapped or replaced; now and then by those of *other*."""
    tokens = [(token.type, token.string) for token in tokens_of(text)]
    pool = [(token.type, token.string) for token in tokens_of(other)] or tokens
    if len(tokens) < 3:
        return text
    for _ in range(random_.randint(1, 5)):
        at = random_.randrange(len(tokens) - 1)
        how = random_.randrange(6)
        if how == 0:
            del tokens[at]
        elif how == 1:
            tokens.insert(at, tokens[at])
        elif how == 2:
            to = random_.randrange(len(tokens) - 1)
            tokens[at], tokens[to] = tokens[to], tokens[at]
        elif how == 3:
            tokens[at] = random_.choice(pool)
        elif how == 4:
            tokens[at] = (tokenize.NAME, random_.choice(PIECES))
        else:
            tokens.insert(at, (tokenize.OP, random_.choice(KEYWORDS)))
    try:
        return str(tokenize.untokenize(tokens))
    except (ValueError, IndexError, TypeError):
        return " ".join(string for _, string in tokens)


class Swap(ast.NodeTransformer):
    """Puts *new* in place of the node *old*; statements may be several."""

    def __init__(self, old: ast.AST, new: Any) -> None:
        self.old, self.new = old, new

    def visit(self, node: ast.AST) -> Any:
        return self.new if node is self.old else self.generic_visit(node)


def by_tree(text: str, random_: random.Random, other: str) -> str:
    """*text* with one to four nodes of its tree left out, doubled, put elsewhere or replaced by others."""
    try:
        tree, pool = ast.parse(text), ast.parse(other)
    except (SyntaxError, ValueError):
        return text
    givers = [node for node in ast.walk(pool) if isinstance(node, (ast.expr, ast.stmt))]
    for _ in range(random_.randint(1, 4)):
        nodes = [node for node in ast.walk(tree) if isinstance(node, (ast.expr, ast.stmt))]
        if not nodes:
            break
        old = random_.choice(nodes)
        kind = ast.stmt if isinstance(old, ast.stmt) else ast.expr
        same = [node for node in (*nodes, *givers) if isinstance(node, kind)]
        new: Any
        if kind is ast.expr:
            new = (
                copy.deepcopy(random_.choice(same))
                if random_.random() < 0.5
                else ast.parse(random_.choice(PIECES), mode="eval").body
            )
        else:
            made = ast.parse(random_.choice(STATEMENTS)).body
            twin, foreign = copy.deepcopy(old), copy.deepcopy(random_.choice(same))
            new = random_.choice(([], [old, twin], [foreign, old], made, [*made, old]))
        tree = Swap(old, new).visit(tree)
    try:
        return ast.unparse(ast.fix_missing_locations(tree))
    except (ValueError, AttributeError, TypeError, RecursionError):
        return text


MUTATIONS: tuple[Callable[[str, random.Random, str], str], ...] = (by_tokens, by_tree)


def failures(text: str, path: str, workspace: Workspace, reader: Ros2Launch, found: Counter[str]) -> list[str]:
    """What is wrong with what the interpreter makes of *text* in the place of the file at *path*."""
    wrong: list[str] = []
    budget = Budget()
    known = {file.path for file in workspace.files}

    def read(asked: str) -> str | None:
        head, _, rest = asked.partition(")")
        if not asked.startswith(MARKERS) or ".." in (*head.partition(" ")[2].split("/"), *rest.split("/")):
            wrong.append(f"asks for {asked!r}")
        inside, content, _ = reader.places.read(asked)
        found["files read"] += inside is not None
        if inside is not None and inside not in known:
            wrong.append(f"reads {inside!r}")
        return content if inside is not None else None

    def checked(description: Description | None) -> Description | None:
        if budget.steps > STEPS or budget.size > SIZE:
            wrong.append(f"takes {budget.steps} steps, makes {budget.size} characters")
        return description

    description = checked(interpret(path, text, read, {"HOME": "/root"}, None, budget))
    assert description is not None
    found["described"] += any(action.kind != "?" for action in description.actions)
    found["out of budget"] += any("is not followed to its end" in action.reason for action in description.actions)
    load = lambda other: description if other == path else reader.loader({})(other)  # noqa: E731
    system = launch_system((path,), workspace, load, {}, {}, reader.places)
    checked(description)
    found["nodes"] += len(system.nodes)
    wrong += [problem.message for problem in system.problems if problem.message.startswith(RAISED)]
    return wrong


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("root", nargs="+", type=Path)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", type=int, help="this round alone, its text printed")
    options = parser.parse_args()
    taken: list[tuple[str, str, Workspace, Ros2Launch]] = []
    for root in options.root:
        workspace = discover(root, ())
        reader = ros2_launch(workspace, builds(workspace))
        for file in workspace.files:
            text = workspace.text(file.path) if file.path.endswith("launch.py") else ""
            if "generate_launch_description" in text:
                taken.append((file.path, text, workspace, reader))
                launch_system((file.path,), workspace, reader.loader({}), {}, {}, reader.places)
    library = (sys.prefix, sys.base_prefix, str(Path(__file__).resolve().parents[2]))
    watch = Watch(tuple(str(root.resolve()) for root in options.root) + library)
    sys.addaudithook(watch.hook)
    found: Counter[str] = Counter()
    slowest = (0.0, 0)
    bad = 0
    start = time.perf_counter()
    number = options.only or 0
    while time.perf_counter() - start < options.seconds:
        random_ = random.Random(f"{options.seed}:{number}")
        path, text, workspace, reader = random_.choice(taken)
        mutation = random_.choice(MUTATIONS)
        text = mutation(text, random_, random_.choice(taken)[1])
        if options.only is not None:
            print(text)
        begun = time.perf_counter()
        faulthandler.dump_traceback_later(120, exit=True)
        watch.on = True
        try:
            wrong = failures(text, path, workspace, reader, found)
        except Exception:
            watch.on = False
            wrong = [traceback.format_exc()]
        watch.on = False
        wrong += [f"the process: {what}" for what in watch.seen]
        watch.seen.clear()
        slowest = max(slowest, (time.perf_counter() - begun, number))
        found[mutation.__name__] += 1
        if wrong:
            bad += 1
            print(f"round {number}, {path}:", *dict.fromkeys(wrong), sep="\n  ")
        number += 1
        if options.only is not None:
            break
    print(f"{len(taken)} launch files, seed {options.seed}: {number} rounds, {bad} with a failure")
    print(", ".join(f"{name}: {count}" for name, count in sorted(found.items())))
    print(f"slowest: {slowest[0]:.2f} s, round {slowest[1]}")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
