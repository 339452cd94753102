# SPDX-License-Identifier: Apache-2.0
"""One browser for all modules of a process, and a page in it that has nothing to complain about in the end."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from browser_kit import Page, browser
from page_kit import given, written


@pytest.fixture(scope="session")
def driver() -> Iterator[Any]:
    yield from browser()


@pytest.fixture(scope="session")
def plain(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("plain") / "page.html"
    path.write_text(written(given()), encoding="utf-8")
    return path


@pytest.fixture
def page(driver: Any, plain: Path) -> Iterator[Page]:
    made = Page(driver, plain)
    made.settled()
    yield made
    assert made.complaints() == []
