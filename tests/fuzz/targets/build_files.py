# SPDX-License-Identifier: Apache-2.0
"""Targets of the workspace room: manifests, build files, interfaces, and what git leaves in its directory."""

from __future__ import annotations

import tempfile
from pathlib import Path

from fuzz.targets.kit import Entry, parts, ros_package, sound, text_of, workspace

from haros_ci.interfaces.definitions import Definitions
from haros_ci.interfaces.hashes import wire_hash
from haros_ci.interfaces.references import of_import, of_include
from haros_ci.model.condition import evaluate
from haros_ci.model.package import Package
from haros_ci.workspace.build import builds
from haros_ci.workspace.cmake_math import evaluate_math
from haros_ci.workspace.cmake_parse import parse_cmake
from haros_ci.workspace.cmake_regex import find_all, replace, search
from haros_ci.workspace.commit_time import commit_time
from haros_ci.workspace.content import examine
from haros_ci.workspace.excludes import Excludes
from haros_ci.workspace.exported import linked
from haros_ci.workspace.git import GitError, Repository, repository_of
from haros_ci.workspace.idl import read_idl
from haros_ci.workspace.interfaces import read_interface
from haros_ci.workspace.language import language_of, script_language
from haros_ci.workspace.manifest import read_manifest
from haros_ci.workspace.package_xml import parse_package, settled
from haros_ci.workspace.plugins_xml import read_plugins
from haros_ci.workspace.provenance import provenance, public_uri
from haros_ci.workspace.reconfigure import read_config
from haros_ci.workspace.roots import locate
from haros_ci.workspace.setup_cfg import (
    console_scripts,
    package_directories,
    project_scripts,
    script_directories,
    scripts_of_text,
)


def package_xml(data: bytes) -> object:
    package = parse_package("p/package.xml", data)
    manifest = read_manifest(data)
    if not isinstance(package, Package):
        sound(package)
        return package, manifest
    assert package.name and package.path == "p" and package.ros in (None, 1, 2)
    return package, manifest, settled(package, "p/package.xml", data, [])


def condition(data: bytes) -> object:
    text = data.decode("utf-8", "replace")
    verdict = evaluate(text, {"ROS_VERSION": "2", "X": ""})
    assert verdict in (True, False, None)
    return verdict


def _built(files: dict[str, bytes]) -> object:
    space = workspace(files)
    made = builds(space)
    for build in made.values():
        sound(*build.problems)
    return made, linked(made)


def cmake(data: bytes) -> object:
    files = {"bot/package.xml": ros_package(), "bot/src/a.cpp": b"int a;\n", "bot/msg/A.msg": b"int8 a\n"}
    given = parts(data, "bot/CMakeLists.txt")
    for path, part in given.items():
        script = parse_cmake(text_of(part, "cmake") or "")
        assert script.commands is not None, path
    return _built(files | given)


def cmake_words(data: bytes) -> object:
    text = data.decode("utf-8", "replace")
    pattern, _, rest = text.partition("\n")
    replacement, _, subject = rest.partition("\n")
    found = search(pattern, subject), find_all(pattern, subject), replace(pattern, replacement, subject)
    value = evaluate_math(pattern)
    assert value is None or -(2**63) <= value < 2**63
    return found, value


def setup_files(data: bytes) -> object:
    files = {"bot/package.xml": ros_package(), "bot/bot/__init__.py": b"", "bot/bot/a.py": b"def main(): pass\n"}
    files["bot/package.xml"] = files["bot/package.xml"].replace(b"ament_cmake", b"ament_python")
    return _built(files | parts(data, "bot/setup.py"))


def setup_texts(data: bytes) -> object:
    text = text_of(data, "setup")
    if text is None:
        return None
    found = console_scripts(text) + project_scripts(text)
    assert all(line >= 1 and column >= 0 for _, line, column in found)
    return found, script_directories(text), package_directories(text), scripts_of_text(text)


def interfaces(data: bytes) -> object:
    kind, _, body = data.partition(b"\n")
    suffix = kind.decode("ascii", "replace").strip()
    folder = suffix if suffix in ("msg", "srv", "action") else "msg"
    path = f"bot/{folder}/A.{suffix if suffix in ('msg', 'srv', 'action', 'idl') else 'msg'}"
    text = text_of(body, "interface")
    if text is None:
        return None
    found, problems = read_interface(path, text, "bot")
    sound(*problems)
    hashes = tuple(wire_hash(found, Definitions([found], ros)) for ros in (1, 2))
    return found, problems, hashes, of_include(text[:200]), of_import(text[:200])


def idl(data: bytes) -> object:
    text = text_of(data, "interface")
    return None if text is None else tuple(read_idl(text, "A", kind) for kind in ("msg", "srv", "action"))


def reconfigure(data: bytes) -> object:
    text = text_of(data, "python")
    if text is None:
        return None
    found, problems = read_config("bot/cfg/A.cfg", text, "bot")
    sound(*problems)
    return found, problems


def plugin_files(data: bytes) -> object:
    text = text_of(data, "xml")
    if text is None:
        return None
    found, problems = read_plugins("bot/plugins.xml", text, "bot")
    sound(*problems)
    manifest = ros_package().replace(b"<export>", b'<export><nav2_core plugin="${prefix}/plugins.xml"/>')
    return found, problems, _built({"bot/package.xml": manifest, "bot/plugins.xml": data, "bot/CMakeLists.txt": b""})


def git_files(data: bytes) -> object:
    """The files of a git directory that are read without git: ``.git``, HEAD, config, packed-refs, excludes."""
    with tempfile.TemporaryDirectory() as scratch:
        root = Path(scratch, "r")
        for path, part in parts(data, ".git").items():
            place = root / path
            try:
                place.parent.mkdir(parents=True, exist_ok=True)
                place.write_bytes(part)
            except OSError:  # one part is a file and another lies below it
                continue
        root.mkdir(exist_ok=True)
        top = repository_of(root)
        assert top is None or top == root or not (root / ".git").exists()
        try:
            origin = provenance(root) if top is not None else None
        except GitError as err:
            return str(err).replace(scratch, "")
        common = Repository(root).git_directory if top is not None else None
        uri = public_uri(data.decode("utf-8", "replace"))
        assert "@" not in uri.partition("://")[2].partition("/")[0], uri
        assert locate((str(root),), root).root
        return origin, str(common).replace(scratch, ""), uri, commit_time(root)


def names(data: bytes) -> object:
    """File names, first lines of scripts, patterns of exclusion, and whether a file is text."""
    first, _, rest = data.partition(b"\n")
    name = first.decode("utf-8", "replace")
    verdicts = tuple(examine("a", language, data) for language in ("cpp", "yaml", "markdown"))
    for _, problem in verdicts:
        if problem is not None:
            sound(problem)
    patterns = tuple(line for line in rest.decode("utf-8", "replace").split("\n") if line)[:50]
    excludes = Excludes(patterns)
    answers = tuple(excludes.match(path, is_directory=False) for path in (name, "src/a/b.cpp", "build/x.py", "a"))
    return language_of(name), script_language(data), verdicts, answers


TARGETS = {
    "package-xml": Entry(package_xml, "package.xml", ("workspace.package_xml", "workspace.manifest", "workspace.xml")),
    "condition": Entry(condition, "conditions in package.xml", ("model.condition",)),
    "cmake": Entry(cmake, "CMakeLists.txt and .cmake files", ("workspace.cmake", "workspace.build", "workspace.tree")),
    "cmake-words": Entry(
        cmake_words, "regular expressions and arithmetic of CMake", ("workspace.cmake_regex", "workspace.cmake_math")
    ),
    "setup-files": Entry(
        setup_files,
        "setup.py, setup.cfg and pyproject.toml of a package",
        ("workspace.setup_py", "workspace.python_values"),
    ),
    "setup-texts": Entry(setup_texts, "setup.cfg, pyproject.toml, entry points", ("workspace.setup_cfg",)),
    "interfaces": Entry(
        interfaces, "msg, srv and action files", ("workspace.interfaces", "interfaces.definitions", "interfaces.md5")
    ),
    "idl": Entry(idl, "IDL files", ("workspace.idl",)),
    "reconfigure": Entry(reconfigure, "dynamic_reconfigure's cfg files", ("workspace.reconfigure",)),
    "plugins-xml": Entry(plugin_files, "descriptions of plug-ins", ("workspace.plugins_xml",)),
    "git-files": Entry(
        git_files,
        "the files of a git directory",
        ("workspace.git", "workspace.roots", "workspace.commit_time"),
        (b"@@ .git/HEAD\n", b"@@ .git/config\n", b"@@ .git/packed-refs\n", b"gitdir: ", b"@@ .git\n"),
    ),
    "names": Entry(
        names, "file names, first bytes, patterns of exclusion", ("workspace.excludes", "workspace.content")
    ),
}
