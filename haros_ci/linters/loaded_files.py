# SPDX-License-Identifier: Apache-2.0
"""Python files that another file of the workspace loads by their path: who does so may put names into them before they are used."""

from __future__ import annotations

from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.code_alone import code_alone, without_comments

_LOADS = regex(
    r"\bload_source\s*\(|\bspec_from_file_location\s*\(|\bSourceFileLoader\s*\(|\bexecfile\s*\(|\brun_path\s*\("
    r"|\bexec\s*\(\s*(?:compile\s*\(\s*)?(?:open\b|\w+\.read(?:_text)?\s*\()"
)
#: A file as code names it, and as a parameter does: by a path.
_IN_CODE = regex(r"(?<![\w-])([\w-]+\.py)\b")
_IN_PATH = regex(r"/(?<![\w-])([\w-]+\.py)\b")
#: Endings of more than one word that code names or looks for (``"*.task.py"``): no import takes a file by such a name, so that who reads it runs its text.
_ENDING = regex(r"[\"'/*]\*?((?:\.[\w-]+)+\.py)[\"']")
_RUNS = regex(r"(?<![\w.])exec\b(?:file)?(?!\w)")
#: Such endings that tools find by themselves.
_OF_TOOLS = (".launch.py", ".test.py")
#: Files that install, and load the version of the package.
_ASIDE = ("setup.py", "conf.py")
_NAMING = frozenset(("yaml", "launch", "xml"))


def loaded_files(workspace: Workspace) -> frozenset[str]:
    """The names of Python files that code which loads files by path names, or that a parameter gives where there is such code."""
    loaders = [
        without_comments(text, "python")
        for file in workspace.files
        if file.language in ("python", "launch") and not file.path.endswith(_ASIDE)
        if _LOADS.search(text := workspace.text(file.path)) and _LOADS.search(code_alone(text, "python"))
    ]
    found = {name for text in loaders for name in _IN_CODE.findall(text)}
    if loaders:
        for file in workspace.files:
            if file.language in _NAMING:
                found.update(_IN_PATH.findall(workspace.text(file.path)))
    return frozenset(found | _of_endings(workspace))


def _of_endings(workspace: Workspace) -> set[str]:
    """The names of Python files with an ending that code of the workspace looks for, where some code of it runs texts."""
    doubled = {
        name for file in workspace.files if (name := file.path.rpartition("/")[2]).endswith(".py") and "." in name[:-3]
    }
    doubled = {name for name in doubled if not name.endswith(_OF_TOOLS)}
    if not doubled:
        return set()
    texts = [workspace.text(file.path) for file in workspace.files if file.language == "python"]
    if not any("exec" in text and _RUNS.search(code_alone(text, "python")) for text in texts):
        return set()
    endings = tuple(
        {end for text in texts if ".py" in text for end in _ENDING.findall(without_comments(text, "python"))}
    )
    return {name for name in doubled if name.endswith(endings)} if endings else set()
