# SPDX-License-Identifier: Apache-2.0
"""Algorithms of C++ call a function that they are given before they return, for the elements of a list (en.cppreference.com/w/cpp/algorithm)."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from haros_ci.follow import activation, unknown_calls
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.values.abstract import NONE, Callable

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: Algorithms that take a function, a predicate or a comparison.
ALGORITHMS = frozenset(
    f"std::{space}{name}"
    for space in ("", "ranges::")
    for name in "accumulate adjacent_difference adjacent_find all_of any_of binary_search copy_if count_if equal equal_range exclusive_scan "
    "find_end find_first_of find_if find_if_not for_each for_each_n generate generate_n includes inclusive_scan inner_product inplace_merge "
    "is_heap is_partitioned is_permutation is_sorted lexicographical_compare lower_bound make_heap max max_element merge min min_element "
    "minmax_element mismatch none_of nth_element partial_sort partial_sum partition partition_copy partition_point pop_heap push_heap reduce "
    "remove_copy_if remove_if replace_copy_if replace_if search set_difference set_intersection set_union sort sort_heap stable_partition "
    "stable_sort transform transform_reduce unique unique_copy upper_bound".split()
)


def applied(walk: Walk, frame: Frame, name: str, args: tuple[PassedArgument, ...]) -> None:
    """What the functions among *args* make where the algorithm *name* calls them: its list may be empty, and what is in it is not known.

    What they change is forgotten before (``unknown_calls.called``), as they may be called several times.
    """
    for argument in args:
        function = argument.value
        if not isinstance(function, Callable) or not walk.relevance.makes(function.function, function.source):
            continue
        given = unknown_calls.unknown_arguments(walk, frame, name, function)
        walk.either_way(
            [lambda: NONE, partial(activation.invoke, walk, frame, function, given)],
            f"{name} goes through what is not known",
        )
