# SPDX-License-Identifier: Apache-2.0
"""How much of a ROS 2 workspace's communication the model does not know, against a text search for the API's names.

    haros-ci model --isolated --format json --output MODEL.json   (in ROOT)
    python tests/bench/unknown_rate.py MODEL.json ROOT [--verbose] [--apis] [--not-endpoints FILE]

The denominator is the call sites that the search finds in production C++ and Python: comments and strings are blanked,
tests and declarations of the API itself left out. A site's name (type, QoS) is unknown if no endpoint of any
configuration that stands at it has a known one, or if none stands there. FILE is a YAML or JSON list of
``{path, line, reason}``: sites that are no endpoints. A wrapper whose own source is in ROOT is counted at the calls
inside it; calls of it that the model does not list are shown as forwarded. A wrapper that has the API's own name is
counted where it is called: what stands inside it, or inside a class that it makes, is forwarded if it is absent.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import sys
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import Any

import yaml

KINDS = ("publishers", "subscribers", "servers", "clients", "action_servers", "action_clients")
TOPICS = ("publishers", "subscribers")
PARAMETERS = ("parameters", "getters", "setters")
POLICIES = ("history", "depth", "reliability", "durability")


@dataclass(frozen=True)
class Api:
    """One name to search for. *form* is call, class (its construction), member (only after ``.`` or ``->``) or template
    (a member with template arguments).

    *kind* is the row of the table that it counts for, *within* a text that the file, and *qualifier* one that the call,
    must have. Only with a *wrapper* may a call be counted inside the wrapper's own source.
    """

    name: str
    kind: str
    form: str = "call"
    language: str = "cpp"
    within: str = ""
    qualifier: str = ""
    wrapper: bool = False


def rows(kind: str, names: str, **options: Any) -> tuple[Api, ...]:
    return tuple(Api(name, kind, **options) for name in names.split())


_IMAGES = r"image_transport|point_cloud_transport"
#: The first row that fits a call counts. A PublishedTimePublisher is not searched for: it makes a topic for each publisher
#: that ``publish_if_subscribed`` is given, and none when it is constructed.
APIS = (
    *rows("action_clients", "create_client", qualifier="rclcpp_action"),
    *rows("action_servers", "create_server", qualifier="rclcpp_action"),
    *rows("action_servers", "create_action_server"),
    *rows("action_clients", "create_action_client"),
    *rows("publishers", "create_publisher create_generic_publisher create_camera_publisher"),
    *rows("subscribers", "create_subscription create_generic_subscription create_camera_subscription"),
    *rows("servers", "create_service create_generic_service"),
    *rows("clients", "create_client create_generic_client"),
    *rows("publishers", "advertise advertiseCamera", form="member", within=_IMAGES),
    *rows("subscribers", "subscribeCamera", form="member", within=_IMAGES),
    *rows("subscribers", "subscribe", form="member", within=_IMAGES + "|message_filters"),
    *rows("subscribers", "TransformListener", form="class", wrapper=True),
    *rows("publishers", "TransformBroadcaster StaticTransformBroadcaster", form="class"),
    *rows("subscribers", "Subscriber", form="class", qualifier="message_filters"),
    *rows("publishers", "Updater", form="class", qualifier="diagnostic_updater"),
    *rows("servers", "InteractiveMarkerServer", form="class"),
    *rows("subscribers", "InterProcessPollingSubscriber", form="class", wrapper=True),
    *rows("publishers", "DiagnosticsInterface", form="class", wrapper=True),
    *rows("publishers", "publish_if_subscribed", form="member"),
    *rows("servers", "LoggerLevelConfigure", form="class", wrapper=True),
    *rows("publishers", "publish", form="template"),
    *rows("publishers", "init_pub", form="member", wrapper=True),
    *rows("subscribers", "init_sub", form="member", wrapper=True),
    *rows("servers", "init_srv", form="member", wrapper=True),
    *rows("clients", "init_cli", form="member", wrapper=True),
    *rows("parameters", "declare_parameter declare_parameters get_parameter get_parameter_or get_parameters"),
    *rows("parameters", "declare_or_get_parameter declare_parameter_if_not_declared get_or_declare_parameter"),
    *rows("publishers", "create_publisher create_lifecycle_publisher", form="member", language="python"),
    *rows("subscribers", "create_subscription", form="member", language="python"),
    *rows("servers", "create_service", form="member", language="python"),
    *rows("clients", "create_client", form="member", language="python"),
    *rows("action_servers", "ActionServer", language="python"),
    *rows("action_clients", "ActionClient", language="python"),
    *rows("subscribers", "Subscriber", language="python", within="message_filters"),
    *rows("subscribers", "TransformListener", language="python"),
    *rows("publishers", "TransformBroadcaster StaticTransformBroadcaster", language="python"),
    *rows("parameters", "declare_parameter declare_parameters get_parameter get_parameter_or", language="python"),
    *rows("parameters", "get_parameters get_parameters_by_prefix", language="python"),
)


@dataclass(frozen=True)
class Site:
    """A call of *api*: from *line*, where the expression begins, to *end*, where it is closed.

    *scope* is the namespace that the call names, or those that the file declares. A *declared* one is the declaration
    of the API itself, its scope the namespace that it stands in.
    """

    path: str
    line: int
    end: int
    api: Api = field(compare=False)
    scope: frozenset[str] = field(default=frozenset(), compare=False)
    declared: bool = False
    #: The line that the body of a declared function ends in, and the classes that it makes.
    body: int = field(default=0, compare=False)
    makes: frozenset[str] = field(default=frozenset(), compare=False)


_CPP = re.compile(
    r'//(?:\\\n|[^\n])*|/\*.*?\*/|R"([^()\\\s"]{0,16})\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|'
    r"(?<!\w)'(?:\\.|[^'\\\n])+'",
    re.S,
)
_PYTHON = re.compile(
    r"#[^\n]*|\"\"\"(?:\\.|.)*?\"\"\"|'''(?:\\.|.)*?'''|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'", re.S
)
_SPACE = re.compile(r"\s*")
_NAMESPACE = re.compile(r"\bnamespace\s+([\w:]+)\s*\{")
_WORD_BEFORE = re.compile(r"\w+$")
_NO_TYPES = {"return", "co_return", "co_await", "co_yield", "throw", "else", "do", "case", "and", "or", "not"}
_PAIRS = {"(": ")", "{": "}", "[": "]"}
_OPENERS = {")": "(", "]": "[", ">": "<"}


def blanked(text: str, language: str) -> str:
    """*text* with comments and the insides of strings as blanks; every other character keeps its place."""

    def blank(found: re.Match[str]) -> str:
        token = found.group()
        hidden = re.sub(r"[^\n]", " ", token)
        return hidden if token[0] in "/#" else '"' + hidden[1:-1] + '"'

    return (_PYTHON if language == "python" else _CPP).sub(blank, text)


def closed(text: str, opening: int) -> int | None:
    """The index after the bracket that closes the one at *opening*; None if none does, or ``<`` is no bracket."""
    angle = text[opening] == "<"
    depth = 0
    stack: list[str] = []
    for index in range(opening, min(len(text), opening + 20_000)):
        char = text[index]
        if char in _PAIRS:
            stack.append(_PAIRS[char])
        elif stack and char == stack[-1]:
            stack.pop()
        elif angle and not stack and char == "<":
            depth += 1
        elif angle and not stack and char == ">" and text[index - 1] != "-":
            depth -= 1
        elif angle and not stack and char in ";)}":
            return None
        if not stack and not depth:
            return index + 1
    return None


def opened(text: str, closing: int) -> int | None:
    """The index of the bracket that the one at *closing* closes."""
    close, open_ = text[closing], _OPENERS[text[closing]]
    depth = 0
    for index in range(closing, max(-1, closing - 5_000), -1):
        if text[index] == close and not (close == ">" and text[index - 1] == "-"):
            depth += 1
        elif text[index] == open_:
            depth -= 1
            if not depth:
                return index
        elif close == ">" and text[index] in ";{}":
            return None
    return None


def beginning(text: str, start: int) -> tuple[int, bool]:
    """Where the expression whose last name is at *start* begins, receiver included, and whether it has a receiver."""
    received = False
    while True:
        end = len(text[:start].rstrip()) if text[max(start - 1, 0) : start].isspace() else start
        word = _WORD_BEFORE.search(text, max(end - 80, 0), end)
        if word and word.group() == "template":
            start = word.start()
            continue
        if text.endswith("::", 0, end):
            end -= 2
        elif text.endswith("->", 0, end):
            end, received = end - 2, True
        elif text.endswith(".", 0, end):
            end, received = end - 1, True
        else:
            return start, received
        while end and text[end - 1].isspace():
            end -= 1
        while end and text[end - 1] in ")]>":
            bracket = opened(text, end - 1)
            if bracket is None:
                return start, received
            end = bracket
            while end and text[end - 1].isspace():
                end -= 1
        word = _WORD_BEFORE.search(text, max(end - 200, 0), end)
        if word and word.group() in _NO_TYPES:
            return start, received
        start = word.start() if word else end


def declares(text: str, start: int) -> bool:
    """Whether a type, or ``def`` or ``class``, stands before the expression at *start*: then it is a declaration."""
    before = text[max(start - 300, 0) : start].rstrip()
    if before.endswith(("->", "&&")):
        return False
    word = _WORD_BEFORE.search(before)
    return word.group() not in _NO_TYPES and not word.group().isdigit() if word else before.endswith((">", "*", "&"))


def past_template(text: str, index: int) -> int:
    """*index* after blanks and, if one stands there, a list of template arguments."""
    index = _SPACE.match(text, index).end()  # type: ignore[union-attr]
    if text[index : index + 1] == "<" and (after := closed(text, index)) is not None:
        index = _SPACE.match(text, after).end()  # type: ignore[union-attr]
    return index


def construction(text: str, start: int, index: int) -> tuple[int, int] | None:
    """Begin and opening bracket if the class whose name is at *start* (*index*: after it) is made here of arguments."""
    begin, _ = beginning(text, start)
    wrapped = False
    while text[index : index + 1] == ">":
        index, wrapped = past_template(text, index + 1), True
    if text[index : index + 1] in ("(", "{"):
        before = text[max(begin - 200, 0) : begin].rstrip()
        made = re.search(r"make_(?:shared|unique)\s*<$", before)
        if wrapped and made:
            return beginning(text, max(begin - 200, 0) + made.start())[0], index
        if re.search(r"\bnew$", before):
            return max(begin - 200, 0) + len(before) - 3, index
        return (begin, index) if not wrapped and re.search(r"[=(,]$|\breturn$", before) else None
    named = re.compile(r"\w+\s*([({])").match(text, index)
    return (begin, named.start(1)) if named and not wrapped else None


def sites(path: str, text: str, language: str) -> Iterator[Site]:
    """The calls in a file, in its order, and the declarations of the API that it holds."""
    apis = [api for api in APIS if api.language == language and (not api.within or re.search(api.within, text))]
    names = re.compile(r"\b(?:" + "|".join(sorted({api.name for api in apis})) + r")\b")
    if not names.search(text):
        return
    code = blanked(text, language)
    spaces = [name.split("::")[-1] for name in _NAMESPACE.findall(code)]
    for found in names.finditer(code):
        for api in (api for api in apis if api.name == found.group()):
            spans = span(code, found.start(), found.end(), api)
            if spans is None:
                continue
            begin, end, declared = spans
            named = re.search(r"(\w+)\s*::\s*$", code[begin : found.start()])
            before = _NAMESPACE.findall(code, 0, found.start())[-1:] if declared else spaces
            scope = frozenset([named.group(1)] if named else [name.split("::")[-1] for name in before])
            line = code.count("\n", 0, begin) + 1
            last = line + code.count("\n", begin, end - 1)
            start, after = body(code, found.end()) if declared and api.form == "call" else (0, 0)
            makes = frozenset(re.findall(r"make_(?:shared|unique)\s*<(?:\s*\w+\s*::)*\s*(\w+)", code[start:after]))
            yield Site(path, line, last, api, scope, declared, code.count("\n", 0, after) + 1 if after else 0, makes)
            break


def body(code: str, index: int) -> tuple[int, int]:
    """Where the body of the function begins and ends whose parameters open after *index*; zeros if it has none."""
    index = past_template(code, index)
    after = closed(code, index) if code[index : index + 1] == "(" else None
    opening = re.compile(r"[^;{}()=]*\{").match(code, after) if after is not None else None
    end = closed(code, opening.end() - 1) if opening is not None else None
    return (opening.end(), end) if opening is not None and end is not None else (0, 0)


def classes(code: str, names: frozenset[str]) -> Iterator[tuple[int, int]]:
    """The first and last lines of those of the classes *names* that *code* defines."""
    for found in re.finditer(r"\b(?:class|struct)\s+(\w+)\s*(?:final\s*)?(?::[^;{}()]*)?\{", code):
        end = closed(code, found.end() - 1) if found.group(1) in names else None
        if end is not None:
            yield code.count("\n", 0, found.start()) + 1, code.count("\n", 0, end) + 1


def inside(root: Path, searched: Iterable[Site]) -> set[tuple[str, int]]:
    """The lines inside wrappers that have an API's own name, and inside the classes that these make."""
    found = {(site.path, line) for site in searched if site.body for line in range(site.line, site.body + 1)}
    names = frozenset(name for site in searched if site.body for name in site.makes)
    for path in sorted({site.path for site in searched if not site.declared}) if names else ():
        code = blanked((root / path).read_text("utf-8", "replace"), "python" if path.endswith(".py") else "cpp")
        found |= {(path, line) for first, last in classes(code, names) for line in range(first, last + 1)}
    return found


def span(code: str, start: int, after: int, api: Api) -> tuple[int, int, bool] | None:
    """Begin and end of the call whose name stands from *start* to *after*, and whether it declares *api*; or None."""
    begin, received = beginning(code, start)
    if api.qualifier not in code[begin:start]:
        return None
    index = past_template(code, after) if api.language == "cpp" else after
    if api.form == "class":
        if re.search(r"\b(?:class|struct)\s*$", code[max(start - 20, 0) : start]):
            return (begin, after, True) if re.match(r"\s*(?:final\s*)?(?:\{|:[^:])", code[after:][:200]) else None
        made = construction(code, start, index)
        if made is None:
            return None
        begin, index = made
    elif code[index : index + 1] != "(":
        return None
    elif not received and (api.form != "call" or declares(code, begin)):
        return begin, after, True
    elif api.form == "template" and code[after : after + 1] != "<":
        return None
    end = closed(code, index)
    if end is None or (api.form != "call" and not code[index + 1 : end - 1].strip()):
        return None
    return begin, end, False


def is_test(path: str) -> bool:
    """Whether a file is a test's by its path."""
    *parents, name = PurePosixPath(path).parts
    stem = name.split(".")[0]
    if re.search(r"^test_|_tests?$|^conftest$|gtest|gmock", stem):
        return True
    return any(re.search(r"^(?:tests?|testing|gtest|gmock|test_.*)$|_tests?$", part) for part in parents)


def production(root: Path) -> Iterator[tuple[str, str, str]]:
    """Path, text and language of each file of *root* that is searched, sorted by path."""
    for place, folders, names in os.walk(root):
        marked = {"COLCON_IGNORE", "AMENT_IGNORE", "CATKIN_IGNORE"} & set(names)
        folders[:] = () if marked else sorted(f for f in folders if f[0] != "." and f not in ("build", "install"))
        for name in () if marked else sorted(names):
            path = Path(place, name).relative_to(root).as_posix()
            suffix = PurePosixPath(name).suffix
            language = {".py": "python", "": "python"}.get(suffix, "cpp")
            if suffix not in ("", ".py", ".cpp", ".cc", ".cxx", ".hpp", ".h", ".hh", ".hxx", ".ipp") or is_test(path):
                continue
            text = Path(place, name).read_text("utf-8", "replace")
            if (suffix or re.match(r"#!.*python", text)) and not re.search(r"#include\s*[<\"]g(?:test|mock)/", text):
                yield path, text, language


def endpoints(model: Mapping[str, Any]) -> dict[tuple[str, str], list[tuple[int, dict[str, Any]]]]:
    """By path and kind: line and endpoint of everything that stands in the source."""
    found: dict[tuple[str, str], list[tuple[int, dict[str, Any]]]] = defaultdict(list)
    for configuration in model["configurations"]:
        for node in configuration["nodes"]:
            for kind in (*KINDS, *PARAMETERS):
                for end in node.get(kind, ()):
                    if (place := end.get("location")) and not end.get("implicit"):
                        row = "parameters" if kind in PARAMETERS else kind
                        found[place["path"], row].append((place["line"], end))
    return found


def standing(site: Site, found: Mapping[tuple[str, str], list[tuple[int, dict[str, Any]]]]) -> list[dict[str, Any]]:
    """The endpoints at *site*: those of its first line, else those of its other lines."""
    there = [(line, end) for line, end in found.get((site.path, site.api.kind), ()) if site.line <= line <= site.end]
    return [end for line, end in there if line == site.line] or [end for _, end in there]


def verdicts(site: Site, ends: Iterable[Mapping[str, Any]]) -> tuple[str, ...]:
    """What is unknown of *site* in every configuration: of absent, name, type, qos."""
    ends = tuple(ends)
    if not ends:
        return ("absent",)
    unknown = []
    if all("?" in end["name"] for end in ends):
        unknown.append("name")
    asked = site.api.kind == "parameters"
    if all(end["type"] is None and (not asked or reason(end, "type")) for end in ends):
        unknown.append("type")
    if site.api.kind in TOPICS and all(
        not end.get("qos") or any(end["qos"].get(p) == "?" for p in POLICIES) for end in ends
    ):
        unknown.append("qos")
    return tuple(unknown)


def forwards(site: Site, own: Iterable[tuple[str, str]]) -> bool:
    """Whether *site* calls a wrapper of *own*: name and namespace of those whose source is in the workspace."""
    return site.api.wrapper and any(
        name == site.api.name and (site.api.form == "member" or space in site.scope) for name, space in own
    )


def reason(end: Mapping[str, Any], about: str) -> str:
    """The model's reason why *about* is unknown of an endpoint, with its place."""
    for unknown in end.get("unknowns", ()):
        if unknown["field"].split(".")[0] == about:
            place = unknown.get("location")
            where = ":".join(str(place[part]) for part in ("path", "line") if place[part]) if place else ""
            return str(unknown["reason"]) + (f" ({where})" if where else "")
    return ""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", type=Path)
    parser.add_argument("root", type=Path)
    parser.add_argument("--verbose", action="store_true", help="each unknown site with the model's reason")
    parser.add_argument("--apis", action="store_true", help="a second table, by language and name of the API")
    parser.add_argument("--not-endpoints", type=Path, help="a list of {path, line, reason}")
    options = parser.parse_args()
    searched = [site for path, text, kind in production(options.root) for site in sites(path, text, kind)]
    own = {(site.api.name, space) for site in searched if site.declared and site.api.wrapper for space in site.scope}
    declared = yaml.safe_load(options.not_endpoints.read_text()) if options.not_endpoints else []
    unused = {(entry["path"], entry["line"]): entry["reason"] for entry in declared}
    excused = dict(unused)
    found = endpoints(json.loads(options.model.read_text()))
    forwarding = inside(options.root, searched)
    by_kind: dict[str, Counter[str]] = {kind: Counter() for kind in (*KINDS, "parameters")}
    by_api: dict[str, Counter[str]] = defaultdict(Counter)
    for site in (site for site in searched if not site.declared):
        ends = standing(site, found)
        unknown = verdicts(site, ends)
        places = {(site.path, line) for line in range(site.line, site.end + 1)} & excused.keys()
        for place in places:
            unused.pop(place, None)
        counts: tuple[str, ...] = ("sites", *unknown)
        if "absent" in unknown and places:
            counts = ("declared",)
        elif "absent" in unknown and (forwards(site, own) or (site.path, site.line) in forwarding):
            counts = ("forwarded",)
        by_kind[site.api.kind].update(counts)
        by_api[f"{site.api.kind}, {site.api.language}: {site.api.name}"].update(counts)
        if options.verbose and unknown and "sites" in counts:
            why = "; ".join(filter(None, (reason(ends[0], about) for about in unknown))) if ends else ""
            print(f"{site.path}:{site.line}: {site.api.name}: {', '.join(unknown)} {why}".rstrip())
    print(table(by_kind))
    if options.apis:
        print("\n" + table(dict(sorted(by_api.items())), sums=False))
    for (path, line), why in sorted(unused.items()):
        print(f"not needed: {path}:{line}: {why}", file=sys.stderr)


def table(counts: Mapping[str, Counter[str]], sums: bool = True) -> str:
    """Markdown. Absent sites are in every rate; QoS is of topics alone, parameters are not in the sum."""
    lines = [
        "| | sites | seen | name ? | type ? | QoS ? | absent | names | types | QoS | declared | forwarded |",
        "|---" * 12 + "|",
    ]
    all_: Counter[str] = Counter()
    topics: Counter[str] = Counter()
    for label, row in counts.items():
        is_topic = label.split(",")[0] in TOPICS
        lines.append(line_of(label, row, row if is_topic else None))
        if label != "parameters":
            all_.update(row)
            topics.update(row if is_topic else {})
    if sums:
        lines.insert(-1 if "parameters" in counts else len(lines), line_of("**all**", all_, topics))
    return "\n".join(lines)


def line_of(label: str, row: Counter[str], topics: Counter[str] | None) -> str:
    def rate(part: str, of: Counter[str]) -> str:
        return f"{(of[part] + of['absent']) / of['sites']:.1%}" if of["sites"] else ""

    qos, qos_rate = (topics["qos"], rate("qos", topics)) if topics else ("", "")
    cells = (label, row["sites"], row["sites"] - row["absent"], row["name"], row["type"], qos, row["absent"])
    rates = (rate("name", row), rate("type", row), qos_rate, row["declared"], row["forwarded"])
    return "| " + " | ".join(map(str, (*cells, *rates))) + " |"


if __name__ == "__main__":
    main()
