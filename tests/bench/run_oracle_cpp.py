# SPDX-License-Identifier: Apache-2.0
"""Whether the model of generated programs in C++ is what they do when they run.

    python -m tests.bench.run_oracle_cpp SEED COUNT [--show]

As ``run_oracle.py`` for Python, which says what the kinds of disagreement are: programs of roscpp, compiled by g++ against a stand-in for
it (``run_cpp.py``). What ``chance()`` returns differs from run to run, and no source says it.

Not generated, as real programs hardly have it or as it has no one meaning: what reads and writes the same in one expression, references
and iterators of containers that change meanwhile, constant references to what changes meanwhile (the model has them as copies), macros, operators of own classes, inheritance from several classes, coroutines, threads.
"""

from __future__ import annotations

import random
import sys
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from tests.bench.run_cpp import compiler
from tests.bench.run_judge import Report, Run, compare
from tests.link.follow_kit import cpp_files, follow

#: Programs in one translation unit.
BATCH = 40
WORDS = "arm base cam drive eye fork gear hub imu jaw".split()
KEYS = "left right top low".split()
TYPES = ("String", "Bool", "Int32", "Empty")
HEAD = """\
#include <ros/ros.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Empty.h>
#include <std_msgs/Int32.h>
#include <std_msgs/String.h>
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <numeric>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

extern "C" bool chance();

std::vector<ros::Publisher> pubs;
std::vector<ros::Subscriber> subs;
"""
#: Functions as programs have them, each of which some use.
HELPERS = {
    "upper": """\
std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), ::toupper);
  return text;
}""",
    "joined": """\
std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += between;
    text += words[i];
  }
  return text;
}""",
    "replaced": """\
std::string replaced(std::string text, const std::string& what, const std::string& by) {
  size_t at = text.find(what);
  if (at != std::string::npos) text.replace(at, what.size(), by);
  return text;
}""",
    "sorted": """\
std::vector<std::string> sorted(std::vector<std::string> words) {
  std::sort(words.begin(), words.end());
  return words;
}""",
    "keys": """\
std::vector<std::string> keys(const std::map<std::string, std::string>& map) {
  std::vector<std::string> found;
  for (const auto& item : map) found.push_back(item.first);
  return found;
}""",
    "split": """\
std::vector<std::string> split(const std::string& text, char by) {
  std::vector<std::string> found;
  std::stringstream stream(text);
  std::string item;
  while (std::getline(stream, item, by)) found.push_back(item);
  return found;
}""",
    "show": """\
template <typename T>
std::string show(const T& value) {
  std::ostringstream out;
  out << value;
  return out.str();
}""",
    "has": """\
template <class T>
bool has(const std::vector<T>& items, const T& item) {
  return std::find(items.begin(), items.end(), item) != items.end();
}""",
    "Box": """\
template <typename T>
class Box {
 public:
  explicit Box(T value) : value_(value) {}
  T get() const { return value_; }
  void set(const T& value) { value_ = value; }
 private:
  T value_;
};""",
    "Kind": """\
enum class Kind { Near, Far, Wide };
std::string word(Kind kind) {
  switch (kind) {
    case Kind::Near: return "near";
    case Kind::Far: return "far";
    default: break;
  }
  return "wide";
}""",
    "announce": """\
template <typename M>
void announce(ros::NodeHandle& handle, const std::string& name, int queue = 1) {
  pubs.push_back(handle.advertise<M>(name, queue));
}""",
    "Talker": """\
template <class M>
class Talker {
 public:
  Talker(ros::NodeHandle handle, const std::string& name) : name_(name), handle_(handle) {
    pub_ = handle_.advertise<M>(name_ + "/out", 3);
  }
  void add(const std::string& more) { others_[more] = handle_.template advertise<M>(name_ + "/" + more, 3); }
  std::string name() const { return name_; }
 private:
  std::string name_;
  ros::NodeHandle handle_;
  ros::Publisher pub_;
  std::map<std::string, ros::Publisher> others_;
};""",
    "Item": """\
struct Item {
  std::string name;
  int size = 2;
};
std::string shown(const Item& item) { return item.name + std::to_string(item.size); }
Item larger(Item item) {
  item.size += 1;
  item.name += "_l";
  return item;
}""",
    "Trouble": """\
class Trouble : public std::runtime_error {
 public:
  explicit Trouble(const std::string& what) : std::runtime_error("t_" + what) {}
};""",
    "nested": """\
void nested(ros::NodeHandle& handle, const std::string& name, int depth) {
  if (depth <= 0 || depth > 4) return;
  pubs.push_back(handle.advertise<std_msgs::Int32>(name, depth));
  nested(handle, name + "/d", depth - 1);
}""",
    "tail": """\
namespace tools {
constexpr int kFew = 2;
const std::string kPrefix = "pre";
inline std::string tail(const std::string& text, int from = 1) {
  return text.size() > static_cast<size_t>(from) ? text.substr(from) : text;
}
}""",
}
TYPE = {
    "str": "std::string",
    "int": "int",
    "bool": "bool",
    "list": "std::vector<std::string>",
    "map": "std::map<std::string, std::string>",
    "pair": "std::pair<std::string, std::string>",
    "opt": "std::optional<std::string>",
}


def is_shared(value: str) -> bool:
    """Whether an expression is a variable of the program or of an object, which a function that is given it may change."""
    return value.isidentifier() and (value.startswith(("G", "shared")) or "_" in value)


@dataclass
class Scope:
    """What may be named where a statement stands, by type; *fixed* may not be changed."""

    names: dict[str, list[str]] = field(default_factory=dict)
    fixed: set[str] = field(default_factory=set)
    handle: str = "nh"
    depth: int = 0
    in_loop: bool = False
    in_switch: bool = False
    returns: str | None = None
    #: Whether names of the program may be changed here.
    is_free: bool = True
    this: str | None = None
    #: Whether the variables here are there until the end of the program.
    lasts: bool = False

    def inner(self, **changes: Any) -> Scope:
        given = {name: getattr(self, name) for name in ("handle", "in_loop", "in_switch", "returns", "is_free", "this")}
        names = {kind: list(names) for kind, names in self.names.items()}
        return Scope(names, set(self.fixed), **{**given, "depth": self.depth + 1, **changes})

    def add(self, kind: str, name: str, is_fixed: bool = False) -> None:
        self.names.setdefault(kind, []).append(name)
        if is_fixed:
            self.fixed.add(name)

    def changeable(self, kind: str) -> list[str]:
        found = [n for n in self.names.get(kind, []) if n not in self.fixed]
        return [n for n in found if self.is_free or not n.startswith(("G", "shared"))]


@dataclass
class Function:
    name: str
    #: Each by its kind, with ``&`` for what it may change.
    parameters: tuple[str, ...]
    kind: str | None
    takes_handle: bool
    #: How many may be left out.
    defaults: int = 0


class Program:
    """One generated program, as text."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.count = 0
        self.lines: list[str] = []
        self.functions: list[Function] = []
        self.callbacks: list[tuple[str, str]] = []
        self.classes: list[str] = []
        #: Of each class the kinds of its constructor's parameters, and its base.
        self.bases: dict[str, str | None] = {}
        self.used: set[str] = set()
        self.text = self._program()

    def new(self, prefix: str) -> str:
        self.count += 1
        return f"{prefix}{self.count}"

    def pick(self, *options: Any) -> Any:
        return self.random.choice(options)

    def chance(self, share: float) -> bool:
        return self.random.random() < share

    def use(self, helper: str) -> str:
        self.used.add(helper)
        return helper

    # -- expressions

    def of(self, kind: str, scope: Scope, depth: int = 0) -> str:
        """An expression of that type."""
        known = scope.names.get(kind, [])
        if known and self.chance(0.55):
            return str(self.random.choice(known))
        if depth > 2 or self.chance(0.25):
            return self.literal(kind)
        ways: dict[str, list[Callable[[Scope, int], str]]] = {
            "str": [self._join, self._join, self._format, self._text, self._choice, self._of_list, self._of_map,
                    self._call_str, self._call_str, self._other_text],
            "int": [self._sum, self._size, self._count, self._call_int],
            "bool": [self._compare, self._compare, self._chance, self._in, self._both],
            "list": [self._list, self._list, self._keys, self._call_list],
            "map": [self._map],
            "pair": [self._pair],
            "opt": [self._optional],
        }  # fmt: skip
        return self.random.choice(ways[kind])(scope, depth + 1)

    def literal(self, kind: str) -> str:
        match kind:
            case "str":
                return f'std::string("{self.random.choice(WORDS)}")'
            case "int":
                return str(self.random.randint(0, 4))
            case "bool":
                return str(self.pick("true", "false"))
            case "list":
                return TYPE["list"] + self._braces(self.random.randint(1, 3))
            case "map":
                keys = self.random.sample(KEYS, self.random.randint(1, 3))
                return TYPE["map"] + "{" + ", ".join(f'{{"{k}", "{self.random.choice(WORDS)}"}}' for k in keys) + "}"
            case "pair":
                return f'std::make_pair(std::string("{self.random.choice(WORDS)}"), std::string("{self.random.choice(WORDS)}"))'
            case _:
                return f'std::optional<std::string>("{self.random.choice(WORDS)}")'

    def _braces(self, size: int) -> str:
        return "{" + ", ".join(f'"{w}"' for w in self.random.sample(WORDS, size)) + "}"

    def short(self, scope: Scope) -> str:
        """A text where a literal needs no type."""
        return f'"{self.random.choice(WORDS)}"' if self.chance(0.3) else self.of("str", scope)

    def copied(self, scope: Scope) -> str:
        """A text that is given to what may change the variable that it is of."""
        value = self.short(scope)
        return value if value.startswith(('"', "(", "std::string(")) else f"std::string({value})"

    def _join(self, scope: Scope, depth: int) -> str:
        between = self.pick(' + "/" + ', ' + "_" + ', " + ")
        one, two = self.of("str", scope, depth), self.of("str", scope, depth)
        return str(self.pick(f"({one}{between}{two})", f'("{self.random.choice(WORDS)}_" + {two})', f'({one} + "_x")'))

    def _format(self, scope: Scope, depth: int) -> str:
        one, two = self.of("str", scope, depth), self.of("int", scope, depth)
        return str(
            self.pick(
                f"({one} + std::to_string({two}))",
                f'("n" + std::to_string({two}))',
                f"({one} + {self.use('show')}({two}))",
            )
        )

    def _text(self, scope: Scope, depth: int) -> str:
        one = self.of("str", scope, depth)
        return str(
            self.pick(
                f"{one}.substr({self.random.randint(0, 2)})",
                f"{one}.substr(0, 2)",
                f"{one}.substr(1, 2)",
                f"{self.use('upper')}({one})",
                f'{self.use("replaced")}({one}, "a", "oo")',
                f'{self.use("joined")}({self.of("list", scope, depth)}, "_")',
                f"std::min({one}, {self.of('str', scope, depth)})",
                f"{one}.c_str()" if False else f"std::string({one}.c_str())",
                f"std::string({one}, 1)",
                f"std::string({one}.begin(), {one}.begin() + 1)" if one.isidentifier() else one,
                f"std::string({self.of('int', scope, 3)}, 'z')",
            )
        )

    def _other_text(self, scope: Scope, depth: int) -> str:
        one = self.of("str", scope, depth)
        return str(
            self.pick(
                f"{self.of('opt', scope, depth)}.value_or({one})",
                f"{self.of('pair', scope, depth)}.{self.pick('first', 'second')}",
                f"[&]() {{ return {one}; }}()",
                f"[&](const std::string& t) {{ return t + {one}; }}({self.of('str', scope, depth)})",
                f"{self.use('Box')}<std::string>({one}).get()",
                f"{'word' if self.use('Kind') else ''}(Kind::{self.pick('Near', 'Far', 'Wide')})",
                f"tools::{self.use('tail')}({one})",
                f"tools::tail({one}, {self.of('int', scope, 3)})" if self.use("tail") else "",
                "tools::kPrefix" if self.use("tail") else "",
            )
        )

    def _choice(self, scope: Scope, depth: int) -> str:
        return f"({self.of('bool', scope, depth)} ? {self.of('str', scope, depth)} : {self.of('str', scope, depth)})"

    def _of_list(self, scope: Scope, depth: int) -> str:
        one = self.of("list", scope, depth)
        ways = [f"{one}.at(0)", f"{one}.front()", f"{one}.back()", f"{one}[0]", f"{self.use('sorted')}({one})[0]"]
        if one.isidentifier():
            ways += [
                f"{one}[{one}.size() - 1]",
                f"(*std::max_element({one}.begin(), {one}.end()))",
                f"(*{one}.begin())",
            ]
        return str(self.random.choice(ways))

    def _of_map(self, scope: Scope, depth: int) -> str:
        one, key = self.of("map", scope, depth), self.random.choice(KEYS)
        ways = [f'{one}.at("{key}")', f"{one}.begin()->second"]
        if one.isidentifier():
            ways += [f'({one}.count("{key}") ? {one}.at("{key}") : {self.of("str", scope, depth)})'] * 2
            ways += [f'({one}.find("{key}") != {one}.end() ? {one}.find("{key}")->second : std::string("no"))']
        return str(self.random.choice(ways))

    def _call_str(self, scope: Scope, depth: int) -> str:
        return self._call("str", scope, depth) or self.literal("str")

    def _call_int(self, scope: Scope, depth: int) -> str:
        return self._call("int", scope, depth) or self.literal("int")

    def _call_list(self, scope: Scope, depth: int) -> str:
        return self._call("list", scope, depth) or self.literal("list")

    def _call(self, kind: str | None, scope: Scope, depth: int) -> str:
        found = [f for f in self.functions if f.kind == kind and (scope.handle or not f.takes_handle)]
        if not found:
            return ""
        function = self.random.choice(found)
        given = [scope.handle] if function.takes_handle else []
        for number, one in enumerate(function.parameters):
            if number >= len(function.parameters) - function.defaults and self.chance(0.5):
                break
            if not one.endswith("&"):
                value = self.of(one, scope, depth + 1)
                given.append(f"{TYPE[one]}({value})" if is_shared(value) else value)
                continue
            names = [n for n in scope.changeable(one[:-1]) if n.isidentifier() and not n.startswith(("G", "shared"))]
            if not names:
                return ""
            given.append(self.random.choice(names))
        return f"{function.name}({', '.join(given)})"

    def _sum(self, scope: Scope, depth: int) -> str:
        one, two = self.of("int", scope, depth), self.of("int", scope, depth)
        return str(
            self.pick(
                f"({one} {self.pick('+', '*', '-')} {two})",
                f"({one} % 3)",
                f"({one} / 2)",
                f"std::{self.pick('max', 'min')}({one}, {two})",
                f"({self.of('bool', scope, depth)} ? {one} : {two})",
                "tools::kFew" if self.chance(0.3) and self.use("tail") else one,
            )
        )

    def _size(self, scope: Scope, depth: int) -> str:
        return f"static_cast<int>({self.of(self.pick('list', 'str', 'map'), scope, depth)}.size())"

    def _count(self, scope: Scope, depth: int) -> str:
        ways = ["(chance() ? 1 : 0)", f"static_cast<int>({self.of('bool', scope, depth)})"]
        ways += ['std::stoi("3")', f"static_cast<int>({self.of('str', scope, depth)}.length())"]
        names = [n for n in scope.names.get("list", []) if n.isidentifier()]
        if names:
            name = self.random.choice(names)
            ways += [f'static_cast<int>(std::count({name}.begin(), {name}.end(), "{self.random.choice(WORDS)}"))']
        return str(self.random.choice(ways))

    def _compare(self, scope: Scope, depth: int) -> str:
        one, two = self.of("str", scope, depth), self.of("int", scope, depth)
        return str(
            self.pick(
                f"({one} {self.pick('==', '!=')} {self.of('str', scope, depth)})",
                f'({one} == "{self.random.choice(WORDS)}")',
                f"({two} {self.pick('<', '>', '==', '!=', '<=', '>=')} {self.of('int', scope, depth)})",
                f'({one}.find("{self.random.choice("abcdefi")}") {self.pick("==", "!=")} std::string::npos)',
                f'({one}.find("{self.random.choice("abcdefi")}") == 0)',
                f"{self.of(self.pick('list', 'str', 'map'), scope, depth)}.empty()",
                f"({one}[0] == '{self.random.choice('abcdefghij')}')",
                f'({one}.compare("{self.random.choice(WORDS)}") == 0)',
            )
        )

    def _chance(self, scope: Scope, depth: int) -> str:
        return "chance()"

    def _in(self, scope: Scope, depth: int) -> str:
        word = self.random.choice(WORDS)
        return str(
            self.pick(
                f'{self.use("has")}<std::string>({self.of("list", scope, depth)}, "{word}")',
                f'({self.of("map", scope, depth)}.count("{self.random.choice(KEYS)}") > 0)',
                f"{self.of('opt', scope, depth)}.has_value()",
            )
        )

    def _both(self, scope: Scope, depth: int) -> str:
        ways = [f"({self.of('bool', scope, depth)} {self.pick('&&', '||')} {self.of('bool', scope, depth)})"] * 2
        ways += [f"!({self.of('bool', scope, depth)})"]
        names = [n for n in scope.names.get("list", []) if n.isidentifier()]
        if names:
            name, test = self.random.choice(names), '[](const std::string& w) { return w > "d"; }'
            ways += [f"std::{self.pick('any_of', 'all_of')}({name}.begin(), {name}.end(), {test})"]
        return str(self.random.choice(ways))

    def _list(self, scope: Scope, depth: int) -> str:
        one, two = self.of("str", scope, depth), self.of("list", scope, depth)
        return str(
            self.pick(
                f"std::vector<std::string>{{{one}, {self.of('str', scope, depth)}}}",
                f"{self.use('sorted')}({two})",
                f"std::vector<std::string>({self.of('int', scope, 3)}, {one})",
                f"({self.of('bool', scope, depth)} ? {two} : {self.of('list', scope, depth)})",
            )
        )

    def _keys(self, scope: Scope, depth: int) -> str:
        return str(
            self.pick(
                f"{self.use('keys')}({self.of('map', scope, depth)})",
                f"{self.use('split')}({self.of('str', scope, depth)}, '{self.pick('_', '/', 'a')}')",
            )
        )

    def _map(self, scope: Scope, depth: int) -> str:
        return f'std::map<std::string, std::string>{{{{"{self.random.choice(KEYS)}", {self.of("str", scope, depth)}}}}}'

    def _pair(self, scope: Scope, depth: int) -> str:
        return f"std::pair<std::string, std::string>({self.of('str', scope, depth)}, {self.of('str', scope, depth)})"

    def _optional(self, scope: Scope, depth: int) -> str:
        one = self.of("str", scope, depth)
        return str(
            self.pick(
                f"std::make_optional({one})",
                "std::optional<std::string>()",
                f"({self.of('bool', scope, depth)} ? std::optional<std::string>({one}) : std::nullopt)",
            )
        )

    # -- statements

    def block(self, scope: Scope, indent: str, size: int) -> list[str]:
        found: list[str] = []
        for _ in range(size):
            found += self.statement(scope, indent)
        return found

    def statement(self, scope: Scope, indent: str) -> list[str]:
        ways = [self._make] * 6 + [self._declare] * 4 + [self._change] * 4
        if scope.depth < 3:
            ways += [self._if] * 3 + [self._for] * 4 + [self._while, self._try, self._switch, self._lambda, self._block]
        ways += [self._plain_call] * 2 + [self._leave, self._stream, self._pointer, self._of_template, self._snippet]
        if scope.depth < 3:
            ways += [self._items, self._lambda_value, self._drained, self._table, self._throwing, self._objects]
        if self.classes and scope.depth < 3 and not scope.this:
            ways += [self._object]
        return self.random.choice(ways)(scope, indent)

    def make(self, scope: Scope, can_keep: bool = True) -> str:
        """A call that makes something, as a statement."""
        name, size, type_ = self.short(scope), self.random.randint(1, 9), self.pick(*TYPES)
        if self.chance(0.6) or not can_keep:
            call = f"{scope.handle}.advertise<std_msgs::{type_}>({name}, {size})"
            return str(
                self.pick(
                    f"pubs.push_back({call});",
                    f"ros::Publisher {self.new('pub')} = {call};",
                    f"auto {self.new('pub')} = {call};",
                    f"pubs.emplace_back({call});",
                )
            )
        ways = ["[](const std_msgs::{0}::ConstPtr&) {{}}"]
        callback, type_ = self.pick(
            *[(f"&{c}" if self.chance(0.3) else c, t) for c, t in self.callbacks], (ways[0], type_)
        )
        if callback == ways[0]:
            call = f"{scope.handle}.subscribe<std_msgs::{type_}>({name}, {size}, {callback.format(type_)})"
        elif self.chance(0.2):
            call = f"{scope.handle}.subscribe<std_msgs::{type_}>({name}, {size}, boost::bind({callback}, _1))"
        else:
            call = f"{scope.handle}.subscribe{self.pick('', f'<std_msgs::{type_}>')}({name}, {size}, {callback})"
        if scope.this and self.chance(0.4):
            call = f"{scope.handle}.subscribe({name}, {size}, &{scope.this}::heard, this)"
            if self.chance(0.3):
                call = f"{scope.handle}.subscribe<std_msgs::Bool>({name}, {size}, boost::bind(&{scope.this}::heard, this, _1))"
        return str(self.pick(f"subs.push_back({call});", f"ros::Subscriber {self.new('sub')} = {call};"))

    def _make(self, scope: Scope, indent: str) -> list[str]:
        return [f"{indent}{self.make(scope)}"]

    def _declare(self, scope: Scope, indent: str) -> list[str]:
        kind = self.pick("str", "str", "str", "int", "bool", "list", "list", "map", "pair", "opt")
        name, value = self.new("v"), self.of(kind, scope)
        way = self.random.randint(0, 9)
        if way == 0:
            scope.add(kind, name, True)
            return [f"{indent}const {TYPE[kind]} {name} = {value};"]
        if way == 1:
            scope.add(kind, name)
            return [f"{indent}auto {name} = {value};"]
        if way == 2 and kind in ("list", "map"):
            scope.add(kind, name)
            one = self._braces(2) if kind == "list" else f'{{{{"{self.random.choice(KEYS)}", {self.short(scope)}}}}}'
            return [f"{indent}{TYPE[kind]} {name}{self.pick('', ' = ')}{one};"]
        names = [n for n in scope.changeable("str") if n.isidentifier()]
        if way == 3 and kind == "str" and names:
            known = self.random.choice(names)
            is_fixed = self.chance(0.4)
            scope.add("str", name, is_fixed or known.startswith(("G", "shared")))
            return [f"{indent}{'const ' if is_fixed else ''}{self.pick('auto', 'std::string')}& {name} = {known};"]
        if way == 4 and kind == "pair":
            other = self.new("v")
            scope.add("str", name)
            scope.add("str", other)
            return [f"{indent}auto [{name}, {other}] = {value};"]
        if way == 5 and kind == "str":
            scope.add("str", name)
            return [f"{indent}std::string {name};", f"{indent}{name} = {value};"]
        if way == 6 and value not in ("std::optional<std::string>()",):  # that would declare a function
            scope.add(kind, name)
            return [f"{indent}{TYPE[kind]} {name}({value});"]
        scope.add(kind, name)
        return [f"{indent}{TYPE[kind]} {name} = {value};"]

    def _change(self, scope: Scope, indent: str) -> list[str]:
        for kind in self.random.sample(tuple(TYPE), 7):
            names = scope.changeable(kind)
            if not names:
                continue
            name = self.random.choice(names)
            word, key = self.of("str", scope), self.random.choice(KEYS)
            ways = {
                "list": [
                    f"{name}.push_back({word});",
                    f"{name}.push_back({word});",
                    f"{name}.emplace_back({word});",
                    f"{name}.insert({name}.begin(), {word});",
                    f"if (!{name}.empty()) {name}[0] = {word};",
                    f"if (!{name}.empty()) {name}.pop_back();",
                    f"if (!{name}.empty()) {name}.erase({name}.begin());",
                    f"std::sort({name}.begin(), {name}.end());",
                    f"std::reverse({name}.begin(), {name}.end());",
                    f'for (auto& w : {name}) w += "{self.pick("x", "_y")}";',
                    f"{name}.clear();",
                    f"{name} = {self.of('list', scope)};",
                    f"{name}.resize(2, {word});",
                    f'{name}.erase(std::remove({name}.begin(), {name}.end(), "{self.random.choice(WORDS)}"), {name}.end());',
                    f"std::transform({name}.begin(), {name}.end(), {name}.begin(), [&](const std::string& w) {{ return w + {word}; }});",
                ],
                "map": [
                    f'{name}["{key}"] = {word};',
                    f'{name}["{key}"] = {word};',
                    f'{name}["{key}"] += {word};',
                    f'{name}.insert({{"{key}", {word}}});',
                    f'{name}.insert(std::make_pair("{key}", {word}));',
                    f'{name}.emplace("{key}", {word});',
                    f'{name}.erase("{key}");',
                    f'for (auto& [k, v] : {name}) v += "x";',
                    f'for (auto& item : {name}) item.second = {word};',
                    f'{name} = {self.of("map", scope)};',
                ],
                "str": [
                    f"{name} += {word};",
                    f"{name} = {word};",
                    f"{name} = {name} + {word};",
                    f"{name}.append({word});",
                    f"{name}.push_back('k');",
                    f"{name}.insert(0, {word});",
                    f"if (!{name}.empty()) {name}.pop_back();",
                    f'{name} = "{self.random.choice(WORDS)}";',
                    f"std::replace({name}.begin(), {name}.end(), 'a', 'e');",
                    f"if (!{name}.empty()) {name}[0] = 'q';",
                    f"{name}.clear();",
                    f"{name}.erase(0, 1);",
                    f"for (char& c : {name}) c = std::toupper(c);",
                    f'{name}.assign("{self.random.choice(WORDS)}");',
                ],
                "int": [f"{name} += {self.of('int', scope, 2)};", f"++{name};", f"{name}--;", f"{name} = {self.of('int', scope)};"],
                "bool": [f"{name} = {self.of('bool', scope)};", f"{name} = !{name};", f"{name} |= {self.of('bool', scope)};"],
                "pair": [f"{name}.first = {word};", f"{name}.second += {word};", f"{name} = {self.of('pair', scope)};",
                         f"std::swap({name}.first, {name}.second);"],
                "opt": [f"{name} = {word};", f"{name}.reset();", f"if ({name}) *{name} += {word};", f"{name} = std::nullopt;"],
            }  # fmt: skip
            other = self.random.choice(names)
            if other != name and self.chance(0.1):
                return [f"{indent}std::swap({name}, {other});"]
            return [indent + self.random.choice(ways[kind])]
        return self._declare(scope, indent)

    def _if(self, scope: Scope, indent: str) -> list[str]:
        inner = scope.inner()
        maps = [n for n in scope.names.get("map", []) if n.isidentifier()]
        options = [n for n in scope.names.get("opt", []) if n.isidentifier()]
        way = self.random.randint(0, 9)
        head = f"if ({self.of('bool', scope)}) {{"
        if way == 0 and maps:
            one, name = self.new("it"), self.random.choice(maps)
            head = f'if (auto {one} = {name}.find("{self.random.choice(KEYS)}"); {one} != {name}.end()) {{'
            inner.add("str", f"{one}->second", True)
            inner.fixed.add(name)
        elif way == 1 and maps:
            one, name = self.new("it"), self.random.choice(maps)
            found = [
                f'{indent}auto {one} = {name}.find("{self.random.choice(KEYS)}");',
                f"{indent}if ({one} != {name}.end()) {{",
            ]
            inner.add("str", f"{one}->second", True)
            inner.fixed.add(name)
            return [*found, *self.block(inner, indent + "  ", self.random.randint(1, 2)), f"{indent}}}"]
        elif way == 2 and options:
            name = self.random.choice(options)
            head = f"if ({name}) {{"
            inner.add("str", f"(*{name})", True)
            inner.add("str", f"{name}.value()", True)
            inner.fixed.add(name)
        if self.chance(0.12):
            return [f"{indent}{head[:-2]}", f"{indent}  {self.make(inner)}"]
        found = [indent + head]
        found += self.block(inner, indent + "  ", self.random.randint(1, 3))
        if self.chance(0.3):
            found.append(f"{indent}}} else if ({self.of('bool', scope)}) {{")
            found += self.block(scope.inner(), indent + "  ", self.random.randint(1, 2))
        if self.chance(0.5):
            found.append(f"{indent}}} else {{")
            found += self.block(scope.inner(), indent + "  ", self.random.randint(1, 2))
        return [*found, f"{indent}}}"]

    def _over(self, kind: str, scope: Scope, inner: Scope) -> tuple[list[str], str]:
        """A container that nothing changes meanwhile, with what stands before the loop."""
        value = self.of(kind, scope)
        if value.isidentifier() and not value.startswith(("G", "shared")) and "_" not in value:
            inner.fixed.add(value)
            return [], value
        if "(" not in value.replace("std::string(", "") and value.startswith("std::") and self.chance(0.6):
            return [], value
        name = self.new("v")
        scope.add(kind, name, True)
        inner.add(kind, name, True)
        return [f"const {TYPE[kind]} {name} = {value};"], name

    def _for(self, scope: Scope, indent: str) -> list[str]:
        inner = scope.inner(in_loop=True, in_switch=False)
        one, two = self.new("i"), self.new("i")
        before: list[str] = []
        way = self.random.randint(0, 7)
        if way <= 1:
            before, over = self._over("list", scope, inner)
            form = self.pick(
                "const auto&", "const std::string&", "auto", "std::string", "auto&&" if over.isidentifier() else "auto"
            )
            head = f"for ({form} {one} : {over}) {{"
            inner.add("str", one, "const" in form or "&" in form)
        elif way == 2:
            before, over = self._over("map", scope, inner)
            head = f"for (const auto& [{one}, {two}] : {over}) {{"
            inner.add("str", one, True)
            inner.add("str", two, True)
        elif way == 3:
            before, over = self._over("map", scope, inner)
            head = f"for (const auto& {one} : {over}) {{"
            inner.add("str", f"{one}.first", True)
            inner.add("str", f"{one}.second", True)
        elif way == 4:
            bound = self.of("int", scope, 2)
            if not bound.isdigit():
                limit = self.new("v")
                before = [f"const int {limit} = {bound};"]
                bound = limit
            head = f"for (int {one} = 0; {one} < {bound}; {self.pick('++' + one, one + '++')}) {{"
            inner.add("int", one, True)
        elif way == 5:
            before, over = self._over("list", scope, inner)
            if over.startswith("std::"):
                before, over = [f"const {TYPE['list']} {two} = {over};"], two
            head = f"for ({self.pick('size_t', 'unsigned int')} {one} = 0; {one} < {over}.size(); {one}++) {{"
            inner.add("str", f"{over}[{one}]", True)
            inner.add("str", f"{over}.at({one})", True)
        elif way == 6:
            kind = self.pick("list", "map")
            before, over = self._over(kind, scope, inner)
            if over.startswith("std::"):
                before, over = [f"const {TYPE[kind]} {two} = {over};"], two
            head = f"for (auto {one} = {over}.begin(); {one} != {over}.end(); ++{one}) {{"
            for text in (f"(*{one})",) if kind == "list" else (f"{one}->first", f"{one}->second"):
                inner.add("str", text, True)
        else:
            words = self._braces(3)
            head = (
                f"for (const std::string {one} : {words}) {{"
                if self.chance(0.5)
                else f"for (const char* {two} : {words}) {{"
            )
            inner.add("str", one if "const std::string" in head else f"std::string({two})", True)
        found = [*(indent + line for line in before), indent + head]
        return [*found, *self.block(inner, indent + "  ", self.random.randint(1, 3)), f"{indent}}}"]

    def _while(self, scope: Scope, indent: str) -> list[str]:
        name = self.new("c")
        inner = scope.inner(in_loop=True, in_switch=False)
        start, end = self.random.randint(0, 2), self.random.randint(1, 4)
        body = self.block(inner, indent + "  ", self.random.randint(1, 2))
        first = f"{indent}int {name} = {start};"
        # No continue may pass over the counter.
        if self.chance(0.4):
            return [first, f"{indent}do {{", f"{indent}  {name}++;", *body, f"{indent}}} while ({name} < {end});"]
        return [first, f"{indent}while ({name} < {end}) {{", f"{indent}  ++{name};", *body, f"{indent}}}"]

    def _switch(self, scope: Scope, indent: str) -> list[str]:
        found = [f"{indent}switch ({self.of('int', scope)}) {{"]
        labels = [f"case {n}:" for n in self.random.sample(range(4), self.random.randint(1, 3))]
        if self.chance(0.6):
            labels.append("default:")
        for label in labels:
            found.append(f"{indent}  {label} {{")
            inner = scope.inner(in_switch=True)
            found += self.block(inner, indent + "    ", self.random.randint(1, 2))
            found += [f"{indent}  }}"] if self.chance(0.25) else [f"{indent}    break;", f"{indent}  }}"]
        return [*found, f"{indent}}}"]

    def _try(self, scope: Scope, indent: str) -> list[str]:
        found = [f"{indent}try {{"]
        inner = scope.inner()
        found += self.block(inner, indent + "  ", self.random.randint(1, 2))
        if self.chance(0.4):
            word = self.random.choice(WORDS)
            found += [
                self.pick(
                    f'{indent}  throw std::runtime_error("{word}");',
                    f'{indent}  if ({self.of("bool", inner)}) throw std::runtime_error("{word}");',
                    f"{indent}  std::vector<std::string>().at(2);",
                    f"{indent}  throw std::invalid_argument({self.of('str', inner)});",
                )
            ]
        what = self.pick("const std::exception& e", "const std::exception& e", "...", "std::runtime_error& e")
        found.append(f"{indent}}} catch ({what}) {{")
        inner = scope.inner()
        if what == "std::runtime_error& e":
            inner.add("str", "std::string(e.what())", True)
        found += self.block(inner, indent + "  ", 1)
        return [*found, f"{indent}}}"]

    def _block(self, scope: Scope, indent: str) -> list[str]:
        return [f"{indent}{{", *self.block(scope.inner(), indent + "  ", self.random.randint(1, 2)), f"{indent}}}"]

    def _lambda(self, scope: Scope, indent: str) -> list[str]:
        """A lambda that uses what is around it, called at once or for the elements of a container."""
        name, parameter = self.new("f"), self.new("a")
        inner = scope.inner(in_loop=False, in_switch=False, returns="")
        for kind in ("list", "map", "pair", "opt"):
            inner.fixed |= set(inner.names.get(kind, []))
        inner.add("str", parameter, True)
        body = [f"{indent}  if ({self.of('bool', inner)}) return;"] if self.chance(0.3) else []
        body += self.block(inner, indent + "  ", self.random.randint(1, 2))
        head = f"[&](const std::string& {parameter}) {{"
        if self.chance(0.25):
            before, over = self._over("list", scope, inner)
            if over.startswith("std::"):
                words = self.new("v")
                before, over = [f"const {TYPE['list']} {words} = {over};"], words
            lines = [indent + line for line in before]
            return [*lines, f"{indent}std::for_each({over}.begin(), {over}.end(), {head}", *body, f"{indent}}});"]
        form = self.pick("auto", "auto", "std::function<void(const std::string&)>")
        calls = [f"{indent}{name}({self.copied(scope)});" for _ in range(self.random.randint(1, 2))]
        if self.chance(0.2):
            bound = self.new("f")
            calls.append(f"{indent}auto {bound} = std::bind({name}, {self.of('str', scope)});")
            calls.append(f"{indent}{bound}();")
        return [f"{indent}{form} {name} = {head}", *body, f"{indent}}};", *calls]

    def _stream(self, scope: Scope, indent: str) -> list[str]:
        name = self.new("out")
        parts = [self.of(self.pick("str", "int", "str"), scope, 2) for _ in range(self.random.randint(1, 3))]
        found = [f"{indent}std::{self.pick('ostringstream', 'stringstream')} {name};"]
        found.append(f"{indent}{name} << " + ' << "_" << '.join(parts) + ";")
        if self.chance(0.3):
            found.append(f"{indent}{name} << {self.short(scope)};")
        scope.add("str", f"{name}.str()", True)
        return found

    def _pointer(self, scope: Scope, indent: str) -> list[str]:
        names = [n for n in scope.changeable("str") if n.isidentifier() and not n.startswith("G") and "shared" not in n]
        name = self.new("p")
        if names and self.chance(0.6):
            scope.add("str", f"(*{name})")
            return [f"{indent}std::string* {name} = &{self.random.choice(names)};"]
        value = self.short(scope)
        scope.add("str", f"(*{name})")
        return [f"{indent}auto {name} = std::make_{self.pick('unique', 'shared')}<std::string>({value});"]

    def _object(self, scope: Scope, indent: str) -> list[str]:
        """An object that stays until the end."""
        one, name = self.random.choice(self.classes), self.new("o")
        first = self.copied(scope)
        base = self.bases[one] or one
        way = self.random.randint(0, 4)
        found, sign = [f"{indent}{one}* {name} = new {one}({first});"], "->"
        if way == 1:
            found = [f"{indent}{base}* {name} = new {one}({first});"]
        elif scope.lasts and way == 2:
            found, sign = [f"{indent}{one} {name}{self.pick('(({}))', '{{{}}}').format(self.copied(scope))};"], "."
            if self.chance(0.3):
                other = self.new("o")
                found.append(f"{indent}{base}& {other} = {name};")
                name = other
        elif scope.lasts and way == 3:
            found = [f"{indent}std::{self.pick('unique', 'shared')}_ptr<{base}> {name}(new {one}({first}));"]
        elif scope.lasts and way == 4:
            made = self.pick("unique", "shared")
            form = self.pick("auto", f"std::{made}_ptr<{base}>")
            found = [f"{indent}{form} {name} = std::make_{made}<{one}>({first});"]
        for _ in range(self.random.randint(0, 2)):
            found.append(f"{indent}{name}{sign}{self.pick('step', 'more')}({self.copied(scope)});")
        if self.chance(0.5):
            scope.add("str", f"{name}{sign}label()", True)
        if self.chance(0.3):
            scope.add("str", f"{name}{sign}p_str", True)
        return found

    def _of_template(self, scope: Scope, indent: str) -> list[str]:
        type_, name = self.pick(*TYPES), self.short(scope)
        if self.chance(0.4):
            queue = self.pick("", ", 4")
            return [f"{indent}{self.use('announce')}<std_msgs::{type_}>({scope.handle}, {name}{queue});"]
        if self.chance(0.3):
            return [f"{indent}{self.use('nested')}({scope.handle}, {name}, {self.of('int', scope, 2)});"]
        one = self.new("t")
        found = [f"{indent}{self.use('Talker')}<std_msgs::{type_}> {one}({scope.handle}, {name});"]
        if self.chance(0.2):
            found = [f"{indent}auto {one}_ = std::make_shared<Talker<std_msgs::{type_}>>({scope.handle}, {name});"]
            found.append(f"{indent}Talker<std_msgs::{type_}>& {one} = *{one}_;")
        if self.chance(0.5):
            found.append(f"{indent}{one}.add({self.short(scope)});")
        scope.add("str", f"{one}.name()", True)
        return found

    def _snippet(self, scope: Scope, indent: str) -> list[str]:
        """Ways to a text that take some lines."""
        name, word, number = self.new("x"), self.of("str", scope), self.of("int", scope, 2)
        test = self.of("bool", scope)
        form, kind = self.pick(
            (f"char {name}[64]; snprintf({name}, sizeof({name}), \"%s_%d\", \"{self.random.choice(WORDS)}\", {number});", f"std::string({name})"),
            (f"char {name} = 'a'; {name} += 1;", f"std::string(2, {name})"),
            (f"std::string {name} = {word}; if ({name}.size() > 2) {name}.resize(2);", name),
            (f"std::string {name} = {word}; {name} = {name}.substr({name}.rfind('_') + 1);", name),
            (f"std::string {name} = {word}; if ({name}.find('a') != std::string::npos) {name}.erase({name}.find('a'), 1);", name),
            (f"std::set<std::string> {name}{self._braces(3)}; {name}.insert({word});", f"(*{name}.begin())"),
            (f"std::array<std::string, 2> {name}{{{{{word}, \"b\"}}}}; {name}[1] += {name}[0];", f"{name}[1]"),
            (f"const char* {name}[] = {self._braces(3)};", f"std::string({name}[{self.random.randint(0, 2)}])"),
            (f"auto {name} = std::make_tuple({word}, {number});", f"std::get<0>({name})"),
            (f"std::string {name}; int {name}n; std::tie({name}, {name}n) = std::make_tuple({word}, {number});", name),
            (f"std::string {name} = {test} ? \"yes\" : \"no\";", name),
            (f"std::string {name}; if ({test}) {name} = \"one\"; else {name} = {word};", name),
            (f"const std::string {name} = [&] {{ if ({test}) return std::string(\"in\"); return {word}; }}();", name),
            (f"int {name}i = 0; for (int k = 0; k < 3; ++k) {{ if (k == 1) continue; {name}i += k; }} std::string {name} = \"s\" + std::to_string({name}i);", name),
            (f"std::string {name} = {word}; for (auto& c : {name}) if (c == 'a') c = 'u';", name),
            (f"std::string {name}; for (int k = 0, m = 3; k < m; k++, m--) {name} += \"k\" + std::to_string(m);", name),
            (f"std::string {name} = std::accumulate({name}w.begin(), {name}w.end(), std::string(\"w\"));", name),
        )  # fmt: skip
        lines = [form]
        if "accumulate" in form:
            lines.insert(0, f"const std::vector<std::string> {name}w = {self.of('list', scope)};")
        scope.add("str", kind, not kind.isidentifier() or form.startswith("const"))
        return [indent + line for line in lines]

    def _items(self, scope: Scope, indent: str) -> list[str]:
        """A list of structures, and a loop over it."""
        self.use("Item")
        name, one = self.new("m"), self.new("i")
        pairs = ", ".join(
            f"{{{self.short(scope)}, {self.random.randint(0, 3)}}}" for _ in range(self.random.randint(1, 3))
        )
        found = [f"{indent}std::vector<Item> {name} = {{{pairs}}};"]
        if self.chance(0.3):
            found.append(f"{indent}for (auto& item : {name}) item.name += {self.of('str', scope)};")
        if self.chance(0.3):
            found.append(
                f"{indent}std::sort({name}.begin(), {name}.end(), [](const Item& a, const Item& b) {{ return a.name < b.name; }});"
            )
        if self.chance(0.2):
            found.append(f"{indent}{name}.push_back(larger({name}.back()));")
        if self.chance(0.2):
            found.append(f"{indent}{name}.push_back(Item{{{self.of('str', scope)}}});")
        inner = scope.inner(in_loop=True, in_switch=False)
        form = self.pick("const auto&", "auto", "const Item&")
        inner.add("str", f"{one}.name", True)
        inner.add("str", f"shown({one})", True)
        inner.add("int", f"{one}.size", True)
        scope.add("str", f"{name}[0].name", True)
        return [
            *found,
            f"{indent}for ({form} {one} : {name}) {{",
            *self.block(inner, indent + "  ", self.random.randint(1, 2)),
            f"{indent}}}",
        ]

    def _lambda_value(self, scope: Scope, indent: str) -> list[str]:
        """A lambda that gives a text, by value or reference, or one that keeps count."""
        name, parameter = self.new("f"), self.new("a")
        inner = scope.inner(in_loop=False, in_switch=False, returns="str", is_free=False)
        inner.fixed |= {n for names in inner.names.values() for n in names}
        inner.add("str", parameter, True)
        way = self.random.randint(0, 3)
        if way == 0:
            capture, start = self.new("n"), self.of("str", scope)
            inner.add("str", capture, True)
            head = f"[&, {capture} = {start}](const std::string& {parameter}) -> std::string {{"
        elif way == 1:
            count = self.new("n")
            scope.add("str", f'{name}("z")', True)
            return [f"{indent}int {count} = 0;", f"{indent}auto {name} = [{count}](const std::string& t) mutable {{ {count} += 2; return t + std::to_string({count}); }};",
                    f'{indent}const std::string {count}s = {name}({self.of("str", inner) if False else self.literal("str")});']  # fmt: skip
        else:
            head = f"[{self.pick('&', '&')}](const std::string& {parameter}) -> std::string {{"
        body = self.block(inner, indent + "  ", self.random.randint(0, 2))
        body.append(f"{indent}  return {self.of('str', inner)};")
        form = self.pick("auto", "auto", "std::function<std::string(const std::string&)>")
        found = [f"{indent}{form} {name} = {head}", *body, f"{indent}}};"]
        scope.add("str", f"{name}({self.literal('str')})", True)
        return found

    def _drained(self, scope: Scope, indent: str) -> list[str]:
        """A list that is gone through until it is empty, or an endless loop that is left."""
        name, one = self.new("v"), self.new("w")
        found = [f"{indent}std::vector<std::string> {name} = {self.of('list', scope)};"]
        inner = scope.inner(in_loop=True, in_switch=False)
        inner.add("str", one)
        if self.chance(0.3):
            found += [f"{indent}size_t {one}n = 0;", f"{indent}while (true) {{", f"{indent}  if ({one}n >= {name}.size()) break;",
                      f"{indent}  const std::string {one} = {name}[{one}n++];"]  # fmt: skip
            inner.fixed.add(one)
        elif self.chance(0.5):
            found += [
                f"{indent}while (!{name}.empty()) {{",
                f"{indent}  std::string {one} = {name}.back();",
                f"{indent}  {name}.pop_back();",
            ]
        else:
            found += [
                f"{indent}for (; !{name}.empty();) {{",
                f"{indent}  std::string {one} = {name}.front();",
                f"{indent}  {name}.erase({name}.begin());",
            ]
        return [*found, *self.block(inner, indent + "  ", self.random.randint(1, 2)), f"{indent}}}"]

    def _table(self, scope: Scope, indent: str) -> list[str]:
        """Functions in a table."""
        name, parameter = self.new("table"), self.new("a")
        inner = scope.inner(in_loop=False, in_switch=False, returns="")
        for kind in ("list", "map", "pair", "opt"):
            inner.fixed |= set(inner.names.get(kind, []))
        inner.add("str", parameter, True)
        lines = []
        for key in self.random.sample(KEYS, 2):
            text = self.pick(
                f"[&](const std::string& {parameter}) {{ {self.make(inner)} }}",
                f"[&](const std::string& {parameter}) {{ if ({self.of('bool', inner)}) return; {self.make(inner)} }}",
            )
            lines.append((key, text))
        if self.chance(0.4):
            found = [f"{indent}std::vector<std::function<void(const std::string&)>> {name};"]
            found += [f"{indent}{name}.push_back({text});" for _, text in lines]
            return [*found, f"{indent}for (auto& each : {name}) each({self.copied(scope)});"]
        found = [f"{indent}std::map<std::string, std::function<void(const std::string&)>> {name};"]
        found += [f'{indent}{name}["{key}"] = {text};' for key, text in lines]
        if self.chance(0.5):
            return [*found, f"{indent}for (auto& each : {name}) each.second(each.first);"]
        return [*found, f'{indent}{name}["{lines[0][0]}"]({self.copied(scope)});']

    def _throwing(self, scope: Scope, indent: str) -> list[str]:
        """A class of exceptions, thrown again or not."""
        self.use("Trouble")
        inner = scope.inner()
        body = self.block(inner, indent + "  ", 1)
        thrown = f"throw Trouble({self.of('str', inner)});"
        if self.chance(0.5):
            thrown = f"if ({self.of('bool', inner)}) {thrown}"
        handler, again = scope.inner(), scope.inner()
        handler.add("str", "std::string(e.what())", True)
        found = [f"{indent}try {{", *body, f"{indent}  {thrown}", *self.block(inner, indent + "  ", 1)]
        found += [f"{indent}}} catch (const Trouble& e) {{", *self.block(handler, indent + "  ", 1)]
        if self.chance(0.4):
            found += [f"{indent}}} catch (const std::exception& e) {{", *self.block(again, indent + "  ", 1)]
        if self.chance(0.15):
            found.append(f"{indent}  throw;")
        return [*found, f"{indent}}}"]

    def _objects(self, scope: Scope, indent: str) -> list[str]:
        """Objects of several classes by pointers to their base, which stay until the end."""
        bases = [one for one in self.classes if self.bases[one] is None]
        if not bases or scope.this:
            return self._declare(scope, indent)
        name, base = self.new("all"), self.random.choice(bases)
        kin = [one for one in self.classes if one == base or self.bases[one] == base]
        found = [f"{indent}std::vector<{base}*> {name};"]
        for _ in range(self.random.randint(1, 2)):
            found.append(f"{indent}{name}.push_back(new {self.random.choice(kin)}({self.copied(scope)}));")
        if scope.lasts and self.chance(0.6):
            found = [f"{indent}std::vector<std::{self.pick('unique', 'shared')}_ptr<{base}>> {name};"]
            for _ in range(self.random.randint(1, 2)):
                made = f"std::make_{'unique' if 'unique' in found[0] else 'shared'}<{self.random.choice(kin)}>"
                found.append(f"{indent}{name}.{self.pick('push_back', 'emplace_back')}({made}({self.copied(scope)}));")
        found.append(f"{indent}for (auto& each : {name}) each->{self.pick('step', 'more')}({self.copied(scope)});")
        scope.add("str", f"{name}[0]->label()", True)
        return found

    def _plain_call(self, scope: Scope, indent: str) -> list[str]:
        call = self._call(None, scope, 0)
        return [f"{indent}{call};"] if call and scope.is_free else self._declare(scope, indent)

    def _leave(self, scope: Scope, indent: str) -> list[str]:
        test = self.of("bool", scope)
        if scope.in_loop and scope.depth and self.chance(0.6):
            word = self.pick("break", "continue") if not scope.in_switch else "continue"
            return [f"{indent}if ({test}) {word};"]
        if scope.returns is not None and scope.depth:
            value = " 0" if scope.returns == "main" else f" {self.of(scope.returns, scope)}" if scope.returns else ""
            if scope.returns == "main" and not self.chance(0.2):
                return self._declare(scope, indent)
            return [f"{indent}if ({test}) return{value};"]
        if scope.is_free and self.chance(0.2):
            return [f'{indent}if ({test}) throw std::runtime_error("{self.random.choice(WORDS)}");']
        return self._declare(scope, indent)

    # -- definitions

    def _function(self, around: Scope) -> None:
        kind = self.pick("str", "str", "int", "list", None, None, None)
        name = self.new("f")
        kinds = [self.pick("str", "str", "int", "list", "bool", "map") for _ in range(self.random.randint(0, 3))]
        takes_handle = self.chance(0.4)
        handle = self.new("h") if takes_handle else "nh"
        scope = around.inner(depth=1, returns=kind or "", is_free=kind is None, handle=handle)
        parameters = (
            [
                f"{self.pick('ros::NodeHandle&', 'ros::NodeHandle', 'const ros::NodeHandle&') if False else 'ros::NodeHandle&'} {handle}"
            ]
            if takes_handle
            else []
        )
        found: list[str] = []
        defaults, has_out = 0, False
        for number, one in enumerate(kinds):
            parameter = self.new("a")
            if kind is None and not has_out and one in ("str", "list", "map") and self.chance(0.3):
                has_out = True
                scope.add(one, parameter)
                parameters.append(f"{TYPE[one]}& {parameter}")
                found.append(one + "&")
                continue
            is_reference = one not in ("int", "bool") and self.chance(0.6)
            scope.add(one, parameter, is_reference)
            text = f"const {TYPE[one]}& {parameter}" if is_reference else f"{TYPE[one]} {parameter}"
            if one in ("str", "int", "bool") and number == len(kinds) - 1 and self.chance(0.3):
                value = f'"{self.random.choice(WORDS)}"' if one == "str" else self.literal(one)
                text += f" = {value}"
                defaults = 1
            parameters.append(text)
            found.append(one)
        head = f"{TYPE[kind] if kind else 'void'} {name}({', '.join(parameters)})"
        body = (
            []
            if takes_handle
            else [
                self.pick(
                    "  ros::NodeHandle nh;", "  ros::NodeHandle nh;", f'  ros::NodeHandle nh("{self.pick("~", "ns")}");'
                )
            ]
        )
        if kind is None and self.chance(0.2):
            counter = self.new("s")
            body += [f"  static int {counter} = 0;", f"  {counter}++;"]
            scope.add("int", counter, True)
        body += self.block(scope, "  ", self.random.randint(1, 4))
        if kind:
            body.append(f"  return {self.of(kind, scope)};")
        prefix = ""
        if self.chance(0.15):
            space = self.new("ns")
            self.lines += [f"namespace {space} {{", f"{head} {{", *body, "}", "}", ""]
            prefix = f"{space}::"
        elif self.chance(0.1):
            static = f"template <int N>\nstatic {head}"
            self.lines += [f"{static} {{", "  const int size = N;", *body, "}", ""]
            name = f"{name}<{self.random.randint(0, 3)}>"
        else:
            self.lines += [f"{head} {{", *body, "}", ""]
        if self.chance(0.2) and found and found[0] in ("int", "str") and not prefix and "<" not in name:
            # An overload, of another first parameter.
            other = self.new("a")
            scope = around.inner(depth=1, returns=kind or "", is_free=kind is None)
            scope.add("bool", other)
            end = f"  return {self.of(kind, scope)};" if kind else f"  {self.make(scope)}"
            self.lines += [
                f"{TYPE[kind] if kind else 'void'} {name}(const {TYPE['opt']}& {other}) {{".replace(
                    "const std::optional<std::string>&", "bool"
                ),
                "  ros::NodeHandle nh;",
                end,
                "}",
                "",
            ]
            if found[0] == "str" and len(found) == 1:
                self.functions.append(Function(name, ("bool",), kind, False))
        self.functions.append(Function(prefix + name, tuple(found), kind, takes_handle, defaults))

    def _callback(self, around: Scope) -> None:
        name, type_ = self.new("heard"), self.pick("Bool", "String")
        scope = around.inner(depth=2, returns="")
        body = ["  ros::NodeHandle nh;", *self.block(scope, "  ", self.random.randint(1, 3))]
        self.lines += [
            f"void {name}(const std_msgs::{type_}{self.pick('::ConstPtr', 'ConstPtr')}& message) {{",
            *body,
            "}",
            "",
        ]
        self.callbacks.append((name, type_))

    def _class(self, around: Scope, base: str | None) -> str:
        name = self.new("C")
        members = {f"{n}_{k}": k for n in "pq" for k in ("str", "int", "list", "map", "bool")}
        lines = [f"class {name} : public {base} {{" if base else f"class {name} {{", " public:"]
        scope = around.inner(depth=1, this=name, handle="nh_", returns=None)
        scope.add("str", "first", True)
        start = []
        if base:
            start.append(f"{base}({self.copied(scope)})")
        elif self.chance(0.7):
            start += ["p_str(first)", f"q_str({self.of('str', scope)})", f"p_int({self.literal('int')})"]
        colon = " : " + ", ".join(start) if start else ""
        lines.append(f"  {self.pick('explicit ', '')}{name}(const std::string& first){colon} {{")
        own = around.inner(depth=1, this=name, handle="nh_", returns="")
        for target in (scope, own):
            for member, kind in members.items():
                target.add(kind, member)
            target.add("str", "shared_")
            target.names["str"].append("label()")
            target.fixed.add("label()")
        lines += self.block(scope, "    ", self.random.randint(1, 4))
        lines.append("  }")
        if not base:
            lines.append(f"  virtual ~{name}() {{}}")
        constant = own.inner(depth=1, is_free=False, handle="")
        constant.fixed |= {n for names in constant.names.values() for n in names}
        constant.names["str"].remove("label()")
        if not base or self.chance(0.5):
            word = f"{self.pick('virtual ', '') if not base else ''}std::string label() const"
            lines += [
                f"  {word}{' ' if not base else self.pick(' ', ' ')}{{",
                f"    return {self.of('str', constant)};",
                "  }",
            ]
        for method in ("step", "more") if not base else (self.pick("step", "more"),):
            inner = own.inner(depth=1)
            inner.add("str", "given", True)
            word = "virtual " if not base and (method == "step" or self.chance(0.5)) else ""
            over = " override" if base and method == "step" and self.chance(0.6) else ""
            lines.append(f"  {word}void {method}(const std::string& given){over} {{")
            if base and self.chance(0.5):
                lines.append(f"    {base}::{method}({self.copied(inner)});")
            lines += self.block(inner, "    ", self.random.randint(1, 3))
            if method == "step" and self.chance(0.5):
                lines.append(f"    more({self.copied(inner)});")
            lines.append("  }")
        inner = own.inner(depth=2)
        lines.append("  void heard(const std_msgs::Bool::ConstPtr& message) {")
        lines += [*self.block(inner, "    ", self.random.randint(1, 2)), "  }"]
        if not base:
            for member, kind in members.items():
                value = self.literal(kind) if self.chance(0.8) else ""
                if kind in ("int", "bool"):
                    value = self.literal(kind)
                if kind == "str" and value and self.chance(0.5):
                    value = value[len("std::string(") : -1]
                lines.append(f"  {TYPE[kind]} {member}" + (f" = {value};" if value else ";"))
            lines.append("  ros::NodeHandle nh_;" if self.chance(0.8) else '  ros::NodeHandle nh_{"~"};')
            is_inline = self.chance(0.5)
            lines.append(
                f'  inline static std::string shared_ = "{self.random.choice(WORDS)}";'
                if is_inline
                else "  static std::string shared_;"
            )
        lines += ["};", ""]
        if not base and not is_inline:
            lines += [f'std::string {name}::shared_ = "{self.random.choice(WORDS)}";', ""]
        self.lines += lines
        self.classes.append(name)
        self.bases[name] = base
        return name

    def _program(self) -> str:
        top = Scope()
        for kind in ("str", "list", "map", "int"):
            name = self.new("G")
            is_fixed = self.chance(0.3)
            self.lines.append(f"{'const ' if is_fixed else ''}{TYPE[kind]} {name} = {self.literal(kind)};")
            top.add(kind, name, is_fixed)
        self.lines.append("")
        for _ in range(self.random.randint(1, 5)):
            self._function(top)
        if self.chance(0.6):
            self._callback(top)
        if self.chance(0.7):
            base = self._class(top, None)
            for _ in range(self.random.randint(0, 2)):
                self._class(top, base)
        scope = top.inner(depth=0, lasts=True, returns="main")
        body = self.block(scope, "  ", self.random.randint(2, 6))
        for one in self.classes:
            if self.chance(0.7):
                kept, self.classes = self.classes, [one]
                body += self._object(scope, "  ")
                self.classes = kept
        handle = self.pick("  ros::NodeHandle nh;", "  ros::NodeHandle nh;", '  ros::NodeHandle nh("~");')
        main = ["int main(int argc, char** argv) {", '  ros::init(argc, argv, "n");', handle, *body]
        self.lines += [*main, "  ros::spin();", "  return 0;", "}", ""]
        helpers = [text for name, text in HELPERS.items() if name in self.used]
        return "\n".join([HEAD, *helpers, "", *self.lines])


def judge(text: str, runs: list[Run]) -> tuple[list[str], Counter[str]]:
    """Where the model of a program disagrees with its runs, and counts."""
    return compare(follow(cpp_files(text)), runs)


def main(seed: int, count: int, show: bool) -> int:
    report = Report(show)
    with compiler() as run:
        for first in range(seed, seed + count, BATCH):
            texts = {number: Program(number).text for number in range(first, min(first + BATCH, seed + count))}
            found, wrong = run.run(texts)
            report.total["programs that do not compile"] += len(wrong)
            for number, error in wrong.items() if show else ():
                print(f"{number}: {error}", flush=True)
            for number, runs in found.items():
                report.add(number, runs, *judge(texts[number], runs))
    return report.end()


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), int(sys.argv[2]), "--show" in sys.argv))
