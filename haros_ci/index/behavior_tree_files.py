# SPDX-License-Identifier: Apache-2.0
"""Behaviour trees in XML files of the workspace (BehaviorTree.CPP): which nodes they have, with which ports."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from haros_ci.index.index import Index, Source
from haros_ci.index.tree_includes import brings_trees
from haros_ci.index.xml_files import XmlFileReader
from haros_ci.model.build import Build
from haros_ci.model.launch import LaunchElement
from haros_ci.records import dataclass, field
from haros_ci.syntax import Function

#: Methods of a factory: they register types of nodes, load libraries that do, read trees, create trees.
REGISTERING = frozenset(
    "registerNodeType registerBuilder registerSimpleAction registerSimpleCondition registerSimpleDecorator".split()
)
LOADING = frozenset(("registerFromPlugin", "registerFromROSPlugins"))
CREATING = frozenset(("createTree", "createTreeFromFile", "createTreeFromText"))
READING = frozenset(("registerBehaviorTreeFromFile", "registerBehaviorTreeFromText"))
#: What in a program makes the nodes of trees (``Relevance``), or reads from their files what they are called.
CALLS = frozenset(f".{name}" for name in (*REGISTERING, *LOADING, *CREATING, *READING, "LoadFile"))
#: The macro that registers the nodes of a library.
REGISTER = "BT_REGISTER_NODES"
#: Tags that name the node in their attribute ``ID``, and attributes that are no ports.
KINDS = frozenset(("Action", "Condition", "Control", "Decorator"))
SUBTREES = frozenset(("SubTree", "SubTreePlus"))
TREE = "BehaviorTree"
#: The nodes that the library itself registers, in version 3 or 4 (bt_factory.cpp); they make nothing.
BUILT_IN = frozenset(
    (
        "AlwaysFailure AlwaysSuccess AsyncFallback AsyncSequence BlackboardCheckBool BlackboardCheckDouble "
        "BlackboardCheckInt BlackboardCheckString Delay Fallback ForceFailure ForceSuccess IfThenElse Inverter "
        "KeepRunningUntilFailure LoopBool LoopDouble LoopInt LoopString ManualSelector Parallel ParallelAll "
        "Precondition ReactiveFallback ReactiveSequence Repeat RetryUntilSuccesful RetryUntilSuccessful RunOnce Script "
        "ScriptCondition Sequence SequenceStar SequenceWithMemory SetBlackboard SkipUnlessUpdated Sleep Switch2 "
        "Switch3 Switch4 Switch5 Switch6 Timeout TryCatch UnsetBlackboard WaitValueUpdate WasEntryUpdated WhileDoElse"
    ).split()
)
#: Longer files, and files of more trees, are not read.
LONGEST = 1_000_000


@dataclass(frozen=True, slots=True)
class Tag:
    """A node of a tree: the *type* that is registered for it, its own name ("" without), its ports as written."""

    type: str
    name: str
    ports: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class BehaviorTreeFile:
    """The trees of one file by ID ("" without), the one to execute, and the subtrees of each."""

    tags: Mapping[str, tuple[Tag, ...]]
    main: str
    inner: Mapping[str, tuple[str, ...]]

    def of(self, name: str) -> tuple[tuple[Tag, ...], bool]:
        """The nodes of the tree *name* and of its subtrees, and whether these are all: every one of them is here."""
        reached, waiting = dict.fromkeys((name,)), [name]
        while waiting:
            for item in self.inner.get(waiting.pop(), ()):
                if item not in reached:
                    reached[item] = None
                    waiting.append(item)
        is_whole = all(item in self.tags for item in reached)
        return tuple(tag for item in reached for tag in self.tags.get(item, ())), is_whole

    def beside(self, others: Iterable[BehaviorTreeFile]) -> BehaviorTreeFile:
        """These trees and those that were read before."""
        tags, inner = dict(self.tags), dict(self.inner)
        for other in others:
            tags = {**other.tags, **tags}
            inner = {**other.inner, **inner}
        return BehaviorTreeFile(tags, self.main, inner)


@dataclass(frozen=True, slots=True)
class TreeFiles:
    """Where trees and the libraries of their nodes are found: nothing is read before it is asked for."""

    xml: XmlFileReader
    index: Index
    builds: Mapping[str, Build]
    memo: dict[str, BehaviorTreeFile | None] = field(default_factory=dict)

    def read(self, path: str) -> BehaviorTreeFile | None:
        """The trees of a file by its path as values have it, or of a text after a line feed; None if not known."""
        if not path.startswith("\n"):
            place = self.xml.place(path)
            if place is None or place not in self.xml.files.listed:
                return None
            path = place
        return self._read(path)

    def every(self) -> Iterator[BehaviorTreeFile]:
        """The trees of all files of the workspace that are not for tests."""
        for file in self.xml.files.workspace.files:
            if file.path.endswith(".xml") and not _is_test(file.path):
                found = self._read(file.path)
                if found is not None:
                    yield found

    def _read(self, path: str) -> BehaviorTreeFile | None:
        if path not in self.memo:
            self.memo[path] = None
            text = path if path.startswith("\n") else self.xml.files.workspace.text(path)
            if f"<{TREE}" in text and len(text) < LONGEST:
                found = self.xml.load(path)
                self.memo[path] = trees_of(found.root) if found is not None and found.root is not None else None
        return self.memo[path]

    def registered(self, library: str | None) -> list[tuple[Source, Function]]:
        """What registers the nodes of a library by the name of its file; of all libraries of the workspace for None."""
        found = [function for function in self.index.functions.get(REGISTER, ()) if function[1].body is not None]
        if library is None:
            return sorted(
                (definition for definition in found if not _is_test(definition[0].path)),
                key=lambda definition: definition[0].path,
            )
        name = library.rpartition("/")[2].removesuffix(".so").removeprefix("lib")
        targets = [target for build in self.builds.values() for target in build.targets if target.kind == "library"]
        sources = {path for target in targets if name in (target.output, target.name) for path in target.sources}
        return [definition for definition in found if definition[0].path in sources]


def trees_of(root: LaunchElement) -> BehaviorTreeFile:
    """What the file with the tag *root* says; *root* may be one tree by itself."""
    tags: dict[str, tuple[Tag, ...]] = {}
    inner: dict[str, tuple[str, ...]] = {}
    for tree in (root,) if root.tag == TREE else (child for child in root.children if child.tag == TREE):
        name = tree.get("ID") or ""
        below = list(_below(tree))
        subtrees = tuple(launch_element.get("ID") or "" for launch_element in below if launch_element.tag in SUBTREES)
        tags[name] = (
            *tags.get(name, ()),
            *(_tag(launch_element) for launch_element in below if launch_element.tag not in SUBTREES),
        )
        inner[name] = (*inner.get(name, ()), *subtrees)
    main = root.get("main_tree_to_execute") or (next(iter(tags)) if len(tags) == 1 else "(of several)")
    return BehaviorTreeFile(tags, main, inner)


def _below(tree: LaunchElement) -> Iterator[LaunchElement]:
    waiting = list(reversed(tree.children))
    while waiting:
        element = waiting.pop()
        yield element
        waiting.extend(reversed(element.children))


def _tag(element: LaunchElement) -> Tag:
    named = element.get("ID") if element.tag in KINDS else None
    ports = tuple((k, v) for k, v in element.attributes if k not in ("ID", "name") and not k.startswith("_"))
    return Tag(named or element.tag, element.get("name") or "", ports)


def makes_trees(source: Source) -> bool:
    """Whether a file includes what makes trees and registers their nodes."""
    return any(map(brings_trees, source.program.includes))


def users(index: Index) -> frozenset[str]:
    """The files that do, by path."""
    return frozenset(path for path, source in index.sources.items() if makes_trees(source))


def runs_trees(index: Index, using: frozenset[str], paths: Iterable[str]) -> bool:
    """Whether one of *paths* is, or includes, one of the files *using* trees."""
    return bool(using) and any(path in using or not using.isdisjoint(index.reach(path)) for path in paths)


def library_files(index: Index, builds: Mapping[str, Build]) -> list[frozenset[str]]:
    """The files of each library of the workspace that registers nodes of trees."""
    found = index.functions.get(REGISTER, ()) if REGISTER in index.functions else ()
    files = []
    for source, _ in found:
        if not _is_test(source.path):
            build = builds.get(source.package or "")
            targets = [t for t in build.targets if source.path in t.sources] if build is not None else []
            files.append(frozenset({source.path, *(path for target in targets for path in target.sources)}))
    return files


def _is_test(path: str) -> bool:
    return any(part in ("test", "tests") for part in path.split("/"))
