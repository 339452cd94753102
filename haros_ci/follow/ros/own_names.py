# SPDX-License-Identifier: Apache-2.0
"""Which node's name and namespace a row of an API stands for where it is given no handle: a nodelet's, or its process's."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from haros_ci.follow.ros.selectors import Applied

#: Libraries whose rows are methods of nodelets.
_OF_NODELETS = frozenset(("nodelet", "nodelet_topic_tools", "jsk_topic_tools"))


def own_names(applied: Applied) -> tuple[str, str]:
    """The full name that ``~`` stands for in what the row makes, and the namespace of its relative names.

    A nodelet has a name of its own by its methods alone (``getNodeHandle``, ``getPrivateNodeHandle``). A library that makes its handles itself, and
    ``ros::param``, have the name of the process, which is the manager's (wiki.ros.org/nodelet). So has the handle of a nodelet at the root:
    ``ros::NodeHandle("/")`` stands for the namespace of the process (roscpp's names.cpp: ``clean("/")`` is empty).
    """
    context = applied.walk.context
    if not context.process_name or applied.row.call.partition("::")[0] in _OF_NODELETS:
        is_root = context.process_name and not context.namespace.strip("/")
        return context.name, context.process_namespace if is_root else context.namespace
    return context.process_name, context.process_namespace
