# SPDX-License-Identifier: Apache-2.0
"""Bags: the files of one recording, which of them may be opened, and their messages as objects."""

from __future__ import annotations

import stat
from collections.abc import Iterator
from importlib.util import find_spec
from itertools import islice
from pathlib import Path
from typing import Any, Protocol

from haros_ci.bounded_yaml import YamlFault, YamlLimits, data
from haros_ci.errors import UserError
from haros_ci.recordings.offered import Offer, offers
from haros_ci.recordings.recording import Channel, Cut, Recording, Unreadable
from haros_ci.records import dataclass

#: Files of one bag, and bytes of its metadata.yaml.
MOST_FILES = 10_000
LARGEST_METADATA = 4 << 20
#: Characters of the profiles of quality of service of all topics.
MOST_PROFILES = 1 << 19
MAGIC_ROS1, MAGIC_MCAP, MAGIC_SQLITE, MAGIC_ZSTD = (
    b"#ROSBAG V",
    b"\x89MCAP0\r\n",
    b"SQLite format 3\x00",
    b"\x28\xb5\x2f\xfd",
)


class Container(Protocol):
    """A file of a bag."""

    def share(self) -> float | None:
        """How much of it has been read, None if that is not known."""

    def raw(self, channels: dict[str, set[str]]) -> Iterator[tuple[Channel, int, bytes]]:
        """Channel, time in nanoseconds and bytes of each message; *channels* takes the topics. Cut where reading ends early."""


class Bag(Recording):
    """A bag of ROS 1, or a file or directory of a bag of ROS 2."""

    def __init__(self, path: Path) -> None:
        super().__init__(path.name)
        demand_extra()
        #: What the metadata of a directory says.
        self.named = named(path) if _is_directory(path) else None
        self.files = (path,) if self.named is None else self.named.files
        if self.named is not None and (left := unnamed(path, self.files)):
            self.notes.append(f"metadata.yaml does not name {left}: not read")
        self.read = 0
        self.container: Container | None = None

    def share(self) -> float | None:
        share = self.container.share() if self.container is not None else None
        return None if share is None else (self.read + share) / len(self.files)

    def messages(self, requested: frozenset[str]) -> Iterator[tuple[str, Any, int, int]]:
        from haros_ci.recordings.types import decoder_of

        for channel, time, raw in self._raw():
            topic = channel.topic
            if topic not in requested:
                continue
            if channel.decoder is None:
                channel.decoder = decoder_of(channel)
            yield topic, channel.decoder(raw, self.count), time, self.count

    def times(self) -> Iterator[tuple[str, int]]:
        seen: set[Channel] = set()
        known: dict[str, tuple[Offer, ...]] = {}
        for channel, time, _ in self._raw():
            if channel not in seen:
                seen.add(channel)
                self.offers.setdefault(channel.topic, set()).update(self._offers(channel, known))
            yield channel.topic, time

    def _offers(self, channel: Channel, known: dict[str, tuple[Offer, ...]]) -> tuple[Offer, ...]:
        """The publishers of a channel; *known* are the profiles that were read so far."""
        if channel.publisher is not None or not channel.profiles:
            return () if channel.publisher is None else (channel.publisher,)
        if channel.profiles not in known:
            if sum(map(len, known)) + len(channel.profiles) > MOST_PROFILES:
                self.notes.append(
                    f"the quality of service of {channel.topic[:200]} is not read: there is too much of it"
                )
                return ()
            known[channel.profiles] = offers(channel.profiles)
        return known[channel.profiles]

    def _raw(self) -> Iterator[tuple[Channel, int, bytes]]:
        """The messages of all files, each of them counted."""
        for path in self.files:
            try:
                self.container = container(path)
                for channel, time, raw in self.container.raw(self.topics):
                    self.passed(time)
                    yield channel, time, raw
            except Cut as cut:
                self.damage = self.damage or str(cut)
                self.notes.append(f"{path.name} can be read up to message {self.count} only: {cut}")
            except UserError as err:
                if len(self.files) == 1:
                    raise
                self.damage = self.damage or err.message
                self.notes.append(f"{path.name} is not read: {err.message}")
            self.read += 1
        if self.named is not None and self.named.count not in (None, self.count):
            self.notes.append(f"metadata.yaml counts {self.named.count:,} messages, and {self.count:,} were read")


def demand_extra() -> None:
    """UserError if what reads bags is not installed."""
    if find_spec("rosbags") is None:
        raise UserError(
            "bags are read with the package rosbags, which is not installed", help="pip install 'haros-ci[bags]'"
        )


@dataclass(frozen=True, slots=True)
class Named:
    """What a metadata.yaml says: the files, in their order, and how many messages these have (None: nothing)."""

    files: tuple[Path, ...]
    count: int | None


def _is_directory(path: Path) -> bool:
    """Whether a bag is a directory; UserError if there is no bag at *path*."""
    try:
        is_directory = path.is_dir()
        if not is_directory and not path.is_file():
            raise UserError(
                f"{path}: there is no bag", help="name a .bag or .mcap file, or the directory of a bag of ROS 2"
            )
    except (OSError, ValueError) as err:
        raise UserError(f"{path}: cannot be read: {err}", help="name a bag") from err
    return is_directory


def named(directory: Path) -> Named:
    """What the metadata of a bag says; UserError if there is none, or if it names no file, or one that lies elsewhere. A file counts once."""
    metadata = directory / "metadata.yaml"
    if not _is_own_file(metadata):
        raise UserError(
            f"{directory}: has no metadata.yaml", help="name the directory of a bag of ROS 2, or a file of it"
        )
    if metadata.stat().st_size > LARGEST_METADATA:
        raise UserError(f"{metadata}: is too large", help=f"at most {LARGEST_METADATA >> 20} MB are read")
    try:
        read = data(metadata.read_text("utf-8"), YamlLimits(LARGEST_METADATA, 50, 200_000, 100))
    except (YamlFault, ValueError) as err:
        raise UserError(f"{metadata}: is no metadata of a bag: {err}", help="name a file of the bag itself") from err
    information = read.get("rosbag2_bagfile_information") if isinstance(read, dict) else None
    information = information if isinstance(information, dict) else {}
    names, count = information.get("relative_file_paths"), information.get("message_count")
    if (
        not isinstance(names, list)
        or not names
        or not all(isinstance(name, str) for name in names)
        or len(names) > MOST_FILES
    ):
        raise UserError(f"{metadata}: names no files", help="name a file of the bag itself")
    files = tuple(dict.fromkeys(_inside(directory, name) for name in names))
    return Named(files, count if isinstance(count, int) and not isinstance(count, bool) else None)


def unnamed(directory: Path, files: tuple[Path, ...]) -> str:
    """Files of recordings that lie beside *files* and are none of them, in words; "" without any."""
    known = {path.name for path in files}
    left = sorted(
        path.name
        for path in islice(directory.iterdir(), MOST_FILES)
        if path.name not in known and path.name.removesuffix(".zstd").endswith((".db3", ".mcap"))
    )
    return ", ".join(left[:3]) + (f" and {len(left) - 3} more" if len(left) > 3 else "")


def _inside(directory: Path, name: str) -> Path:
    """A file of the directory itself; older bags have its name in front."""
    parts = Path(name).parts
    if len(parts) == 2 and parts[0] == directory.name:
        parts = parts[1:]
    if len(parts) != 1 or parts[0] in ("..", "/"):
        raise UserError(
            f"{directory}: metadata.yaml names {name!r}, which is not in the directory of the bag",
            help="it is not opened",
        )
    found = directory / parts[0]
    if not _is_own_file(found):
        raise UserError(f"{directory}: {parts[0]!r} is missing, or no file", help="links are not followed")
    return found


def _is_own_file(path: Path) -> bool:
    try:
        return stat.S_ISREG(path.lstat().st_mode)
    except (OSError, ValueError):
        return False


def container(path: Path) -> Container:
    """The reader of a file, by how it begins; UserError for what is no bag."""
    from haros_ci.recordings.jsonl import opened

    with opened(path) as file:
        head = file.read(16)
    if not head:
        raise UserError(f"{path}: is empty", help="name a recording with messages")
    if head.startswith(MAGIC_ROS1):
        from haros_ci.recordings.ros1 import Ros1File

        return Ros1File(path)
    if head.startswith(MAGIC_MCAP) or (head.startswith(MAGIC_ZSTD) and ".mcap" in path.suffixes):
        from haros_ci.recordings.mcap import McapFile

        return McapFile(path, is_packed=head.startswith(MAGIC_ZSTD))
    if head.startswith((MAGIC_SQLITE, MAGIC_ZSTD)):
        from haros_ci.recordings.sqlite import SqliteFile

        return SqliteFile(path, is_packed=head.startswith(MAGIC_ZSTD))
    raise UserError(f"{path}: is no bag of ROS 1, no MCAP and no SQLite file", help="--jsonl reads lines of JSON")


def unreadable(number: int, channel: Channel, why: str) -> Unreadable:
    """A message that cannot be had."""
    return Unreadable(f"message {number}, on {channel.topic[:200]}, cannot be read: {why}")
