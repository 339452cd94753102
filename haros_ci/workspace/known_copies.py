# SPDX-License-Identifier: Apache-2.0
"""Single files of well-known libraries and tools, which projects copy among their own sources, often without the licence beside them."""

from __future__ import annotations

import re

from haros_ci.regex import regex
from haros_ci.workspace.generated import leading_comment

#: Fewer lines have only wrappers, whose comments may name the library, too.
SHORTEST = 100
#: The last part of a file's name, what its first comment says if it is the library's own, and how packages of the library are called.
#: Both must fit: a name alone is anybody's.
_TABLE: tuple[tuple[str, str, str], ...] = (
    (
        r"json(?:_fwd)?\.hpp",
        r"Copyright.{0,40}Niels Lohmann|\bJSON for Modern C\+\+\s+(?:\S+\s+){0,8}version \d",
        "json",
    ),
    (
        r"stb_\w+\.[ch]|imstb_\w+\.h|stb_vorbis\.c",
        r"nothings\.org|\bpublic domain\b.{0,80}\bSean Barrett|\[DEAR IMGUI\]",
        "stb",
    ),
    (r"httplib\.h", r"Copyright.{0,40}\bYuji Hirose", "httplib"),
    (r"pugi(?:xml|config)\.[ch]pp", r"Copyright.{0,60}\bArseny Kapoulkine", "pugixml"),
    (r"tinyxml2\.(?:h|cpp|cc)", r"\bOriginal code by Lee Thomason\b", "tinyxml2"),
    (
        r"tinyxml(?:error|parser)?\.(?:h|cpp|cc)|tinystr\.(?:h|cpp)",
        r"sourceforge\.net/projects/tinyxml|\bOriginal code by Lee Thomason\b",
        "tinyxml",
    ),
    (r"catch2?\.hpp|catch_amalgamated\.[ch]pp", r"Copyright.{0,60}\b(?:Two Blue Cubes|Catch2 Authors)", "catch"),
    (r"doctest\.h", r"Copyright.{0,40}\bViktor Kirilov", "doctest"),
    (r"cxxopts\.hpp", r"Copyright.{0,60}\bJarryd Beck", "cxxopts"),
    (r"argparse\.h(?:pp)?", r"Copyright.{0,60}\bPranav Srinivas Kumar|github\.com/p-ranav/argparse", "argparse"),
    (
        r"jsoncpp\.cpp|json(?:-forwards)?\.h",
        r"\bJson-?cpp amalgam(?:at)?ed\b|\bJsonCpp\b.{0,200}\bBaptiste Lepilleur",
        "jsoncpp",
    ),
    (r"lodepng\.(?:h|c|cpp)", r"Copyright.{0,40}\bLode Vandevenne", "lodepng"),
    (r"miniz\w*\.[ch]", r"\bRich Geldreich\b|\bminiz\.c \d", "miniz"),
    (r"imgui\w*\.(?:h|cpp)", r"\bdear imgui[,:]", "imgui"),
    (r"rapidxml\w*\.hpp", r"Copyright.{0,40}\bMarcin Kalicinski", "rapidxml"),
    (r"picojson\.h", r"Copyright.{0,60}\b(?:Cybozu Labs|Kazuho Oku)", "picojson"),
    (r"jsmn\.[ch]", r"Copyright.{0,40}\bSerge Zaitsev", "jsmn"),
    (
        r"sqlite3(?:ext)?\.[ch]",
        r"\bThe author disclaims copyright to this source code\b|\bamalgamation of\b.{0,80}\bSQLite",
        "sqlite3",
    ),
    (
        r"(?:blocking)?concurrentqueue\.h|(?:readerwriter\w*|lightweightsemaphore|atomicops)\.h",
        r"\bCameron Desrochers\b|\bmoodycamel\b",
        "concurrentqueue",
    ),
    (r"backward\.[ch]pp", r"\bbackward\.[ch]pp\b.{0,80}Copyright.{0,40}\bGoogle", "backward"),
    (r"toml\.hpp", r"\btoml\+\+ v\d|Copyright.{0,40}\b(?:Toru Niina|Mark Gillard)", "toml"),
    (r"CLI11\.hpp", r"\bCLI11: Version \d|\bOriginally designed by Henry Schreiner\b", "cli11"),
    (r"magic_enum\w*\.hpp", r"Copyright.{0,60}\bDaniil Goncharov", "magicenum"),
    (r"nanoflann\.hpp", r"Copyright.{0,60}\b(?:Jose Luis Blanco|Marius Muja)", "nanoflann"),
    (
        r"getopt\w*\.(?:c|cc|cpp|h)",
        r"Copyright.{0,80}\b(?:Free Software Foundation|NetBSD Foundation|Todd C\. Miller)",
        "getopt",
    ),
    (
        r"matplotlibcpp\.h",
        r"github\.com/lava/matplotlib-cpp|\bPython headers must be included before any system headers\b",
        "matplotlibcpp",
    ),
    (r"mongoose\.[ch]", r"Copyright.{0,40}\b(?:Cesanta|Sergey Lyubka)", "mongoose"),
    (
        r"(?:serial|v8stdint|win|unix|list_ports_\w+)\.(?:h|cc)",
        r"Copyright.{0,40}\bWilliam Woodall\b.{0,2000}\bserial",
        "serial",
    ),
)
#: The same for scripts.
_SCRIPTS: tuple[tuple[str, str, str], ...] = (
    (
        r"git-clang-format(?:\.py)?|(?:run-clang-format|run-clang-tidy|clang-format-diff|clang-tidy-diff)(?:[.-]\d{1,2})?(?:\.py)?",
        r"\bLLVM Compiler Infrastructure\b|\bPart of the LLVM Project\b",
        "clang",
    ),
    (r"(?:ament_)?cpplint\.py", r"Copyright.{0,40}\bGoogle\b", "cpplint"),
    (r"six\.py", r"Copyright.{0,40}\bBenjamin Peterson\b", "six"),
    (r"(?:stats|pstat)\.py", r"Copyright.{0,40}\bGary Strangman\b", "stats"),
    (r"svgfig\.py", r"Copyright.{0,40}\bJim Pivarski\b", "svgfig"),
    (r"inputs\.py", r"Copyright.{0,40}\bZeth\b|\bInputs - user input for humans\b", "inputs"),
    (r"\w*transform\w*\.py", r"Copyright.{0,40}\bChristoph Gohlke\b", "transformations"),
    (r"bottle\.py", r"Copyright.{0,40}\bMarcel Hellkamp\b", "bottle"),
)
#: Scripts without a first comment, by what their documentation says, which who takes a few lines of them does not copy.
_WITHOUT_HEAD: tuple[tuple[str, bytes, str], ...] = (
    (r"easysensors\.py|easygopigo3\.py", b"Dexter Industries `shop`_", "gopigo3"),
)
_INSIDE = tuple((regex(name), inside, own) for name, inside, own in _WITHOUT_HEAD)
_KNOWN = {
    language: tuple((regex(n), regex(s, re.IGNORECASE | re.DOTALL), own) for n, s, own in table)
    for language, table in (("cpp", _TABLE), ("python", _SCRIPTS))
}
_WRAPS = regex(r"[_-](?:ros[12]?|vendor|catkin|wrapper)$", re.IGNORECASE)
_ANY = {
    language: regex("|".join(name for name, _, _ in table))
    for language, table in (("cpp", _TABLE), ("python", _SCRIPTS))
}


def copied_library(path: str, language: str, data: bytes) -> str:
    """The library whose own file the one at *path* is by its name and by what its first comment says, or its documentation; "" otherwise."""
    name = path.rpartition("/")[2]
    if language == "python" and data.count(b"\n") >= SHORTEST:
        for names, inside, own in _INSIDE:
            if names.fullmatch(name) and inside in data:
                return own
    if language not in _ANY or _ANY[language].fullmatch(name) is None or data.count(b"\n") < SHORTEST:
        return ""
    comment = re.sub(r"[\s#]+", " ", leading_comment(language, data))
    return next(
        (own for names, pattern, own in _KNOWN[language] if names.fullmatch(name) and pattern.search(comment)), ""
    )


def is_of_project(library: str, package: str | None) -> bool:
    """Whether *package* is the project of the *library* itself, by its name: there its files are no copies.

    A package called after the library and ROS, or ``_vendor``, wraps it.
    """
    if package is None or _WRAPS.search(package):
        return False
    return re.sub(r"[^a-z0-9]", "", package.lower()).startswith(library)
