# SPDX-License-Identifier: Apache-2.0
"""The effective settings as text, with where each value comes from."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence

from haros_ci.config.settings import Exemption, LinterSettings, LocalPolicy, Policy, Settings
from haros_ci.model.declared_tool import DeclaredTool

DEFAULT = "default"


def describe(settings: Settings) -> str:
    """The settings in the words of a project file, a line each, and whence; foreign text is quoted and escaped."""
    lines = [f"# project file: {_quoted(settings.project_file) if settings.project_file else 'none'}"]
    lines.extend(_values(settings))
    lines.extend(_policy("", settings.policy))
    lines.extend(_local("per-package", [(entry.names, entry) for entry in settings.per_package]))
    lines.extend(_local("per-path", [(entry.globs, entry) for entry in settings.per_path]))
    if settings.exemptions:
        lines.append("exceptions:")
        lines.extend(f"  - {_exemption(entry)}  # {_quoted(entry.origin)[1:-1]}" for entry in settings.exemptions)
    if settings.command_line != Policy():
        lines.append("# on the command line, beating all of the above:")
        lines.extend(_policy("", settings.command_line))
    lines.extend(f"# note: {_quoted(note)[1:-1]}" for note in settings.notes)
    return "\n".join(lines) + "\n"


def _values(settings: Settings) -> Iterator[str]:
    origins = dict(settings.origins)

    def line(key: str, value: object) -> str:
        return f"{key}: {_shown(value)}  # {_quoted(origins.get(key, DEFAULT))[1:-1]}"

    yield line("profile", settings.profile)
    yield line("fail-on", settings.fail_on.value if settings.fail_on else "never")
    yield line("exclude", settings.exclude)
    yield line("packages", settings.packages)
    if settings.ignore_files:
        yield f"ignore-files: {_shown(settings.ignore_files)}  # analysis.ignore.files"
    yield line("max-file-size", settings.max_file_size)
    yield line("compile-database", settings.compile_database)
    yield line("baseline", settings.baseline)
    if settings.baseline_rev:
        yield line("baseline-rev", settings.baseline_rev)
    if settings.without_base:
        yield f"# No baseline: {_quoted(settings.without_base)[1:-1]}"
    yield line("plugins", settings.plugins)
    yield from (line(key, names) for key, names in _model(settings.project))
    if settings.access:
        yield line("access", tuple(f"{rule.verb} {rule.name}" for rule in settings.access))
    yield f"trust-config: {_shown(settings.trust_config)}"
    if settings.linters:
        yield f"linters:  # {_quoted(origins.get('linters', origins.get('plugin_blacklist', DEFAULT)))[1:-1]}"
        declared = {tool.name: tool for tool in settings.declared}
        for name, linter in settings.linters:
            yield f"  {_key(name)}: {_linter(linter, declared.get(name))}"


def _model(project: Mapping[str, object]) -> Iterator[tuple[str, tuple[str, ...]]]:
    """What the architecture is made with: the names in each key that is there."""
    for key in ("configurations", "nodes", "known_nodes"):
        value = project.get(key)
        if isinstance(value, Mapping) and value:
            yield key, tuple(str(name) for name in value)
    files = project.get("environment_files")
    if files:
        yield "environment_files", tuple(map(str, files)) if isinstance(files, (list, tuple)) else (str(files),)
    rows = project.get("apis")
    if isinstance(rows, Sequence) and rows:
        yield "apis", tuple(str(row.get("call", row.get("class"))) for row in rows if isinstance(row, Mapping))


def _policy(indent: str, policy: Policy) -> Iterator[str]:
    if policy.select:
        yield f"{indent}select: {_shown(policy.select)}"
    if policy.ignore:
        yield f"{indent}ignore: {_shown(policy.ignore)}"
    if policy.levels:
        yield f"{indent}levels:"
        yield from (f"{indent}  {_key(name)}: {level.value if level else 'off'}" for name, level in policy.levels)


def _local(key: str, entries: Sequence[tuple[tuple[str, ...], LocalPolicy]]) -> Iterator[str]:
    if entries:
        yield f"{key}:"
    for names, entry in entries:
        yield f"  {_quoted(', '.join(names))}:"
        if entry.profile:
            yield f"    profile: {entry.profile}"
        yield from _policy("    ", entry.policy)


def _exemption(entry: Exemption) -> str:
    values = {key: getattr(entry, key) for key in ("files", "packages", "rules", "message", "reason")}
    return _shown({key: value for key, value in values.items() if value})


def _linter(linter: LinterSettings, tool: DeclaredTool | None) -> str:
    values: dict[str, object] = {
        "enabled": linter.enabled,
        "timeout": linter.timeout,
        "arguments": linter.arguments or None,
    }
    if tool is not None:
        values |= {"exec": tool.argv, "files": tool.files or None, "languages": tool.languages or None}
        values |= {"reads": tool.reads or None, "output": tool.output, "pattern": tool.pattern or None}
        values |= {"fields": dict(tool.fields) or None, "levels": dict(tool.levels) or None}
        values |= {"stream": tool.stream, "exit": tool.exits or "any"}
    return _shown({key: value for key, value in values.items() if value is not None})


def _shown(value: object) -> str:
    """Plain words bare, everything else as JSON, which is YAML, too."""
    if isinstance(value, str):
        return _key(value)
    return json.dumps(value)


def _key(text: str) -> str:
    bare = text.isascii() and text[:1].isalpha() and all(c.isalnum() or c in "-_/." for c in text)
    return (
        text
        if bare and text.lower() not in ("on", "off", "yes", "no", "true", "false", "null", "y", "n")
        else _quoted(text)
    )


def _quoted(text: str) -> str:
    return json.dumps(text)
