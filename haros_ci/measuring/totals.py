# SPDX-License-Identifier: Apache-2.0
"""From the values of functions, classes and files to those of files and packages."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence

from haros_ci.model.measurement import Measurement

Combine = Callable[[Sequence[float]], float]


def mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)


#: How the values of functions and classes become one of their file, where files have none of their own.
OF_FILE: dict[str, Combine] = {
    "function-calls": sum,
    "unique-function-calls": max,
    "function-parameters": max,
    "nested-control": max,
    "static-path-count": max,
    "coupling": max,
    "depth-in-tree": max,
    "number-of-children": max,
    "weighted-methods": max,
    "methods-available": max,
}
#: How the values of files become one of their package. The comment ratio is made of its sums.
OF_PACKAGE: dict[str, Combine] = {
    **OF_FILE,
    "cyclomatic-complexity": sum,
    "comments": sum,
    "ploc": sum,
    "sloc": sum,
    "lloc": sum,
    "eloc": sum,
    "halstead-volume": sum,
    "halstead-time": sum,
    "halstead-bugs": sum,
    "maintainability-index": mean,
}


#: All metrics, as HAROS names them but with hyphens.
METRICS = frozenset(OF_PACKAGE) | {"comment-ratio"}


def of_files(values: Iterable[Measurement]) -> Iterator[Measurement]:
    """The values of files that follow from those of their functions and classes."""
    together: dict[tuple[str, str, str], list[float]] = defaultdict(list)
    for value in values:
        if (value.function or value.class_name) and value.metric in OF_FILE:
            together[value.package, value.path, value.metric].append(value.value)
    for (package, path, metric), found in together.items():
        yield Measurement(package, path, 0, "", "", metric, OF_FILE[metric](found))


def of_packages(values: Iterable[Measurement]) -> Iterator[Measurement]:
    """The values of packages from those of their files."""
    together: dict[tuple[str, str], list[float]] = defaultdict(list)
    for value in values:
        if value.package and value.path and not value.function and not value.class_name:
            together[value.package, value.metric].append(value.value)
    for (package, metric), found in sorted(together.items()):
        combine = OF_PACKAGE.get(metric)
        if combine is not None:
            yield Measurement(package, "", 0, "", "", metric, combine(found))
        elif metric == "comment-ratio":
            lines = sum(together.get((package, "sloc"), ()))
            yield Measurement(
                package, "", 0, "", "", metric, sum(together.get((package, "comments"), ())) / lines if lines else 0.0
            )
