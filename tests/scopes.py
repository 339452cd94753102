# SPDX-License-Identifier: Apache-2.0
"""How processes of pytest-xdist share the tests with ``--dist loadscope``: module by module, slow ones first.

The scheduler of pytest-xdist takes what stands before the last ``::`` for the module, and so divides those that have C++ names in the names of
their cases: fixtures of such a module were made again and again, in each process. For each test it also looks through all that were given out.
"""

from __future__ import annotations

from collections import OrderedDict
from typing import Any

from tiers import TESTS, is_slow
from xdist.scheduler import LoadScopeScheduling
from xdist.workermanage import WorkerController

#: The tests of a scope, and whether each has run.
Unit = dict[str, bool]


class Modules(LoadScopeScheduling):
    """The same in a time that is linear in the tests, and what takes long is not left for the end, where one process waits for the other."""

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self._is_sorted = False
        self._places: dict[WorkerController, dict[str, int]] = {}

    def _split_scope(self, nodeid: str) -> str:
        return scope_of(nodeid)

    def _assign_work_unit(self, node: WorkerController) -> None:
        if not self._is_sorted:
            self.workqueue = OrderedDict(sorted(self.workqueue.items(), key=lambda item: not has_slow(item[0])))
            self._is_sorted = True
        if node not in self._places:
            self._places[node] = {nodeid: number for number, nodeid in enumerate(self.registered_collections[node])}
        scope, unit = self.workqueue.popitem(last=False)
        self.assigned_work.setdefault(node, {})[scope] = unit
        node.send_runtest_some([self._places[node][nodeid] for nodeid, is_done in unit.items() if not is_done])

    def _pending_of(self, workload: dict[str, Unit]) -> int:
        for scope in [scope for scope, unit in workload.items() if all(unit.values())]:
            del workload[scope]
        return int(super()._pending_of(workload))


def scope_of(nodeid: str) -> str:
    """The module of a test, or its class; names of cases may have ``::`` in them, and those of directories no bracket."""
    return nodeid.partition("[")[0].rpartition("::")[0]


def has_slow(scope: str) -> bool:
    """Whether the tests of a scope are of the slow tier; *scope* begins with a path below the repository's root."""
    return is_slow(TESTS.parent / scope.partition("::")[0])
