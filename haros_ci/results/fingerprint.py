# SPDX-License-Identifier: Apache-2.0
"""What each result is about, as hashes that survive moved lines; and the fingerprints that SARIF logs carry."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from hashlib import sha256
from itertools import islice

from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.results.comments import bare, lines_of, syntax
from haros_ci.results.line_hash import github_line_hashes
from haros_ci.results.result import Identity, Result, Run
from haros_ci.results.scope import LineScopes, scopes

#: The hash of nothing: a context with this value begins or ends the file.
EDGE = sha256(b"").hexdigest()[:16]

#: No finding is about more; of one that is, the first count.
MOST_NAMES = 1_000

_CONTEXT_LINES = 3
_LEAST_CONTEXT = 8  # letters and digits
_LONGEST_SNIPPET = 300
_LONGEST_TEMPLATE = 300
_SCOPED = ("cpp", "python")  # what scopes() reads; results in other files keep the scope that their tool gave
_QUOTED = regex(r"(?<!\w)'[^'\n]{1,200}'(?!\w)|\"[^\"\n]{1,200}\"|`[^`\n]{1,200}`|‘[^’\n]{1,200}’|“[^”\n]{1,200}”")
_WORD = regex(r"\w+")
_NO_WORD = regex(r"\W+")
_NUMBER = regex(r"(?<![A-Za-z_])\d+(?:\.\d+)*")


def fingerprint(runs: Iterable[Run], text: Callable[[str], str], language: Callable[[str], str]) -> tuple[Run, ...]:
    """The runs with every ``Result.identity`` filled; ``scope`` too, where the tool gave none.

    The scope of a result in C++ or Python is always our own reading of the file, because the tools name functions
    differently and a result must keep its scope when its tool is upgraded.
    """
    runs = tuple(runs)
    results = _identified([result for run in runs for result in run.results], text, language)
    joined = [index for index, result in enumerate(results) if result.parts]
    parts = iter(_identified([part for index in joined for part in results[index].parts], text, language))
    for index in joined:
        result = results[index]
        results[index] = replace(result, parts=tuple(islice(parts, len(result.parts))))
    done = iter(results)
    return tuple(replace(run, results=tuple(islice(done, len(run.results)))) for run in runs)


def _identified(results: list[Result], text: Callable[[str], str], language: Callable[[str], str]) -> list[Result]:
    """*results*, each with its identity and scope."""
    by_path: dict[str, list[int]] = {}
    for index, result in enumerate(results):
        by_path.setdefault(result.location.path, []).append(index)
    for path, indexes in sorted(by_path.items()):
        file = _FileLines(path, text(path), language(path))
        for index, identity in zip(indexes, _identities([results[i] for i in indexes], file), strict=True):
            result = results[index]
            results[index] = replace(result, identity=identity, scope=result.scope or identity.scope)
    return results


def text_hashes(text: str, path: str, language: str) -> frozenset[str]:
    """``Identity.text`` of every line of a file."""
    kind = syntax(language, path)
    return frozenset(digest(bare(line, kind)) for line in set(lines_of(text)))


def message_template(message: str, *, keep_names: bool = False) -> str:
    """The message with quoted names and numbers replaced, so that a renamed variable or another count keeps it.

    A result on a whole file has nothing but its message to tell it from others: its template *keeps* the *names*.
    """
    return _NUMBER.sub("0", message if keep_names else _QUOTED.sub("'_'", message)).rstrip(".")[:_LONGEST_TEMPLATE]


def quoted_names(message: str) -> tuple[str, ...]:
    """What stands in quotes in the message, in order: what the finding is about."""
    return tuple(match[0][1:-1] for match in _QUOTED.finditer(message))


def partial_fingerprints(result: Result) -> dict[str, str]:
    """SARIF §3.27.17, by versioned name; none for a result without identity. No value depends on a line number.

    ``harosCi/v1`` is strict (rule, scope, text, then ``:occurrence``), ``harosCiScope/v1`` survives an edited line
    (rule, scope, message template); the others are the identity's own hashes, so that a log restores it.
    ``harosCiSubject/v1`` and ``harosCiRoles/v1`` tell with the rule which finding of the architecture it is.
    """
    identity = result.identity
    if identity is None:
        return {}
    rule = f"{result.tool}\0{result.rule}\0{identity.scope}"
    strict = digest(f"{rule}\0{identity.text}")
    values = {
        "harosCi/v1": f"{strict}:{identity.occurrence}",
        "harosCiScope/v1": digest(f"{rule}\0{identity.template}"),
        "harosCiText/v1": identity.text,
        "harosCiShape/v1": identity.shape,
        "harosCiBefore/v1": identity.before,
        "harosCiAfter/v1": identity.after,
        "harosCiSubject/v1": identity.names,
        "harosCiRoles/v1": identity.roles,
        "primaryLocationLineHash": identity.line_hash,
    }
    return {name: value for name, value in values.items() if value}


def restore_identity(fingerprints: Mapping[str, str], *, scope: str, template: str, snippet: str) -> Identity | None:
    """The identity behind the *fingerprints* of a log of our own; None if they are not ours."""
    strict = fingerprints.get("harosCi/v1", "")
    occurrence = strict.partition(":")[2]
    if not occurrence.isascii() or not occurrence.isdigit() or len(occurrence) > 9:
        return None
    return Identity(
        scope=scope,
        text=fingerprints.get("harosCiText/v1", ""),
        before=fingerprints.get("harosCiBefore/v1", ""),
        after=fingerprints.get("harosCiAfter/v1", ""),
        template=template,
        occurrence=int(occurrence),
        line_hash=fingerprints.get("primaryLocationLineHash", ""),
        snippet=snippet,
        shape=fingerprints.get("harosCiShape/v1", ""),
        names=fingerprints.get("harosCiSubject/v1", ""),
        roles=fingerprints.get("harosCiRoles/v1", ""),
    )


def names_digest(subject: Iterable[str]) -> str:
    """``Identity.names`` of the ROS names that a finding is about; the order and repetitions do not count."""
    names = sorted_names(subject)
    return digest("\0".join(names)) if names else ""


def sorted_names(subject: Iterable[str]) -> tuple[str, ...]:
    """Each name once."""
    return tuple(sorted(set(subject))[:MOST_NAMES])


def roles_digest(roles: Iterable[str]) -> str:
    """``Identity.roles`` of what those names are; the order does not count."""
    ordered = sorted(roles)
    return digest("\0".join(ordered)) if ordered else ""


def digest(text: str) -> str:
    """The first 16 hexadecimal digits of the SHA-256."""
    return sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:16]


@dataclass(slots=True)
class _FileLines:
    """A file's lines; normalised ones are made on demand and kept."""

    path: str
    text: str
    language: str
    lines: list[str] = field(init=False)
    filled: list[int] = field(init=False)  # indexes of lines that are not blank
    kind: str = field(init=False)
    known: dict[int, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.lines = lines_of(self.text)
        self.filled = [index for index, line in enumerate(self.lines) if line and not line.isspace()]
        self.kind = syntax(self.language, self.path)

    def bare(self, index: int) -> str:
        if index not in self.known:
            self.known[index] = bare(self.lines[index], self.kind)
        return self.known[index]

    def context(self, index: int) -> tuple[str, str]:
        """Hashes of the nearest non-blank lines before and after the line at *index*; "" where they say too little."""
        at = bisect_left(self.filled, index)
        after = at + (at < len(self.filled) and self.filled[at] == index)
        groups = (self.filled[max(0, at - _CONTEXT_LINES) : at], self.filled[after : after + _CONTEXT_LINES])
        before_text, after_text = ("\n".join(map(self.bare, group)) for group in groups)
        return _context_hash(before_text), _context_hash(after_text)


def _context_hash(text: str) -> str:
    """Closing braces alone stand everywhere: they do not tell a place."""
    return digest(text) if not text or len(_NO_WORD.sub("", text)) >= _LEAST_CONTEXT else ""


def _identities(results: list[Result], file: _FileLines) -> list[Identity]:
    """Identities of the results of one file, in the order given."""
    placed = {line for result in results if 0 < (line := result.location.line or 0) <= len(file.lines)}
    hashes = github_line_hashes(file.text, placed) if file.text else {}
    own = file.language in _SCOPED
    names = scopes(file.text, file.language) if own and placed else LineScopes()
    counts: dict[tuple[str, str, str, str], int] = {}
    identities = [Identity()] * len(results)
    for index in sorted(range(len(results)), key=lambda i: results[i].sort_key):
        result = results[index]
        line = result.location.line or 0
        here = line in placed
        code = file.bare(line - 1) if here else ""
        scope = names.at(line) if here and own else result.scope
        text = digest(code) if here else ""
        before, after = file.context(line - 1) if here else ("", "")
        key = (result.tool, result.rule, scope, text)
        counts[key] = counts.get(key, 0) + 1
        identities[index] = Identity(
            scope=scope,
            text=text,
            shape=digest(_WORD.sub("_", code)) if here else "",
            before=before,
            after=after,
            template=message_template(result.message, keep_names=not line),
            occurrence=counts[key],
            line_hash=hashes.get(line, "") if here else "",
            snippet=file.lines[line - 1][:_LONGEST_SNIPPET] if here else "",
            names=names_digest(result.subject),
            roles=roles_digest(result.roles),
        )
    return identities
