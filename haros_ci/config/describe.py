# SPDX-License-Identifier: Apache-2.0
"""The effective settings as text, with where each value comes from."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence

from haros_ci.config.settings import LinterSettings, Policy, Settings

DEFAULT = "default"


def describe(settings: Settings) -> str:
    """The settings in the words of a project file, a line each, and whence; foreign text is quoted and escaped."""
    lines = [f"# project file: {_quoted(settings.project_file) if settings.project_file else 'none'}"]
    lines.extend(_values(settings))
    lines.extend(_policy("", settings.policy))
    if settings.per_path:
        lines.append("per-path:")
        for entry in settings.per_path:
            lines.append(f"  {_quoted(', '.join(entry.globs))}:")
            if entry.profile:
                lines.append(f"    profile: {entry.profile}")
            lines.extend(_policy("    ", entry.policy))
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
    yield line("plugins", settings.plugins)
    yield from (line(key, names) for key, names in _model(settings.project))
    yield f"trust-config: {_shown(settings.trust_config)}"
    if settings.linters:
        yield f"linters:  # {_quoted(origins.get('linters', origins.get('plugin_blacklist', DEFAULT)))[1:-1]}"
        yield from (f"  {_key(tool)}: {_linter(linter)}" for tool, linter in settings.linters)


def _model(project: Mapping[str, object]) -> Iterator[tuple[str, tuple[str, ...]]]:
    """What the architecture is made with: the names in each key that is there."""
    for key in ("configurations", "nodes", "known_nodes"):
        value = project.get(key)
        if isinstance(value, Mapping) and value:
            yield key, tuple(str(name) for name in value)
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


def _linter(linter: LinterSettings) -> str:
    values = {"enabled": linter.enabled, "timeout": linter.timeout, "arguments": linter.arguments or None}
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
