# SPDX-License-Identifier: Apache-2.0
"""Builds the pages as a site: ``python tools/build_site.py DIRECTORY``, with what .ci/site-requirements.txt names.

The site has the paths of the repository, so that a relative link means the same on both. A link to what is no page of the site leads to
the repository's web view.
"""

from __future__ import annotations

import posixpath
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SETTINGS = ROOT / "tools" / "site.yml"
WEB = "https://github.com/haros-ci/haros-ci"

#: Pages, pictures and data that pages lead to.
SHOWN = (
    "*.md",
    "docs/**/*.md",
    "docs/pictures/*",
    "docs/workflows/*",
    "docs/**/*.jsonl",
    "checks/*.md",
    "examples/README.md",
)
_FENCE = re.compile(r"\s*(?:```|~~~)")
_LINK = re.compile(r"(\]\()([^)\s#]+)((?:#[^)\s]*)?\))")
_ITEM = re.compile(r"(?:[-*]|\d{1,3}\.) ")
#: An item of a list in a list, which Python-Markdown sees from four spaces on.
_INNER = re.compile(r" {2,3}(?=(?:[-*]|\d{1,3}\.) )")
_ENTRY = re.compile(r"^( *- )(?:[^:\n]+: )?([\w./-]+/)\*$", re.M)


def shown() -> list[str]:
    """The paths of all files of the site, relative to the repository."""
    found = {path.relative_to(ROOT).as_posix() for glob in SHOWN for path in ROOT.glob(glob) if path.is_file()}
    return sorted(found)


def page_for_site(path: str, text: str, there: Iterable[str]) -> str:
    """The Markdown of a page as mkdocs reads it like the web view does: links to what is not *there* lead to the repository."""
    there = frozenset(there)

    def led(match: re.Match[str]) -> str:
        target = match[2]
        full = posixpath.normpath(posixpath.join(posixpath.dirname(path), target))
        if "://" in target or target.startswith("mailto:") or full in there or not (ROOT / full).exists():
            return match[0]
        if (ROOT / full).is_dir():
            index = f"{full}/README.md"
            if index in there:
                return f"{match[1]}{target.rstrip('/')}/README.md{match[3]}"
            return f"{match[1]}{WEB}/tree/main/{full}{match[3]}"
        return f"{match[1]}{WEB}/blob/main/{full}{match[3]}"

    return "\n".join(_lines(text.splitlines(), led)) + "\n"


def _lines(lines: Iterable[str], led: Callable[[re.Match[str]], str]) -> Iterator[str]:
    is_code, before = False, ""
    for line in lines:
        if _FENCE.match(line):
            is_code = not is_code
        elif not is_code:
            if _ITEM.match(line) and before.strip() and not _ITEM.match(before) and before[0] not in " |#<":
                yield ""  # Python-Markdown begins no list within a paragraph
            line = _INNER.sub("    ", line, count=1) if _INNER.match(line) else line
            line = _LINK.sub(led, line)
        yield line
        before = line


def settings(pages: Iterable[str], places: dict[str, str]) -> str:
    """The configuration with all pages in the navigation; *places* are absolute directories by key."""
    text = SETTINGS.read_text(encoding="utf-8")
    named = set(re.findall(r"[\w./-]+\.md\b", text))

    def all_of(match: re.Match[str]) -> str:
        indent = " " * (len(match[1]) + 2)
        head = match[0].rpartition(":")[0]
        rest = (page for page in pages if posixpath.dirname(page) + "/" == match[2] and page not in named)
        return "\n".join((f"{head}:", *(f"{indent}- {page}" for page in rest if page.endswith(".md"))))

    head = "".join(f"{key}: {place}\n" for key, place in places.items())
    return head + _ENTRY.sub(all_of, text)


def build(target: Path) -> int:
    """Build the site in *target*, which is made anew; the exit code of mkdocs."""
    with tempfile.TemporaryDirectory() as scratch:
        pages = shown()
        for path in pages:
            place = Path(scratch, "pages", path)
            place.parent.mkdir(parents=True, exist_ok=True)
            if path.endswith(".md"):
                text = (ROOT / path).read_text(encoding="utf-8")
                place.write_text(page_for_site(path, text, pages), encoding="utf-8")
            else:
                shutil.copyfile(ROOT / path, place)
        places = {"docs_dir": f"{scratch}/pages", "site_dir": str(target.resolve())}
        Path(scratch, "mkdocs.yml").write_text(settings(pages, places), encoding="utf-8")
        command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--config-file", f"{scratch}/mkdocs.yml"]
        return subprocess.run(command, check=False).returncode


if __name__ == "__main__":
    sys.exit(build(Path(sys.argv[1])))
