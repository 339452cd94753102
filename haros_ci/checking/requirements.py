# SPDX-License-Identifier: Apache-2.0
"""Python distributions of which a package asks pip for a certain version: requirements, setup.py, setup.cfg, pyproject.toml."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import lru_cache

from haros_ci.checking.brought_by_pip import brought
from haros_ci.checking.project import Project, ProjectPackage
from haros_ci.model.location import Location
from haros_ci.model.named_distribution import is_page
from haros_ci.regex import regex

_NAME = r"([A-Za-z0-9][\w.-]{0,100}?)[ \t]{0,9}(?:\[[\w ,.-]{0,200}\])?"
_RULE = r"[ \t]{0,9}\(?(?:===?|[<>~!]=|[<>])[ \t]{0,9}v?\d"
#: A line of requirements.txt or of ``install_requires`` in setup.cfg, and a quoted one in setup.py and pyproject.toml (PEP 508).
_LINE = regex(rf"^[ \t]*{_NAME}{_RULE}", re.MULTILINE)
_QUOTED = regex(rf"""["']{_NAME}{_RULE}""")
#: A dependency as Poetry writes it: ``scipy = "^1.9"``.
_POETRY = regex(
    r"""^([A-Za-z0-9][\w.-]{0,100})[ \t]{0,9}=[ \t]{0,9}(?:\{[^}\n]{0,300}\bversion[ \t]{0,9}=[ \t]{0,9})?["'][\^~<>=!]*[ \t]*\d""",
    re.MULTILINE,
)
_POETRY_PART = regex(r"^\[tool\.poetry\.(?:group\.[\w-]+\.)?dependencies\][ \t]*\n((?:(?!\[).*\n?)*)", re.MULTILINE)
_REQUIREMENTS = regex(r"requirements?(?:[-_.][\w.-]+)?\.(?:txt|in)")
_FILES = ("setup.py", "setup.cfg", "pyproject.toml")
_MAX = 200_000

#: A line of requirements.txt or setup.cfg, whatever its version, and the items of a list in setup.py and pyproject.toml.
_PLAIN = regex(rf"^[ \t]*{_NAME}[ \t]{{0,9}}(?:$|[#;<>=!~(@])", re.MULTILINE)
_ITEM = regex(rf"""["']{_NAME}[ \t]{{0,9}}(?=["';<>=!~(@])""")
_REQUIRES = regex(
    r"(?:\binstall_requires[\"']?[ \t]*[=:]|^dependencies[ \t]*=)\s*[\[(]((?:[^\[\]()]|\[[^\[\]\n]{0,200}\]|\([^()\n]{0,200}\)){0,5000})[\])]",
    re.MULTILINE,
)
_CFG_PART = regex(r"^install_requires[ \t]*=([^\n]*(?:\n(?:[ \t]+[^\n]*)?(?=\n|\Z))*)", re.MULTILINE)
_POETRY_NAME = regex(r"^([A-Za-z0-9][\w.-]{0,100})[ \t]{0,9}=", re.MULTILINE)
_REMARK = regex(r"^[ \t]*#[^\n]*", re.MULTILINE)
#: What installs a file of requirements.
_PIP_INSTALL = regex(r"\bpip[23]?[ \t]+install\b((?:[^\n;&|\\]|\\\n){0,400})")
_REQUIREMENTS_FILE = regex(r"(?:-r|--requirement)[ \t=]{0,9}[\"']?([\w./${}~-]{1,200}\.(?:txt|in))")

#: What ``pip freeze`` lists of a machine with ROS, and no index of packages has unless the file names another one: pip stops there.
_OF_ROS = regex(r"^[ \t]*(?:rclpy|rospy)[ \t]{0,9}===?[ \t]{0,9}\d", re.MULTILINE | re.IGNORECASE)
_INDEX = regex(r"^[ \t]*(?:-i|-f|--(?:extra-)?index-url|--find-links)[ \t=]", re.MULTILINE)

_READMES = ("README.md", "README.rst", "README.txt", "README")
#: A sentence, an item of a list, or a row of a table.
_SENTENCE = regex(r"(?:[^\s.]|\.(?!\s)|[ \t]|\n(?!\s*(?:\n|[-*+|#]|\d+\.))){1,2000}")
_OPTIONAL = regex(
    r"\boptional(?:ly)?\b|\bnot (?:strictly )?(?:required|needed)\b|\bmanaged (?:by|with|through|in|separately)\b|\binstall(?:ed)? (?:separately|by hand|manually)\b",
    re.IGNORECASE,
)
_WORD = regex(r"[A-Za-z][\w-]{1,60}")

#: What pip calls the distribution of a module that has another name (its own page in the package index).
_CALLED = {
    "attr": "attrs",
    "bs4": "beautifulsoup4",
    "can": "python-can",
    "crypto": "pycryptodome",
    "cv2": "opencv-python opencv-python-headless opencv-contrib-python opencv-contrib-python-headless",
    "dateutil": "python-dateutil",
    "dotenv": "python-dotenv",
    "git": "gitpython",
    "google": "protobuf",
    "igraph": "python-igraph",
    "jwt": "pyjwt",
    "magic": "python-magic",
    "opengl": "pyopengl",
    "paho": "paho-mqtt",
    "pil": "pillow",
    "serial": "pyserial",
    "skimage": "scikit-image",
    "sklearn": "scikit-learn",
    "smbus": "smbus2",
    "socketio": "python-socketio",
    "torch": "pytorch",
    "usb": "pyusb",
    "websocket": "websocket-client",
    "yaml": "pyyaml",
    "zmq": "pyzmq",
}


def distributions_of(module: str) -> frozenset[str]:
    """The names that pip may have for what brings *module*, as PEP 503 writes them."""
    return frozenset(normal(part) for part in (module, *_CALLED.get(module.lower(), "").split()))


def normal(name: str) -> str:
    """Names of distributions are equal whatever their case and separators (PEP 503)."""
    return re.sub(r"[-_.]+", "-", name).lower()


def pinned(package: ProjectPackage) -> Mapping[str, Location]:
    """The distributions that files of *package*, or of the folders around it, give a version, each with the first place.

    A name without a version does not count: any version will do, including the system's.
    """
    found: dict[str, Location] = {}
    names = package.project.workspace.names
    folder = "" if package.path == "." else package.path
    while True:
        for path in _listed(names).get(folder, ()):
            for name, line in _pins(path, package.project.text(path)[:_MAX]):
                found.setdefault(name, Location(path, line))
        if not folder:
            return found
        folder = folder.rpartition("/")[0]


@lru_cache(maxsize=4)
def _listed(names: frozenset[str]) -> Mapping[str, tuple[str, ...]]:
    """The files that may name distributions, by their folder; those in ``requirements/`` belong to the folder around it."""
    found: dict[str, list[str]] = {}
    for path in sorted(names):
        folder, _, name = path.rpartition("/")
        if folder.rpartition("/")[2] == "requirements" and name.endswith((".txt", ".in")):
            found.setdefault(folder.rpartition("/")[0], []).append(path)
        elif name in _FILES or _REQUIREMENTS.fullmatch(name):
            found.setdefault(folder, []).append(path)
    return {folder: tuple(paths) for folder, paths in found.items()}


def _pins(path: str, text: str) -> Iterator[tuple[str, int]]:
    if path.endswith((".txt", ".in", ".cfg")):
        yield from _matches(_LINE, text, 0, text) if not _is_frozen(text) else ()
        return
    yield from _matches(_QUOTED, text, 0, text)
    for part in _POETRY_PART.finditer(text) if path.endswith(".toml") else ():
        yield from _matches(_POETRY, part[1], part.start(1), text)


def _matches(pattern: re.Pattern[str], part: str, start: int, text: str) -> Iterator[tuple[str, int]]:
    for match in pattern.finditer(part):
        yield normal(match[1]), text.count("\n", 0, start + match.start(1)) + 1


def left_to_pip(package: ProjectPackage) -> Mapping[str, Location]:
    """The distributions that *package* leaves to pip on purpose, each with the first place; at the base revision, too, if there is one.

    Its setup.py, setup.cfg or pyproject.toml depends on them; or a file of requirements names them, and a page, script or Dockerfile
    installs what that file names; or its README says that they are optional, or are not managed by ROS; or one of the first two, or one
    that is given a version, brings them.
    """
    found = _left(package)
    base = package.project.base if found else None
    if base is None:
        return found
    before = base.package(package.name)
    known = _left(before) if before is not None else {}
    return {name: place for name, place in found.items() if name in known}


def _left(package: ProjectPackage) -> dict[str, Location]:
    """What *package* leaves to pip, with what that brings."""
    found = _named(package)
    for name, place in (*found.items(), *pinned(package).items()):
        if place.path.rpartition("/")[2] not in _READMES:  # words of a sentence
            for other in brought(name):
                found.setdefault(other, place)
    return found


def _named(package: ProjectPackage) -> dict[str, Location]:
    found: dict[str, Location] = {}
    project = package.project
    names = project.workspace.names
    installed = project.sources.once("installed requirements", lambda: _installed(project))
    folder, is_own = ("" if package.path == "." else package.path), True
    while True:
        for name, place in _told(project, folder):
            found.setdefault(name, place)
        for path in _listed(names).get(folder, ()):
            text = project.text(path)[:_MAX]
            if path.endswith((".txt", ".in")):
                is_installed = path.rpartition("/")[2] in installed and not _is_frozen(text)
                pairs = _matches(_PLAIN, text, 0, text) if is_installed else iter(())
            else:
                pairs = _depended(path, text) if is_own else iter(())
            for name, line in pairs:
                found.setdefault(name, Location(path, line))
        if not folder:
            return found
        folder, is_own = folder.rpartition("/")[0], False


def _is_frozen(text: str) -> bool:
    """Whether a file of requirements lists what somebody's machine has, packages of ROS among it: it chooses nothing, and pip cannot install it."""
    return _OF_ROS.search(text) is not None and _INDEX.search(text) is None


def _told(project: Project, folder: str) -> Iterator[tuple[str, Location]]:
    """The words of the sentences of a README in *folder* by which something is optional, or is not managed by ROS."""
    inside = f"{folder}/" if folder else ""
    for path in (f"{inside}{name}" for name in _READMES):
        text = project.text(path)[:_MAX] if path in project.workspace.names else ""
        for sentence in _SENTENCE.finditer(text):
            if _OPTIONAL.search(sentence[0]):
                line = text.count("\n", 0, sentence.start()) + 1
                for word in _WORD.findall(sentence[0]):
                    yield normal(word), Location(path, line)


def _depended(path: str, text: str) -> Iterator[tuple[str, int]]:
    """What setup.py, setup.cfg or pyproject.toml depends on, with the lines."""
    if path.endswith(".cfg"):
        for part in _CFG_PART.finditer(text):
            yield from _matches(_PLAIN, part[1], part.start(1), text)
        return
    for part in _REQUIRES.finditer(_REMARK.sub(lambda found: " " * len(found[0]), text)):
        yield from _matches(_ITEM, part[1], part.start(1), text)
    for part in _POETRY_PART.finditer(text) if path.endswith(".toml") else ():
        yield from _matches(_POETRY_NAME, part[1], part.start(1), text)


def _installed(project: Project) -> frozenset[str]:
    """The files of requirements that pages, scripts and Dockerfiles of the workspace install."""
    return frozenset(
        item.rpartition("/")[2]
        for path in project.workspace.names
        if is_page(path)
        for command in _PIP_INSTALL.findall(project.text(path)[:_MAX])
        for item in _REQUIREMENTS_FILE.findall(command)
    )
