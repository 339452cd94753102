# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import os
import stat
from pathlib import Path

import pytest

from haros_ci.errors import UserError
from haros_ci.workspace.cache import DiskCache, MemoryCache, cache_directory

VALUE = [["unused-import", 3, None, "Ünused"], {"b": 1, "a": [True, 1.5]}]


def filled(directory: Path, count: int = 1, *, cap: int = 10**9, group: str = "pylint", size: int = 10) -> DiskCache:
    cache = DiskCache(directory, cap_bytes=cap)
    for number in range(count):
        cache.put(group, f"src/{number}.py", f"k{number}", "x" * size)
    assert cache.flush() is None
    return cache


def kept(directory: Path, count: int, group: str = "pylint") -> list[int]:
    cache = DiskCache(directory)
    return [number for number in range(count) if cache.get(group, f"src/{number}.py", f"k{number}") is not None]


@pytest.mark.parametrize("path", ["a.py", "src/ä b.py", "a\x1b.py", "a\udcff.py"])
def test_what_was_put_comes_back_in_a_later_run(tmp_path: Path, path: str) -> None:
    first = DiskCache(tmp_path / "c")
    assert first.get("pylint", path, "k") is None
    first.put("pylint", path, "k", VALUE)
    assert first.get("pylint", path, "k") == VALUE
    assert first.flush() is None
    later = DiskCache(tmp_path / "c")
    assert later.get("pylint", path, "k") == VALUE
    assert str(later.stats) == "1 hits, 0 misses"


@pytest.mark.parametrize(
    ("group", "path", "key"), [("radon", "a.py", "k"), ("pylint", "b.py", "k"), ("pylint", "a.py", "l")]
)
def test_another_group_path_or_key_misses(tmp_path: Path, group: str, path: str, key: str) -> None:
    for cache in (DiskCache(tmp_path), MemoryCache()):
        cache.put("pylint", "a.py", "k", VALUE)
        assert cache.get(group, path, key) is None
        assert (cache.stats.hits, cache.stats.misses) == (0, 1)


def test_memory_forgets_on_clear() -> None:
    cache = MemoryCache()
    cache.put("pylint", "a.py", "k", VALUE)
    assert cache.get("pylint", "a.py", "k") == VALUE
    assert cache.flush() is None
    cache.clear()
    assert cache.get("pylint", "a.py", "k") is None


def test_a_warm_run_writes_nothing(tmp_path: Path) -> None:
    filled(tmp_path, 40)
    before = {path: path.stat().st_ino for path in tmp_path.iterdir()}
    cache = DiskCache(tmp_path)
    assert cache.get("pylint", "src/7.py", "k7") is not None
    assert cache.flush() is None
    assert {path: path.stat().st_ino for path in tmp_path.iterdir()} == before


def test_the_same_entries_make_the_same_bytes_in_any_order(tmp_path: Path) -> None:
    for name, order in (("one", range(50)), ("two", reversed(range(50)))):
        cache = DiskCache(tmp_path / name)
        for number in order:
            cache.put("pylint", f"{number}.py", "k", VALUE)
        cache.flush()
    one, two = ({path.name: path.read_bytes() for path in (tmp_path / name).iterdir()} for name in ("one", "two"))
    assert one == two


def test_only_the_owner_can_read_it(tmp_path: Path) -> None:
    filled(tmp_path / "deep" / "c")
    assert stat.S_IMODE((tmp_path / "deep" / "c").stat().st_mode) == 0o700
    assert [stat.S_IMODE(path.stat().st_mode) for path in (tmp_path / "deep" / "c").iterdir()] == [0o600]


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"{",
        b"[]",
        b"null",
        b"\xff\xfe\x00",
        b'{"format":99,"run":1,"entries":{"k0 src/0.py":[1,"planted"]}}',
        b'{"format":1,"run":"1","entries":{"k0 src/0.py":[1,"planted"]}}',
        b'{"format":1,"run":-1,"entries":{"k0 src/0.py":[1,"planted"]}}',
        b'{"format":1,"run":1,"entries":[["k0 src/0.py",1,"planted"]]}',
        b'{"format":1,"run":1,"entries":{"k0 src/0.py":"planted"}}',
        b'{"format":1,"run":1,"entries":{"k0 src/0.py":[1,"planted",2]}}',
        b'{"format":1,"run":1,"entries":{"k0 src/0.py":[1,NaN]}}',
        b'{"format":1,"run":1,"entries":{"k0 src/0.py":[1,' + b"[" * 100_000 + b"]" * 100_000 + b"]}}",
        b'{"format":1,"run":1,"entries":{"k0 src/0.py":[1,' + b"9" * 10_000 + b"]}}",
    ],
)
def test_foreign_and_broken_files_count_as_empty(tmp_path: Path, data: bytes) -> None:
    filled(tmp_path)
    (place,) = tmp_path.iterdir()
    place.write_bytes(data)
    assert kept(tmp_path, 1) == []
    filled(tmp_path)  # and are replaced
    assert kept(tmp_path, 1) == [0]


@pytest.mark.parametrize("value", [b'"\xff"', b'"\xc3\xa9"', b"[\xf0\x9f\x92\xa9]", b"\xdd", b'"\\ud800"'])
def test_what_is_not_ascii_in_a_planted_file_does_not_hinder_the_next_run(tmp_path: Path, value: bytes) -> None:
    filled(tmp_path)
    (place,) = tmp_path.iterdir()
    place.write_bytes(b'{"format":1,"run":1,"entries":{\n"other key":[1,%s]\n}}\n' % value)
    cache = DiskCache(tmp_path)
    cache.put("pylint", "src/0.py", "k0", 0)
    assert cache.flush() is None
    assert all(path.read_bytes().isascii() for path in tmp_path.iterdir())


def test_a_truncated_file_counts_as_empty(tmp_path: Path) -> None:
    filled(tmp_path)
    (place,) = tmp_path.iterdir()
    place.write_bytes(place.read_bytes()[:-10])
    assert kept(tmp_path, 1) == []


def test_an_enormous_file_is_not_read(tmp_path: Path) -> None:
    filled(tmp_path)
    (place,) = tmp_path.iterdir()
    with place.open("r+b") as file:
        file.truncate(3_000_000_000)
    assert kept(tmp_path, 1) == []


def test_links_are_neither_read_nor_written_through(tmp_path: Path) -> None:
    filled(tmp_path / "c")
    (place,) = (tmp_path / "c").iterdir()
    outside = tmp_path / "outside"
    outside.write_bytes(place.read_bytes())
    place.unlink()
    place.symlink_to(outside)
    assert kept(tmp_path / "c", 1) == []
    secret = outside.read_bytes()
    filled(tmp_path / "c", size=20)
    assert outside.read_bytes() == secret
    assert not place.is_symlink() and kept(tmp_path / "c", 1) == [0]


def test_a_pipe_in_its_place_does_not_hang(tmp_path: Path) -> None:
    filled(tmp_path)
    (place,) = tmp_path.iterdir()
    place.unlink()
    os.mkfifo(place)
    assert kept(tmp_path, 1) == []


@pytest.mark.parametrize("group", ["../../etc", "a/b", "", "..", "Ruff 0.4", "ä"])
def test_no_group_leads_out_of_the_directory(tmp_path: Path, group: str) -> None:
    filled(tmp_path / "c", group=group)
    assert len(list((tmp_path / "c").iterdir())) == 1
    assert [path.name for path in tmp_path.iterdir()] == ["c"]
    assert kept(tmp_path / "c", 1, group) == [0]


def test_a_place_that_cannot_be_written_is_said_and_no_error(tmp_path: Path) -> None:
    (tmp_path / "c").write_bytes(b"a file")
    cache = DiskCache(tmp_path / "c")
    cache.put("pylint", "a.py", "k", VALUE)
    said = cache.flush()
    assert said is not None and "--no-cache" in said and str(tmp_path) not in said
    assert cache.get("pylint", "a.py", "k") == VALUE


def test_over_the_cap_the_unused_go_first(tmp_path: Path) -> None:
    filled(tmp_path, 200, size=1000)
    total = sum(path.stat().st_size for path in tmp_path.iterdir())
    cache = DiskCache(tmp_path, cap_bytes=total)
    for number in range(100, 200):
        cache.get("pylint", f"src/{number}.py", f"k{number}")
    for number in range(200, 250):
        cache.put("pylint", f"src/{number}.py", f"k{number}", "x" * 1000)
    cache.flush()
    left = kept(tmp_path, 250)
    assert sum(path.stat().st_size for path in tmp_path.iterdir()) <= total
    assert {n for n in left if n >= 200}
    assert len([n for n in left if n < 100]) < len([n for n in left if 100 <= n < 200])
    assert left == sorted(left)


def test_trimming_is_deterministic(tmp_path: Path) -> None:
    for name in ("one", "two"):
        filled(tmp_path / name, 300, cap=100_000, size=1000)
    assert kept(tmp_path / "one", 300) == kept(tmp_path / "two", 300)
    assert 0 < len(kept(tmp_path / "one", 300)) < 100


def test_two_runs_at_once_leave_whole_files(tmp_path: Path) -> None:
    one, two = DiskCache(tmp_path), DiskCache(tmp_path)
    for cache, value in ((one, "one"), (two, "two")):
        for number in range(64):
            cache.put("pylint", f"src/{number}.py", f"k{number}", value)
    one.flush()
    two.flush()
    for path in tmp_path.iterdir():
        json.loads(path.read_bytes())
    assert kept(tmp_path, 64) == list(range(64))


def test_clear_deletes_its_own_files_only(tmp_path: Path) -> None:
    cache = filled(tmp_path, 30)
    (tmp_path / ".new-abc").write_bytes(b"left by a run that was killed")
    (tmp_path / "notes.json").write_bytes(b"{}")
    (tmp_path / "sub").mkdir()
    cache.clear()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["notes.json", "sub"]
    assert cache.get("pylint", "src/0.py", "k0") is None
    DiskCache(tmp_path / "nowhere").clear()


def test_a_restored_cache_hits_wherever_it_lies(tmp_path: Path) -> None:
    filled(tmp_path / "here", 5)
    (tmp_path / "here").rename(tmp_path / "there")
    assert kept(tmp_path / "there", 5) == [0, 1, 2, 3, 4]


@pytest.mark.parametrize(
    ("choice", "environment", "expected"),
    [
        ("/c", {"HAROS_CI_CACHE": "/e"}, "/c"),
        (None, {"HAROS_CI_CACHE": "/e", "XDG_CACHE_HOME": "/x", "HOME": "/h"}, "/e"),
        (None, {"HAROS_CI_CACHE": "", "XDG_CACHE_HOME": "/x", "HOME": "/h"}, "/x/haros-ci"),
        (None, {"XDG_CACHE_HOME": "relative", "HOME": "/h"}, "/h/.cache/haros-ci"),
        (None, {"HOME": "/h"}, "/h/.cache/haros-ci"),
    ],
)
def test_where_it_lies(tmp_path: Path, choice: str | None, environment: dict[str, str], expected: str) -> None:
    named = Path(choice) if choice else None
    assert cache_directory(named, environment, tmp_path, explicit=choice is not None) == Path(expected)


@pytest.mark.parametrize("place", ["", "cache", "a/../cache", "link/cache"])
def test_inside_the_workspace_only_when_named(tmp_path: Path, place: str) -> None:
    root = tmp_path / "ws"
    (root / "target").mkdir(parents=True)
    (tmp_path / "link").symlink_to(root)
    inside = tmp_path / place if place.startswith("link") else root / place
    with pytest.raises(UserError, match="inside the workspace"):
        cache_directory(None, {"HAROS_CI_CACHE": str(inside)}, root, explicit=False)
    assert cache_directory(inside, {}, root, explicit=True).resolve().is_relative_to(root)


def test_a_link_planted_in_the_workspace_is_not_followed(tmp_path: Path) -> None:
    root = tmp_path / "ws"
    root.mkdir()
    (tmp_path / "home").mkdir()
    (root / "cache").symlink_to(tmp_path / "home")
    for place in (root / "cache", root / "cache" / "deep"):
        with pytest.raises(UserError):
            cache_directory(place, {}, root, explicit=True)


def test_a_link_of_the_user_outside_is_followed(tmp_path: Path) -> None:
    (tmp_path / "disk").mkdir()
    (tmp_path / "cache").symlink_to(tmp_path / "disk")
    (tmp_path / "ws").mkdir()
    place = cache_directory(tmp_path / "cache", {}, tmp_path / "ws", explicit=True)
    filled(place)
    assert len(list((tmp_path / "disk").iterdir())) == 1


def test_an_entry_is_read_when_it_is_asked_for(tmp_path: Path) -> None:
    """Others in its file may be anything: they are neither read nor lost."""
    first = DiskCache(tmp_path)
    paths = [f"p{number}" for number in range(200)]
    for path in paths:
        first.put("facts", path, "k", {"path": path, "text": 'a "quoted",\nline'})
    first.flush()
    file = max(tmp_path.iterdir(), key=lambda each: each.stat().st_size)
    lines = file.read_text().splitlines()
    broken = next(number for number, line in enumerate(lines) if line.startswith('"k p'))
    name = lines[broken].split('"')[1].partition(" ")[2]
    lines[broken] = f'"k {name}":[1,{{oops]' + ("," if lines[broken].endswith(",") else "")
    file.write_text("\n".join(lines) + "\n")

    second = DiskCache(tmp_path)
    found = {path: second.get("facts", path, "k") for path in paths}
    assert [path for path, value in found.items() if value is None] == [name]
    assert all(value == {"path": path, "text": 'a "quoted",\nline'} for path, value in found.items() if value)
    second.put("facts", name, "k", "anew")
    second.flush()
    third = DiskCache(tmp_path)
    assert third.get("facts", name, "k") == "anew"
    assert all(third.get("facts", path, "k") == value for path, value in found.items() if value)


@pytest.mark.parametrize("layout", [None, 1])
def test_entries_that_are_laid_out_in_another_way_are_read(tmp_path: Path, layout: int | None) -> None:
    first = DiskCache(tmp_path)
    first.put("facts", "p", "k", [1, "two"])
    first.flush()
    (file,) = tmp_path.iterdir()
    file.write_text(json.dumps(json.loads(file.read_text()), indent=layout))
    assert DiskCache(tmp_path).get("facts", "p", "k") == [1, "two"]
