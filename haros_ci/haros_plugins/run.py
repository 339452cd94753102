# SPDX-License-Identifier: Apache-2.0
"""Plug-ins of HAROS, each in a process of its own: first all analyses, then what processes their data, as HAROS does."""

from __future__ import annotations

import os
import pickle
import sys
from collections.abc import Iterable, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from haros_ci.errors import RunFailure, UserError
from haros_ci.haros_plugins.manifest import HarosPlugin
from haros_ci.linters.conversation import Conversation, Ended
from haros_ci.linters.linter import Command
from haros_ci.linters.process import TimedOut, Unstartable, search_path
from haros_ci.records import dataclass, field
from haros_ci.scratch import scratch_directory
from haros_ci.writing import put_below

#: Violations, values and log messages of one plug-in that are kept.
MOST, MOST_LOGGED = 200_000, 50
#: Bytes of all files that one plug-in exports.
MOST_EXPORTED = 200_000_000

Data = dict[str, Any]
#: Violations or values by the id of what they are about.
ByScope = Mapping[str, Sequence[Data]]


@dataclass(frozen=True, slots=True)
class Scene:
    """What a plug-in is shown: the workspace at *root*, its *model* for the process, the names of *packages* and paths of *files* to analyse."""

    root: Path
    model: tuple[Any, Any, Any]
    packages: tuple[str, ...]
    files: tuple[str, ...]


@dataclass(slots=True)
class PluginOutput:
    """What a plug-in has said. *failures* ended it; what it had said before stays."""

    plugin: HarosPlugin
    violations: list[Data] = field(default_factory=list)
    metrics: list[Data] = field(default_factory=list)
    logged: list[tuple[str, str]] = field(default_factory=list)
    exported: list[str] = field(default_factory=list)
    failures: list[str] = field(default_factory=list)

    def take(self, message: Data) -> None:
        """Handle one message of the process; anything malformed is ignored."""
        kind = message.get("kind")
        if kind == "failed":
            self.failures.append(str(message.get("message")))
        elif kind == "log" and len(self.logged) < MOST_LOGGED:
            self.logged.append(("error" if message.get("level") == "error" else "warning", str(message.get("message"))))
        elif kind == "export" and isinstance(message.get("path"), str):
            self.exported.append(message["path"])
        elif kind == "violation":
            self._keep(self.violations, message)
        elif kind == "metric" and isinstance(message.get("value"), (int, float)):
            self._keep(self.metrics, message)

    def _keep(self, kept: list[Data], message: Data) -> None:
        if len(kept) == MOST:
            self.failures.append(f"said more than {MOST:,} things; the rest is lost")
        if len(kept) <= MOST:
            kept.append(message)


def run(
    plugins: Iterable[HarosPlugin],
    scene: Scene,
    seconds: Mapping[str, float],
    violations: ByScope,
    metrics: ByScope,
    export: Path | None,
) -> tuple[PluginOutput, ...]:
    """What each plug-in says of *scene*, in at most so many *seconds* a phase (by name).

    *violations* and *metrics* are haros-ci's own, which the hooks of processing see beside those of all plug-ins. Files that a plug-in
    exports go into a directory of its name in *export*; None leaves them out.
    """
    outputs: list[PluginOutput] = []
    open_ones: list[tuple[PluginOutput, Conversation, Path]] = []
    with ExitStack() as stack:
        directory = stack.enter_context(scratch_directory("haros-ci-"))
        model = directory / "model"
        model.write_bytes(pickle.dumps(scene.model))
        for plugin in plugins:
            output = PluginOutput(plugin)
            outputs.append(output)
            scratch = directory / plugin.name
            talk = _started(output, scene, model, scratch, seconds[plugin.name], stack)
            if talk is None:
                continue
            if _asked(output, talk, _job(plugin, scene, model)) and _asked(output, talk, {"phase": "analysis"}):
                open_ones.append((output, talk, scratch))
            else:
                talk.__exit__(None, None, None)
                _exported(output, scratch, export)
        reported = _merged([violations, *(_by_scope(output.violations, output.plugin) for output in outputs)])
        values = _merged([metrics, *(_by_scope(output.metrics, output.plugin) for output in outputs)])
        for output, talk, scratch in open_ones:
            if _processes(output.plugin):
                _asked(output, talk, {"phase": "processing", "violations": reported, "metrics": values})
            talk.__exit__(None, None, None)
            _exported(output, scratch, export)
    return tuple(outputs)


def _started(
    output: PluginOutput, scene: Scene, model: Path, scratch: Path, seconds: float, stack: ExitStack
) -> Conversation | None:
    argv = (sys.executable, "-I", "-X", "utf8", str(Path(__file__).with_name("child.py")))
    programs = [os.path.join(sys.prefix, "bin"), *search_path(os.environ, scene.root)]  # tools beside us come first
    command = Command(argv, environment={"PATH": os.pathsep.join(programs)})
    try:
        return stack.enter_context(Conversation(command, root=scene.root, scratch=scratch, seconds=seconds))
    except Unstartable as err:
        output.failures.append(f"could not be started: {err}")
        return None


def _job(plugin: HarosPlugin, scene: Scene, model: Path) -> Data:
    import haros_ci

    rules, metrics = plugin.all_rules(), plugin.all_metrics()
    return {
        "path": list(dict.fromkeys((*sys.path, str(Path(haros_ci.__path__[0]).parent)))),
        "name": plugin.name,
        "home": str(plugin.home),
        "root": str(scene.root),
        "model": str(model),
        "languages": plugin.languages,
        "packages": scene.packages,
        "files": scene.files,
        "rules": [
            {"id": id, "name": rule.summary, "description": rule.help, "tags": list(rule.tags)}
            for id, rule in rules.items()
        ],
        "metrics": [
            {
                "id": id,
                "name": metric.name,
                "scope": metric.scope,
                "description": metric.description,
                "minimum": metric.minimum,
                "maximum": metric.maximum,
            }
            for id, metric in metrics.items()
        ],
    }


def _asked(output: PluginOutput, talk: Conversation, request: Data) -> bool:
    """Whether the plug-in did what was asked of it; what it says meanwhile is taken."""
    before = len(output.failures)
    try:
        for message in talk.ask(request):
            output.take(message)
    except TimedOut:
        output.failures.append(f"was stopped after {talk.seconds:g} s")
    except Ended as err:
        output.failures.append(f"crashed: {err}")
    return len(output.failures) == before


def _processes(plugin: HarosPlugin) -> bool:
    names = ("process_", "pre_process", "post_process", "*")
    return any(hook.startswith(names) for hook in plugin.hooks)


def _by_scope(data: Iterable[Data], plugin: HarosPlugin) -> dict[str, list[Data]]:
    """The data of a plug-in as others see them: their ids are then whole."""
    found: dict[str, list[Data]] = {}
    for item in data:
        seen = {key: item.get(key) for key in ("line", "function", "class", "message", "value")}
        id = str(item.get("rule", item.get("metric")))
        if "rule" in item:
            rule = plugin.rules.get(id)
            seen["rule"] = f"{plugin.name}:{id}" if rule is not None else id
            seen |= {"name": rule.summary if rule else id, "description": rule.help if rule else ""}
            seen["tags"] = list(rule.tags) if rule else []
        else:
            seen["metric"] = f"{plugin.name}:{id}" if id in plugin.metrics else id
        found.setdefault(str(item.get("scope")), []).append(seen)
    return found


def _merged(parts: Iterable[ByScope]) -> dict[str, list[Data]]:
    found: dict[str, list[Data]] = {}
    for part in parts:
        for scope, data in part.items():
            found.setdefault(scope, []).extend(data)
    return found


def _exported(output: PluginOutput, scratch: Path, export: Path | None) -> None:
    """Copy what the plug-in wants kept: plain files of its own directory, up to a limit."""
    if not output.exported:
        return
    if export is None:
        output.logged.append(
            ("warning", f"exported {len(output.exported)} files, which are kept with --plugin-export DIR")
        )
        return
    left = MOST_EXPORTED
    for name in dict.fromkeys(output.exported):
        source = (scratch / name).resolve()
        if not source.is_relative_to(scratch.resolve()) or not source.is_file():
            continue  # as in HAROS, which keeps what is there
        left -= source.stat().st_size
        if left < 0:
            output.logged.append(("warning", f"exported more than {MOST_EXPORTED:,} bytes; the rest is not kept"))
            break
        target = f"{output.plugin.name}/{source.relative_to(scratch.resolve()).as_posix()}"
        try:
            put_below(export, {target: source.read_bytes()})
        except OSError as err:
            output.failures.append(f"{source.name} cannot be exported: {err.strerror}")
        except (RunFailure, UserError) as err:
            output.failures.append(f"{source.name} cannot be exported: {err.message}")
