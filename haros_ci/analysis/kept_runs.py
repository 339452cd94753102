# SPDX-License-Identifier: Apache-2.0
"""What is found in a whole revision, kept in the cache: the same files, settings and program give the same."""

from __future__ import annotations

import zlib
from base64 import b64decode, b64encode
from binascii import Error
from collections.abc import Callable, Iterable
from dataclasses import replace
from hashlib import blake2b
from typing import TYPE_CHECKING, Any

from haros_ci.model.workspace import Reader, Store, Workspace
from haros_ci.own_sources import program_digest
from haros_ci.records import dataclass, field
from haros_ci.report.escape import multiline
from haros_ci.results import own
from haros_ci.results.result import Run
from haros_ci.results.values import NotThat, plain, read

if TYPE_CHECKING:
    from haros_ci.workspace.base import Base

GROUP = "whole"
#: Bytes of an output that is kept, as it is and packed.
MAX_OUTPUT, MAX_PACKED = 1 << 28, 1 << 24

#: The first bytes of a file that no digest covers: its path, and the digest of these bytes.
Head = tuple[str, str]
#: What text of ours has of ASCII.
_PLAIN = bytes(range(0x20, 0x7F)) + b"\n"
Make = Callable[[Workspace, "Base | None"], Run]


def kept_run(name: str, make: Make, workspace: Workspace, past: Base | None, settings: str, store: Store) -> Run:
    """What *make* finds in *workspace*, and in what has changed since *past*; from *store* if nothing that it depends on has changed.

    *name* is the stage's, *settings* the digest of those that it depends on. The stage may read the listed files and the heads of the
    others, and nothing else.
    """
    key = _digest(name, settings, program_digest(), state(workspace), "" if past is None else _base_state(past))
    kept = store.get(GROUP, f"{name} {key}", key)
    if (found := _held(kept, workspace)) is not None:
        return found
    reader = Noting(workspace.reader)
    run = make(replace(workspace, reader=reader), past)
    if run.successful:
        store.put(GROUP, f"{name} {key}", key, {"heads": reader.heads(), "run": plain(run)})
    return run


@dataclass(frozen=True, slots=True)
class Output:
    """What a command writes: *content* to where it was asked to, *messages* line by line to the standard error."""

    content: bytes
    messages: tuple[str, ...] = ()


def kept_output(
    name: str,
    make: Callable[[], Output],
    workspace: Workspace,
    settings: str,
    store: Store,
    *,
    is_binary: bool = False,
    is_kept: Callable[[Output], bool] = lambda output: True,
) -> Output:
    """What *make* writes of *workspace*; from *store* if nothing that it depends on has changed.

    *name* is the command's, *settings* stands for all its options. The command may read the listed files, and nothing else. What is
    kept is data, not trust: text with characters that no text of ours has is made anew, and who writes ``said`` escapes it. What is not
    *is_kept* is made again the next time.
    """
    key = key_of(name, settings, workspace)
    found = _unpacked(store.get(GROUP, f"{name} {key}", key))
    if found is not None and (is_binary or _is_plain(found.content)):
        return found
    output = make()
    packed = zlib.compress(output.content, 1)
    if is_kept(output) and len(output.content) <= MAX_OUTPUT and len(packed) <= MAX_PACKED:
        store.put(GROUP, f"{name} {key}", key, [list(output.messages), b64encode(packed).decode()])
    return output


def key_of(name: str, settings: str, workspace: Workspace) -> str:
    """The key of what the stage *name* finds in *workspace* alone, with the digest of its *settings*, by this program."""
    return _digest(name, settings, program_digest(), state(workspace))


def _unpacked(kept: Any) -> Output | None:
    """The output that is *kept*, unless it is none."""
    try:
        report, text = read(tuple[tuple[str, ...], str], kept)
        unpacker = zlib.decompressobj()
        content = unpacker.decompress(b64decode(text, validate=True), MAX_OUTPUT)
    except (NotThat, Error, ValueError, zlib.error):
        return None
    return Output(content, report) if unpacker.eof else None


def _is_plain(content: bytes) -> bool:
    """Whether text has nothing that a terminal or a runner would obey."""
    if not content.translate(None, _PLAIN) and b"##" not in content:  # most text, at the speed of C
        return True
    text = content.decode("utf-8", "replace")
    return multiline(text) == text


def state(workspace: Workspace) -> str:
    """A digest of all that a stage sees of *workspace*: its files, their names, what they are, and what is reported on."""
    return _digest(
        *(
            repr((f.path, f.digest, f.language, f.package, f.is_generated, f.third_party, f.has_directive))
            for f in workspace.files
        ),
        *map(repr, (workspace.packages, workspace.problems, workspace.faults, workspace.links, workspace.hiding)),
        *map(_listed, (workspace.names, workspace.targets, workspace.executables)),
    )


def launch_state(workspace: Workspace) -> str:
    """A digest of all that launch files are evaluated with: the same, but for what C++ files hold.

    A launch file that reads the text of a C++ file as a parameter is the exception: the base's has the head's text.
    """
    files = tuple(
        replace(f, digest="", size=0, lines=0, has_directive=False) if f.language == "cpp" else f
        for f in workspace.files
    )
    return state(replace(workspace, files=files))


def _base_state(past: Base) -> str:
    return _digest(past.revision, state(past.workspace), repr(sorted(past.renames.items())))


def _listed(names: Iterable[str] | None) -> str:
    return "-" if names is None else "\0".join(sorted(names))


def _digest(*parts: str) -> str:
    digest = blake2b(digest_size=16)
    for part in parts:
        data = part.encode("utf-8", "surrogatepass")
        digest.update(b"%d\0" % len(data))
        digest.update(data)
    return digest.hexdigest()


def _held(kept: Any, workspace: Workspace) -> Run | None:
    """The run of ours that is *kept*, unless it is none, or a head that it rests on is another by now."""
    try:
        heads: tuple[Head, ...] = read(tuple[Head, ...], kept["heads"])
        run: Run = read(Run, kept["run"])
    except (KeyError, TypeError, NotThat, RecursionError):
        return None
    if any(result.tool != own.TOOL for result in run.results):
        return None
    return run if all(_head_digest(workspace.head(path)) == digest for path, digest in heads) else None


def _head_digest(head: bytes) -> str:
    return blake2b(head, digest_size=16).hexdigest()


@dataclass(slots=True)
class Noting:
    """A reader that notes which heads of files are read: the files themselves are in no digest."""

    inner: Reader
    _read: dict[str, str] = field(default_factory=dict)

    def text(self, path: str) -> str:
        """As ``Reader.text``."""
        return self.inner.text(path)

    def data(self, path: str) -> bytes | None:
        """As ``Reader.data``."""
        return self.inner.data(path)

    def head(self, path: str, length: int) -> bytes:
        """As ``Reader.head``; noted."""
        head = self.inner.head(path, length)
        self._read[path] = _head_digest(head)
        return head

    def heads(self) -> list[list[str]]:
        """What was read, sorted."""
        return [list(pair) for pair in sorted(self._read.items())]
