# SPDX-License-Identifier: Apache-2.0
"""What analysed files say of others: which of these are code, though their names are those of no language."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.workspace.discover import discover
from haros_ci.workspace.used_code import UsedCode

PYTHON = "def f():\n    return undefined\n"
BODY = "int f(int x) {\n  return x;\n}\n"

NEWER = "type Number = int\nprint(undefined)\n"

#: A file that refers to "src/part.…", its text, and the name and text of the part.
FIRES = {
    "an include": ("src/a.cpp", '#include "part.inc"\n', "part.inc", BODY),
    "an include of another directory": ("src/a.cpp", '#include "../b/./part.x"\n', "part.x", BODY),
    "an include in brackets, without a suffix": ("src/a.cpp", "#include <part>\n", "part", BODY),
    "a digraph": ("src/a.cpp", '%:include "part.inc"\n', "part.inc", BODY),
    "a name with a blank": ("src/a.cpp", '#include "part.cpp "\n', "part.cpp ", BODY),
    "a macro": ("src/a.cpp", '#define PART "part.inc"\n#include PART\n', "part.inc", BODY),
    "a macro that makes a text": ("src/a.cpp", "#define S(x) #x\n#include S(part.inc)\n", "part.inc", BODY),
    "a splice": ("src/a.cpp", '#inc\\\nlude "pa\\\nrt.inc"\n', "part.inc", BODY),
    "comments between": ("src/a.cpp", '/* a */ # /* b */ include /* c */ "part.inc"\n', "part.inc", BODY),
    "a source of a target": ("CMakeLists.txt", "add_executable(a src/part.dat)\n", "part.dat", BODY),
    "a copy": ("CMakeLists.txt", "file(COPY_FILE src/part.txt part.cpp)\n", "part.txt", BODY),
    "a file that is read": ("CMakeLists.txt", "file(READ src/part.txt TEXT)\n", "part.txt", BODY),
    "a command": (
        "CMakeLists.txt",
        "add_custom_command(OUTPUT a.cpp COMMAND cp ${X}/src/part.txt a.cpp)\n",
        "part.txt",
        BODY,
    ),
    "an interpreter in CMake": (
        "CMakeLists.txt",
        "execute_process(COMMAND python3 -u src/part.dat)\n",
        "part.dat",
        "import os\n",
    ),
    "an interpreter that CMake found": (
        "CMakeLists.txt",
        "execute_process(COMMAND ${Python3_EXECUTABLE} src/part.dat)\n",
        "part.dat",
        "import os\n",
    ),
    "an interpreter in Python": (
        "a.py",
        "subprocess.run([sys.executable, 'src/part.dat'])\n",
        "part.dat",
        "import os\n",
    ),
    "an interpreter as prefix": (
        "a.launch",
        '<launch><node pkg="p" type="n" name="n" launch-prefix="python3 $(find p)/src/part.dat"/></launch>\n',
        "part.dat",
        "import os\n",
    ),
    "a program for uv": (
        "CMakeLists.txt",
        "install(PROGRAMS src/part DESTINATION lib/p)\n",
        "part",
        "#!/usr/bin/env -S uv run --script\nimport os\n",
    ),
    "a first line that asks for Python": (
        "setup.py",
        "DATA = [('lib/p', ['src/part.run'])]\n",
        "part.run",
        f"#!/usr/bin/env -S nice python3\n{NEWER}",
    ),
    "a name of full width": ("a.py", "\uff45xec(open('src/part.txt').read())\n", "part.txt", "print(undefined)\n"),
    "an interpreter in quotes": (
        "setup.py",
        "DATA = [('lib/p', ['src/part'])]\n",
        "part",
        '#!/usr/bin/env -S py"thon3"\nprint(undefined)\n',
    ),
    "an interpreter that is not known": (
        "setup.py",
        "DATA = [('lib/p', ['src/part'])]\n",
        "part",
        "#!/usr/bin/env -S coverage run\nprint(undefined)\n",
    ),
    "a copy that is kept": (
        "setup.py",
        "DATA = [('lib/p', ['src/part.old'])]\n",
        "part.old",
        "#!/usr/bin/env python3\nprint(undefined)\n",
    ),
    "a program whose first line has the name of another language": (
        "CMakeLists.txt",
        "install(PROGRAMS src/part.run DESTINATION lib/p)\n",
        "part.run",
        f"#!/usr/bin/env -S lua=1 nice python3\n{NEWER}",
    ),
    "lines that Python runs when it starts": (
        "setup.py",
        "",
        "part.pth",
        "# paths\nlib/more\nimport os; print(undefined)\n",
    ),
    "a notebook's interpreter": (
        "a.launch",
        '<launch><node launch-prefix="ipython src/part.ipy" pkg="p" type="n" name="n"/></launch>\n',
        "part.ipy",
        "%precision 3\nprint(x)\n",
    ),
    "Objective-C in a directory of sources": ("CMakeLists.txt", "aux_source_directory(src SOURCES)\n", "part.M", BODY),
    "an archive": ("a.py", "sys.path.insert(0, 'part.zip')\n", "part.zip", "\0"),
    "another way to exec": (
        "a.py",
        "__import__('builtins').exec(open('part.txt').read())\n",
        "part.txt",
        "import os\n",
    ),
    "a template of a header": ("src/a.cpp", '#include "part.hpp.in"\n', "part.hpp.in", BODY),
    "a language": (
        "CMakeLists.txt",
        "set_source_files_properties(src/part.dat PROPERTIES LANGUAGE CXX)\n",
        "part.dat",
        BODY,
    ),
    "a language of a pattern": (
        "CMakeLists.txt",
        "file(GLOB A src/*.dat)\nset_source_files_properties(${A} PROPERTIES LANGUAGE CXX)\n",
        "part.dat",
        BODY,
    ),
    "a language for a compiler": (
        "CMakeLists.txt",
        "add_compile_options(-xc++)\nadd_library(a src/part.z)\n",
        "part.z",
        BODY,
    ),
    "an include of the command line": (
        "CMakeLists.txt",
        "add_compile_options(-include src/part.txt)\n",
        "part.txt",
        BODY,
    ),
    "a header that is made": ("CMakeLists.txt", "configure_file(src/part.h.in part.h @ONLY)\n", "part.h.in", BODY),
    "a source that is made of any file": (
        "CMakeLists.txt",
        "configure_file(src/part.txt part.cpp)\n",
        "part.txt",
        BODY,
    ),
    "Python that is made": ("CMakeLists.txt", "configure_file(src/part.py.in part.py)\n", "part.py.in", "import os\n"),
    "a program": (
        "CMakeLists.txt",
        "catkin_install_python(PROGRAMS src/part DESTINATION bin)\n",
        "part",
        "import os\n",
    ),
    "a program of a suffix": (
        "CMakeLists.txt",
        "install(PROGRAMS src/part.node DESTINATION bin)\n",
        "part.node",
        "#!/usr/bin/python3\n",
    ),
    "a text that is run": ("a.py", "exec(open('part.txt').read())\n", "part.txt", "import os\n"),
    "a text that is run by name": (
        "a.py",
        "NAME = 'part.txt'\nwith open(NAME) as file:\n    exec(file.read())\n",
        "part.txt",
        "import os\n",
    ),
    "a module that is loaded": (
        "a.py",
        "SourceFileLoader('part', 'src/part.mod').load_module()\n",
        "part.mod",
        "import os\n",
    ),
    "an include of a name of data": ("src/a.cpp", '#include "part.md"\n', "part.md", "using A = int;\n"),
    "an include of settings": ("src/a.cpp", '#include "../b/part.yaml"\n', "part.yaml", BODY),
    "an include of data by a macro": ("src/a.cpp", "#define S(x) #x\n#include S(part.xml)\n", "part.xml", BODY),
    "a language for a page": (
        "CMakeLists.txt",
        "set_source_files_properties(src/part.md PROPERTIES LANGUAGE CXX)\n",
        "part.md",
        "/* a */\n" + BODY,
    ),
    "settings that are copied as C++": ("CMakeLists.txt", "file(COPY_FILE src/part.yaml a.cpp)\n", "part.yaml", BODY),
    "a name of data with a shebang": ("a.py", "", "part.xml", "#!/usr/bin/env python3\nx\n"),
    "a name of data that is run": ("a.py", "exec(open('part.yaml').read())\n", "part.yaml", "import os\n(\n"),
    "a page that is run": ("a.py", "runpy.run_path('part.md')\n", "part.md", "print(undefined)\n"),
    "a name as an argument": (
        "a.py",
        "def load(name):\n    exec(open(name).read())\n\nload('part.dat')\n",
        "part.dat",
        PYTHON,
    ),
    "over lines": ("a.py", "with open('part.dat',\n  'r') as f:\n    exec(\n        f.read())\n", "part.dat", PYTHON),
    "an interpreter in Python code": (
        "a.py",
        "code.InteractiveInterpreter().runsource(open('part.dat').read())\n",
        "part.dat",
        PYTHON,
    ),
    "a profiler": ("a.py", "cProfile.run(open('part.cfg').read())\n", "part.cfg", PYTHON),
    "a debugger": ("a.py", "text = open('part.dat').read()\nimport pdb\npdb.run(text)\n", "part.dat", PYTHON),
    "lines of a file": ("a.py", "exec(''.join(linecache.getlines('part.dat')))\n", "part.dat", PYTHON),
    "a pipe": ("a.py", "subprocess.run('cat part.dat | python3', shell=True)\n", "part.dat", PYTHON),
    "words of a command": ("a.py", "os.execvp('python3', shlex.split('python3 part.cfg'))\n", "part.cfg", PYTHON),
    "a shell script": ("a.sh", "cat part.dat | python3\n", "part.dat", PYTHON),
    "a program in a launch file": (
        "a.launch",
        '<launch><node pkg="p" type="part.yaml" name="n"/></launch>\n',
        "part.yaml",
        PYTHON,
    ),
    "a program called as data": (
        "CMakeLists.txt",
        "install(PROGRAMS src/part.yaml DESTINATION lib)\n",
        "part.yaml",
        PYTHON,
    ),
    "settings of dynamic_reconfigure that are run": (
        "a.py",
        "subprocess.run(['python3', 'part.cfg'])\n",
        "part.cfg",
        "import os\ngen = ParameterGenerator()\n",
    ),
    "a comment of several lines before an include": ("src/a.cpp", '/* a\n*/ #include "part.inc"\n', "part.inc", BODY),
    "a long comment within an include": (
        "src/a.cpp",
        "#include /*" + "a\n" * 900 + '*/ "part.inc"\n',
        "part.inc",
        BODY,
    ),
    "a splice behind a form feed": ("src/a.cpp", '#inc\\\f\nlude "pa\\\v \nrt.inc"\n', "part.inc", BODY),
    "a form feed": ("src/a.cpp", '\f#\vinclude "part.inc"\n', "part.inc", BODY),
    "a long path": ("src/a.cpp", '#include "' + "./" * 900 + 'part.inc"\n', "part.inc", BODY),
    "a name in brackets": (
        "CMakeLists.txt",
        "set_source_files_properties([[src/part.dat]] PROPERTIES LANGUAGE CXX)\n",
        "part.dat",
        BODY,
    ),
    "a name with an escape": (
        "CMakeLists.txt",
        "set_source_files_properties(src/part\\.dat PROPERTIES LANGUAGE CXX)\n",
        "part.dat",
        BODY,
    ),
    "a name in an expression": ("CMakeLists.txt", "add_library(a $<1:src/part.dat>)\n", "part.dat", BODY),
    "a command with parentheses in a comment": (
        "CMakeLists.txt",
        "configure_file( # (made)\n  src/part.h.in part.h)\n",
        "part.h.in",
        BODY,
    ),
    "a template in brackets": ("CMakeLists.txt", "configure_file([=[src/part.h.in]=] part.h)\n", "part.h.in", BODY),
    "a command in a block": (
        "CMakeLists.txt",
        "if(A)\nelse()\n  add_library(a [[src/part.dat]])\nendif()\n",
        "part.dat",
        BODY,
    ),
    "a form": (
        "src/form.ui",
        '<ui><customwidget><header location="global"> part&#46;inc </header></customwidget></ui>\n',
        "part.inc",
        BODY,
    ),
    "an include of a form": ("src/form.ui", '<ui><include location="src/part.inc"/></ui>\n', "part.inc", BODY),
    "a module of C++": ("src/a.cpp", "int b;\n", "part.cppm", BODY),
    "Objective-C++": ("src/a.cpp", "int b;\n", "part.mm", BODY),
    "an extension of Python": ("setup.py", "Extension('a', ['src/part.txt'], language='c++')\n", "part.txt", BODY),
    "a flag of an extension": (
        "setup.py",
        "Extension('a', ['src/a.cpp'], extra_compile_args=['-include', 'src/part.txt'])\n",
        "part.txt",
        BODY,
    ),
    "a language in brackets": (
        "CMakeLists.txt",
        "set_source_files_properties(src/part.dat PROPERTIES LANGUAGE [[CXX]])\n",
        "part.dat",
        BODY,
    ),
    "a language after a comment": (
        "CMakeLists.txt",
        "set_source_files_properties(src/part.dat PROPERTIES LANGUAGE #[[a]] CXX)\n",
        "part.dat",
        BODY,
    ),
    "a source without a dot": (
        "CMakeLists.txt",
        "set_source_files_properties(src/part PROPERTIES LANGUAGE CXX)\n",
        "part",
        BODY,
    ),
    "a pattern of a language": (
        "CMakeLists.txt",
        "file(GLOB A src/[p]art.da?)\nset_source_files_properties(${A} PROPERTIES LANGUAGE CXX)\n",
        "part.dat",
        BODY,
    ),
    "an include of the command line in long": (
        "CMakeLists.txt",
        "add_compile_options(--include=src/part.txt src/part.txt)\n",
        "part.txt",
        BODY,
    ),
    "a comment before the body": (
        "CMakeLists.txt",
        "configure_file(src/part.hpp.in part.hpp)\n",
        "part.hpp.in",
        "int & pick()  // ; (\n{\n  return a;\n}\n",
    ),
    "digraphs": (
        "CMakeLists.txt",
        "configure_file(src/part.h.in part.h)\n",
        "part.h.in",
        "int f() <%\n  return a;\n%>\n",
    ),
    "Python with a place to fill": (
        "CMakeLists.txt",
        "configure_file(src/part.py.in part.py)\n",
        "part.py.in",
        "@HEADER@\nimport os\n",
    ),
    "a program by its permissions": (
        "CMakeLists.txt",
        "install(FILES src/part.x DESTINATION lib PERMISSIONS OWNER_READ OWNER_EXECUTE)\n",
        "part.x",
        "import os\n",
    ),
    "annotated assignments": (
        "a.py",
        "cProfile.run(open('part.dat').read())\n",
        "part.dat",
        "part: int = undefined(1)\n",
    ),
    "a long text of Python": (
        "a.py",
        "cProfile.run(open('part.dat').read())\n",
        "part.dat",
        "import os\n" + "a = f(1)\n" * 40_000,
    ),
    "Cython": ("a.py", "", "part.pyx", "import os\n"),
    "compiled Python": ("a.py", "", "part.pyc", "x"),
}
PAGE = "# Part\n\nUse it so:\n\n```python\nimport os\n```\n\n```cpp\nint f() {\n  return 1;\n}\n```\n"
QUIET = {
    "a page that nothing includes": ("src/a.cpp", '#include "other.md"\n', "part.md", BODY),
    "a page of the setup": (
        "setup.py",
        "with open('version.py') as f:\n    exec(f.read())\nwith open('part.md') as f:\n    text = f.read()\n",
        "part.md",
        PAGE,
    ),
    "a page beside a header that a macro names": (
        "src/a.cpp",
        "// see part.md\n#include FT_FREETYPE_H\n",
        "part.md",
        PAGE,
    ),
    "a page on which a command depends": (
        "CMakeLists.txt",
        "add_custom_target(doc DEPENDS src/part.md)\n",
        "part.md",
        PAGE,
    ),
    "settings of a program": (
        "a.py",
        "subprocess.run([sys.executable, 'a.py'])\nyaml.safe_load(open('part.yaml'))\n",
        "part.yaml",
        "a: 1\nb:\n  import: os\n",
    ),
    "settings beside a search path": (
        "a.py",
        "here = os.path.dirname(__file__)\nsys.path.append(here)\nf = os.path.join(here, 'part.yaml')\n",
        "part.yaml",
        "rate: 10\n",
    ),
    "a list of requirements": (
        "a.py",
        "subprocess.run('pip install -r part.txt')\n",
        "part.txt",
        "numpy\nscipy==1.0\n",
    ),
    "JSON": ("a.py", "subprocess.run(['tool', 'part.json'])\n", "part.json", '{"a": [1, 2], "b": "f(x)"}\n'),
    "settings that parse as Python": (
        "a.py",
        "subprocess.run(['tool', 'part.ini'])\n",
        "part.ini",
        "a = 1\nb = name\n",
    ),
    "Python that only an editor reads": ("a.py", "print('part.txt')\n", "part.txt", PYTHON),
    "Python of another name": ("a.py", "exec(open('apart.txt').read())\n", "part.txt", PYTHON),
    "a shell script that is installed": (
        "CMakeLists.txt",
        "install(PROGRAMS src/part.sh DESTINATION lib/p)\n",
        "part.sh",
        "#!/bin/sh\nf() {\n  python3 -c 'import os';\n}\n",
    ),
    "a module of CMake": ("CMakeLists.txt", "include(src/part.cmake)\n", "part.cmake", "project(a)\nmessage(b)\n"),
    "a robot that is read": (
        "a.py",
        "subprocess.check_output(['xacro', 'part.urdf'])\n",
        "part.urdf",
        "<robot name='a'><!-- import os --></robot>\n",
    ),
    "an archive of settings": ("a.launch", '<launch><rosparam file="part.yaml"/></launch>\n', "part.yaml", "if: on\n"),
    "settings of dynamic_reconfigure": (
        "CMakeLists.txt",
        "generate_dynamic_reconfigure_options(src/part.cfg)\n",
        "part.cfg",
        "#!/usr/bin/env python\nfrom dynamic_reconfigure.parameter_generator_catkin import *\ngen = ParameterGenerator()\n",
    ),
    "a comment that names a header": ("src/a.cpp", "/* see part.inc */\n", "part.inc", BODY),
    "data that is installed with permissions": (
        "CMakeLists.txt",
        "install(FILES src/part.x DESTINATION share PERMISSIONS OWNER_READ OWNER_WRITE)\n",
        "part.x",
        "import os\n",
    ),
    "an address in a list of options": ("CMakeLists.txt", "# mail a@b.org about src/part.dat\n", "part.dat", BODY),
    "paths alone": ("setup.py", "DATA = ['src/part.pth']\n", "part.pth", "# import os\nlib/more\nimportant/one\n"),
    "another language": (
        "setup.py",
        "DATA = ['src/part.run']\n",
        "part.run",
        "#!/usr/bin/env -S nice perl\nprint $x;\n",
    ),
    "a first line that nobody names": (
        "setup.py",
        "DATA = ['src/part.run.txt']\n",
        "part.run",
        "#!/usr/bin/env -S nice python3\nx = 1\n",
    ),
    "a script of Matlab": ("CMakeLists.txt", "add_executable(a src/a.cpp)\n", "part.m", BODY),
    "Matlab in a directory of sources": (
        "CMakeLists.txt",
        "aux_source_directory(src SOURCES)\n",
        "part.m",
        "function y = f(x)\n  y = x;\nend\n",
    ),
    "weights": ("a.py", "exec(x)\nload('part.pth')\n", "part.pth", "\0"),
    "what a program of Python is given": (
        "a.py",
        "subprocess.run([sys.executable, 'tool.py', 'part.txt'])\n",
        "part.txt",
        "x",
    ),
    "what a module is given": ("a.py", "subprocess.run([sys.executable, '-m', 'tool', 'part.txt'])\n", "part.txt", "x"),
    "what a text is given": (
        "CMakeLists.txt",
        'execute_process(COMMAND python3 -c "print(1)" part.txt OUTPUT_VARIABLE x)\n',
        "part.txt",
        "x",
    ),
    "a version of Python": ("a.py", "# python 3.8 reads this\nopen('part.txt')\n", "part.txt", "x"),
    "a program in Julia": (
        "CMakeLists.txt",
        "install(PROGRAMS src/part DESTINATION lib/p)\n",
        "part",
        "#!/usr/bin/env julia\nx = 1\n",
    ),
    "nothing": ("src/a.cpp", BODY, "part.inc", BODY),
    "a form with another header": (
        "src/form.ui",
        "<ui><header>other.inc</header><string>part.inc</string></ui>\n",
        "part.inc",
        BODY,
    ),
    "an include of another name": ("src/a.cpp", '#include "apart.inc"\n', "part.inc", BODY),
    "a text": ("src/a.cpp", 'const char *s = "part.inc";\n', "part.inc", BODY),
    "a macro that nothing includes": ("src/a.cpp", '#define PART "part.inc"\n', "part.inc", BODY),
    "a macro that includes another": ("src/a.cpp", "#include FT_FREETYPE_H\n", "part.inc", BODY),
    "a file that is opened": ("src/a.cpp", 'std::ifstream f("part.txt");\n', "part.txt", "x"),
    "a file that is installed": ("CMakeLists.txt", "install(FILES src/part.txt DESTINATION share)\n", "part.txt", "x"),
    "a source without a language": ("CMakeLists.txt", "add_library(a src/part.ui)\n", "part.ui", "x"),
    "the languages of a project": (
        "CMakeLists.txt",
        "project(a LANGUAGES CXX)\ninstall(FILES part.txt)\n",
        "part.txt",
        "x",
    ),
    "the language of a linker": (
        "CMakeLists.txt",
        "set_target_properties(a PROPERTIES LINKER_LANGUAGE CXX)\ninstall(FILES part.txt)\n",
        "part.txt",
        "x",
    ),
    "the language in a condition": (
        "CMakeLists.txt",
        "add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-Wall>)\ninstall(FILES part.txt)\n",
        "part.txt",
        "x",
    ),
    "an include directory": (
        "CMakeLists.txt",
        "include_directories(include-x)\ninstall(FILES part.txt)\n",
        "part.txt",
        "x",
    ),
    "a header of values": (
        "CMakeLists.txt",
        "configure_file(part.h.in part.h)\n",
        "part.h.in",
        '#define VERSION "@V@"\n',
    ),
    "data that is made": ("CMakeLists.txt", "configure_file(part.yaml.in part.yaml)\n", "part.yaml.in", "a: 1\n"),
    "a page that is made": ("CMakeLists.txt", "configure_file(part.txt.in part.txt)\n", "part.txt.in", "x\n"),
    "a text that CMake reads": ("CMakeLists.txt", "file(READ src/part.txt TEXT)\n", "part.txt", "1.2.3\n"),
    "Protocol Buffers": (
        "CMakeLists.txt",
        "add_custom_command(OUTPUT a.cc COMMAND protoc src/part.proto)\n",
        "part.proto",
        'syntax = "proto3";\nservice A {\n  rpc B(C) returns (D) {}\n}\nmessage C { int32 a = 1; }\n',
    ),
    "a text that is installed": ("CMakeLists.txt", "install(FILES src/part.txt DESTINATION share)\n", "part.txt", BODY),
    "a directory on the path": ("a.py", "sys.path.append('part')\n", "other", "x"),
    "Perl": ("CMakeLists.txt", "install(PROGRAMS src/part.pl DESTINATION bin)\n", "part.pl", "#!/usr/bin/env perl\n"),
    "a text that is read": ("a.py", "text = open('part.txt').read()\n", "part.txt", "import os\n"),
    "a text beside one that is run": (
        "a.py",
        "exec(open('version.py').read())\nsetup(long_description=open('part.rst').read())\n",
        "part.rst",
        "Part\n====\n\n    import os\n",
    ),
    "a model that is evaluated": ("a.py", "model.eval('part.pth')\nre.compile('part.pth')\n", "part.pth", "x"),
    "a program of Ruby": ("setup.py", "DATA = ['src/part']\n", "part", "#!/usr/bin/env ruby\nprint(1)\n"),
    "an interpreter that is not known, of what is no Python": (
        "setup.py",
        "DATA = ['src/part']\n",
        "part",
        "#!/usr/bin/env elvish\necho $a\n",
    ),
    "what is no text": ("a.py", "exec(open('part.txt').read())\n", "part.txt", "\0"),
    "a method that is called so": ("a.py", "cursor.execute('part.txt')\nre_compiled = 'part.txt'\n", "part.txt", "x"),
}


def why(place: Path, path: str, text: str, name: str, part: str) -> str:
    for file, data in ((path, text), (f"src/{name}", part)):
        (place / file).parent.mkdir(exist_ok=True, parents=True)
        (place / file).write_text(data)
    return UsedCode(discover(place, (".",))).why(f"src/{name}")


@pytest.mark.parametrize("name", FIRES)
def test_code_under_a_name_of_no_language(name: str, tmp_path: Path) -> None:
    assert why(tmp_path, *FIRES[name])


@pytest.mark.parametrize("name", QUIET)
def test_what_is_no_code(name: str, tmp_path: Path) -> None:
    assert why(tmp_path, *QUIET[name]) == ""


@pytest.mark.parametrize(
    ("path", "text", "is_reached"),
    [
        ("a.cpp", '#include ".h/part.hpp"\n', True),
        ("CMakeLists.txt", "include_directories(.h)\n", True),
        ("a.py", "sys.path.append('.h')\nimport part\n", True),
        ("a.py", "sys.path.append('.h')\n", False),
        ("a.py", "import x.h.part\n", False),
        ("a.py", "from .h.part import x\n", True),
        ("a.py", "import part\n", False),
        ("a.cpp", '#include "x.h/part.hpp"\n', False),
        ("a.cpp", '#include "part.h"\n', False),
        ("readme.md", ".h/part.hpp\n", False),
    ],
)
def test_who_leads_to_a_directory_that_nobody_enters(path: str, text: str, is_reached: bool, tmp_path: Path) -> None:
    (tmp_path / path).write_text(text)
    assert UsedCode(discover(tmp_path, (".",))).reaches(".h/part.hpp", ".h") is is_reached


def test_a_link_leads_there(tmp_path: Path) -> None:
    (tmp_path / ".h").mkdir()
    (tmp_path / ".h/part.hpp").write_text(BODY)
    (tmp_path / "lib").symlink_to(".h")
    assert UsedCode(discover(tmp_path, (".",))).reaches(".h/part.hpp", ".h")


@pytest.mark.parametrize(
    ("name", "text", "other", "is_stray"),
    [
        ("all.xml", "<launch/>\n", "", True),
        ("all.xml", "<?xml version='1.0'?>\n<!-- a -->\n<launch>\n</launch>\n", "", True),
        ("all.xml", "<launch/>\n", '<launch><include file="$(find a)/all.xml"/></launch>\n', False),
        ("all.xml", "<robot/>\n", "", False),
        ("all.xml", "<robot><launch/></robot>\n", "", False),
        ("all.launch.xml", "<launch/>\n", "", False),
        ("all.launch", "<launch/>\n", "", False),
        ("all.yaml", "launch:\n- node:\n    pkg: a\n", "", True),
        ("all.yml", "%YAML 1.2\n---\n# a\n'launch' :\n  # b\n  - node: {pkg: a}\n", "", True),
        ("all.yaml", "launch: [{node: {pkg: a}}]\n", "", True),
        ("all.yaml", "launch:\n- node:\n    pkg: a\n", "# all.yaml\n", False),
        ("all.xml", "<!DOCTYPE launch>\n<launch/>\n", "", True),
        ("all.yaml", "{launch: [{node: {pkg: a}}]}\n", "", True),
        ("all.yaml", "&a launch:\n- node:\n    pkg: a\n", "", True),
        ("all.yaml", "!!map\n? launch\n: - node: {pkg: a}\n", "", True),
        ("all.yaml", "{launching: [a]}\n", "", False),
        ("all.xml", "<!DOCTYPE robot>\n<robot/>\n", "", False),
        ("all.xml", "<launch/>\n", "add_rostest(all.xml)\n", False),
        ("all.yaml", "launch: true\n", "", False),
        ("all.yaml", "launch:\n  file: a.py\n", "", False),
        ("all.yaml", "launches:\n- a\n", "", False),
        ("all.yaml", "a:\n  launch:\n  - a\n", "", False),
        ("all.launch.yaml", "launch:\n- node:\n    pkg: a\n", "", False),
    ],
)
def test_launch_files_by_their_text_alone(name: str, text: str, other: str, is_stray: bool, tmp_path: Path) -> None:
    (tmp_path / name).write_text(text)
    (tmp_path / ("CMakeLists.txt" if "(" in other else "other.launch")).write_text(other)
    assert UsedCode(discover(tmp_path, (".",))).kind_of_stray_launch(name) == (
        is_stray and Path(name).suffix[1:].replace("yml", "yaml") or ""
    )


@pytest.mark.parametrize(
    ("name", "text", "language"),
    [
        ("part.inc", BODY, "C++"),
        ("part", "// a\n" + BODY, "C++"),
        ("part.dat", PYTHON, "Python"),
        ("part.old", "#!/usr/bin/env python3\nprint(x)\n", "Python"),
        ("part.run", f"#!/usr/bin/env -S nice python3\n{NEWER}", "Python"),
        ("part.ipynb", '{"cells": [{"cell_type": "code", "source": []}]}\n', "Python"),
        ("part.ipynb", '{"cells": [{"cell_type": "markdown", "source": []}]}\n', ""),
        ("part.run", "#!/bin/sh\nprint(x)\n", ""),
        ("part.md", PYTHON, "Python"),
        ("part.pyi", PYTHON, ""),
        ("part.java", "class A { int f(int x) { return x; } }\n", ""),
        ("part.md", BODY, ""),
        ("part.txt", "Call f(x) {\n", ""),
        ("part.json", '{"a": [{"b": 1}]}\n', ""),
        ("part.cfg", "gen = ParameterGenerator()\nimport os\n", ""),
        ("part.dat", "1 2 3\n", ""),
        ("part.inc", "X(a)\nX(b)\n", ""),
        ("part.h.in", BODY, ""),
        ("part.bin", "\0" + BODY, ""),
    ],
)
def test_languages_by_the_text_alone(name: str, text: str, language: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(text)
    assert UsedCode(discover(tmp_path, (".",))).language_by_text(name) == language


def _reaches(root: Path, manifest: str) -> bool:
    """Whether a file of the ignored package ``arm_sim`` is reached, where this stands in the manifest of another and that names the file, too."""
    for path, text in {
        "arm/package.xml": f"<package><name>arm</name>{manifest}</package>\n",
        "arm/src/a.cpp": "int simulation;\n",
        "arm_sim/COLCON_IGNORE": "",
        "arm_sim/src/simulation.cpp": BODY,
    }.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text, encoding="utf-8")
    return UsedCode(discover(root, (".",))).reaches("arm_sim/src/simulation.cpp", "arm_sim")


@pytest.mark.parametrize(
    "manifest",
    [
        "",
        "<exec_depend>arm_sim</exec_depend>",
        '<build_export_depend condition="$ROS_VERSION == 2">arm_sim</build_export_depend>',
        "<!-- <exec_depend>arm_sim</exec_depend> -->",
        "<!--\n arm_sim \n-->",
        "<!-- no end: arm_sim " + "<!--" * 200_000,
    ],
)
def test_a_dependency_on_an_ignored_package_reaches_no_file_of_it(manifest: str, tmp_path: Path) -> None:
    assert not _reaches(tmp_path, manifest)


@pytest.mark.parametrize(
    "manifest",
    [
        '<export><arm plugin="${prefix}/../arm_sim/simulation.xml"/></export>',
        "<!-- a --><export>arm_sim</export><!-- b -->",
    ],
)
def test_another_word_of_a_manifest_may(manifest: str, tmp_path: Path) -> None:
    assert _reaches(tmp_path, manifest)


@pytest.mark.parametrize(
    ("name", "part", "code", "is_named"),
    [
        ("part.txt", "print(undefined)\n", "pydoc.importfile('part.txt')\n", True),
        ("part.dat", "print(undefined)\n", "PLACE = f'{HERE}/part.dat'\n", True),
        ("part", "x = call()\n", 'run(HERE / "part")\n', True),
        ("part.yaml", "print(undefined)\n", "load('src/part.yaml')\n", True),
        ("part.txt", "print(undefined)\n", "part = 'part.text'\n", False),
        ("part.txt", "print(undefined)\n", "# part.txt\n", False),
        ("part.txt", "rate = 10\n", "load('part.txt')\n", False),
        ("part.txt", "numpy\nscipy\n", "load('part.txt')\n", False),
        ("part.txt", "Run print(x) to see it.\n", "load('part.txt')\n", False),
        ("part.yaml", "rate: 10\nname: f(x)\n", "load('part.yaml')\n", False),
        ("part.json", '{"a": [1, "f(x)"]}\n', "load('part.json')\n", False),
        ("part.lua", 'include "map.lua"\noptions = {\n  a = 1,\n}\n', "load('part.lua')\n", False),
        ("part.cmake", "set(A)\n", "load('part.cmake')\n", False),
        ("part.cfg", "gen = ParameterGenerator()\n", "load('part.cfg')\n", False),
        ("part.md", "print(1)\n", "load('part.md')\n", False),
    ],
)
def test_calls_that_code_names(name: str, part: str, code: str, is_named: bool, tmp_path: Path) -> None:
    for file, data in (("a.py", code), (f"src/{name}", part)):
        (tmp_path / file).parent.mkdir(exist_ok=True)
        (tmp_path / file).write_text(data)
    assert UsedCode(discover(tmp_path, (".",))).namer_of_calls(f"src/{name}") == ("a.py" if is_named else "")
