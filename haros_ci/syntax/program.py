# SPDX-License-Identifier: Apache-2.0
"""A source file as a program: what C++ and Python say alike, lowered to one small language without resolving anything.

Front ends write it, ``link`` interprets it. It depends on one file's bytes alone.
"""

from __future__ import annotations

from haros_ci.syntax.expressions import Argument, Expression, Type
from haros_ci.syntax.node import Record
from haros_ci.syntax.statements import Block, Init


class Parameter(Record, frozen=True):
    """A function's parameter. Python: *name* starts with ``*`` or ``**`` where it collects; no ``self``."""

    name: str
    type: Type
    default: Expression | None = None


class Initializer(Record, frozen=True):
    """What a constructor gives a member or base class. *guards* are ``(line, column, text)`` of the ``#if`` lines around it in the list."""

    name: str
    type: Type
    arguments: tuple[Expression, ...]
    line: int
    column: int
    guards: tuple[tuple[int, int, str], ...] = ()


class Function(Record, frozen=True):
    """A function's definition or declaration.

    *name* is qualified by the enclosing namespaces and classes, joined by ``::`` (Python: by ``.``, without the module; ""
    is the module's own body). *owner* is the qualified class as far as the file tells, else ""; for C++ it is all of the name but the
    last part, even where that may be a namespace. *kind*: function, constructor, destructor, lambda, module. *templates* are template
    parameters' names, *template_defaults* the types that some of them stand for where nothing else tells. *body* is None for a declaration; *body_line* and *body_column* are its opening brace's (Python: the
    ``def``'s). *guards* are ``(line, column, text)`` of the ``#if`` lines around it. *captures* are the variables that a lambda captures by value, ``=`` for all but ``&name``.
    *specialises* are the template arguments of which it is a full specialisation, as far as they are written behind its name.
    """

    name: str
    owner: str
    kind: str
    parameters: tuple[Parameter, ...]
    returns: Type
    line: int
    column: int
    body: Block | None
    body_line: int = 0
    body_column: int = 0
    templates: tuple[str, ...] = ()
    inits: tuple[Initializer, ...] = ()
    guards: tuple[tuple[int, int, str], ...] = ()
    is_static: bool = False
    is_virtual: bool = False
    decorators: tuple[Expression, ...] = ()
    template_defaults: tuple[tuple[str, Type], ...] = ()
    captures: tuple[str, ...] = ()
    specialises: tuple[Argument, ...] = ()


class Field(Record, frozen=True):
    """A data member, or a variable at namespace or module scope, where its *name* is qualified. *guards* are as of functions."""

    name: str
    type: Type
    init: Init | None
    line: int
    column: int
    is_static: bool = False
    guards: tuple[tuple[int, int, str], ...] = ()


class Directive(Record, frozen=True):
    """A line of the preprocessor: its *word* (``define``, ``include``, ``if``, …) and the *text* after it, without comments.

    ``lost`` stands for those of a file that has too many.
    """

    line: int
    word: str
    text: str


class Class(Record, frozen=True):
    """A class or struct with its bases and its own data members; its methods are functions with it as owner.

    *specialises* are the template arguments that ``struct C<int>`` is written for, with *templates* in them where it is partial; *decorators* are Python's.
    """

    name: str
    bases: tuple[Type, ...]
    fields: tuple[Field, ...]
    line: int
    column: int
    templates: tuple[str, ...] = ()
    specialises: tuple[Argument, ...] = ()
    decorators: tuple[Expression, ...] = ()


class Alias(Record, frozen=True):
    """``using X = T``, ``typedef T X`` (*name* qualified); a namespace alias has marks "namespace" in its type.

    A using-declaration ``using a::b;`` is an alias b of the enclosing scope. Python: an import, *name* local, the type's
    name the dotted target (``rospy``, ``std_msgs.msg.String``; relative imports keep their leading dots).
    """

    name: str
    type: Type
    templates: tuple[str, ...] = ()


class Program(Record, frozen=True):
    """One file. *scopes* are using-directives: (qualified enclosing scope, namespace). *includes* are C++'s, as written.

    *macros* are ``(name, parameters or None, body)``; *registered* are calls at namespace scope, such as
    ``PLUGINLIB_EXPORT_CLASS(A, B)``: (macro, arguments as text, line, column). *problems* are (line, message). *directives*
    are those of the preprocessor that decide which lines a build compiles, in their order.
    """

    language: str
    functions: tuple[Function, ...] = ()
    classes: tuple[Class, ...] = ()
    variables: tuple[Field, ...] = ()
    aliases: tuple[Alias, ...] = ()
    scopes: tuple[tuple[str, str], ...] = ()
    includes: tuple[str, ...] = ()
    macros: tuple[tuple[str, tuple[str, ...] | None, str], ...] = ()
    registered: tuple[tuple[str, tuple[str, ...], int, int], ...] = ()
    problems: tuple[tuple[int, str], ...] = ()
    directives: tuple[Directive, ...] = ()
