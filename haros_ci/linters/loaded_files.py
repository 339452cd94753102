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
    return frozenset(found)
