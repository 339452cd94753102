# SPDX-License-Identifier: Apache-2.0
"""Images that the YAML files of map_server name (map_server, nav2_map_server: ``image``, ``resolution``, ``origin``), and that are not there."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator

from haros_ci.checking.appearing import is_told_of, may_appear
from haros_ci.checking.project import Project, ProjectPackage
from haros_ci.checking.wording import alternatives
from haros_ci.model.launch_facts import FileUse
from haros_ci.model.location import Location
from haros_ci.model.similar_files import similar_files
from haros_ci.records import dataclass
from haros_ci.regex import regex

_IMAGE = regex(
    r"^image:[ \t]+(?:\"([^\"\n]{1,300})\"|'([^'\n]{1,300})'|([^\s\"'#]{1,300}))[ \t]*(?:#[^\n]*)?\r?$", re.MULTILINE
)
_OTHERS = ("resolution", "origin", "occupied_thresh")
#: Names of files and directories that are for tests, or meant to be wrong.
_ASIDE = regex(r"(?:^|[/_])(?:tests?|testing|invalid\w*|examples?)(?:[/_.]|$)", re.IGNORECASE)
#: What an image's name begins with that is no path below the workspace, or has in it.
_ELSEWHERE = regex(r"^[/~\\]|[$:%{]")
#: What writes maps, or images.
_WRITES = regex(r"map_saver|save_?map|imwrite|\.save\(|write_?pgm|pbstream_to|map_generator", re.IGNORECASE)
_TEXTS = (".py", ".sh", ".bash", ".md", ".rst", ".txt", ".launch", ".xml", ".cpp", ".cc", ".hpp", ".h")
#: Commands of CMake that make no image.
_QUIET = ("install", "find_package", "project")
#: So many files are looked at for what writes maps, and so much of each.
_MOST, _LONGEST = 5_000, 200_000


@dataclass(frozen=True, slots=True)
class LostImage:
    """An image that the map at *location* names, *path* from the root on; *is_used* if a launch file names the map. *advice* is what to write."""

    location: Location
    package: ProjectPackage
    path: str
    advice: str
    is_used: bool


def lost_images(project: Project) -> Iterator[LostImage]:
    """The images of maps in packages that do not exist, that git does not ignore, and that nothing here writes or tells to bring."""
    names = project.workspace.names
    for package in project.packages:
        for name in project.below(package.path):
            if not name.endswith((".yaml", ".yml")) or _ASIDE.search(name):
                continue
            text = project.text(name)
            found = _IMAGE.search(text) if all(re.search(rf"(?m)^{word}:", text) for word in _OTHERS) else None
            image = next((group for group in found.groups() if group), "") if found is not None else ""
            if found is None or not image or _ELSEWHERE.search(image):
                continue
            path = posixpath.normpath(posixpath.join(posixpath.dirname(name), image))
            if path in names or path.startswith("..") or may_appear(package, path, _QUIET) or is_told_of(package, path):
                continue
            if not _is_written(project, posixpath.splitext(posixpath.basename(path))[0]):
                location = Location(name, text.count("\n", 0, found.start()) + 1)
                yield LostImage(location, package, path, _advice(project, name, path), name in _used(project))


def _used(project: Project) -> frozenset[str]:
    """The files that launch files name."""
    return project.sources.once(
        "files that launch files name",
        lambda: frozenset(use.path for system in project.systems for use in system.facts(FileUse) if use.path),
    )


def _is_written(project: Project, stem: str) -> bool:
    """Whether a program, script or page of the workspace has *stem* beside what writes maps or images."""
    word = re.compile(rf"(?<![\w-]){re.escape(stem)}(?![\w-])")
    return any(word.search(text) for text in project.sources.once("what writes maps", lambda: _writers(project)))


def _writers(project: Project) -> tuple[str, ...]:
    paths = [path for path in sorted(project.workspace.names) if path.lower().endswith(_TEXTS)][:_MOST]
    texts = (project.text(path)[:_LONGEST] for path in paths)
    return tuple(text for text in texts if _WRITES.search(text))


def _advice(project: Project, name: str, path: str) -> str:
    """What to write: the image beside the map, whose name counts from there on, or one that is called likewise."""
    folder, base = posixpath.dirname(name), posixpath.basename(path)
    beside = [one for one in project.below(folder or ".") if posixpath.dirname(one) == folder and one != name]
    if f"{folder}/{base}".removeprefix("/") in beside:
        return f"the name counts from the directory of the YAML file on: write {base}"
    stem = posixpath.splitext(base)[0].lower()
    images = [posixpath.basename(one) for one in beside if one.lower().endswith((".pgm", ".png", ".bmp", ".jpg"))]
    near = [one for one in images if posixpath.splitext(one)[0].lower() == stem] or similar_files(base, images)
    meant = alternatives([repr(one) for one in near])
    return f"did you mean {meant}?" if meant else "add the image, or remove the map"
