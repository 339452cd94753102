# SPDX-License-Identifier: Apache-2.0
"""The cache on disk: JSON by content key, safe to delete, to restore from any older run, and to share between runs."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import TypeVar
from zlib import crc32

from haros_ci.errors import UserError
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.timing import timed
from haros_ci.workspace.cache_shard import CacheFile
from haros_ci.workspace.files import TooLarge, read_regular

T = TypeVar("T")
SHARDS = 16
CAP_BYTES = 200_000_000
MAX_SHARD = 96_000_000  # bytes; a larger one was not written here

_FILL = 0.8  # after trimming, so that not every further run trims
_NEW = ".new-"
_SHARD = regex(r"[a-z0-9_.-]*-[0-9a-f]\.json")
_OURS = regex(rf"{_SHARD.pattern}|{re.escape(_NEW)}\w+")


@dataclass(slots=True)
class Stats:
    """What a run asked for and got."""

    hits: int = 0
    misses: int = 0

    def __str__(self) -> str:
        return f"{self.hits} hits, {self.misses} misses"


class MemoryCache:
    """A store for one run, which base and head share (``--no-cache``)."""

    def __init__(self) -> None:
        self.stats = Stats()
        self._values: dict[tuple[str, str, str], object] = {}

    def get(self, group: str, path: str, key: str) -> object | None:
        value = self._values.get((group, path, key))
        if value is None:
            self.stats.misses += 1
        else:
            self.stats.hits += 1
        return value

    def put(self, group: str, path: str, key: str, value: object) -> None:
        self._values[group, path, key] = value

    def get_text(self, group: str, path: str, key: str) -> str | None:
        value = self.get(group, path, key)
        return value if isinstance(value, str) else None

    def put_text(self, group: str, path: str, key: str, text: str) -> None:
        self.put(group, path, key, text)

    def flush(self) -> str | None:
        return None

    def clear(self) -> None:
        self._values.clear()


class DiskCache:
    """A store in *directory*: for each group SHARDS files, each read when first asked for and written by ``flush``.

    A file that is not what ``flush`` writes counts as empty. Values are JSON; they come back as such, unchecked.
    """

    def __init__(self, directory: Path, *, cap_bytes: int = CAP_BYTES) -> None:
        self.stats = Stats()
        self._directory = directory
        self._cap = cap_bytes
        self._shards: dict[tuple[str, int], CacheFile] = {}

    @timed("cache")
    def get(self, group: str, path: str, key: str) -> object | None:
        return self._counted(self._shard(group, path).get(f"{key} {path}"))

    @timed("cache")
    def put(self, group: str, path: str, key: str, value: object) -> None:
        self._shard(group, path).put(f"{key} {path}", value)

    @timed("cache")
    def get_text(self, group: str, path: str, key: str) -> str | None:
        return self._counted(self._shard(group, path).get_text(f"{key} {path}"))

    @timed("cache")
    def put_text(self, group: str, path: str, key: str, text: str) -> None:
        self._shard(group, path).put_text(f"{key} {path}", text)

    @timed("cache")
    def flush(self) -> str | None:
        """Write new entries. Returns a sentence for the user if that failed; the run goes on without the cache."""
        changed = {_file_name(*place): shard for place, shard in self._shards.items() if shard.is_changed}
        if not changed:
            return None
        try:
            os.makedirs(self._directory, mode=0o700, exist_ok=True)
            for name, shard in changed.items():
                self._write(name, shard, MAX_SHARD)
            self._trim()
        except OSError as err:
            return (
                f"the cache cannot be written ({err.strerror}); name another place with --cache-dir or use --no-cache"
            )
        return None

    def clear(self) -> None:
        """Delete the cache's own files; whatever else lies in the directory stays."""
        self._shards.clear()
        try:
            for name in self._names(_OURS):
                (self._directory / name).unlink(missing_ok=True)
        except OSError as err:
            raise UserError(f"the cache cannot be cleared ({err.strerror})", help="delete its directory") from err

    def size(self) -> int:
        """Bytes of the cache's own files."""
        try:
            return sum(os.lstat(self._directory / name).st_size for name in self._names(_SHARD))
        except OSError as err:
            raise UserError(
                f"the cache cannot be read ({err.strerror})", help="name another place with --cache-dir"
            ) from err

    def _counted(self, value: T | None) -> T | None:
        if value is None:
            self.stats.misses += 1
        else:
            self.stats.hits += 1
        return value

    def _shard(self, group: str, path: str) -> CacheFile:
        """By path, so that a changed file rewrites one shard, where its old entries are the first to be dropped."""
        place = (group, crc32(path.encode("utf-8", "surrogatepass")) % SHARDS)
        shard = self._shards.get(place)
        if shard is None:
            shard = self._shards[place] = self._load(_file_name(*place))
        return shard

    def _load(self, name: str) -> CacheFile:
        try:
            return CacheFile(read_regular(self._directory / name, MAX_SHARD) or b"")
        except (OSError, TooLarge):
            return CacheFile(b"")

    def _write(self, name: str, shard: CacheFile, limit: int) -> None:
        """Replace a file as a whole: never torn, and a symbolic link in its place is replaced, not followed."""
        import tempfile

        document = shard.document(limit)
        descriptor, new = tempfile.mkstemp(prefix=_NEW, dir=self._directory)
        try:
            with os.fdopen(descriptor, "w", encoding="ascii") as file:
                file.write(document)
            os.replace(new, self._directory / name)
        except BaseException:
            os.unlink(new)
            raise

    def _trim(self) -> None:
        """Over the cap every shard gives up the same share, what was not used for the longest first."""
        sizes = {name: os.lstat(self._directory / name).st_size for name in self._names(_SHARD)}
        total = sum(sizes.values())
        if total > self._cap:
            loaded = {_file_name(*place): shard for place, shard in self._shards.items()}
            for name, size in sizes.items():
                self._write(name, loaded.get(name) or self._load(name), int(size * _FILL * self._cap / total))

    def _names(self, pattern: re.Pattern[str]) -> list[str]:
        try:
            return sorted(name for name in os.listdir(self._directory) if pattern.fullmatch(name))
        except FileNotFoundError:
            return []


def cache_directory(choice: Path | None, environment: Mapping[str, str], root: Path, *, explicit: bool) -> Path:
    """Where the cache lies: *choice*, else ``$HAROS_CI_CACHE``, else haros-ci in the XDG cache directory.

    A pull request could bring along what is inside the workspace at *root*: such a place is only taken if it is
    *explicit*, named on the command line, and reached without a symbolic link. UserError otherwise.
    """
    if choice is None:
        choice = _default(environment)
    place = Path(os.path.abspath(choice))
    real_root = root.resolve()
    if not Path(os.path.realpath(place)).is_relative_to(real_root) and not place.is_relative_to(root):
        return place
    if not explicit:
        raise UserError(
            "the cache directory lies inside the workspace, which could plant results in it",
            help="set HAROS_CI_CACHE to a directory elsewhere, name this one with --cache-dir, or use --no-cache",
        )
    links = [directory for directory in (place, *place.parents) if directory.is_symlink()]
    if any(link.is_relative_to(root) and link != root for link in links):
        raise UserError(
            "the cache directory is reached through a symbolic link of the workspace", help="name its real place"
        )
    return place


def _default(environment: Mapping[str, str]) -> Path:
    named = environment.get("HAROS_CI_CACHE", "")
    if named:
        return Path(named)
    base = environment.get("XDG_CACHE_HOME", "")
    if os.path.isabs(base):  # XDG Base Directory Specification: relative paths are to be ignored
        return Path(base, "haros-ci")
    home = environment.get("HOME", "") or os.path.expanduser("~")
    if not os.path.isabs(home):
        raise UserError("no place for the cache: HOME is not set", help="use --cache-dir DIR or --no-cache")
    return Path(home, ".cache", "haros-ci")


def _file_name(group: str, number: int) -> str:
    return f"{re.sub('[^a-z0-9_.-]', '_', group.lower()).lstrip('.')}-{number:x}.json"
