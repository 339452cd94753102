# SPDX-License-Identifier: Apache-2.0
"""Runs mypy over the files that stdin names, again without those that stop it, so that one file costs only itself.

Run as a script in isolated mode: ``mypy_worker.py DIRECTORY``, in the workspace's root. The files come in parts, each with
the directory (*home*) that they are relative to and that nothing is looked for above. Writes for each part ``{"home": …}``,
mypy's lines of JSON and a line ``{"file", "line", "gave_up"}`` for each file left out, and last ``{"done": true}``.
"""

from __future__ import annotations

import ast
import configparser
import importlib
import json
import os
import re
import sys
import warnings
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from pathlib import Path

if not __package__:  # run as a script: haros_ci itself, also where it is not installed
    sys.path.append(str(Path(__file__).resolve().parents[2]))

from haros_ci.linters.isolation import is_below, refuse_ways_out

#: Times that mypy is started again, because of a file that Python can read and mypy cannot.
ATTEMPTS = 20
OPTIONS = (
    *("--output=json", "--show-error-end", "--no-error-summary", "--hide-error-context", "--no-pretty"),
    # A directory is a package only with an __init__.py: else the directory ``launch`` of a package would be the module.
    *("--no-namespace-packages", "--no-explicit-package-bases", "--scripts-are-modules", "--no-sqlite-cache"),
)
SYNTAX = "syntax"

Mypy = Callable[[list[str]], tuple[str, str, int]]


def check(
    mypy: Mypy, files: Sequence[str], options: Sequence[str], config: str, own: str, strange: Collection[str] = ()
) -> Iterator[str]:
    """Lines to write for *files*; *config* is the file of the settings, *own* where ours may stand that also leaves
    out what stops mypy ("": nowhere, for settings whose place matters), and modules with a *strange* name.

    Files that share a module name are checked one after another. Raises RuntimeError if mypy fails for another reason
    than a file.
    """
    left_out: dict[str, tuple[int, str]] = {}
    for name in files:
        if (line := unparsable(name)) is not None:
            left_out[name] = (line, SYNTAX)
    rounds = in_rounds([name for name in files if name not in left_out])
    attempts = len(rounds) + ATTEMPTS
    while rounds:
        waiting = rounds.pop(0)
        if not waiting:
            continue
        if not attempts:
            raise RuntimeError("mypy was stopped too often")
        attempts -= 1
        if own:
            write_settings(config, own, left_out, strange)
        stdout, stderr, code = mypy(
            [*OPTIONS, *options, f"--config-file={own or config}", "--", *map(_argument, waiting)]
        )
        if code in (0, 1):
            yield from stdout.splitlines()
            continue
        found = list(blamed(stdout, stderr, waiting))
        if all(name in left_out for name, _, _ in found):  # found again, because of the files beside it
            places = {os.path.dirname(name): why for name, _, why in found}
            found = [(name, 0, places[place]) for name in waiting if (place := os.path.dirname(name)) in places]
        if not found:
            raise RuntimeError((stderr or stdout).strip()[-300:])
        left_out.update((name, (line, why)) for name, line, why in found if name not in left_out)
        rounds.insert(0, [name for name in waiting if name not in left_out])
    for name, (line, why) in left_out.items():
        yield json.dumps({"file": name, "line": line, "gave_up": why})


def _argument(name: str) -> str:
    """*name* as it can be given to mypy, which would read its arguments from a file after an ``@``."""
    return f"./{name}" if name.startswith("@") else name


def unparsable(path: str) -> int | None:
    """The line (0 if unknown) where Python cannot read the file *path*, None if it can."""
    try:
        with open(path, "rb") as stream:
            ast.parse(stream.read())
    except SyntaxError as err:
        return err.lineno or 0
    except (OSError, ValueError, RecursionError, MemoryError):
        return 0
    return None


def blamed(stdout: str, stderr: str, files: Collection[str]) -> Iterator[tuple[str, int, str]]:
    """The files that have stopped mypy, with line and reason: ``syntax``, or mypy's words."""
    for line in stdout.splitlines():
        report = json.loads(line)
        if report["severity"] == "error" and (report["code"] in (SYNTAX, None) or report["line"] < 1):
            yield (
                os.path.normpath(report["file"]),
                max(report["line"], 0),
                SYNTAX if report["code"] == SYNTAX else report["message"],
            )
    for line in stderr.splitlines():
        if match := re.match(r"(.+?): error: (Cannot (?:decode|read) file)", line):
            yield os.path.normpath(match[1]), 0, match[2]
        elif match := re.match(r"(.+?) (?:contains __init__\.py but )?is not a valid Python package name", line):
            inside = (name for name in files if match[1] in name.split("/")[:-1])
            yield from ((name, 0, f"{match[1]} is not a valid name of a package") for name in inside)


def in_rounds(files: Iterable[str]) -> list[list[str]]:
    """*files* in as few lists as possible of which none has two files for the same module, which mypy refuses."""
    rounds: list[list[str]] = []
    count: dict[str, int] = {}
    for name in files:
        module = module_name(name)
        number = count[module] = count.get(module, -1) + 1
        if number == len(rounds):
            rounds.append([])
        rounds[number].append(name)
    return rounds


def module_name(path: str) -> str:
    """What mypy calls the module at *path*: it grows upwards as long as directories have an ``__init__.py``."""
    directory, _, stem = path.removesuffix(".py").rpartition("/")
    parts = [] if stem == "__init__" else [stem]
    while directory and os.path.exists(directory + "/__init__.py"):
        directory, _, name = directory.rpartition("/")
        parts.insert(0, name)
    return ".".join(parts)


def write_settings(config: str, own: str, skipped: Collection[str], strange: Collection[str] = ()) -> None:
    """Writes to *own* what *config* says, and that imports of the files *skipped* are not followed.

    Nor are those of modules with *strange* in their name, whatever *config* says of them.
    """
    parser = configparser.RawConfigParser(strict=False)
    parser.read(config, encoding="utf-8")
    for section in parser.sections() if strange else ():
        if section.startswith("mypy-"):
            parser.remove_option(section, "follow_imports")
            parser.remove_option(section, "follow_imports_for_stubs")
    modules = {name for name in map(module_name, skipped) if all(map(str.isidentifier, name.split(".")))}
    patterns = {pattern for name in strange for pattern in (name, f"{name}.*", f"*.{name}", f"*.{name}.*")}
    for section in (f"mypy-{name}" for name in sorted(modules | patterns)):
        if not parser.has_section(section):
            parser.add_section(section)
        parser.set(section, "follow_imports", "skip")
        parser.set(section, "follow_imports_for_stubs", "True")
    with open(own, "w", encoding="utf-8") as stream:
        parser.write(stream)


def leading_out(root: str) -> set[str]:
    """The names of modules and packages below the current directory that are links to what does not lie in *root*."""
    found: set[str] = set()
    waiting = ["."]
    while waiting:  # os.walk is recursive up to Python 3.11
        directory = waiting.pop()
        try:
            entries = list(os.scandir(directory))
        except OSError:
            continue
        for entry in entries:
            if not entry.is_symlink():
                waiting += [entry.path] if entry.is_dir() and not entry.name.startswith(".") else []
            elif not is_below(os.path.realpath(entry.path), root):
                stem = os.path.splitext(entry.name)[0]
                module = os.path.basename(os.path.abspath(directory)) if stem == "__init__" else stem
                found |= {module} if module.isidentifier() else set()
    return found


def forget_all_but_the_standard_library(cache: str) -> None:
    """Takes modules of the workspace out of mypy's cache: the next of that name is another one."""
    for directory, _, names in os.walk(cache):
        for name in names:
            path = os.path.join(directory, name)
            if re.search(r"\.meta\.\w+$", name):
                with open(path, "rb") as stream:
                    ours = b"/typeshed/" not in stream.read()
                if ours:
                    os.unlink(path)


def main() -> None:
    request = json.load(sys.stdin)
    if sys.argv[1] not in sys.path:
        sys.path.append(sys.argv[1])
    warnings.simplefilter("ignore")  # of the files' syntax
    run: Mypy = importlib.import_module("mypy.api").run

    def mypy(arguments: list[str]) -> tuple[str, str, int]:
        forget_all_but_the_standard_library(request["cache"])
        return run(arguments)

    if request["own"]:
        refuse_ways_out()
    root, options = os.getcwd(), [*request["options"], f"--cache-dir={request['cache']}"]
    for part in request["parts"]:
        os.chdir(os.path.join(root, part["home"]))
        print(json.dumps({"home": part["home"]}))
        strange = leading_out(root) if request["own"] else ()
        for line in check(mypy, part["files"], options, request["config"], request["own"], strange):
            print(line)
    print(json.dumps({"done": True}))


if __name__ == "__main__":
    main()
