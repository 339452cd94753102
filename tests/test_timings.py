# SPDX-License-Identifier: Apache-2.0
"""``--timings``: every moment belongs to one stage, so that stages add up to the whole."""

from __future__ import annotations

import re
import threading
from itertools import count
from pathlib import Path

import pytest
from commandline import haros
from test_missing_files_off_by_default import ros2

from haros_ci.timing import NOTHING, OTHER, Clock, Spent, remark, running, side_by_side, stage, timed

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"
LINE = re.compile(r" *(\d+\.\d{3}) +(-?\d+\.\d{3})  (  )?(.+)")
#: What the table may be off: each of its numbers is rounded.
ROUNDED = 0.0005


def ticking() -> Clock:
    """A clock that goes on by one second, and by half a second of a processor, whenever it is looked at."""
    seconds = count()
    return Clock(now=lambda: (lambda second: Spent(second, second / 2))(float(next(seconds))))


def whole(clock: Clock, name: str) -> Spent:
    """What a stage has taken."""
    found = NOTHING
    for each in clock.spent[name].values():
        found = found.plus(each)
    return found


class TestAClock:
    def test_a_stage_within_another_interrupts_it(self) -> None:
        clock = ticking()
        with running(clock), stage("outer"):
            with stage("inner"):
                pass
            with stage("inner"):
                pass
        assert (whole(clock, "outer").wall, whole(clock, "inner").wall) == (3.0, 2.0)

    def test_stages_add_up_to_the_whole(self) -> None:
        clock = ticking()
        with running(clock):
            for name in ("a", "b", "a"):
                with stage(name, "part"), stage("c"), stage(name):
                    pass
        first = clock.total()
        clock.charge()
        assert clock.total() == first.plus(Spent(1.0, 0.5))
        assert clock.total() == Spent(clock._since.wall, clock._since.cpu)

    def test_what_ends_by_an_exception_has_ended(self) -> None:
        clock = ticking()
        with running(clock), pytest.raises(KeyError), stage("a"), stage("b"):
            raise KeyError
        with running(clock), stage("c"):
            pass
        clock.charge()
        assert {name: whole(clock, name).wall for name in clock.spent} == {OTHER: 3.0, "a": 2.0, "b": 1.0, "c": 1.0}

    def test_a_whole_stage_has_all_that_begins_within_it(self) -> None:
        clock = ticking()
        with running(clock), stage("checks", "one"), stage("variants", whole=True), stage("launch"), stage("follow"):
            pass
        assert set(clock.spent) == {OTHER, "checks", "variants"}

    def test_other_threads_do_not_turn_it(self) -> None:
        clock = ticking()

        @timed("elsewhere")
        def work() -> None:
            with stage("elsewhere"):
                remark("elsewhere")

        with running(clock), stage("here"):
            thread = threading.Thread(target=work)
            thread.start()
            thread.join()
        assert "elsewhere" not in clock.spent and not clock.remarks

    def test_without_a_clock_nothing_happens(self) -> None:
        with stage("a"):
            remark("nothing")
            side_by_side("a", "b", NOTHING)

    def test_parts_side_by_side_share_the_wall_of_their_stage(self) -> None:
        clock = ticking()
        with running(clock), stage("linters"):
            side_by_side("linters", "one", Spent(9.0, 7.0))
            side_by_side("linters", "two", Spent(3.0, 2.0))
        whole_one = whole(clock, "linters").wall
        assert clock.parts("linters") == {"one": Spent(whole_one * 0.75, 7.0), "two": Spent(whole_one * 0.25, 2.0)}

    def test_ten_parts_are_listed_and_the_rest_is_one_line(self) -> None:
        clock = ticking()
        with running(clock), stage("checks"):
            for number in range(13):
                for _ in range(number):
                    with stage("checks", f"c{number:02}"):
                        pass
        lines = [found.groups() for found in map(LINE.match, clock.lines()) if found]
        parts = [what for _, _, inner, what in lines if inner]
        assert parts == [*(f"c{number:02}" for number in range(12, 2, -1)), "the other 2, and what is of none"]
        of_parts = sum(float(wall) for wall, _, inner, _ in lines if inner)
        assert of_parts == whole(clock, "checks").wall


def table(stderr: str) -> list[tuple[float, bool, str]]:
    """Seconds on the wall, whether it is a part, and of what."""
    _, _, said = stderr.rpartition("  wall s    CPU s  stage\n")
    return [
        (float(wall), bool(inner), what)
        for wall, _, inner, what in (m.groups() for m in map(LINE.fullmatch, said.splitlines()) if m)
    ]


def is_whole(lines: list[tuple[float, bool, str]]) -> bool:
    """Whether the stages add up to the last line."""
    *stages, (total, _, last) = lines
    each = [wall for wall, inner, _ in stages if not inner]
    return last.startswith("done; cache: ") and abs(sum(each) - total) <= ROUNDED * (len(each) + 1)


@pytest.mark.parametrize(
    ("command", "expected"),
    [
        (["check", "--profile", "all"], {"discover", "build files", "parse", "index", "launch", "follow", "checks", "linters", "findings", "render", OTHER}),
        (["model"], {"settings", "discover", "build files", "parse", "index", "launch", "follow", "link", "render", OTHER}),
    ],
)  # fmt: skip
def test_a_run_says_where_its_time_went(command: list[str], expected: set[str], tmp_path: Path) -> None:
    done = haros(*command, "--timings", "--cache-dir", str(tmp_path / "cache"), cwd=EXAMPLES / "legacy_ws")
    lines = table(done.stderr)
    assert is_whole(lines), done.stderr
    names = {what for _, inner, what in lines if not inner}
    assert expected | {"cache"} <= names
    parts = {what for _, inner, what in lines if inner}
    assert command != ["model"] or not parts
    assert command[0] != "check" or {"pylint", "cppcheck"} <= parts


def test_systems_under_other_arguments_are_no_part_of_checks(tmp_path: Path) -> None:
    """What a check makes of a system only under other launch arguments is followed for it, and told by itself."""
    for name, text in ros2('if="$(var sim)"').items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    done = haros("check", "--profile", "architecture", "--no-cache", "--timings", cwd=tmp_path)
    names = {what for _, inner, what in table(done.stderr) if not inner}
    assert {"checks", "variants", "confirmations"} <= names, done.stdout + done.stderr
