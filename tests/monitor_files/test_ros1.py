# SPDX-License-Identifier: Apache-2.0
"""Generated monitors beside a real ROS 1: verdicts on the topic, in the report, in the exit code; actions; no process is left."""

from __future__ import annotations

import json
import os
import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from monitor_files.ros1_kit import PATIENCE, Ros1, demand, line_of, ros1

from haros_ci.behaviour.parser import parse_property
from haros_ci.monitor_files.classes import Described
from haros_ci.monitor_files.monitor_file import Watched, monitor_file
from haros_ci.monitoring.patterns import monitor_of

DRIVER = str(Path(__file__).with_name("ros1_driver.py"))
PROPERTIES = {
    "holds": "globally: /level {data = 1} causes /level {data = 2} within 50 s",
    "late": "globally: /level {data = 3} causes /level {data = 4} within 100 ms",
    "never": "globally: no /level {data > 100}",
    "other": "globally: no /other {not data}",
}
TYPES = {"/level": "std_msgs/Int32", "/other": ""}  # the type of the latter comes from its publisher
ACTIONS = {
    "late": [{"publish": "/alarm", "type": "std_msgs/String", "message": {"data": "late"}}, {"log": "error"}],
    "*": [{"call": "/motors/off", "type": "roscpp/Empty", "message": {}}],
}


@pytest.fixture(scope="module")
def system(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Ros1]:
    demand()
    with ros1(tmp_path_factory.mktemp("ros1")) as running:
        described = [Described(monitor_of(parse_property(text)), name, text) for name, text in PROPERTIES.items()]
        text, _ = monitor_file(
            Watched("robot", 1, TYPES, {"/level": (("/driver", "driver.py", 7),)}, ACTIONS), described
        )
        (running.directory / "monitor_robot.py").write_text(text, encoding="utf-8")
        yield running
    assert all(process.poll() is not None for process in running.started)


def ran(
    system: Ros1, numbers: list[int], *flags: str, interrupt: bool = False
) -> tuple[int, dict[str, Any], dict[str, Any], str]:
    """Exit code and report of the monitor, what the driver saw, and the standard error of the monitor."""
    report = system.directory / "report.json"
    report.unlink(missing_ok=True)
    driver = system.start(
        DRIVER, "haros_ci_monitor_robot", "acts" if "--act" in flags else "watches", *map(str, numbers)
    )
    assert line_of(driver) == {"ready": True}
    monitor = system.start("monitor_robot.py", "--report", str(report), *flags)
    seen = line_of(driver)
    assert "trouble" not in seen, monitor.communicate()
    if interrupt:
        monitor.send_signal(signal.SIGINT)
    _, errors = monitor.communicate(timeout=PATIENCE)
    last, _ = driver.communicate("\n", timeout=PATIENCE)
    return monitor.returncode, json.loads(report.read_text(encoding="utf-8")), json.loads(last), errors


def verdicts(report: dict[str, Any]) -> dict[str, str]:
    return {one["id"]: one["verdict"] for one in report["properties"]}


def test_what_holds(system: Ros1) -> None:
    code, report, seen, _ = ran(system, [1, 2], interrupt=True)
    assert code == 0
    assert verdicts(report) == {"holds": "held", "late": "never exercised", "never": "held", "other": "held"}
    assert report["recording"]["topics"] == {"/level": 2, "/other": 1}
    assert seen["state"]["violated"] == 0 and seen["state"]["messages"] == 3
    assert {one["verdict"] for one in seen["state"]["properties"]} == {"open"}


def test_what_does_not_come_in_time_is_found_at_its_deadline(system: Ros1) -> None:
    code, report, seen, errors = ran(system, [1, 2, 3], "--stop-at-violation")
    assert code == 1
    assert verdicts(report) == {"holds": "held", "late": "violated", "never": "held", "other": "held"}
    late = next(one for one in report["properties"] if one["id"] == "late")
    (trigger,) = late["witnesses"]
    assert (trigger["role"], trigger["topic"], trigger["values"]) == ("trigger", "/level", {"data": 3})
    assert trigger["publishers"] == [{"node": "/driver", "path": "driver.py", "line": 7}]
    assert round(late["time"] - trigger["time"], 6) == 0.1
    assert seen["state"]["violated"] == 1 and "violated: late" in errors
    assert (seen["alarms"], seen["calls"]) == ([], 0) and "nothing is done without --act" in errors


def test_what_must_not_come_is_found_at_once_and_actions_are_done(system: Ros1) -> None:
    code, report, seen, errors = ran(system, [3], "--act", interrupt=True)
    assert code == 1 and verdicts(report)["late"] == "violated"
    assert "nothing is done" not in errors
    assert seen["alarms"] == ["late"] and seen["calls"] == 1


def test_time_that_is_over_ends_it(system: Ros1) -> None:
    monitor = system.start("monitor_robot.py", "--duration", "0.3")
    out, errors = monitor.communicate(timeout=PATIENCE)
    assert monitor.returncode == 0, errors
    assert out.endswith("0 held, 0 violated, 4 never exercised, 0 undecided\n")


def test_without_a_master_it_says_so(system: Ros1) -> None:
    monitor = Ros1(system.directory).start("monitor_robot.py")
    _, errors = monitor.communicate(timeout=PATIENCE)
    assert monitor.returncode == 3 and "no master answers" in errors


def test_no_process_is_left(system: Ros1) -> None:
    running = [process.pid for process in system.started[1:] if process.poll() is None]
    assert running == [] and all(not os.path.exists(f"/proc/{process.pid}") for process in system.started[1:])
