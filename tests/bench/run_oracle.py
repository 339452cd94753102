# SPDX-License-Identifier: Apache-2.0
"""Whether the model of generated programs in Python is what they do when they run.

    python -m tests.bench.run_oracle SEED COUNT [--show] [--ros2]

Each program is generated (none is anybody's), its model is made, and it is run several times with something in place of rospy (with ``--ros2`` of rclpy) that writes down
what is made; what a program draws by chance differs from run to run, and every callback is called. The exit code is 1 where the two disagree:

- ``missing``: something is made that the model does not have, and does not say that it may lack anything;
- ``ruled out``: something is made of which the model says that it cannot be;
- ``phantom``: the model has something without a condition that a run to the end does not make;
- ``never``: the model has something under conditions that none of the runs makes: counted, and shown with ``--show``.
"""

from __future__ import annotations

import random
import re
import resource
import sys
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

from tests.bench.run_judge import Report, Run, compare
from tests.link.follow_kit import follow, python_files

RUNS = 12
#: Bytes that all may take: a text that doubles in a loop ends its program.
MEMORY = 600_000_000
STEPS = 3_000
WORDS = "arm base cam drive eye fork gear hub imu jaw".split()
KEYS = "left right top low".split()
CALLS = {
    1: {"publishers": "rospy.Publisher({0}, {1}, queue_size={2})", "subscribers": "rospy.Subscriber({0}, {1}, {3})"},
    2: {
        "publishers": "NODE.create_publisher({1}, {0}, {2})",
        "subscribers": "NODE.create_subscription({1}, {0}, {3}, 1)",
    },
}
HEADS = {1: ("import rospy",), 2: ("import rclpy", "from rclpy.node import Node")}
BEGIN = {
    1: ('    rospy.init_node("n")',),
    2: ("    global NODE", "    rclpy.init()", '    NODE = rclpy.create_node("n")'),
}
SPIN = {1: "    rospy.spin()", 2: "    rclpy.spin(NODE)"}
TIMER = {1: "rospy.Timer(rospy.Duration({0}), {1})", 2: "NODE.create_timer({0} + 1.0, lambda: {1}(None))"}
INTERFACES = {1: "std_msgs/{}", 2: "std_msgs/msg/{}"}
TYPES = ("String", "Bool", "Int32", "Empty")


class Stop(BaseException):
    """A program that takes too long."""


@dataclass
class Scope:
    """What may be named where a statement stands, by type."""

    names: dict[str, list[str]] = field(default_factory=dict)
    depth: int = 0
    in_loop: bool = False
    returns: str | None = None
    has_self: bool = False

    def inner(self, **changes: Any) -> Scope:
        given = {"depth": self.depth + 1, "in_loop": self.in_loop, "returns": self.returns, "has_self": self.has_self}
        return Scope({kind: list(names) for kind, names in self.names.items()}, **{**given, **changes})

    def add(self, kind: str, name: str) -> None:
        for names in self.names.values():
            if name in names:
                names.remove(name)
        self.names.setdefault(kind, []).append(name)


class Program:
    """One generated program, as text."""

    def __init__(self, seed: int, ros: int = 1) -> None:
        self.ros = ros
        self.random = random.Random(seed)
        self.count = 0
        self.lines: list[str] = []
        #: Functions by what they return, each with its name, the types of its parameters, and whether it makes something.
        self.functions: list[tuple[str, tuple[str, ...], str | None]] = []
        self.methods: dict[str, list[tuple[str, tuple[str, ...], str | None]]] = {}
        self.attributes: dict[str, dict[str, str]] = {}
        self.callbacks: list[str] = []
        self.text = self._program()

    def new(self, prefix: str) -> str:
        self.count += 1
        return f"{prefix}{self.count}"

    def pick(self, *options: Any) -> Any:
        return self.random.choice(options)

    def chance(self, share: float) -> bool:
        return self.random.random() < share

    # -- expressions

    def of(self, kind: str, scope: Scope, depth: int = 0) -> str:
        """An expression of that type."""
        known = scope.names.get(kind, [])
        if known and self.chance(0.55):
            return str(self.random.choice(known))
        if depth > 2:
            return self.literal(kind)
        ways: dict[str, list[Callable[[Scope, int], str]]] = {
            "str": [
                self._join,
                self._format,
                self._text_method,
                self._choice,
                self._of_list,
                self._of_dict,
                self._call_str,
            ],
            "int": [self._sum, self._len, self._count, self._call_int],
            "bool": [self._compare, self._chance, self._in, self._both, self._compare],
            "list": [self._list, self._comprehension, self._keys, self._split, self._list],
            "dict": [self._dict, self._dict_comprehension, self._dict],
        }
        if self.chance(0.3):
            return self.literal(kind)
        return self.random.choice(ways[kind])(scope, depth + 1)

    def literal(self, kind: str) -> str:
        match kind:
            case "str":
                return f'"{self.random.choice(WORDS)}"'
            case "int":
                return str(self.random.randint(0, 4))
            case "bool":
                return str(self.pick("True", "False"))
            case "list":
                return "[" + ", ".join(f'"{w}"' for w in self.random.sample(WORDS, self.random.randint(1, 3))) + "]"
            case _:
                keys = self.random.sample(KEYS, self.random.randint(1, 3))
                return "{" + ", ".join(f'"{k}": "{self.random.choice(WORDS)}"' for k in keys) + "}"

    def _join(self, scope: Scope, depth: int) -> str:
        between = self.pick(' + "/" + ', ' + "_" + ', " + ")
        return f"({self.of('str', scope, depth)}{between}{self.of('str', scope, depth)})"

    def _format(self, scope: Scope, depth: int) -> str:
        one, two = self.of("str", scope, depth), self.of("int", scope, depth)
        return str(
            self.pick(
                f'"%s_%d" % ({one}, {two})',
                f'"{{}}/n{{}}".format({one}, {two})',
                f'"{{a}}_{{b}}".format(a={one}, b={two})',
                f'f"{{{one.replace(chr(34), chr(39))}}}/n{{{two.replace(chr(34), chr(39))}}}"'
                if 'f"' not in one + two and "\\" not in one + two and "'" not in one + two
                else one,
                f'"n" + str({two})',
            )
        )

    def _text_method(self, scope: Scope, depth: int) -> str:
        one = self.of("str", scope, depth)
        return str(
            self.pick(
                f"{one}.upper()",
                f'{one}.replace("a", "o")',
                f"{one}[1:]",
                f"{one}[:2]",
                f'{one}.strip("a")',
                f'{one}.rstrip("r")',
                f'"_".join({self.of("list", scope, depth)})',
                f'{one}.split("/")[0]',
                f"{one}.title()",
                f'{one}.partition("_")[2]',
                f'"".join(w for w in {one} if w != "a")',
                f'"%(a)s_%(b)s" % {{"a": {one}, "b": {self.of("int", scope, depth)}}}',
                f'{one}.rsplit("_", 1)[0]',
                f"{one}[::-1]",
                f"{one}.lower().capitalize()",
                f"{one}.zfill(5)",
                f'(lambda t: t + "_x")({one})',
                f"str({one})",
            )
        )

    def _choice(self, scope: Scope, depth: int) -> str:
        return (
            f"({self.of('str', scope, depth)} if {self.of('bool', scope, depth)} else {self.of('str', scope, depth)})"
        )

    def _of_list(self, scope: Scope, depth: int) -> str:
        one = self.of("list", scope, depth)
        return str(self.pick(f"{one}[0]", f"{one}[-1]", f"sorted({one})[0]", f"max({one})", f"next(iter({one}))"))

    def _of_dict(self, scope: Scope, depth: int) -> str:
        one, key = self.of("dict", scope, depth), self.random.choice(KEYS)
        return str(self.pick(f'{one}.get("{key}", {self.of("str", scope, depth)})', f"list({one}.values())[0]"))

    def _call_str(self, scope: Scope, depth: int) -> str:
        return self._call("str", scope, depth) or self.literal("str")

    def _call_int(self, scope: Scope, depth: int) -> str:
        return self._call("int", scope, depth) or self.literal("int")

    def _call(self, kind: str | None, scope: Scope, depth: int) -> str:
        found = [f for f in self.functions if f[2] == kind]
        if not found:
            return ""
        name, parameters, _ = self.random.choice(found)
        return f"{name}({', '.join(self.of(p, scope, depth + 1) for p in parameters)})"

    def _sum(self, scope: Scope, depth: int) -> str:
        sign = self.pick("+", "*", "+")
        return str(
            self.pick(
                f"({self.of('int', scope, depth)} {sign} {self.of('int', scope, depth)})",
                f"({self.of('int', scope, depth)} % 3)",
                f"({self.of('int', scope, depth)} // 2)",
                f"max({self.of('int', scope, depth)}, {self.of('int', scope, depth)})",
            )
        )

    def _len(self, scope: Scope, depth: int) -> str:
        return f"len({self.of(self.pick('list', 'str', 'dict'), scope, depth)})"

    def _count(self, scope: Scope, depth: int) -> str:
        return str(
            self.pick(
                f"int({self.of('bool', scope, depth)})",
                f"sum(1 for _ in {self.of('list', scope, depth)})",
                f'{self.of("str", scope, depth)}.count("a")',
                "random.randint(0, 2)",
            )
        )

    def _compare(self, scope: Scope, depth: int) -> str:
        return str(
            self.pick(
                f"{self.of('str', scope, depth)} == {self.of('str', scope, depth)}",
                f"({self.of('int', scope, depth)} {self.pick('<', '>', '==', '!=', '<=')} {self.of('int', scope, depth)})",
                f'{self.of("str", scope, depth)}.startswith("{self.random.choice("abcdef")}")',
                f"bool({self.of(self.pick('list', 'str', 'int'), scope, depth)})",
            )
        )

    def _chance(self, scope: Scope, depth: int) -> str:
        return "random.random() < 0.5"

    def _in(self, scope: Scope, depth: int) -> str:
        which = self.pick("list", "dict")
        word = self.random.choice(WORDS if which == "list" else KEYS)
        return f'("{word}" {self.pick("in", "not in")} {self.of(which, scope, depth)})'

    def _both(self, scope: Scope, depth: int) -> str:
        return str(
            self.pick(
                f"({self.of('bool', scope, depth)} {self.pick('and', 'or')} {self.of('bool', scope, depth)})",
                f"(not {self.of('bool', scope, depth)})",
                f'{self.pick("any", "all")}(w > "d" for w in {self.of("list", scope, depth)})',
            )
        )

    def _list(self, scope: Scope, depth: int) -> str:
        return str(
            self.pick(
                f"[{self.of('str', scope, depth)}, {self.of('str', scope, depth)}]",
                f"({self.of('list', scope, depth)} + {self.of('list', scope, depth)})",
                f"sorted({self.of('list', scope, depth)})",
                f"list(reversed({self.of('list', scope, depth)}))",
                f"[*{self.of('list', scope, depth)}, {self.of('str', scope, depth)}]",
                f"({self.of('list', scope, depth)} * 2)",
            )
        )

    def _comprehension(self, scope: Scope, depth: int) -> str:
        name = self.new("w")
        inner = scope.inner()
        inner.add("str", name)
        end = f" if {self.of('bool', inner, depth + 1)}" if self.chance(0.4) else ""
        made = f"[{self.of('str', inner, depth)} for {name} in {self.of('list', scope, depth)}{end}]"
        return f'({made} or ["none"])'

    def _keys(self, scope: Scope, depth: int) -> str:
        one = self.of("dict", scope, depth)
        return str(self.pick(f"list({one})", f"sorted({one}.values())", f"list(map(str.upper, {one}))"))

    def _split(self, scope: Scope, depth: int) -> str:
        return f'{self.of("str", scope, depth)}.split("{self.pick("_", "/", "a")}")'

    def _dict(self, scope: Scope, depth: int) -> str:
        return str(
            self.pick(
                f'{{"{self.random.choice(KEYS)}": {self.of("str", scope, depth)}}}',
                f"dict({self.random.choice(KEYS)}={self.of('str', scope, depth)})",
                f"dict(zip({self.of('list', scope, depth)}, {self.of('list', scope, depth)}))",
                f'{{**{self.of("dict", scope, depth)}, "{self.random.choice(KEYS)}": {self.of("str", scope, depth)}}}',
            )
        )

    def _dict_comprehension(self, scope: Scope, depth: int) -> str:
        name = self.new("k")
        inner = scope.inner()
        inner.add("str", name)
        return f"{{{name}: {self.of('str', inner, depth)} for {name} in {self.of('list', scope, depth)}}}"

    # -- statements

    def block(self, scope: Scope, indent: str, size: int) -> list[str]:
        found: list[str] = []
        for _ in range(size):
            found += self.statement(scope, indent)
        return found or [f"{indent}pass"]

    def statement(self, scope: Scope, indent: str) -> list[str]:
        ways = [self._make] * 4 + [self._assign] * 5 + [self._change] * 2
        if scope.depth < 3:
            ways += [self._if] * 3 + [self._for] * 3 + [self._while, self._try, self._with, self._nested]
            ways += [self._stored, self._endless, self._match, self._table, self._generator, self._counter]
        ways += [self._plain_call, self._leave, self._spread, self._timer]
        return self.random.choice(ways)(scope, indent)

    def make(self, scope: Scope) -> str:
        kind = self.pick("publishers", "subscribers")
        callback = self.random.choice([*self.callbacks, "print"])
        return CALLS[self.ros][kind].format(
            self.of("str", scope), self.pick(*TYPES), self.of("int", scope, 2), callback
        )

    def _make(self, scope: Scope, indent: str) -> list[str]:
        return [f"{indent}{self.make(scope)}"]

    def _assign(self, scope: Scope, indent: str) -> list[str]:
        kind = self.pick("str", "str", "int", "bool", "list", "dict")
        value = self.of(kind, scope)
        if scope.has_self and self.chance(0.4):
            name = f"self.{self.random.choice('pqr')}_{kind}"
            return [f"{indent}{name} = {value}"]
        name = self.new("v")
        names = scope.names.get(kind, [])
        plain = [n for n in names if "." not in n and not n.startswith("G")]
        if plain and self.chance(0.35):
            name = self.random.choice(plain)
        second, other = self.of("str", scope), self.new("v")
        scope.add(kind, name)
        if kind == "str" and self.chance(0.15):
            scope.add("str", other)
            return [f"{indent}{name}, {other} = {value}, {second}"]
        return [f"{indent}{name} = {value}"]

    def _change(self, scope: Scope, indent: str) -> list[str]:
        for kind in self.random.sample(("list", "dict", "str", "int"), 4):
            names = [n for n in scope.names.get(kind, []) if not n.startswith("G")]
            if names:
                name = self.random.choice(names)
                word = self.of("str", scope)
                return [
                    indent
                    + {
                        "list": self.pick(
                            f"{name}.append({word})",
                            f"{name}.extend({self.of('list', scope)})",
                            f"{name}.insert(0, {word})",
                            f"{name}[0] = {word}",
                            f"{name} += [{word}]",
                            f"{name}.sort()",
                            f"{name}.reverse()",
                            f"{name}.append({name}.pop(0))",
                            f'{name}[:] = [w + "_c" for w in {name}]',
                            f"del {name}[1:]",
                        ),
                        "dict": self.pick(
                            f'{name}["{self.random.choice(KEYS)}"] = {word}',
                            f'{name}.setdefault("{self.random.choice(KEYS)}", {word})',
                            f"{name}.update({self.of('dict', scope)})",
                        ),
                        "str": f"{name} += {word}",
                        "int": f"{name} += {self.of('int', scope, 2)}",
                    }[kind]
                ]
        return self._assign(scope, indent)

    def _if(self, scope: Scope, indent: str) -> list[str]:
        found = [f"{indent}if {self.of('bool', scope)}:"]
        found += self.block(scope.inner(), indent + "    ", self.random.randint(1, 3))
        if self.chance(0.3):
            found.append(f"{indent}elif {self.of('bool', scope)}:")
            found += self.block(scope.inner(), indent + "    ", self.random.randint(1, 2))
        if self.chance(0.5):
            found.append(f"{indent}else:")
            found += self.block(scope.inner(), indent + "    ", self.random.randint(1, 2))
        return found

    def _for(self, scope: Scope, indent: str) -> list[str]:
        inner = scope.inner(in_loop=True)
        one, two = self.new("i"), self.new("i")
        way = self.random.randint(0, 4)
        if way == 0:
            head = f"for {one} in {self.of('list', scope)}:"
            inner.add("str", one)
        elif way == 1:
            head = f"for {one}, {two} in {self.of('dict', scope)}.items():"
            inner.add("str", one)
            inner.add("str", two)
        elif way == 2:
            head = f"for {one}, {two} in enumerate(list({self.of('list', scope)})):"
            inner.add("int", one)
            inner.add("str", two)
        elif way == 3:
            head = f"for {one} in range({self.of('int', scope, 2)}):"
            inner.add("int", one)
        else:
            head = f"for {one}, {two} in zip(list({self.of('list', scope)}), list({self.of('list', scope)})):"
            inner.add("str", one)
            inner.add("str", two)
        found = [indent + head, *self.block(inner, indent + "    ", self.random.randint(1, 3))]
        if self.chance(0.15):
            found += [f"{indent}else:", *self.block(scope.inner(), indent + "    ", 1)]
        return found

    def _while(self, scope: Scope, indent: str) -> list[str]:
        name = self.new("c")
        inner = scope.inner(in_loop=True)
        body = self.block(inner, indent + "    ", self.random.randint(1, 2))
        # No continue may pass over the counter.
        return [
            f"{indent}{name} = {self.random.randint(0, 2)}",
            f"{indent}while {name} < {self.random.randint(1, 4)}:",
            f"{indent}    {name} += 1",
            *body,
        ]

    def _try(self, scope: Scope, indent: str) -> list[str]:
        found = [f"{indent}try:"]
        found += self.block(scope.inner(), indent + "    ", self.random.randint(1, 2))
        if self.chance(0.4):
            found += [f'{indent}    {{}}["none"]' if self.chance(0.5) else f"{indent}    raise ValueError()"]
        found += [f"{indent}except ({self.pick('KeyError, ValueError', 'Exception', 'LookupError, ValueError')}):"]
        found += self.block(scope.inner(), indent + "    ", 1)
        if self.chance(0.3):
            found += [f"{indent}finally:", *self.block(scope.inner(in_loop=False, returns=None), indent + "    ", 1)]
        return found

    def _with(self, scope: Scope, indent: str) -> list[str]:
        return [f"{indent}with LOCK:", *self.block(scope.inner(), indent + "    ", self.random.randint(1, 2))]

    def _nested(self, scope: Scope, indent: str) -> list[str]:
        """A function inside that uses what is around it, called at once or twice."""
        name, parameter = self.new("inner"), self.new("a")
        inner = scope.inner(in_loop=False, returns=None)
        inner.add("str", parameter)
        body = [f"{indent}    {self.make(inner)}"]
        if self.chance(0.5):
            body = [f"{indent}    if {self.of('bool', inner)}:", f"{indent}        return", *body]
        calls = [f"{indent}{name}({self.of('str', scope)})" for _ in range(self.random.randint(1, 2))]
        if self.chance(0.3):
            calls = [
                f"{indent}for {self.new('i')} in map({name}, list({self.of('list', scope)})):",
                f"{indent}    pass",
            ]
        return [f"{indent}def {name}({parameter}):", *body, *calls]

    def _stored(self, scope: Scope, indent: str) -> list[str]:
        """Functions in a list that are called later."""
        name, one, parameter = self.new("fs"), self.new("one"), self.new("a")
        inner = scope.inner(in_loop=False, returns=None)
        inner.add("str", parameter)
        given = [f"lambda {parameter}: {self.make(inner)}" for _ in range(self.random.randint(1, 2))]
        given += [f[0] for f in self.functions if f[1] == ("str",)][:1]
        found = [f"{indent}{name} = [{', '.join(given)}]"]
        if self.chance(0.3):
            found.append(f"{indent}{name}.append(lambda {parameter}: {self.make(inner)})")
        call = self.pick(f"{one}({self.of('str', scope)})", f"{one}(*[{self.of('str', scope)}])")
        return [*found, f"{indent}for {one} in {name}:", f"{indent}    {call}"]

    def _endless(self, scope: Scope, indent: str) -> list[str]:
        name = self.new("c")
        body = self.block(scope.inner(in_loop=False), indent + "    ", self.random.randint(1, 2))
        return [
            f"{indent}{name} = 0",
            f"{indent}while True:",
            f"{indent}    {name} += 1",
            *body,
            f"{indent}    if {name} > {self.random.randint(0, 2)}:",
            f"{indent}        break",
        ]

    def _match(self, scope: Scope, indent: str) -> list[str]:
        found = [f"{indent}match {self.of('str', scope)}:"]
        for word in self.random.sample(WORDS, self.random.randint(1, 2)):
            found += [f'{indent}    case "{word}":', *self.block(scope.inner(), indent + "        ", 1)]
        if self.chance(0.6):
            found += [f"{indent}    case _:", *self.block(scope.inner(), indent + "        ", 1)]
        return found

    def _table(self, scope: Scope, indent: str) -> list[str]:
        """Functions in a dictionary, of which one is called by its key."""
        parameter = self.new("a")
        inner = scope.inner(in_loop=False, returns=None)
        inner.add("str", parameter)
        name, keys = self.new("table"), self.random.sample(KEYS, 2)
        entries = ", ".join(f'"{key}": lambda {parameter}: {self.make(inner)}' for key in keys)
        key = self.pick(f'"{keys[0]}"', f'"{keys[1]}" if {self.of("bool", scope)} else "{keys[0]}"')
        return [f"{indent}{name} = {{{entries}}}", f"{indent}{name}[{key}]({self.of('str', scope)})"]

    def _generator(self, scope: Scope, indent: str) -> list[str]:
        name, one, inside = self.new("gen"), self.new("i"), self.new("w")
        inner = scope.inner(in_loop=False, returns=None)
        body = [f"{indent}    yield {self.of('str', inner)}"]
        loop = inner.inner()
        loop.add("str", inside)
        if self.chance(0.5):
            body += [
                f"{indent}    for {inside} in {self.of('list', inner)}:",
                f"{indent}        yield {self.of('str', loop)}",
            ]
        if self.chance(0.4):
            body += [f"{indent}    if {self.of('bool', inner)}:", f"{indent}        yield {self.of('str', inner)}"]
        after = scope.inner(in_loop=True)
        after.add("str", one)
        # A generator is read as a list of what it gives: nothing may change between two elements.
        use = [f"{indent}for {one} in list({name}()):", *self.block(after, indent + "    ", 1)]
        return [f"{indent}def {name}():", *body, *use]

    def _counter(self, scope: Scope, indent: str) -> list[str]:
        """A function inside that changes a variable around it."""
        if scope.depth == 0 and not scope.names.get("str"):
            return self._assign(scope, indent)
        name, variable = self.new("count"), self.new("v")
        inner = scope.inner(in_loop=False, returns=None)
        inner.add("str", variable)
        body = [f"{indent}    nonlocal {variable}", f"{indent}    {variable} = {self.of('str', inner)}"]
        found = [f"{indent}{variable} = {self.of('str', scope)}", f"{indent}def {name}():", *body]
        found += [f"{indent}{name}()"] * self.random.randint(1, 2)
        scope.add("str", variable)
        return found

    def _spread(self, scope: Scope, indent: str) -> list[str]:
        found = [f for f in self.functions if f[1] and all(kind in ("str", "int") for kind in f[1])]
        if not found:
            return self._assign(scope, indent)
        name, types, _ = self.random.choice(found)
        return [f"{indent}{name}(*[{', '.join(self.of(kind, scope) for kind in types)}])"]

    def _timer(self, scope: Scope, indent: str) -> list[str]:
        if not self.callbacks:
            return self._assign(scope, indent)
        return [indent + TIMER[self.ros].format(self.of("int", scope, 2), self.random.choice(self.callbacks))]

    def _plain_call(self, scope: Scope, indent: str) -> list[str]:
        call = self._call(None, scope, 0)
        return [f"{indent}{call}"] if call else self._assign(scope, indent)

    def _leave(self, scope: Scope, indent: str) -> list[str]:
        if scope.in_loop and scope.depth and self.chance(0.6):
            return [f"{indent}if {self.of('bool', scope)}:", f"{indent}    {self.pick('break', 'continue')}"]
        if scope.returns is not None and scope.depth:
            value = f" {self.of(scope.returns, scope)}" if scope.returns else ""
            return [f"{indent}if {self.of('bool', scope)}:", f"{indent}    return{value}"]
        return self._assign(scope, indent)

    # -- definitions

    def _function(self, around: Scope) -> None:
        kind = self.pick("str", "str", "int", None, None)
        name = self.new("f")
        types = tuple(self.pick("str", "int", "list", "bool") for _ in range(self.random.randint(0, 2)))
        scope = around.inner(depth=1, returns=kind or "", in_loop=False)
        parameters = []
        for number, one in enumerate(types):
            parameter = self.new("a")
            scope.add(one, parameter)
            default = f"={self.literal(one)}" if number == len(types) - 1 and self.chance(0.3) and one != "list" else ""
            parameters.append(parameter + default)
        body = self.block(scope, "    ", self.random.randint(1, 4))
        if kind:
            body.append(f"    return {self.of(kind, scope)}")
        if self.chance(0.15):
            self.lines.append("@passed")
        self.lines += [f"def {name}({', '.join(parameters)}):", *body, ""]
        self.functions.append((name, types, kind))

    def _callback(self, around: Scope) -> None:
        name = self.new("heard")
        scope = around.inner(depth=2, returns="", in_loop=False)
        self.lines += [f"def {name}(message):", *self.block(scope, "    ", self.random.randint(1, 3)), ""]
        self.callbacks.append(name)

    def _class(self, around: Scope, base: str | None) -> str:
        name = self.new("C")
        attributes = {f"self.{n}_{k}": k for n in "pqr" for k in ("str", "int", "list", "dict", "bool")}
        head = f"class {name}({base}):" if base else f"class {name}:"
        lines = [head]
        if self.chance(0.5):
            lines.append(f"    shared = {self.literal('str')}")
        else:
            lines.append('    shared = "hub"')
        scope = around.inner(depth=1, has_self=True, returns=None, in_loop=False)
        scope.add("str", "first")
        lines.append("    def __init__(self, first):")
        if base:
            lines.append(f"        super().__init__({self.of('str', scope)})")
        else:
            lines += [f"        {full} = {self.literal(kind)}" for full, kind in attributes.items()]
        for full, kind in attributes.items():
            scope.names.setdefault(kind, []).append(full)
        scope.names["str"].append("self.shared")
        lines += self.block(scope, "        ", self.random.randint(1, 4))
        own = around.inner(depth=1, has_self=True, returns="", in_loop=False)
        for full, kind in attributes.items():
            own.names.setdefault(kind, []).append(full)
        own.names["str"].append("self.shared")
        for method in ("step", "more") if not base else (self.pick("step", "more"),):
            inner = own.inner(depth=1)
            inner.add("str", "given")
            lines.append(f"    def {method}(self, given):")
            if base and self.chance(0.5):
                lines.append(f"        super().{method}({self.of('str', inner)})")
            lines += self.block(inner, "        ", self.random.randint(1, 3))
            if method == "step" and self.chance(0.5):
                lines.append(f"        self.more({self.of('str', inner)})")
        if not base:
            lines += ["    @property", "    def whole(self):", f"        return {self.of('str', own)}"]
            lines += ["    @staticmethod", "    def plain(given):", "        return given + self_free(given)"]
            lines += ["    @classmethod", "    def named(cls, given):", "        return cls.shared + given"]
        self.lines += [*lines, ""]
        return name

    def _program(self) -> str:
        top = Scope()
        self.lines = [
            "#!/usr/bin/env python3",
            "import random",
            "import threading",
            *HEADS[self.ros],
            "from std_msgs.msg import Bool, Empty, Int32, String",
            "",
            "LOCK = threading.RLock()",
            *(("NODE = None",) if self.ros == 2 else ()),
            "",
            "def passed(function):",
            "    def wrapped(*args, **kwargs):",
            "        return function(*args, **kwargs)",
            "    return wrapped",
            "",
            "def self_free(given):",
            '    return "_" + given[:1]',
            "",
        ]
        for kind in ("str", "list", "dict", "int"):
            name = self.new("G")
            self.lines.append(f"{name} = {self.literal(kind)}")
            top.add(kind, name)
        self.lines.append("")
        classes: list[str] = []
        for _ in range(self.random.randint(1, 5)):
            self._function(top)
        if self.chance(0.6):
            self._callback(top)
        if self.chance(0.7):
            classes.append(self._class(top, None))
            if self.chance(0.6):
                classes.append(self._class(top, classes[0]))
        scope = top.inner(depth=0)
        body = self.block(scope, "    ", self.random.randint(2, 6))
        for one in classes:
            if self.chance(0.8):
                body.append(f"    made = {one}({self.of('str', scope)})")
                for _ in range(self.random.randint(0, 2)):
                    body.append(f"    made.{self.pick('step', 'more')}({self.of('str', scope)})")
                if self.chance(0.4):
                    name = self.pick(
                        "made.whole",
                        "made.plain(G1)",
                        f"{one}.plain(G1)",
                        f'{one}.named("x")',
                        'getattr(made, "p_str")',
                        "made.shared",
                    )
                    body.append("    " + CALLS[self.ros]["publishers"].format(name, "String", 1))
                if self.chance(0.2):
                    body += [
                        f'    setattr(made, "p_str", {self.of("str", scope)})',
                        "    " + CALLS[self.ros]["publishers"].format("made.p_str", "Bool", 1),
                    ]
                if self.chance(0.2):
                    body.append(f'    getattr(made, "{self.pick("step", "more")}")({self.of("str", scope)})')
        main = ["def main():", *BEGIN[self.ros], *body, SPIN[self.ros], ""]
        self.lines += [*main, 'if __name__ == "__main__":', "    main()", ""]
        return "\n".join(self.lines)


def run(text: str, seed: int) -> Run:
    """Run a program of ours with something in rospy's place."""
    made: list[tuple[str, str, str, int | None]] = []
    callbacks: list[Callable[[Any], Any]] = []
    steps, spun = 0, False

    def watch(frame: Any, event: str, argument: Any) -> Any:
        nonlocal steps
        steps += 1
        if steps > STEPS:
            raise Stop
        return watch

    def publisher(name: str, kind: Any, queue_size: int | None = None) -> None:
        made.append(("publishers", name, kind, queue_size))

    def subscriber(name: str, kind: Any, callback: Any) -> None:
        made.append(("subscribers", name, kind, None))
        if callback is not print:
            callbacks.append(callback)

    def spin() -> None:
        nonlocal spun
        spun = True
        for _ in range(3):
            for callback in list(callbacks):
                callback(None)

    rospy = SimpleNamespace(Publisher=publisher, Subscriber=subscriber, init_node=lambda name: None, spin=spin)
    rospy.Duration, rospy.Timer = float, lambda period, callback: callbacks.append(callback)
    node = SimpleNamespace(
        create_publisher=lambda kind, name, depth: publisher(name, kind, depth),
        create_subscription=lambda kind, name, callback, depth: subscriber(name, kind, callback),
        create_timer=lambda period, callback: callbacks.append(lambda _: callback()),
    )
    rclpy = SimpleNamespace(init=lambda: None, create_node=lambda name: node, spin=lambda node: spin())
    own = re.sub(
        r"^(import rospy|import rclpy|from rclpy.*|from std_msgs.*|import random)$", "", text, flags=re.MULTILINE
    )
    names: dict[str, Any] = {
        "rospy": rospy,
        "rclpy": rclpy,
        "random": random.Random(seed),
        "__name__": "__main__",
        **{t: t for t in TYPES},
    }
    before = sys.gettrace()
    try:
        code = compile(own, "generated", "exec")
        sys.settrace(watch)
        exec(code, names)
    except Stop:
        return Run(made, "steps")
    except Exception as error:
        return Run(made, f"{type(error).__name__}: {error}")
    finally:
        sys.settrace(before)
    return Run(made, "" if spun else "it does not spin")


def judge(text: str, runs: Sequence[Run], ros: int = 1) -> tuple[list[str], Counter[str]]:
    """Where the model of a program disagrees with its runs, and counts."""
    return compare(follow(python_files(text), ros), runs, INTERFACES[ros])


def main(seed: int, count: int, show: bool, ros: int) -> int:
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    report = Report(show)
    for number in range(seed, seed + count):
        text = Program(number, ros).text
        runs = [run(text, k) for k in range(RUNS)]
        report.add(number, runs, *judge(text, runs, ros))
    return report.end()


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), int(sys.argv[2]), "--show" in sys.argv, 2 if "--ros2" in sys.argv else 1))
