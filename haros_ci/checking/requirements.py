# SPDX-License-Identifier: Apache-2.0
"""Python distributions of which a package asks pip for a certain version: requirements, setup.py, setup.cfg, pyproject.toml."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import lru_cache

from haros_ci.checking.project import ProjectPackage
from haros_ci.model.location import Location

_NAME = r"([A-Za-z0-9][\w.-]{0,100}?)[ \t]{0,9}(?:\[[\w ,.-]{0,200}\])?"
_RULE = r"[ \t]{0,9}\(?(?:===?|[<>~!]=|[<>])[ \t]{0,9}v?\d"
#: A line of requirements.txt or of ``install_requires`` in setup.cfg, and a quoted one in setup.py and pyproject.toml (PEP 508).
_LINE = re.compile(rf"^[ \t]*{_NAME}{_RULE}", re.MULTILINE)
_QUOTED = re.compile(rf"""["']{_NAME}{_RULE}""")
#: A dependency as Poetry writes it: ``scipy = "^1.9"``.
_POETRY = re.compile(
    r"""^([A-Za-z0-9][\w.-]{0,100})[ \t]{0,9}=[ \t]{0,9}(?:\{[^}\n]{0,300}\bversion[ \t]{0,9}=[ \t]{0,9})?["'][\^~<>=!]*[ \t]*\d""",
    re.MULTILINE,
)
_POETRY_PART = re.compile(
    r"^\[tool\.poetry\.(?:group\.[\w-]+\.)?dependencies\][ \t]*\n((?:(?!\[).*\n?)*)", re.MULTILINE
)
_REQUIREMENTS = re.compile(r"requirements?(?:[-_.][\w.-]+)?\.(?:txt|in)")
_FILES = ("setup.py", "setup.cfg", "pyproject.toml")
_MAX = 200_000

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
    "usb": "pyusb",
    "websocket": "websocket-client",
    "yaml": "pyyaml",
    "zmq": "pyzmq",
}


def distributions_of(module: str) -> frozenset[str]:
    """The names that pip may have for what brings *module*, as PEP 503 writes them."""
    return frozenset(normal(each) for each in (module, *_CALLED.get(module.lower(), "").split()))


def normal(name: str) -> str:
    """Names of distributions are equal whatever their case and separators (PEP 503)."""
    return re.sub(r"[-_.]+", "-", name).lower()


def pinned(package: ProjectPackage) -> Mapping[str, Location]:
    """The distributions that files of *package*, or of the folders around it, give a version, each with the first place.

    A bare name is none: any version will do, the system's, too.
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
        yield from _matches(_LINE, text, 0, text)
        return
    yield from _matches(_QUOTED, text, 0, text)
    for part in _POETRY_PART.finditer(text) if path.endswith(".toml") else ():
        yield from _matches(_POETRY, part[1], part.start(1), text)


def _matches(pattern: re.Pattern[str], part: str, start: int, text: str) -> Iterator[tuple[str, int]]:
    for match in pattern.finditer(part):
        yield normal(match[1]), text.count("\n", 0, start + match.start(1)) + 1
