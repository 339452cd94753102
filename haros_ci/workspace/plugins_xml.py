# SPDX-License-Identifier: Apache-2.0
"""Plug-in descriptions (pluginlib, "Plugin Description File"): which classes a package offers by which names."""

from __future__ import annotations

import posixpath

from haros_ci.model.build import PluginClass
from haros_ci.model.element import Element
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.model.workspace import Problem
from haros_ci.regex import regex
from haros_ci.workspace.tree import PathTree
from haros_ci.workspace.xml import XmlError, parse_xml


def exported_descriptions(tree: PathTree, package: Package) -> tuple[list[tuple[str, Location]], list[Problem]]:
    """The files that ``<export>`` of the manifest names by ``plugin="${prefix}/x.xml"``, and problems of others."""
    path = "package.xml" if package.path == "." else f"{package.path}/package.xml"
    found: list[tuple[str, Location]] = []
    problems: list[Problem] = []
    try:
        manifest = parse_xml(tree.workspace.text(path).encode("utf-8", "replace"))
    except XmlError:
        return found, problems  # a fault of the workspace already
    for export in manifest.all("export"):
        for tag in export.children:
            word = tag.attributes.get("plugin", "").strip()
            if not word:
                continue
            relative = word.replace("${prefix}/", "").replace("${prefix}", ".")
            inner = posixpath.normpath(posixpath.join(package.path, relative))
            if _PLACEHOLDER.search(inner):
                message = f"<{tag.tag} plugin={word!r}>: which file that is, is only known in a build; it is not read"
                problems.append(Problem(path, message, tag.line))
            elif tree.is_file(inner):
                found.append((inner, Location(path, tag.line)))
            else:
                message = f"<{tag.tag} plugin={word!r}>: there is no such file; its classes are missing"
                problems.append(Problem(path, message, tag.line))
    return found, problems


_PLACEHOLDER = regex(r"\$[({]|@\w+@")
_ATTRIBUTE = regex(r"""=\s*(?:"[^"]*"|'[^']*')""")
_DECLARATION = regex(r"\s*<\?xml[^>]*\?>")


def _root(text: str) -> Element | XmlError:
    """The root element; pluginlib's reader also takes several roots, and ``<`` in attributes, so these are, too."""
    try:
        return parse_xml(text.encode("utf-8", "replace"))
    except XmlError as err:
        body = _DECLARATION.sub(lambda match: "\n" * match[0].count("\n"), text, count=1)
        body = _ATTRIBUTE.sub(lambda match: match[0].replace("<", "&lt;"), body)
        try:
            root = parse_xml(f"<class_libraries>{body}</class_libraries>".encode("utf-8", "replace"))
        except XmlError:
            return err
        roots = root.children
        return roots[0] if len(roots) == 1 else root if roots else err


def read_plugins(path: str, text: str, package: str) -> tuple[list[PluginClass], list[Problem]]:
    """The classes of the description at *path*: ``<library>`` as root, or several in ``<class_libraries>``.

    Without a ``name`` the type is the look-up name; a class without ``type`` is a problem. Other tools, too, let packages
    export files as ``plugin``: what neither is XML nor is called so, is theirs.
    """
    root = _root(text)
    if isinstance(root, XmlError) and not path.endswith(".xml") and not text.lstrip().startswith("<"):
        return [], []
    if isinstance(root, XmlError):
        return [], [Problem(path, root.message, root.line)]
    libraries: list[Element] = [root] if root.tag == "library" else list(root.all("library"))
    found: list[PluginClass] = []
    problems: list[Problem] = []
    if root.tag not in ("library", "class_libraries"):
        message = f"<{root.tag}> is no plug-in description; expected <library> or <class_libraries>"
        return [], [Problem(path, message, root.line)]
    for library in libraries:
        for tag in library.all("class"):
            kind = tag.attributes.get("type", "").strip()
            if not kind:
                problems.append(Problem(path, "<class> without type; pluginlib ignores it", tag.line))
                continue
            found.append(
                PluginClass(
                    name=tag.attributes.get("name", "").strip() or kind,
                    type=kind,
                    base=tag.attributes.get("base_class_type", "").strip(),
                    library=library.attributes.get("path", "").strip(),
                    package=package,
                    location=Location(path, tag.line),
                )
            )
    return found, problems
