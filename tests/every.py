# SPDX-License-Identifier: Apache-2.0
"""One test that looks at every row of a table: hundreds of rows are one test to collect and report, and the ones that fail are all named."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterable
from typing import Any

import pytest

#: How many of the failures are shown with their message; the others are counted.
SHOWN = 20


def every(
    names: str | tuple[str, ...], cases: Iterable[Any], ids: Callable[[Any], str] = str
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """As ``pytest.mark.parametrize`` with *names* and *cases*, in one test that goes on after a failure.

    *ids* makes the name of a case. The test gets its fixtures once, so it is for bodies that leave nothing behind. Fails where there is no case;
    cases that skip themselves are named once the others have passed.
    """

    def decorate(test: Callable[..., None]) -> Callable[..., None]:
        argument_names = (names,) if isinstance(names, str) else names

        @functools.wraps(test)
        def over_all(**fixtures: Any) -> None:
            failures: list[tuple[str, BaseException]] = []
            skipped: list[str] = []
            count = 0
            for case in cases:
                count += 1
                values = (case,) if isinstance(names, str) else case
                try:
                    test(**fixtures, **dict(zip(argument_names, values, strict=True)))
                except pytest.skip.Exception as reason:
                    skipped.append(f"{ids(case)}: {reason}")
                except (Exception, pytest.fail.Exception) as error:  # noqa: BLE001 - every failure is named, the first one with its traceback
                    failures.append((ids(case), error))
            assert count, "there is nothing to look at"
            if failures:
                shown = [f"{name}: {type(error).__name__}: {error}" for name, error in failures[:SHOWN]]
                text = "\n".join((f"{len(failures)} of {count} fail", *shown))
                raise AssertionError(text) from failures[0][1]
            if skipped:
                pytest.skip("; ".join((f"{len(skipped)} of {count}", *skipped[:SHOWN])))

        signature = inspect.signature(test)
        kept = [parameter for name, parameter in signature.parameters.items() if name not in argument_names]
        over_all.__signature__ = signature.replace(parameters=kept)  # type: ignore[attr-defined]  # what pytest reads for fixtures
        del over_all.__wrapped__  # type: ignore[attr-defined]  # or pytest looks at the signature of the body
        return over_all

    return decorate
