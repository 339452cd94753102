# SPDX-License-Identifier: Apache-2.0
"""The wrapper for rclpy against a module of our own that has the calls of rclpy that it makes: what it makes of the system, and what it does."""

from __future__ import annotations

import ast
import json
import sys
import types
from pathlib import Path
from typing import Any

import pytest

from haros_ci.behaviour.parser import parse_property
from haros_ci.commands.monitor_generate import requested
from haros_ci.extract.apis import ros2_node, ros2_rclpy
from haros_ci.model.architecture import Qos
from haros_ci.monitor_files.classes import Described
from haros_ci.monitor_files.monitor_file import Watched, monitor_file, type_name
from haros_ci.monitoring.patterns import monitor_of

PROPERTIES = {
    "late": "globally: /level {data = 3} causes /level {data = 4} within 100 ms",
    "never": "globally: no /level {data > 100}",
    "unknown": "globally: no /unknown",
}
ACTIONS = {
    "never": [{"publish": "/alarm", "type": "std_msgs/msg/Bool", "message": {"data": True}}, {"log": "error"}],
    "*": [{"call": "/off", "type": "std_srvs/srv/Empty", "message": {}}],
}


class Level:
    def __init__(self, data: Any = None) -> None:
        self.data = data

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        return {"data": "int32"}


class Fake:
    """What a node of rclpy was asked for. The system sends *numbers* while the node spins, and is shut down behind them."""

    def __init__(self, numbers: list[int]) -> None:
        self.numbers = numbers
        self.is_up = False
        self.subscriptions: dict[str, tuple[Any, Any, Any]] = {}
        self.published: list[tuple[str, Any]] = []
        self.called: list[str] = []
        self.said: list[str] = []
        self.time = 0

    def modules(self) -> dict[str, types.ModuleType]:
        fake = self

        class Node:
            def create_publisher(self, kind: Any, name: str, qos: Any) -> Any:
                return types.SimpleNamespace(publish=lambda message: fake.published.append((name, message)))

            def create_subscription(self, kind: Any, name: str, callback: Any, qos: Any) -> Any:
                fake.subscriptions[name] = kind, callback, qos

            def create_client(self, kind: Any, name: str) -> Any:
                return types.SimpleNamespace(
                    service_is_ready=lambda: True, call_async=lambda request: fake.called.append(name)
                )

            def get_logger(self) -> Any:
                return types.SimpleNamespace(**dict.fromkeys(("info", "warning", "error", "fatal"), fake.said.append))

            def get_clock(self) -> Any:
                return types.SimpleNamespace(now=lambda: types.SimpleNamespace(nanoseconds=fake.time))

        def spin(node: Any) -> None:
            for number in fake.numbers:
                fake.time += 10_000_000
                fake.subscriptions["/level"][1](Level(number))
            fake.is_up = False

        def init(args: Any = None) -> None:
            fake.is_up = True

        def profile(**given: Any) -> Any:
            return types.SimpleNamespace(**given)

        words = {
            "RELIABLE": "reliable",
            "BEST_EFFORT": "best_effort",
            "TRANSIENT_LOCAL": "transient_local",
            "VOLATILE": "volatile",
            "KEEP_LAST": "keep_last",
        }
        policy = types.SimpleNamespace(**words)
        contents: dict[str, dict[str, Any]] = {
            "rclpy": {
                "init": init,
                "ok": lambda: fake.is_up,
                "create_node": lambda name: Node(),
                "spin": spin,
                "try_shutdown": lambda: None,
            },
            "rclpy.executors": {"ExternalShutdownException": type("ExternalShutdownException", (Exception,), {})},
            "rclpy.qos": {
                "QoSProfile": profile,
                "DurabilityPolicy": policy,
                "ReliabilityPolicy": policy,
                "HistoryPolicy": policy,
            },
            "rosidl_runtime_py": {},
            "rosidl_runtime_py.utilities": {
                "get_message": lambda name: Level,
                "get_service": lambda name: types.SimpleNamespace(Request=Level),
            },
            "rosidl_runtime_py.set_message": {
                "set_message_fields": lambda message, values: vars(message).update(values)
            },
            "std_msgs": {},
            "std_msgs.msg": {"String": Level},
        }
        made = {}
        for name, entries in contents.items():
            made[name] = types.ModuleType(name)
            vars(made[name]).update(entries)
        return made


def text() -> str:
    described = [Described(monitor_of(parse_property(text)), name, text) for name, text in PROPERTIES.items()]
    watched = Watched(
        "robot",
        2,
        {"/level": "std_msgs/msg/Int32", "/unknown": ""},
        {},
        ACTIONS,
        {"/level": {"reliability": "reliable"}},
    )
    return monitor_file(watched, described)[0]


def ran(
    numbers: list[int], monkeypatch: pytest.MonkeyPatch, directory: Path, *flags: str
) -> tuple[int, dict[str, str], Fake]:
    fake = Fake(numbers)
    for name, module in fake.modules().items():
        monkeypatch.setitem(sys.modules, name, module)
    found: dict[str, Any] = {"__name__": "generated"}
    module = types.ModuleType("generated")
    monkeypatch.setitem(sys.modules, "generated", module)
    exec(text(), vars(module))
    found = vars(module)
    report = directory / "report.json"
    code = found["main"](found["SYSTEM"], found["PROPERTIES"], found["run_rclpy"], ["--report", str(report), *flags])
    document = json.loads(report.read_text(encoding="utf-8"))
    return code, {one["id"]: one["verdict"] for one in document["properties"]}, fake


def test_what_holds(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    code, verdicts, fake = ran([3, 4], monkeypatch, tmp_path)
    assert (code, verdicts) == (0, {"late": "held", "never": "held", "unknown": "undecided"})
    kind, _, qos = fake.subscriptions["/level"]
    assert kind is Level and (qos.reliability, qos.durability, qos.history) == ("reliable", "volatile", "keep_last")
    assert "/unknown" not in fake.subscriptions


def test_what_is_violated(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    code, verdicts, fake = ran([3, 4, 101], monkeypatch, tmp_path, "--act")
    assert (code, verdicts["never"]) == (1, "violated")
    assert fake.called == ["/off"]
    assert [(name, message.data) for name, message in fake.published if name == "/alarm"] == [("/alarm", True)]
    states = [json.loads(message.data) for name, message in fake.published if name == "~/verdicts"]
    assert states[-1]["violated"] == 1 and any("violated: never" in line for line in fake.said)


def test_nothing_is_done_without_the_flag(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    _, _, fake = ran([101], monkeypatch, tmp_path)
    assert fake.called == [] and {name for name, _ in fake.published} == {"~/verdicts"}


def test_calls_are_those_of_the_tables() -> None:
    """What the wrapper calls of a node is what the extraction knows of rclpy's nodes."""
    rows = {str(row.get("call", "")).rpartition(".")[2] for table in (ros2_rclpy.ROWS, ros2_node.ROWS) for row in table}
    called = {
        node.func.attr
        for node in ast.walk(ast.parse(text()))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute)
    }
    assert {name for name in called if name.startswith("create_")} <= rows


@pytest.mark.parametrize(
    ("offered", "expected"),
    [
        ([], {}),
        ([None], {}),
        ([Qos()], {"reliability": "reliable"}),
        ([Qos(reliability="reliable"), Qos(reliability="best_effort")], {}),
        ([Qos(reliability="?")], {}),
        ([Qos(reliability="best_available")], {}),
        ([Qos(reliability="reliable"), None], {}),
        ([Qos(durability="transient_local")], {"reliability": "reliable", "durability": "transient_local"}),
        ([Qos(durability="transient_local"), Qos()], {"reliability": "reliable"}),
    ],
)
def test_subscriptions_fit_the_publishers(offered: list[Any], expected: dict[str, str]) -> None:
    assert requested(offered) == expected


@pytest.mark.parametrize(
    ("types_", "ros", "name"),
    [
        (("a/B",), 1, "a/B"),
        (("a/msg/B",), 1, "a/B"),
        (("a/B",), 2, "a/msg/B"),
        (("a/B", "a/C"), 2, ""),
        ((), 1, ""),
        (None, 1, ""),
        (("a?/B",), 1, ""),
    ],
)
def test_names_of_types(types_: Any, ros: int, name: str) -> None:
    assert type_name(types_, ros) == name


def test_python_3_8_reads_it() -> None:
    ast.parse(text(), feature_version=(3, 8))
