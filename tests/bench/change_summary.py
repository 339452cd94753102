# SPDX-License-Identifier: Apache-2.0
"""Replay a repository's history: what ``haros-ci diff`` says of each commit, beside what its textual diff contains.

    python tests/bench/change_summary.py CLONE OUT [--last 100] [--cache-dir DIR] [--only SHA ...] [--passes 2]

For each commit of the first-parent history of HEAD, oldest first, ``haros-ci diff COMMIT^ COMMIT`` is run as a process and timed; with two
passes the second one has a warm cache. An oracle that shares no code with haros-ci reads the files before and after with regular
expressions and PyYAML and lists candidates: names of parameters, topics, services, interface fields, YAML keys, remappings and launch
arguments that come, go or change. What stands on one side alone is listed in ``OUT/disagreements.md``, for a person to read; the verdicts
are in docs/change-summary.md.
"""

from __future__ import annotations

import argparse
import json
import re
import resource
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import yaml

#: Calls whose first string literal is a name, by what it is the name of.
CALLS = {
    "parameter": r"declare_parameter\w*|declareParameter\w*|declare_or_get_parameter|get_parameter_or|getParam\w*|addParam",
    "topic": r"create_publisher|create_subscription|create_generic_\w+|advertise|message_filters::Subscriber",
    "service": r"create_service|create_client|ServiceClient|SimpleActionServer|ActionServer|ActionClient",
}
TEST = re.compile(r"(^|/)tests?/|(^|/)test_[^/]*$|_tests?\.\w+$")
#: The call, and its arguments up to the end of the statement; the name is the first literal among them.
_STATEMENT = re.compile(rf"\b({'|'.join(CALLS.values())})\b\s*(<[^;()]*>)?\s*\(([^;]{{0,600}}?)(?:;|\n\s*\n)", re.S)
_LITERAL = re.compile(r"[\"']([^\"'\n]*\w[^\"'\n]*)[\"']")
_ARGUMENT = re.compile(r"DeclareLaunchArgument\(\s*[\"']([^\"']+)[\"'](.{0,300}?)\)", re.S)
_REMAP = re.compile(r"\(\s*[\"'](/?[\w/~]+)[\"']\s*,\s*[\"'](/?[\w/~]+)[\"']\s*\)")
_NODE = re.compile(r"\b(?:Node|LifecycleNode|ComposableNode)\(\s*(.{0,500}?)\n\s*\)", re.S)

Fact = tuple[str, str, str]  # kind, name, rest


def git(clone: Path, *arguments: str) -> str:
    done = subprocess.run(["git", "-C", str(clone), *arguments], capture_output=True, check=True)
    return done.stdout.decode("utf-8", "replace")


def before_and_after(clone: Path, commit: str) -> Iterator[tuple[str, str, str, str]]:
    """Paths and texts of the files that *commit* changes, on both sides."""
    fields = git(clone, "diff", "--raw", "-z", "-M", "--no-abbrev", f"{commit}^", commit).split("\0")
    position = 0
    while position + 1 < len(fields):
        meta = fields[position].split()
        old, new = fields[position + 1], fields[position + 1]
        position += 2
        if meta[4][0] in "RC":
            new = fields[position]
            position += 1
        yield old, new, _blob(clone, meta[2]), _blob(clone, meta[3])


def _blob(clone: Path, name: str) -> str:
    if not name.strip("0"):
        return ""
    try:
        return git(clone, "cat-file", "blob", name)
    except subprocess.CalledProcessError:
        return ""


def facts(path: str, text: str) -> Counter[Fact]:
    """What a file says of interfaces, ends and parameters, as far as a text search tells."""
    if path.endswith((".msg", ".srv", ".action")):
        return Counter(
            ("interface", path, " ".join(line.split("#")[0].split()))
            for line in text.splitlines()
            if line.split("#")[0].strip()
        )
    if TEST.search(path):
        return Counter()
    if path.endswith((".yaml", ".yml")):
        return Counter(_values(text))
    if path.endswith((".cpp", ".hpp", ".h", ".py", ".cc")):
        return Counter(_code(path, text))
    return Counter()


def _values(text: str) -> Iterator[Fact]:
    if "ros__parameters" not in text:
        return
    try:
        documents = list(yaml.safe_load_all(text))
    except yaml.YAMLError:
        return
    for document in documents:
        for name, value in _leaves(document, ""):
            yield "value", name, repr(value)


def _leaves(value: Any, prefix: str) -> Iterator[tuple[str, Any]]:
    if isinstance(value, dict):
        for key, item in value.items():
            yield from _leaves(item, f"{prefix}.{key}" if prefix else str(key))
    else:
        yield prefix, value


def _code(path: str, text: str) -> Iterator[Fact]:
    text = (
        re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)
        if not path.endswith(".py")
        else re.sub(r"(?m)^\s*#.*$", "", text)
    )
    for found in _STATEMENT.finditer(text):
        kind = next((kind for kind, names in CALLS.items() if re.fullmatch(names, found[1])), "")
        literal = _LITERAL.search(found[3])
        if literal is not None:
            rest = " ".join(found[3][literal.end() :].split())
            yield kind, literal[1], rest[:120] if kind == "parameter" else ""
    if "launch" in path:
        for found in _ARGUMENT.finditer(text):
            yield "argument", found[1], " ".join(re.sub(r"description=.*", "", found[2], flags=re.S).split())
        for found in _REMAP.finditer(text):
            yield "remap", found[1], found[2]
        for found in _NODE.finditer(text):
            program = re.search(r"(?:executable|plugin)=[\"']([^\"']+)", found[1])
            if program is not None:
                yield "node", program[1], ""


def candidates(clone: Path, commit: str) -> list[dict[str, str]]:
    """What comes and goes by the textual diff of *commit*, per file."""
    found = []
    moved: tuple[Counter[Fact], Counter[Fact]] = (Counter(), Counter())
    files = list(before_and_after(clone, commit))
    for old, new, before, after in files:
        for total, side in zip(moved, (facts(old, before), facts(new, after)), strict=True):
            total.update(side)
    for old, new, before, after in files:
        left, right = facts(old, before), facts(new, after)
        for sign, side in (("-", left - right), ("+", right - left)):
            found += [
                {"sign": sign, "kind": kind, "name": name, "rest": rest, "path": new if after else old}
                for kind, name, rest in sorted(side)
                if moved[0][kind, name, rest] != moved[1][kind, name, rest]  # else it stands in another file now
            ]
    return found


def tail(name: str) -> str:
    return re.split(r"[./:]", name)[-1]


def matches(candidate: dict[str, str], change: dict[str, Any]) -> bool:
    """Whether the change in the summary may be that candidate."""
    kind, what = candidate["kind"], change["what"]
    if kind == "interface":
        stem = Path(candidate["path"]).stem
        return what == "interface" and any(
            name.endswith(f"/{stem}") for name in (*change["names"], *change["old_names"])
        )
    if kind == "node":
        return what == "node" or what == "launch file"
    names = {tail(name) for name in (*change["names"], *change["old_names"])}
    fits = {
        "parameter": ("parameter",),
        "value": ("value",),
        "topic": ("publisher", "subscriber", "QoS"),
        "service": ("service server", "service client", "action server", "action client"),
        "argument": ("launch argument",),
        "remap": ("remapping",),
    }[kind]
    whole = change["aspect"] == "file" and candidate["path"] in (change["names"])
    return what in fits and (tail(candidate["name"]) in names or whole)


def replay(clone: Path, out: Path, commit: str, cache: str) -> dict[str, Any]:
    """One commit: the command's JSON, its time, and where it and the oracle disagree."""
    row: dict[str, Any] = {"commit": commit, "subject": git(clone, "log", "-1", "--format=%s", commit).strip()}
    file = out / f"{commit[:9]}.json"
    command = [
        sys.executable,
        "-m",
        "haros_ci",
        "diff",
        f"{commit}^",
        commit,
        "--format",
        "json",
        "--output",
        str(file),
    ]
    started, spent = time.perf_counter(), _processor_seconds()
    subprocess.run([*command, "--cache-dir", cache], cwd=clone, check=True, stdout=subprocess.DEVNULL)
    row["seconds"] = round(time.perf_counter() - started, 2)
    row["processor_seconds"] = round(_processor_seconds() - spent, 2)
    changes = json.loads((out / f"{commit[:9]}.json").read_text(encoding="utf-8"))["changes"]
    wanted = candidates(clone, commit)
    row["changes"] = len(changes)
    row["candidates"] = len(wanted)
    row["not_said"] = [each for each in wanted if not any(matches(each, change) for change in changes)]
    row["not_in_text"] = [
        {
            key: change[key]
            for key in ("what", "action", "aspect", "names", "before", "after", "head", "base", "programs")
        }
        for change in changes
        if not any(matches(each, change) for each in wanted)
    ]
    return row


def _processor_seconds() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def written(rows: list[dict[str, Any]], out: Path) -> None:
    (out / "rows.json").write_text(json.dumps(rows, indent=1), encoding="utf-8")
    lines = []
    for row in rows:
        if row["not_said"] or row["not_in_text"]:
            lines.append(f"\n## {row['commit'][:9]} {row['subject']} ({row['changes']} said)\n")
            lines += (
                f"- text alone: {e['sign']} {e['kind']} {e['name']} {e['rest'][:80]} [{e['path']}]"
                for e in row["not_said"]
            )
            lines += (
                f"- said alone: {e['what']} {e['action']} {e['aspect'] or ''} {e['names'][:2]} {e['before']} -> {e['after']} "
                f"[{(e['head'] or e['base'] or {}).get('path')}]"
                for e in row["not_in_text"]
            )
    (out / "disagreements.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("clone", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--last", type=int, default=100)
    parser.add_argument("--cache-dir", default="")
    parser.add_argument("--only", nargs="*", default=())
    parser.add_argument("--passes", type=int, default=1)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    commits = git(options.clone, "log", "--first-parent", f"-{options.last}", "--format=%H").split()[::-1]
    if options.only:
        commits = [each for each in commits if each.startswith(tuple(options.only))]
    cache = options.cache_dir or str(options.out / "cache")
    for number in range(options.passes):
        rows = []
        for commit in commits:
            rows.append(replay(options.clone, options.out, commit, cache))
            row = rows[-1]
            print(
                f"{commit[:9]} {row['changes']:4} changes {row['seconds']:6.1f} s ({row['processor_seconds']:.1f} s of processor)  {row['subject'][:60]}",
                flush=True,
            )
        written(rows, options.out)
        seconds = sorted(row["seconds"] for row in rows)
        print(
            f"pass {number + 1}: median {seconds[len(seconds) // 2]} s, longest {seconds[-1]} s; {sum(row['changes'] for row in rows)} changes"
        )


if __name__ == "__main__":
    main()
