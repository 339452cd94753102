# SPDX-License-Identifier: Apache-2.0
"""Files that analysed code uses as code, though nothing analyses them: their names are those of no language, or nobody looks where they lie.

Compilers and interpreters take a file under any name: ``#include`` does, CMake's property ``LANGUAGE`` makes C++ of any file, a template
becomes a header, ``exec`` runs any text. Names are looked up in the texts of the workspace; nothing is evaluated.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator
from fnmatch import fnmatchcase
from functools import cached_property

from haros_ci.model.package import SourceFile
from haros_ci.model.python_names import as_python_reads
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.workspace.cmake_plain import spelled_out
from haros_ci.workspace.code_text import has_body, has_lines_of_python, is_cpp, is_python
from haros_ci.workspace.first_lines import asks_for_another, asks_for_python
from haros_ci.workspace.language import language_of, suffix_of
from haros_ci.workspace.used_names import (
    CODE,
    PIECE,
    STRING,
    TEMPLATES,
    compiled,
    filled,
    included,
    named,
    of_extensions,
    of_form,
    perhaps_included,
    programs,
    taken,
)

#: The beginning of a launch file in XML, and in YAML, whatever its name is.
_LAUNCH = regex(r"(?:\s|<\?[^>]{0,1000}>|<!DOCTYPE[^<>\[]{0,1000}>|<!--(?:[^-]|-(?!->))*-->)*<launch[\s/>]")
_LAUNCH_YAML = regex(
    r"(?:\s|#[^\n]{0,1000}\n|(?:---|%)[^\n]{0,1000}\n)*(?:(?:!!?\w{0,80}|&\w{1,80}|\?)\s+|\{\s*){0,8}[\"']?launch[\"']?\s*:\s*(?:#[^\n]{0,1000}\n\s*){0,20}(?:-|\[\s*\{)"
)
#: Code that no reader here knows, and no other name is needed for: Cython, and Python that is compiled.
_UNKNOWN = {"pyx": "Cython", "pxi": "Cython", "pyc": "Python that is compiled"} | dict.fromkeys(
    ("egg", "whl", "pyz"), "an archive of Python"
)
_UNKNOWN |= dict.fromkeys(("cppm", "ixx", "ccm", "cxxm", "c++m", "mpp"), "a module of C++") | {"mm": "Objective-C++"}
_REFERRING = frozenset(("cpp", "python", "cmake", "launch", "setup", "package"))
#: What a manifest says of packages, by their names, and in comments: no file is reached by it.
_NAMES_PACKAGES = regex(r"<!--.*?(?:-->|\Z)|<(?:\w{0,30}depend|name)\b[^<>]{0,400}>[^<>]{0,400}<", re.DOTALL)


_WILD = regex(r"[*?\[]")
#: What runs the text of a file as Python.
_RUNS = regex(
    r"(?:(?<![.\w])|\bbuiltins\.)(?:exec|execfile|compile|eval)\s*\("
    r"|\b(?:SourceFileLoader|spec_from_file_location|run_path|load_source|load_compiled|spec_from_loader|zipimporter|(?:__)?builtins(?:__)?)\b"
    r"|\bsys\.path\b"
)
#: What gives a file to an interpreter of Python in one line: CMake, launch files, ``subprocess``.
_GIVEN = regex(
    r"(?:\b(?:i?python|pypy|jupyter|papermill)[\d.]{0,6}|\bsys\.executable|\$\{\w{0,60}PYTHON\w{0,60}\})(?!\w)([^\n]{1,1000})",
    re.I,
)
#: In files of dynamic_reconfigure, which are read as such (``cfg/Planner.cfg``).
_RECONFIGURE = "ParameterGenerator"
#: A line of a .pth file that is run (docs.python.org, site), and a cell of a notebook with code in it (nbformat).
_RUN_AT_START = regex(r"^import[ \t]", re.M)
_CELL = regex(r"\"cell_type\"\s*:\s*\"code\"")
#: Words of what may run a text or a program, in Python code that names a file with Python in it.
_MAY_RUN = regex(
    r"\b(?:exec|execfile|eval|compile|runpy|subprocess|Popen|popen|system|exec[lv]p?e?|spawn\w*|pty|run|runcode|runsource|interact|InteractiveInterpreter"
    r"|InteractiveConsole|cProfile|profile|timeit|doctest|testfile|importlib|import_module|__import__|imp|zipimport|Loader|SourceFileLoader|PYTHONSTARTUP"
    r"|FindExecutable|ExecuteProcess|Node)\b"
)
#: How C++ begins: a directive, a comment, a declaration.
_BEGINS_CPP = regex(
    r"\s*(?:#[ \t]*(?:pragma|include|if|ifdef|ifndef|define)\b|//|/\*|(?:namespace|using|template|struct|class|enum|union|static|inline|extern|constexpr|typedef)\b"
    r"|[A-Za-z_][\w:<>,&*\[\] \t]{0,300}(?:\([^;{}]{0,500}\)\s{0,20}(?:const\s{0,20})?\{|=|;))"
)
_IDENTIFIER = regex(r"\b[A-Za-z_]\w{0,100}\b")
_BOUND = regex(r"\b([A-Za-z_]\w{0,100})[ \t]*(?::[^=\n]{0,100})?=(?!=)|\bas[ \t]+([A-Za-z_]\w{0,100})")
_HEAD = 512
#: Files of other languages that may read as calls of Python, or are read as what they are.
_NO_PROGRAMS = frozenset(("cmake", "markdown", "dockerfile"))
#: Suffixes of other languages with bodies in braces.
_LIKE_CPP = frozenset(
    "java js mjs cjs ts tsx jsx cs rs go kt kts swift php scala dart glsl vert frag geom comp hlsl metal cl proto css scss less qml json "
    "pl pm r lua m mm sql y l ino pde asm s awk tcl groovy gradle vala d zig sol wgsl idl thrift fbs capnp svg html htm dox ld lds shader cginc json5 policy conf mk".split()
)
#: How many names in turn may lead from what runs a text to the name of its file.
_STEPS = 4


class UsedCode:
    """What the analysed files of *workspace* say of others; each question reads the texts when it is first asked."""

    def __init__(self, workspace: Workspace, text: Callable[[str], str] | None = None) -> None:
        """*text* reads the files that are asked about, where they are not *workspace*'s."""
        self._workspace = workspace
        self._text = text or workspace.text
        self._names: dict[str, frozenset[str]] = {}
        self._read_before: dict[str, str] = {}

    def why(self, path: str) -> str:
        """Why the file at *path*, which is not analysed as code, is code, as a clause; "" if nothing says so.

        If its name is that of another language (``part.yaml``), its text has to be code, too, but for what C++ includes.
        """
        name = path.rpartition("/")[2]
        language = language_of(name)
        if language in CODE:
            return ""
        text = self._text(path)
        if suffix := _UNKNOWN.get(suffix_of(name)):
            return f"it is {suffix}, which is not analysed"
        if suffix_of(name) == "pth" and "\0" not in text and _RUN_AT_START.search(text):
            return "Python runs the lines of a .pth file that begin with import, when it starts"
        if name in self._in_forms:
            return "a form of Qt has C++ include it, and no C++ file is called so"
        if name in self._of("cpp", included) or (_may_be_cpp(text, language) and self._is_perhaps_included(name)):
            return "C++ includes it, and no C++ file is called so"
        return self._why_built(path, name, text, language) or self._why_run(name, text, language)

    def _is_perhaps_included(self, name: str) -> bool:
        """Whether a macro may stand for the file called *name* in an #include; what defines it may be CMake."""
        perhaps = self._of("cpp", perhaps_included)
        return name in perhaps or (bool(perhaps) and name in self._of("cmake", named))

    def _why_built(self, path: str, name: str, text: str, language: str | None) -> str:
        """Why CMake makes code of it, or a program."""
        if _may_be_cpp(text, language) and self._is_among(name, "cmake", compiled):
            return "CMake has it compiled, and no C++ file is called so"
        if name in self._of("python", of_extensions) and _may_be_cpp(text, language):
            return "setup.py has it compiled, and no C++ file is called so"
        made = _template_of(name, text) if name in self._of("cmake", filled) else ""
        if made == "Python" or (made and _may_be_cpp(text, language)):
            return f"a build makes {made} of it"
        if is_cpp(text) and _may_be_cpp(text, language) and self._is_among(name, "cmake", taken):
            return "CMake takes it, it holds functions of C++, and no C++ file is called so"
        is_objective = suffix_of(name) == "m" and is_cpp(text)
        if is_objective and any(
            "aux_source_directory" in self._workspace.text(f.path) for f in self._files(("cmake",))
        ):
            return "CMake has it compiled as Objective-C, by aux_source_directory()"
        is_program = language is None and text and not asks_for_another(text)
        if is_program and self._is_among(name, "cmake", programs):
            return "CMake installs it as a program, and neither its name nor its first line tells the language"
        return ""

    def _why_run(self, name: str, text: str, language: str | None) -> str:
        """Why an interpreter of Python runs it."""
        is_archive = name.endswith(".zip")
        if not text.strip() and not is_archive:
            return ""
        is_reconfigure = language == "setup" and _RECONFIGURE in text
        if language is not None and asks_for_python(text) and not is_reconfigure:
            return f"its first line asks for Python, and its name is that of {language}"
        if language is None and asks_for_python(text) and (user := self._namer_of(name)):
            return f"its first line asks for Python, {user} names it, and it is not analysed as Python"
        is_perhaps_python = (
            language is None or (language != "markdown" and has_lines_of_python(text)) or is_python(text)
        )
        if is_perhaps_python and name in self._of("python", _loaded):
            return "Python code loads it as Python, and no Python file is called so"
        if is_perhaps_python and name in self._given():
            return "it is given to Python as a program, and no Python file is called so"
        if is_python(text, with_calls=language != "cmake") and (user := self._user_of(name, is_reconfigure)):
            return f"it holds Python, {user} names it, and no Python file is called so"
        return ""

    def is_used(self, path: str, directory: str) -> bool:
        """Whether the file at *path* is used as code here, below *directory* if that is never entered."""
        if directory:
            return self.reaches(path, directory)
        if is_opaque(path):
            stem = re.compile(rf"\b{re.escape(path.rpartition('/')[2].partition('.')[0])}\b")
            return any(stem.search(self._read(file)) for file in self._files(_REFERRING))
        return bool(self.why(path))

    def _namer_of(self, name: str) -> str:
        """The path of a file that installs or starts programs and names the file called *name*; "" without one."""
        place = re.compile(rf"(?<![\w.-]){re.escape(name)}(?![\w.-])")
        files = self._files(("setup", "python", "cmake", "launch", "shell", "dockerfile"))
        return next((file.path for file in files if place.search(self._workspace.text(file.path))), "")

    def _user_of(self, name: str, is_reconfigure: bool) -> str:
        """The path of a file that names the file called *name*, and that may have it run; "" without one."""
        place = re.compile(rf"(?<![\w.-]){re.escape(name)}(?![\w-])")
        for file in self._files(("python", "launch", "shell", "dockerfile")):
            source = self._read(file)
            if name in source and place.search(source) and (file.language != "python" or _MAY_RUN.search(source)):
                return file.path
        is_taken = self._is_among(name, "cmake", programs)
        is_taken |= not is_reconfigure and self._is_among(name, "cmake", taken)
        return "CMakeLists.txt" if is_taken else ""

    def reaches(self, path: str, directory: str) -> bool:
        """Whether analysed files, or links, lead to the file at *path* below *directory*, which nobody enters."""
        if any(target == directory or target.startswith(f"{directory}/") for _, target in self._workspace.links):
            return True
        name = directory.rpartition("/")[2]
        stem = path.rpartition("/")[2].partition(".")[0]
        place = re.compile(
            rf"(?<![\w.-]){re.escape(name)}(?![\w-])|^[ \t]*(?:from|import)[ \t][^\n]{{0,500}}?\.{re.escape(name)}(?![\w-])",
            re.M,
        )
        file = re.compile(rf"(?<!\w){re.escape(stem)}(?!\w)")
        is_named = False
        for source in self._files(_REFERRING):
            text = self._read(source)
            if name in text and source.language == "package":
                text = _NAMES_PACKAGES.sub("", text)
            if name in text and place.search(text):
                is_named = True
                if source.language == "cmake" and (name.startswith(".") or "*" in text):
                    return True
        return is_named and any(file.search(self._read(f)) for f in self._files(_REFERRING))

    def language_by_text(self, path: str) -> str:
        """``Python`` or ``C++`` if the file at *path* is a program or has functions by its text; "" else.

        Stubs (PEP 484), settings of dynamic_reconfigure and languages whose functions look like those of C++ are none.
        """
        name = path.rpartition("/")[2]
        suffix = suffix_of(name)
        if suffix == "pyi" or b"\0" in self._workspace.reader.head(path, _HEAD):
            return ""
        text = self._workspace.text(path)
        if suffix == "ipynb":
            return "Python" if _CELL.search(text) else ""
        is_script = language_of(name) is None and asks_for_python(text)
        if _RECONFIGURE not in text and (is_script or is_python(text, with_calls=False)):
            return "Python"
        is_known = language_of(name) is not None or suffix in _LIKE_CPP or suffix in TEMPLATES
        return "C++" if not is_known and _begins_as_cpp(text) else ""

    def namer_of_calls(self, path: str) -> str:
        """The path of Python code that has the name of the file at *path* in a text, if the latter is a program of Python that calls something; else "".

        What runs a text is more than anybody can list; a name of other code, and none of data, tells that it may be run.
        """
        name = path.rpartition("/")[2]
        text = self._workspace.text(path)
        if language_of(name) in _NO_PROGRAMS or _RECONFIGURE in text or not is_python(text):
            return ""
        quoted = re.compile(rf"[\"'/]{re.escape(name)}[\"']")
        return next((file.path for file in self._files(("python",)) if quoted.search(self._read(file))), "")

    def kind_of_stray_launch(self, path: str) -> str:
        """``xml`` or ``yaml`` if the file at *path* is a launch file by its text, not by its name, and none that is analysed names it; else ""."""
        name = path.rpartition("/")[2]
        kind = language_of(name) or ""
        form = {"xml": _LAUNCH, "yaml": _LAUNCH_YAML}.get(kind)
        if form is None or not form.match(self._workspace.text(path)):
            return ""
        others = self._files(("launch", "python", "xml", "yaml", "cmake"))
        return "" if any(name in self._workspace.text(file.path) for file in others if file.path != path) else kind

    def names_in(self, paths: Iterable[str]) -> frozenset[str]:
        """The words in the texts of *paths* that may be names of files."""
        return frozenset(name for path in paths for name in PIECE.findall(as_python_reads(self._workspace.text(path))))

    def _read(self, file: SourceFile) -> str:
        """The text of *file*, names as Python reads them."""
        text = self._workspace.text(file.path)
        read = self._read_before.get(file.path) or as_python_reads(text)
        if read is not text:
            self._read_before[file.path] = read
        return read

    def _files(self, languages: Collection[str]) -> Iterator[SourceFile]:
        return (file for file in self._workspace.files if file.language in languages)

    def _of(self, language: str, find: Callable[[str], Iterable[str]]) -> frozenset[str]:
        key = f"{language} {find.__name__}"
        if key not in self._names:
            texts = (self._read(file) for file in self._files((language,)))
            if language == "cmake":
                texts = (form for text in texts for form in (text, spelled_out(text)))
            found = (name for text in texts for name in find(text))
            self._names[key] = frozenset(name.rpartition("/")[2] for name in found)
        return self._names[key]

    @cached_property
    def _in_forms(self) -> frozenset[str]:
        """The names of what forms of Qt have the code that is made of them include."""
        forms = (self._workspace.text(path) for path in self._workspace.names if path.endswith(".ui"))
        return frozenset(name.rpartition("/")[2] for text in forms for name in of_form(text))

    def _given(self) -> frozenset[str]:
        return frozenset(
            name for language in ("cmake", "launch", "python") for name in self._of(language, _interpreted)
        )

    def _is_among(self, name: str, language: str, find: Callable[[str], Iterable[str]]) -> bool:
        names = self._of(language, find)
        return name in names or any(_WILD.search(pattern) and fnmatchcase(name, pattern) for pattern in names)


def is_opaque(path: str) -> bool:
    """Whether the file at *path* is code by its name, of a kind that nothing here analyses."""
    return suffix_of(path.rpartition("/")[2]) in _UNKNOWN


def _may_be_cpp(text: str, language: str | None) -> bool:
    """Whether a file may be C++: under a name of no language if it has a statement or block, under one of another language if it begins and goes on so."""
    if language is None:
        return ";" in text or "{" in text
    return _begins_as_cpp(text)


def _begins_as_cpp(text: str) -> bool:
    return _BEGINS_CPP.match(text) is not None and is_cpp(text)


def _template_of(name: str, text: str) -> str:
    """The language of what a template makes, "" if it is neither C++ nor Python, or holds values alone."""
    stem, _, suffix = name.rpartition(".")
    language = language_of(stem) if suffix.lower() in TEMPLATES else "cpp"
    if language == "python":
        return "Python"
    return "C++" if language == "cpp" and has_body(text) else ""


def _interpreted(text: str) -> Iterator[str]:
    """The first name of a file behind an interpreter; ``-m`` and ``-c`` give it none."""
    for rest in _GIVEN.findall(text):
        words = PIECE.findall(rest)
        name = next((word for word in words if "." in word.strip(".") or word in ("-m", "-c")), "")
        if name not in ("", "-m", "-c"):
            yield name


def _loaded(text: str) -> Iterator[str]:
    """The texts that stand where a text is run, or where a name is bound that leads there."""
    lines = text.split("\n")
    run = [line for line in lines if _RUNS.search(line)]
    if not run:
        return
    bound: dict[str, list[str]] = {}
    for line in lines:
        for names in _BOUND.findall(line):
            bound.setdefault(names[0] or names[1], []).append(line)
    seen: set[str] = set()
    for _ in range(_STEPS):
        yield from (name for line in run for name in STRING.findall(line))
        names = {name for line in run for name in _IDENTIFIER.findall(line) if name in bound} - seen
        seen |= names
        run = [line for name in sorted(names) for line in bound[name]]
