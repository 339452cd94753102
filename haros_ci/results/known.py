# SPDX-License-Identifier: Apache-2.0
"""Known findings: what a baseline remembers of a result, and what the two sides of a comparison offer."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass, field
from haros_ci.results.counted import is_set_aside
from haros_ci.results.fingerprint import message_template, names_digest, roles_digest, sorted_names
from haros_ci.results.result import BaselineState, Identity, Result, Run
from haros_ci.results.rule import Level

ABSENT = BaselineState.ABSENT


@dataclass(frozen=True, slots=True, kw_only=True)
class KnownFinding:
    """One finding of the past. The fields up to ``reason`` are all that a compact baseline holds.

    ``scope`` to ``roles`` are those of Identity, ``subject`` are Result's names, sorted; ``graph`` is Result's and
    ``related`` are the paths and lines of its related places. A finding of a foreign log has no ``text`` although it has a
    ``line``. ``message`` is "" and ``level``, ``value``, ``line`` are None where the baseline does not tell.
    ``parts`` are the findings of one cause that it was put together of, where that is known. ``reason`` is the user's own: why the finding is accepted.
    """

    tool: str
    rule: str
    path: str
    scope: str = ""
    text: str = ""
    shape: str = ""
    before: str = ""
    after: str = ""
    template: str = ""
    occurrence: int = 1
    names: str = ""
    roles: str = ""
    subject: tuple[str, ...] = ()
    reason: str = ""
    message: str = ""
    level: Level | None = None
    value: float | None = None
    line: int | None = None
    graph: str = ""
    related: tuple[tuple[str, int], ...] = ()
    parts: tuple[KnownFinding, ...] = ()

    @property
    def sort_key(self) -> tuple[object, ...]:
        """By content, so that an entry keeps its place when lines move."""
        content = (self.path, self.tool, self.rule, self.scope, self.template, self.text, self.subject)
        return (*content, self.occurrence, self.shape, self.before, self.after, self.roles)


def _everything(tool: str, path: str) -> bool:
    return True


def _nothing(path: str) -> str:
    return ""


@dataclass(frozen=True, slots=True, kw_only=True)
class ComparedFiles:
    """The files behind a comparison, read on demand.

    *head* and *base* give a file's text, "" where there is none; *base* is None where the past's files cannot be had.
    *language* is of a path on either side. *renames* maps old paths to new, *aliases* old ``tool:rule`` to current.
    *analysed* is whether this run's tool analysed a file, *exists* whether the file is in the workspace now.
    *head_names* and *base_names* are the names in each graph of the two sides; *base_names* is None where the past's
    graphs cannot be had. *architecture* tells whether this run looked at the architecture. *partial* runs did not look at every file: nothing is absent only because its file is gone.
    """

    head: Callable[[str], str]
    language: Callable[[str], str]
    exists: Callable[[str], bool]
    analysed: Callable[[str, str], bool] = _everything
    base: Callable[[str], str] | None = None
    renames: Mapping[str, str] = field(default_factory=dict)
    aliases: Mapping[str, str] = field(default_factory=dict)
    partial: bool = False
    architecture: bool = True
    head_names: Mapping[str, frozenset[str]] = field(default_factory=dict)
    base_names: Mapping[str, frozenset[str]] | None = None

    def rule(self, known: KnownFinding) -> str:
        """Today's ``tool:rule`` of a known finding."""
        name = f"{known.tool}:{known.rule}"
        return self.aliases.get(name, name)

    def answered(self, known: KnownFinding) -> bool:
        """Whether this run can tell that a known finding is gone."""
        if known.names and not self.architecture:
            return False
        now = self.renames.get(known.path, known.path)
        return self.analysed(known.tool, now) if self.exists(now) else not self.partial


def known_from_results(results: Iterable[Result]) -> tuple[KnownFinding, ...]:
    """What a baseline remembers, sorted by content: every result that is neither set aside nor absent."""
    found = (known_from(result) for result in results if not is_set_aside(result) and result.state != ABSENT)
    return tuple(sorted(found, key=lambda known: known.sort_key))


def known_from_sarif(runs: Iterable[Run]) -> tuple[KnownFinding, ...]:
    """What the runs of a SARIF log remember."""
    return known_from_results(result for run in runs for result in run.results)


def identity_of(result: Result) -> Identity:
    """The result's own, or what can be said without its file."""
    if result.identity is not None:
        return result.identity
    template = message_template(result.message, keep_names=result.location.line is None)
    names, roles = names_digest(result.subject), roles_digest(result.roles)
    return Identity(scope=result.scope, template=template, names=names, roles=roles)


def known_from(result: Result, reason: str = "") -> KnownFinding:
    """One result as a known finding."""
    identity = identity_of(result)
    return KnownFinding(
        tool=result.tool,
        rule=result.rule,
        path=result.location.path,
        scope=identity.scope,
        text=identity.text,
        shape=identity.shape,
        before=identity.before,
        after=identity.after,
        template=identity.template,
        occurrence=identity.occurrence,
        names=identity.names,
        roles=identity.roles,
        subject=sorted_names(result.subject),
        reason=reason,
        message=result.message,
        level=result.level,
        value=result.value,
        line=result.location.line,
        graph=result.graph,
        related=tuple((r.location.path, r.location.line) for r in result.related if r.location.line is not None),
        parts=tuple(known_from(part) for part in result.parts),
    )


def names_in(runs: Iterable[Run]) -> dict[str, frozenset[str]]:
    """The names of nodes, topics, services and actions in each graph of the runs."""
    found: dict[str, set[str]] = {}
    for graph in (graph for run in runs for graph in run.graphs):
        found.setdefault(graph.name, set()).update(vertex.label for vertex in graph.vertices)
    return {name: frozenset(names) for name, names in found.items()}


def rule_aliases(runs: Iterable[Run]) -> dict[str, str]:
    """Old ``tool:rule`` to current, from the rules' deprecated ids (SARIF §3.49.4)."""
    return {
        f"{run.tool.name}:{old}": f"{run.tool.name}:{rule.id}"
        for run in runs
        for rule in run.rules
        for old in rule.deprecated_ids
    }


def sides(
    workspace: Workspace,
    runs: tuple[Run, ...],
    paths: tuple[str, ...],
    base: Workspace | None = None,
    renames: Mapping[str, str] | None = None,
    past: tuple[Run, ...] | None = None,
) -> ComparedFiles:
    """The files on the two sides of a comparison, as the matcher asks for them.

    *paths* are the arguments of the run: of a file outside them it cannot be said that it is gone, nor of a
    finding of the architecture in them, as what it is about may lie outside. *past* are the runs
    of the past, for the names that were.
    """
    language = {file.path: file.language for side in (base, workspace) if side for file in side.files}
    present = {file.path for file in workspace.files}
    analysed = {run.tool.name: run.analysed for run in runs}
    above = tuple(f"{path}/" for path in paths if path != ".")
    return ComparedFiles(
        head=workspace.text,
        language=lambda path: language.get(path, ""),
        exists=lambda path: path in present or ("." not in paths and not path.startswith(above)),
        analysed=lambda tool, path: path in analysed.get(tool, ()),
        base=base.text if base else None,
        renames=renames or {},
        aliases=rule_aliases(runs),
        partial=workspace.targets is not None,
        architecture="." in paths and any(run.architecture for run in runs),
        head_names=names_in(runs),
        base_names=None if past is None else names_in(past),
    )
