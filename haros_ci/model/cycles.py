# SPDX-License-Identifier: Apache-2.0
"""Circles of names that need each other."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, TypeVar

Name = TypeVar("Name", bound=Any)


def circles(graph: Mapping[Name, Iterable[Name]]) -> Iterator[frozenset[Name]]:
    """The strongly connected components of more than one name, in the order of *graph*."""
    return (group for group in components(graph) if len(group) > 1)


def components(graph: Mapping[Name, Iterable[Name]]) -> Iterator[frozenset[Name]]:
    """The strongly connected components of *graph* (Tarjan 1972, without recursion): all that one leads to comes before it."""
    index: dict[Name, int] = {}
    low: dict[Name, int] = {}
    stack: list[Name] = []
    held: set[Name] = set()
    for root in graph:
        if root in index:
            continue
        work = [(root, iter(graph[root]))]
        while work:
            name, rest = work[-1]
            if name not in index:
                index[name] = low[name] = len(index)
                stack.append(name)
                held.add(name)
            for other in rest:
                if other not in index:
                    work.append((other, iter(graph.get(other, ()))))
                    break
                if other in held:
                    low[name] = min(low[name], index[other])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[name])
                if low[name] == index[name]:
                    group = {stack.pop()}
                    while name not in group:
                        group.add(stack.pop())
                    held -= group
                    yield frozenset(group)


def in_circles(graph: Mapping[Name, Iterable[Name]]) -> dict[Name, int]:
    """The names that need themselves through others, with the number of their circle from 0; the same for the same *graph*."""
    ordered = {name: sorted(graph[name]) for name in sorted(graph)}
    return {name: number for number, group in enumerate(circles(ordered)) for name in group}
