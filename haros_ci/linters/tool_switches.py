# SPDX-License-Identifier: Apache-2.0
"""How each tool's settings are read for what they switch off: one function for each notation, one set of keys for each tool."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from posixpath import basename
from typing import Any

from haros_ci.linters import (
    bandit,
    clang_format,
    codespell,
    flake8,
    isort,
    pylint_config,
    ruff_config,
    settings_files,
    yaml_settings,
    yamllint,
)
from haros_ci.linters.switches import Keys, Switches, joined, switches
from haros_ci.model.workspace import Workspace

#: pylint counts what is above a limit; these are its own.
PYLINT_LIMITS: dict[str, float | None] = {
    **{
        "max-line-length": 100,
        "max-module-lines": 1000,
        "max-args": 5,
        "max-positional-arguments": 5,
        "max-locals": 15,
    },
    **{"max-returns": 6, "max-branches": 12, "max-statements": 50, "max-parents": 7, "max-attributes": 7},
    **{"max-public-methods": 20, "max-bool-expr": 5, "max-nested-blocks": 5, "docstring-min-length": -1},
    **{"min-similarity-lines": 4},
}
KEYS = {
    "pylint": Keys(
        off=("disable",),
        more=("enable",),
        words=(
            *("ignore", "ignore-patterns", "ignore-paths", "confidence", "ignore-long-lines", "ignored-parents"),
            *("good-names", "good-names-rgxs", "no-docstring-rgx", "dummy-variables-rgx", "ignored-argument-names"),
            *("additional-builtins", "callbacks", "allowed-redefined-builtins", "ignored-modules", "ignored-classes"),
            *("generated-members", "ignored-checks-for-mixins", "mixin-class-rgx", "exclude-protected", "notes-rgx"),
            *("defining-attr-methods", "exclude-too-few-public-methods", "contextmanager-decorators"),
        ),
        flags=("ignore-none", "ignore-on-opaque-inference", "ignore-mixin-members", "allow-wildcard-with-all"),
        limits=PYLINT_LIMITS,
    ),
    "flake8": Keys(
        off=("ignore", "extend-ignore"),
        only=("select",),
        more=("extend-select", "enable-extensions"),
        words=("per-file-ignores", "exclude", "extend-exclude", "builtins", "exclude-from-doctest"),
        stricter=("disable-noqa", "doctests"),
        limits={
            "max-line-length": 79,
            "max-doc-length": None,
            "max-complexity": None,
            "max-cognitive-complexity": None,
        },
    ),
    "ruff": Keys(
        off=("ignore", "extend-ignore"),
        only=("select",),
        more=("extend-select",),
        words=(
            *("exclude", "extend-exclude", "per-file-ignores", "extend-per-file-ignores", "builtins"),
            *("allowed-confusables", "typing-modules", "dummy-variable-rgx"),
        ),
        flags=("force-exclude",),
        stricter=("preview",),
        limits={"line-length": 88, "max-complexity": None, "max-doc-length": None, "max-line-length": None},
        is_all=False,
    ),
    "bandit": Keys(off=("skips",), only=("tests",), words=("exclude", "exclude-dirs")),
    "black": Keys(
        words=("exclude", "extend-exclude", "force-exclude"),
        flags=("skip-string-normalization", "skip-magic-trailing-comma", "skip-source-first-line"),
    ),
    "isort": Keys(
        words=("skip", "extend-skip", "skip-glob", "extend-skip-glob"),
        flags=("only-modified", "no-sections", "ignore-whitespace", "no-inline-sort", "append-only", "only-sections"),
    ),
    "mypy": Keys(
        off=("disable-error-code",),
        more=("enable-error-code",),
        words=("follow-imports", "untyped-calls-exclude", "deprecated-calls-exclude", "always-true", "always-false"),
        flags=(
            *("ignore-errors", "ignore-missing-imports", "allow-untyped-globals", "allow-redefinition"),
            *("implicit-optional", "implicit-reexport", "follow-imports-for-stubs"),
        ),
        stricter=(
            *("strict", "check-untyped-defs", "disallow-any-unimported", "disallow-any-expr", "disallow-any-decorated"),
            *("disallow-any-explicit", "disallow-any-generics", "disallow-subclassing-any", "disallow-untyped-calls"),
            *("disallow-untyped-defs", "disallow-incomplete-defs", "disallow-untyped-decorators", "strict-equality"),
            *("warn-redundant-casts", "warn-unused-ignores", "warn-return-any", "warn-unreachable", "extra-checks"),
        ),
    ),
    "codespell": Keys(
        words=("ignore-words-list", "uri-ignore-words-list", "ignore-regex", "ignore-multiline-regex", "skip", "regex")
    ),
    "vulture": Keys(words=("exclude", "ignore-names", "ignore-decorators"), limits={"min-confidence": 80}),
    "cmake-lint": Keys(
        off=("disabled-codes",),
        limits={
            **{"line-width": 80, "max-branches": 12, "max-arguments": 5, "max-localvars": 15, "max-statements": 50},
            **{"max-conditionals-custom-parser": 2, "max-returns": 6},
        },
    ),
    "hadolint": Keys(
        off=("ignored",), words=("trustedregistries",), stricter=("strict-labels", "disable-ignore-pragma")
    ),
    "yamllint": Keys(
        limits={
            **{"line-length.max": 80, "empty-lines.max": 2, "empty-lines.max-start": 0, "empty-lines.max-end": 0},
            **{f"{kind}.max-spaces-inside": 0 for kind in ("braces", "brackets")},
            **{f"{kind}.max-spaces-inside-empty": -1 for kind in ("braces", "brackets")},
            **{"colons.max-spaces-before": 0, "colons.max-spaces-after": 1, "hyphens.max-spaces-after": 1},
            **{"commas.max-spaces-before": 0, "commas.max-spaces-after": 1},
        }
    ),
    "cpplint": Keys(limits={"linelength": 100}),
    "cmakelint": Keys(limits={"linelength": 140}),
}


def of_sections(tool: str, workspace: Workspace, path: str) -> Switches:
    """Of an INI or TOML file: the tool's own section."""
    return switches(settings_files.read(workspace, path).get(tool, {}), KEYS[tool])


def of_pylint(workspace: Workspace, path: str) -> Switches:
    return switches(pylint_config.inert_options(basename(path), workspace.setting(path)), KEYS["pylint"])


def of_isort(workspace: Workspace, path: str) -> Switches:
    sections = settings_files.read(workspace, path)
    return joined(switches(sections.get(name, {}), KEYS["isort"]) for name in isort.SECTIONS)


def of_bandit(workspace: Workspace, path: str) -> Switches:
    return of_sections(bandit.NAME, workspace, path)


def of_flake8(workspace: Workspace, path: str) -> Switches:
    return of_sections(flake8.NAME, workspace, path)


def of_black(workspace: Workspace, path: str) -> Switches:
    return of_sections("black", workspace, path)


def of_vulture(workspace: Workspace, path: str) -> Switches:
    return of_sections("vulture", workspace, path)


def of_mypy(workspace: Workspace, path: str) -> Switches:
    """The global section, and those of modules, whose options begin with the module's name."""
    sections = settings_files.read(workspace, path)
    parts = [switches(sections.get("mypy", {}), KEYS["mypy"])]
    named = [(name.removeprefix("mypy-"), options) for name, options in sections.items() if name.startswith("mypy-")]
    overrides = sections.get("mypy", {}).get("overrides")
    for entry in overrides if isinstance(overrides, list) else ():
        if isinstance(entry, dict):
            named += ((module, entry) for module in settings_files.words(entry.get("module", [])))
    return joined([*parts, *(switches(options, KEYS["mypy"], f"[{module}] ") for module, options in named)])


def of_codespell(workspace: Workspace, path: str) -> Switches:
    """The section, and the lines of the files that it names."""
    settings = settings_files.read(workspace, path).get("codespell", {})
    found = {
        (key, line) for key in ("ignore-words", "exclude-file") for line in _named_lines(workspace, key, settings, path)
    }
    found |= {("dictionary", name) for name in codespell.lists("dictionary", settings, path)}
    more = frozenset(_named_lines(workspace, "dictionary", settings, path))
    return joined([switches(settings, KEYS["codespell"]), Switches(more=more, words=frozenset(found))])


def _named_lines(workspace: Workspace, key: str, settings: dict[str, object], path: str) -> Iterator[str]:
    for name in codespell.lists(key, settings, path):
        yield from _lines(workspace.setting(name)[: codespell.LIST_SIZE])


def of_ruff(workspace: Workspace, path: str) -> Switches:
    """The whole chain, of which the file that extends counts over the extended one."""
    return joined(switches(_flat(link.options), KEYS["ruff"]) for link in reversed(ruff_config.chain(workspace, path)))


def of_yamllint(workspace: Workspace, path: str) -> Switches:
    """The configuration with all that it refers to in its place; the one for a directory without any is ours."""
    settings: Mapping[str, Any] = yamllint.resolved(workspace, path, []) if path else yamllint.DEFAULT_SETTINGS
    off: set[str] = set()
    limits: dict[str, float] = {}
    words = {("ignore", word) for word in _lines(settings.get("ignore"))}
    for name, options in settings.get("rules", {}).items():
        if options in (False, "disable"):
            off.add(str(name))
        elif isinstance(options, dict):
            words |= {(f"{name}.ignore", word) for word in _lines(options.get("ignore"))}
            words |= {
                (f"{name}.{k}", "true") for k, v in options.items() if k.startswith(("allow", "ignore")) and v is True
            }
            limits |= {f"{name}.{k}": float(v) for k, v in options.items() if k.startswith("max") and _is_number(v)}
    base = settings.get("extends")
    words |= {("extends", str(base))} if base in ("relaxed", "empty") else set()
    words |= {("extends", "nothing")} if base is None else set()
    return Switches(off=frozenset(off), words=frozenset(words), limits=limits)


def of_hadolint(workspace: Workspace, path: str) -> Switches:
    """What is ignored, and what has a lower level than an error."""
    settings = yaml_settings.read(workspace.setting(path))
    override = settings.get("override")
    levels = override if isinstance(override, dict) else {}
    words = {(f"override.{level}", str(rule)) for level in ("info", "style") for rule in levels.get(level) or ()}
    return joined([switches(settings, KEYS["hadolint"]), Switches(words=frozenset(words))])


def of_shellcheck(workspace: Workspace, path: str) -> Switches:
    pairs = re.findall(r"^[ \t]*(disable|enable|shell|extended-analysis)=([\w,.:-]+)", workspace.setting(path), re.M)
    found: dict[str, set[str]] = {}
    for key, value in pairs:
        found.setdefault(key, set()).update(value.split(","))
    words = {(key, word) for key in ("shell", "extended-analysis") for word in found.get(key, ())} - {
        ("extended-analysis", "true")
    }
    return Switches(
        off=frozenset(found.get("disable", ())), more=frozenset(found.get("enable", ())), words=frozenset(words)
    )


def of_cmake_lint(workspace: Workspace, path: str) -> Switches:
    return switches(_flat(yaml_settings.read(workspace.setting(path))), KEYS["cmake-lint"])


def of_cpplint(workspace: Workspace, path: str) -> Switches:
    """One CPPLINT.cfg; lines ``name=value``, where ``filter`` has words with ``-`` and ``+``."""
    return _of_lines(workspace.setting(path), "cpplint", ("exclude_files", "extensions", "headers", "includeorder"))


def of_cmakelint(workspace: Workspace, path: str) -> Switches:
    return _of_lines(workspace.setting(path), "cmakelint", ("spaces",))


def of_clang_format(workspace: Workspace, path: str) -> Switches:
    """A style file; without one clang-format does not run."""
    text = workspace.setting(path)
    if basename(path) == clang_format.IGNORED:
        return Switches(words=frozenset(("a line", line) for line in _lines(text) if not line.startswith("#")))
    found = re.findall(r"^[ \t]*(DisableFormat|SortIncludes|BasedOnStyle)[ \t]*:[ \t]*['\"]?(\w+)", text, re.M)
    silent = {("DisableFormat", "true"), ("SortIncludes", "false"), ("SortIncludes", "Never"), ("BasedOnStyle", "None")}
    return Switches(words=frozenset(pair for pair in found if pair in silent), runs=bool(text.strip()))


def _of_lines(text: str, tool: str, words: tuple[str, ...]) -> Switches:
    off: dict[str, None] = {}
    more: dict[str, None] = {}
    options: dict[str, object] = {}
    named = set()
    for line in text.splitlines():
        name, _, value = (part.strip() for part in line.partition("#")[0].partition("="))
        if name == "filter":
            for word in settings_files.words(value):
                rule = word[1:].strip() or "*"
                if word.startswith("-"):
                    off[rule] = None
                    more.pop(rule, None)
                elif word.startswith("+"):
                    more[rule] = None
                    off.pop(rule, None)
        elif name in words:
            named.add((name, value))
        else:
            options[name] = value
    rest = Switches(off=frozenset(off), more=frozenset(more), words=frozenset(named))
    return joined([switches(options, KEYS[tool]), rest])


def _flat(options: Mapping[str, Any], depth: int = 0) -> dict[str, Any]:
    """The options of all tables in one; those of inner ones count. Tables of globs (``per-file-ignores``) stay."""
    found: dict[str, Any] = {}
    inner: list[Mapping[str, Any]] = []
    for key, value in options.items():
        if isinstance(value, dict) and not key.endswith(("per-file-ignores", "target-version")) and depth < 5:
            inner.append(value)
        else:
            found[key] = value
    for table in inner:
        found |= _flat(table, depth + 1)
    return found


def _lines(value: object) -> list[str]:
    items = value if isinstance(value, list) else str(value or "").splitlines()
    return [line for line in (str(item).strip() for item in items) if line]


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)
