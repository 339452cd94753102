# SPDX-License-Identifier: Apache-2.0
"""Ways to make a tool read what lies outside the workspace, one word of its own in each place that must not be read.

An attack is a function of an Attacker; it writes files of the workspace. Whatever it reaches, the canary must appear in no output.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from dataclasses import dataclass

from hostile_kit import Trap

#: What an attack asks a tool to take in, in a place where cppcheck prints what it has read as part of a condition.
CONDITION = "bool f_{name}(int e) {{ return e ==\n{directive}\n && e ==\n{directive}\n; }}\n"
DATABASE = "build/compile_commands.json"


@dataclass
class Attacker:
    """One attack's view of a trap: *canary* is the word that must not come out, *outside* the file that holds it."""

    trap: Trap
    name: str

    @property
    def canary(self) -> str:
        return f"CANARY_{self.name}"

    @property
    def outside(self) -> str:
        return str(self.trap.outside / self.name / "target.h")

    def place(self, name: str = "target.h", text: str | None = None) -> str:
        """A file outside; its absolute path."""
        path = self.trap.outside / self.name / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"{self.canary}\n" if text is None else text.replace("CANARY", self.canary))
        return str(path)

    def write(self, name: str, text: str) -> None:
        """A file of the workspace, in the attack's own directory."""
        self.trap.write(f"{self.name}/{name}", text.replace("CANARY", self.canary).replace("OUTSIDE", self.outside))

    def link(self, name: str, target: str) -> None:
        place = self.trap.root / self.name / name
        place.parent.mkdir(parents=True, exist_ok=True)
        place.symlink_to(target)

    def condition(self, directive: str, name: str = "a.cpp", before: str = "") -> None:
        """A source that takes *directive* in within a condition; ``OUTSIDE`` in it stands for the file outside."""
        self.place()
        self.write(name, before + CONDITION.format(name=self.name, directive=directive))

    def up(self, depth: int = 2) -> str:
        """The file outside as a path that climbs, from *depth* directories below the root."""
        return "../" * (depth + 1) + f"outside/{self.name}/target.h"

    def built_with(self, *flags: str) -> None:
        """The source stands in a compile database with *flags*."""
        path = self.trap.root / DATABASE
        entries = json.loads(path.read_text()) if path.exists() else []
        root = str(self.trap.root)
        arguments = ["c++", *flags, "-c", f"{root}/{self.name}/a.cpp"]
        entries.append({"directory": root, "file": f"{self.name}/a.cpp", "arguments": arguments})
        self.trap.write(DATABASE, json.dumps(entries))


Attack = Callable[[Attacker], None]


def _linked_directory(a: Attacker) -> None:
    a.condition('#include "there/target.h"')
    a.link("there", str(a.trap.outside / a.name))


def _linked_file(a: Attacker) -> None:
    a.condition('#include "here.h"')
    a.link("here.h", a.outside)


def _link_of_link(a: Attacker) -> None:
    a.condition('#include "one.h"')
    a.link("two.h", a.outside)
    a.link("one.h", "two.h")


def _through_text(a: Attacker) -> None:
    """The way out stands in a file that is no C++."""
    a.condition('#include "rows.inc"')
    a.write("rows.inc", '#include "OUTSIDE"\n')


def _through_python(a: Attacker) -> None:
    a.condition('#include "rows.py"')
    a.write("rows.py", '#include "OUTSIDE"\n')


def _through_header(a: Attacker) -> None:
    a.condition('#include "in.h"')
    a.write("in.h", '#include "OUTSIDE"\n')


def _decoy(a: Attacker) -> None:
    """A file of the workspace makes the climbing path look as if it led there."""
    a.condition(f'#include "{a.up(4)}"', "p/q/r/a.cpp")
    a.trap.write(f"outside/{a.name}/target.h.txt", "nothing\n")
    a.trap.write(f"{a.name}/outside/{a.name}/target.h", "0\n")


def _asked(a: Attacker) -> str:
    """A finding that names the canary, which stands in no line of the source, but where macros are expanded, as in the facts that the cache has."""
    return f"#define J(x, y) x##y\nint f() {{ int J(CANA, RY_{a.name}); return J(CANA, RY_{a.name}); }}\n#endif\n"


#: Attacks of that kind: whether a tool names the canary is the answer.
ASKING = frozenset(("question", "question_by_macro", "renamed_question"))


def _question(a: Attacker) -> None:
    """Whether a file is there is told by a finding, too."""
    a.place()
    a.write("a.cpp", '#if __has_include("OUTSIDE")\n' + _asked(a))


def _question_by_macro(a: Attacker) -> None:
    a.place()
    a.write("a.cpp", '#define H "OUTSIDE"\n#if __has_include(H)\n' + _asked(a))


def _renamed_question(a: Attacker) -> None:
    a.place()
    a.write("a.cpp", '#define Q __has_include\n#if Q("OUTSIDE")\n' + _asked(a))


def _in_git(a: Attacker) -> None:
    """Checkouts keep tokens in the repository's settings."""
    a.trap.write(".git/canary_git", f"{a.canary}\n")
    a.write("a.cpp", CONDITION.format(name=a.name, directive='#include "../.git/canary_git"'))


def _ignored_file(a: Attacker) -> None:
    """A file beside the sources that git does not know: passwords for the developer's machine."""
    a.trap.write(".gitignore", "*.env\n")
    a.trap.write(f"{a.name}/local.env", f"{a.canary}\n")
    a.write("a.cpp", CONDITION.format(name=a.name, directive='#include "local.env"'))


def _with_flags(*flags: str, directive: str = '#include "target.h"') -> Attack:
    def attack(a: Attacker) -> None:
        a.condition(directive)
        directory = os.path.dirname(a.outside)
        a.built_with(*(flag.replace("OUTSIDE", a.outside).replace("DIRECTORY", directory) for flag in flags))

    return attack


def _flags_of_a_file(a: Attacker) -> None:
    a.condition('#include "target.h"')
    a.trap.write(f"{a.name}/flags", f"-I{os.path.dirname(a.outside)} -include {a.outside}\n")
    a.built_with(f"@{a.trap.root}/{a.name}/flags")


def _repository_as_headers(a: Attacker) -> None:
    a.trap.write(".git/canary_flag", f"{a.canary}\n")
    a.write("a.cpp", CONDITION.format(name=a.name, directive="#include <canary_flag>"))
    a.built_with(f"-I{a.trap.root}/.git")


def _linked_headers(a: Attacker) -> None:
    a.condition('#include "target.h"')
    a.link("headers", os.path.dirname(a.outside))
    a.built_with(f"-I{a.trap.root}/{a.name}/headers")


def _directive(text: str, before: str = "") -> Attack:
    return lambda a: a.condition(text.replace("UP", a.up(1)), before=before)


#: Ways into tools that read C++.
CPP: dict[str, Attack] = {
    "absolute": _directive('#include "OUTSIDE"'),
    "angles": _directive("#include <OUTSIDE>"),
    "climbing": _directive('#include "UP"'),
    "climbing_angles": _directive("#include <UP>"),
    "climbing_late": _directive('#include "a/b/../../UP"'),
    "double_slash": _directive('#include "/OUTSIDE"'),
    "import": _directive('#import "OUTSIDE"'),
    "next": _directive('#include_next "OUTSIDE"'),
    "embed": _directive('#embed "OUTSIDE"'),
    "macro": _directive("#include M", '#define M "OUTSIDE"\n'),
    "macro_angles": _directive("#include M", "#define M <OUTSIDE>\n"),
    "macro_function": _directive("#include M(OUTSIDE)", "#define S(x) #x\n#define M(x) S(x)\n"),
    "spliced_word": _directive('#inc\\\nlude "OUTSIDE"'),
    "spliced_target": _directive('#include "/\\\nOUTSIDE"'),
    "spliced_with_blanks": _directive('#include \\ \n"OUTSIDE"'),
    "spliced_crlf": _directive('#include \\\r\n"OUTSIDE"'),
    "comment": _directive('# /* x */ include /* y */ "OUTSIDE"'),
    "comment_of_lines": _directive('#/*\n*/include/*\n*/"OUTSIDE"'),
    "after_a_comment": _directive('/* x\n */ #include "OUTSIDE"'),
    "raw_string": _directive('#/**/include "OUTSIDE"', 'const char* r = R"x( /* )x";\n'),
    "digraph": _directive('%:include "OUTSIDE"'),
    "trigraph": _directive('??=include "OUTSIDE"'),
    "form_feed": _directive('\f#\finclude\f"OUTSIDE"'),
    "process": _directive('#include "/proc/self/root/OUTSIDE"'),
    "link": _linked_file,
    "link_directory": _linked_directory,
    "link_of_link": _link_of_link,
    "text": _through_text,
    "python": _through_python,
    "header": _through_header,
    "decoy": _decoy,
    "question": _question,
    "question_by_macro": _question_by_macro,
    "renamed_question": _renamed_question,
    "git": _in_git,
    "ignored": _ignored_file,
    "flag_include_directory": _with_flags("-IDIRECTORY"),
    "flag_separate": _with_flags("-I", "DIRECTORY"),
    "flag_system": _with_flags("-isystem", "DIRECTORY"),
    "flag_quote": _with_flags("-iquoteDIRECTORY"),
    "flag_include": _with_flags("-include", "OUTSIDE", directive=""),
    "flag_macros": _with_flags("-imacros", "OUTSIDE", directive=""),
    "flag_define": _with_flags('-DM="OUTSIDE"', directive="#include M"),
    "flag_file": _flags_of_a_file,
    "flag_repository": _repository_as_headers,
    "flag_link": _linked_headers,
    "pragma": _directive('#pragma GCC dependency "OUTSIDE"\n0'),
    "line": _directive('0\n#line 1 "OUTSIDE"\n'),
}


def _settings(name: str, text: str, outside: str | None = None, target: str = "target.h", **files: str) -> Attack:
    """A settings file of a tool that names the file outside, and the files that it holds for."""

    def attack(a: Attacker) -> None:
        a.place(target, outside)
        where = str(a.trap.outside / a.name / target)
        a.write(name, text.replace("OUTSIDE", where).replace("UP", f"../../outside/{a.name}/{target}"))
        for file, content in (files or {"x_py": PYTHON}).items():
            a.write(file.replace("_", ".", 1), content)

    return attack


def _linked_settings(name: str, text: str, **files: str) -> Attack:
    def attack(a: Attacker) -> None:
        a.place("target.h", text)
        a.link(name, a.outside)
        for file, content in files.items():
            a.write(file.replace("_", ".", 1), content)

    return attack


def _linked_module(use: str) -> Attack:
    def attack(a: Attacker) -> None:
        a.place("target.h", "from typing import Final\nKEY: Final = 'CANARY'\nclass A:\n    CANARY = 1\n")
        a.link("leak.py", a.outside)
        a.write("x.py", use)

    return attack


def _linked_package(a: Attacker) -> None:
    a.place("pk/__init__.py", "class A:\n    CANARY = 1\n")
    a.link("pk", str(a.trap.outside / a.name / "pk"))
    a.write("x.py", "import pk\n\npk.A().CANARX\n")


PYTHON = "import os\n\nx = undefined_here\n"
#: Ways into tools that read Python. Most tools print a line of a settings file that they cannot read.
PY: dict[str, Attack] = {
    "ruff_extend": _settings("ruff.toml", 'extend = "OUTSIDE"\n'),
    "ruff_extend_climbing": _settings("ruff.toml", 'extend = "UP"\n'),
    "ruff_extend_variable": _settings(".ruff.toml", 'extend = "${PWD}/UP"\n'),
    "ruff_extend_home": _settings("pyproject.toml", '[tool.ruff]\nextend = "~/OUTSIDE"\n'),
    "ruff_extend_again": _settings("ruff.toml", 'extend = "b.toml"\n', x_py=PYTHON, b_toml='extend = "OUTSIDE"\n'),
    "ruff_link": _linked_settings("ruff.toml", "CANARY\n", x_py=PYTHON),
    "ruff_link_extended": _settings("ruff.toml", 'extend = "there/target.h"\n'),
    "ruff_cache": _settings("ruff.toml", 'cache-dir = "OUTSIDE"\n'),
    "ruff_version": _settings("ruff.toml", 'required-version = "OUTSIDE"\n'),
    "pylint_module": _linked_module("import leak\n\nleak.A().CANARX\n"),
    "pylint_package": _linked_package,
    "pylint_settings": _linked_settings("pylintrc", "[MAIN]\nnotes=CANARY\n", x_py=PYTHON),
    "pylint_hook": _settings("pylintrc", "[MAIN]\ninit-hook=print(open('OUTSIDE').read())\n"),
    "pylint_words": _settings(
        "pylintrc", "[SPELLING]\nspelling-dict=en\nspelling-private-dict-file=OUTSIDE\n[MAIN]\nenable=spelling\n"
    ),
    "mypy_module": _linked_module("from typing import Literal\nimport leak\n\nx: Literal['a'] = leak.KEY\n"),
    "mypy_path": _settings(
        "mypy.ini", "[mypy]\nmypy_path = OUTSIDE/..\n", "KEY = 'CANARY'\n", "target.py",
        x_py="import target\n\nreveal_type(target.KEY)\ny: int = target.KEY\n",
    ),
    "mypy_files": _settings("mypy.ini", "[mypy]\nfiles = OUTSIDE\n"),
    "mypy_typeshed": _settings("mypy.ini", "[mypy]\ncustom_typeshed_dir = OUTSIDE\n"),
    "flake8_settings": _linked_settings(".flake8", "[flake8]\nselect = CANARY\n", x_py=PYTHON),
    "flake8_append": _settings(".flake8", "[flake8]\nappend-config = OUTSIDE\noutput-file = OUTSIDE\n"),
    "flake8_local": _settings(".flake8", "[flake8:local-plugins]\nextension = X = target:CANARY\npaths = OUTSIDE/..\n"),
    "bandit_baseline": _settings(".bandit", "[bandit]\nbaseline = OUTSIDE\nini = OUTSIDE\nconfigfile = OUTSIDE\n"),
    "bandit_targets": _settings(".bandit", "[bandit]\ntargets = OUTSIDE\n", "import pickle  # CANARY\n", "target.py"),
    "black_settings": _linked_settings("pyproject.toml", "[tool.black]\nline-length = 'CANARY'\n", x_py=PYTHON),
    "isort_settings": _settings(".isort.cfg", "[settings]\nsettings_path = OUTSIDE\nadd_imports = import CANARX\n"),
    "isort_link": _linked_settings(".isort.cfg", "[settings]\nprofile = CANARY\n", x_py="import sys\nimport os\n"),
    "vulture_paths": _settings(
        "pyproject.toml", '[tool.vulture]\npaths = ["OUTSIDE"]\n', "def CANARY():\n    pass\n", "target.py"
    ),
    "codespell_dictionary": _settings(
        ".codespellrc", "[codespell]\ndictionary = OUTSIDE\n", "undefinde->CANARY\n", x_py="x = 1  # undefinde\n"
    ),
    "codespell_words": _settings(".codespellrc", "[codespell]\nignore-words = OUTSIDE\nexclude-file = OUTSIDE\n"),
    "fifo_module": lambda a: (os.mkfifo(_parent(a) / "pipe.py"), a.write("x.py", "import pipe\n\nprint(pipe.x)\n"))[1],
}  # fmt: skip

SHELL = "#!/bin/bash\n# shellcheck source=OUTSIDE\n. ./there\necho $CANARX\n"
ENTITY = '<?xml version="1.0"?>\n<!DOCTYPE r [<!ENTITY e SYSTEM "file://OUTSIDE">]>\n<robot name="r">&e;</robot>\n'
INCLUDE = '<robot xmlns:xi="http://www.w3.org/2001/XInclude"><xi:include href="OUTSIDE" parse="text"/></robot>\n'
SCHEMA = '<?xml-model href="OUTSIDE"?>\n<!DOCTYPE r SYSTEM "OUTSIDE">\n<r xsi:schemaLocation="x OUTSIDE"/>\n'
#: Ways into tools for other files.
TEXTS: dict[str, Attack] = {
    "yamllint_extends": _settings(".yamllint", "extends: OUTSIDE\n", "CANARY: [\n", x_yaml="a:   b\n"),
    "yamllint_ignore": _settings(".yamllint", "extends: default\nignore-from-file: OUTSIDE\n", x_yaml="a:   b\n"),
    "yamllint_link": _linked_settings(".yamllint", "rules: {CANARY: enable}\n", x_yaml="a:   b\n"),
    "shellcheck_source": _settings("x.bash", SHELL, "if CANARY; fi\n"),
    "shellcheck_settings": _settings(
        ".shellcheckrc", "external-sources=true\nsource-path=OUTSIDE/..\n", "if CANARY; fi\n",
        x_bash=". ./target.h\n. OUTSIDE\n",
    ),
    "hadolint_link": _linked_settings(".hadolint.yaml", "CANARY: [\n", Dockerfile="FROM debian\n"),
    "xml_entity": _settings("x.xml", ENTITY),
    "xml_parameter_entity": _settings(
        "x.urdf", '<!DOCTYPE r [<!ENTITY % p SYSTEM "OUTSIDE"> %p;]>\n<robot/>\n', '<!ENTITY e "CANARY">\n'
    ),
    "xml_include": _settings("x.xacro", INCLUDE),
    "xml_schema": _settings("x.xml", SCHEMA),
    "clang_format_inherit": _settings(
        ".clang-format", "BasedOnStyle: InheritParentConfig=OUTSIDE/..\n", "CANARY: [\n", ".clang-format",
        x_cpp="int  f( ){return 1;}\n",
    ),
    "clang_format_link": _linked_settings(".clang-format", "CANARY: [\n", x_cpp="int  f( ){return 1;}\n"),
    "cpplint_link": _linked_settings("CPPLINT.cfg", "filter=CANARY\nlinelength=CANARY\n", x_cpp="int f();\n"),
    "cmake_include": _settings("x.cmake", "include(OUTSIDE)\nconfigure_file(OUTSIDE x)\n", "message(CANARY\n"),
    "cmake_format": _settings(
        ".cmake-format.yaml", "include: [OUTSIDE]\n", "CANARY: [\n", x_cmake="message( hello )\n"
    ),
    "cmake_format_link": _linked_settings(".cmake-format.json", '{"CANARY": ', x_cmake="message( hello )\n"),
    "launch_include": _settings(
        "x.launch.xml", "<launch><include file='OUTSIDE'/><arg name='a' default='$(file-content OUTSIDE)'/></launch>\n",
        "<launch><CANARY/></launch>\n",
    ),
    "launch_command": _settings("x.launch", "<launch><param name='a' command='cat OUTSIDE'/></launch>\n"),
    "launch_textfile": _settings("x.launch", "<launch><param name='a' textfile='OUTSIDE'/></launch>\n"),
    "launch_parameters": _settings("x.launch", "<launch><rosparam file='OUTSIDE'/></launch>\n", "CANARY: 1\n"),
    "manifest_link": _linked_settings("package.xml", "<package><CANARY></package>\n", x_py=PYTHON),
}  # fmt: skip


def _parent(a: Attacker) -> os.PathLike[str]:
    place = a.trap.root / a.name
    place.mkdir(parents=True, exist_ok=True)
    return place
