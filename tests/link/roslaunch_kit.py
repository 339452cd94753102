# SPDX-License-Identifier: Apache-2.0
"""Small workspaces of launch files in memory, and short views of what they start and set."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from haros_ci.extract.launch.xml import read_launch
from haros_ci.launch.facts.memory import Memo
from haros_ci.launch.ros1.roslaunch import evaluate
from haros_ci.model.launch import Launched, LaunchFile
from haros_ci.model.package import Package, SourceFile
from haros_ci.model.workspace import Workspace

MAIN = "bot/launch/main.launch"


@dataclass(frozen=True)
class Texts:
    texts: Mapping[str, str]

    def text(self, path: str) -> str:
        return self.texts.get(path, "")


def workspace(files: Mapping[str, str], packages: Mapping[str, str] | None = None, ros: int | None = None) -> Workspace:
    """*files* by path; a package per first directory unless *packages*, names to paths, says otherwise."""
    places = packages if packages is not None else {path.split("/")[0]: path.split("/")[0] for path in files}
    made = tuple(Package(name, path, ros=ros) for name, path in sorted(places.items()))

    def package_of(path: str) -> str | None:
        return next((name for name, start in places.items() if path.startswith(start + "/")), None)

    def language(path: str) -> str:
        return "launch" if ".launch" in path else "yaml"

    listed = tuple(SourceFile(path, language(path), 0, "", package_of(path)) for path in sorted(files))
    return Workspace(Path("/nowhere"), made, listed, Texts(files))


def loader(files: Mapping[str, str]) -> Callable[[str], LaunchFile | None]:
    return lambda path: read_launch(files[path]) if path in files else None


def launch(
    body: str,
    files: Mapping[str, str] | None = None,
    *,
    args: Mapping[str, str] | None = None,
    env: Mapping[str, str] | None = None,
) -> Launched:
    """The launch file ``<launch>`` + *body* + ``</launch>`` of package ``bot``, evaluated beside *files*."""
    everything = {MAIN: f"<launch>{body}</launch>", **(files or {})}
    return run([MAIN], everything, args=args, env=env)


def run(
    paths: Sequence[str],
    files: Mapping[str, str],
    *,
    args: Mapping[str, str] | None = None,
    env: Mapping[str, str] | None = None,
    memo: Memo | None = None,
) -> Launched:
    return evaluate(paths, workspace(files), loader(files), args or {}, env or {}, memo=memo)


def values(launched: Launched) -> dict[str, Any]:
    """Parameters by name; of those set more than once a list."""
    found: dict[str, Any] = {}
    for parameter in launched.parameters:
        assert parameter.name not in found
        found[parameter.name] = parameter.value
    return found


def names(launched: Launched) -> list[str]:
    return [node.name for node in launched.nodes]


def messages(launched: Launched) -> list[str]:
    return [f"{problem.path}:{problem.line}: {problem.message}" for problem in launched.problems]


def told(launched: Launched) -> list[str]:
    """Messages without the place in MAIN, which most are on line 1 of."""
    return [message.removeprefix(f"{MAIN}:1: ") for message in messages(launched)]


def node(attributes: str = "", inner: str = "", name: str = "n") -> str:
    return f'<node pkg="p" type="t" name="{name}" {attributes}>{inner}</node>'
