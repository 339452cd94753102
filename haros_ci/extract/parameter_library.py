# SPDX-License-Identifier: Apache-2.0
"""The YAML of generate_parameter_library as the program that is generated from it."""

from __future__ import annotations

from haros_ci.extract.parameter_library_cpp import cpp_program
from haros_ci.extract.parameter_library_python import python_program
from haros_ci.extract.parameter_library_tree import read_library
from haros_ci.syntax import Program


def read_parameter_library(path: str, text: str, language: str = "cpp") -> Program:
    """The code that generate_parameter_library (*language* cpp) or generate_parameter_module (python) makes of YAML.

    The classes have the names and members of the generated ones (the package's README, "Use generated struct into
    project source code"): ``ns::Params`` and its structs, ``ns::ParamListener`` with its constructors and get_params;
    in Python they are members of the class ``ns``. Each parameter is one call of ``declare_parameter`` on the first
    argument of the constructor, at the line and column of its key: ``declare_parameter<T>(prefix + name, default,
    descriptor)``, without the default where there is none. Parameters of a ``__map_`` are declared in a loop over the
    array that names its keys. A validator is in the descriptor as far as it bounds a number.

    Faults of the YAML are the program's problems; nothing is raised. The program does not depend on *path*.
    """
    library = read_library(text)
    if not library.name:
        return Program(language, problems=tuple(library.problems))
    return python_program(library) if language == "python" else cpp_program(library)
