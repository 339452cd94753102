# SPDX-License-Identifier: Apache-2.0
"""A browser without a window that opens pages from disk; without one, tests are skipped where none is demanded."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from itertools import count
from pathlib import Path
from typing import Any

import pytest

#: Set where tests must not be skipped.
DEMANDED = "HAROS_CI_BROWSER"
#: Milliseconds after which the page has looked up what was typed.
WAIT = 90
_TIMES = count()


def missing() -> str:
    """What keeps a browser from being started, "" for nothing."""
    try:
        import selenium  # noqa: F401
    except ImportError:
        return "selenium is not installed"
    names = [name for name in ("chromium", "chromedriver") if shutil.which(name) is None]
    return f"not installed: {', '.join(names)}" if names else ""


def browser(size: str = "1400,900") -> Iterator[Any]:
    """A driver; the test is skipped with the reason if there is none, or fails where one is demanded."""
    why = missing()
    if why and os.environ.get(DEMANDED):
        pytest.fail(why)
    if why:
        pytest.skip(why)
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    options.binary_location = str(shutil.which("chromium"))
    for word in (
        "--headless=new",
        "--no-sandbox",
        "--disable-gpu",
        "--disable-dev-shm-usage",
        "--disable-background-networking",
        f"--window-size={size}",
    ):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(str(shutil.which("chromedriver"))))
    try:
        driver.set_script_timeout(30)
        yield driver
    finally:
        driver.quit()


class Page:
    """A page that is open, and what can be done with it."""

    def __init__(self, driver: Any, path: Path, place: str = "") -> None:
        self.driver = driver
        self.path = path
        # Another query makes it another document: it is read anew even where only the place differs.
        driver.get(f"{path.as_uri()}?{next(_TIMES)}{f'#{place}' if place else ''}")

    def run(self, script: str, *given: Any) -> Any:
        """What a script returns; it runs as the tester's, whatever the page allows its own."""
        return self.driver.execute_script(script, *given)

    def settled(self, milliseconds: int = 0) -> None:
        """After the frames that the page has asked for, and so long a wait before."""
        self.driver.execute_async_script(
            "const [wait, done] = arguments;"
            " setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 0))), wait);",
            milliseconds,
        )

    def go(self, place: str) -> None:
        self.run("location.hash = arguments[0]", place)
        self.settled()

    def all(self, selector: str) -> list[Any]:
        return list(self.driver.find_elements("css selector", selector))

    def text(self, selector: str = "main") -> str:
        return str(
            self.run(
                "return [...document.querySelectorAll(arguments[0])].map((one) => one.textContent).join('\\n')",
                selector,
            )
        )

    def click(self, selector: str, words: str = "") -> None:
        """Click on the first that has these *words*."""
        found = self.run(
            "const one = [...document.querySelectorAll(arguments[0])].find((each) => each.textContent.includes(arguments[1]));"
            " if (one) one.dispatchEvent(new MouseEvent('click', { bubbles: true })); return Boolean(one);",
            selector,
            words,
        )
        assert found, f"no {selector} with {words!r}"
        self.settled()

    def type(self, selector: str, words: str) -> None:
        (field,) = self.all(selector)
        field.clear()
        field.send_keys(words)
        self.settled(WAIT)

    def key(self, name: str) -> None:
        from selenium.webdriver.common.action_chains import ActionChains

        ActionChains(self.driver).send_keys(name).perform()
        self.settled(WAIT)

    def complaints(self) -> list[str]:
        """What the console says."""
        return [entry["message"] for entry in self.driver.get_log("browser")]
