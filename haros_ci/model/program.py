# SPDX-License-Identifier: Apache-2.0
"""A source file as a program: what C++ and Python say alike, lowered to one small language without resolving anything.

Front ends write it, ``link`` interprets it. It depends on one file's bytes alone and is JSON as it stands: statements,
expressions and types are nested tuples with their kind first (lists, once they come back from a cache: read them by
index, never compare them with tuples). Lines and columns are 1-based and count as in ``Location``.

Types, ``T``: ``(name, arguments, marks)``. *name* as written, without template arguments (``std::vector``), Python dotted;
*arguments* are types, or expressions for value arguments; *marks* is a string with ``c`` for const, ``*`` for each
pointer, ``&`` for each reference. A function type is ``("()", (returned, *parameters), marks)``. ``("auto", (), marks)``;
``("", (), "")`` where Python says nothing. A member type keeps its path and has the
arguments of its class where it has none: ``A<T>::B`` is ``("A::B", (T,), "")``.

Expressions, ``E``:

    ("str", text)  ("num", int or float)  ("bool", bool)  ("none",)       literals; adjacent strings are joined
    ("name", "a::b")               an identifier as written, qualified by ``::``; Python names are bare
    ("this",)                      C++ ``this``; Python's first parameter of a method, whatever its name
    ("field", E, name)             ``a.b``, ``a->b``, Python attribute access
    ("index", E, E)                ``a[b]``
    ("call", E, args, T..., line, column)   is ("call", callee, args, template arguments, line, column): where the call
                                   begins, receiver included. ``T(x)``, ``T{x}`` and Python calls are calls, too
    ("new", T, args, line, column)          at the ``new``
    ("op", operator, (E, ...))     unary and binary; ``not``, ``and``, ``or`` are spelled ``!``, ``&&``, ``||``
    ("set", operator, E, E)        assignment: ``=``, ``+=``, ``<<`` stays an op; ``++x`` is ``x += 1``, ``x++`` is
                                   ``(x += 1) - 1`` where its value is used
    ("if", E, E, E)                the conditional expression: test, then, else
    ("lambda", index)              the function at *index* of ``Program.functions``
    ("list", (E, ...))             braces, Python lists, tuples and sets
    ("dict", ((E, E), ...))        Python
    ("format", (E, ...))           Python f-string: its parts, to be joined as text
    ("&", E)  ("*", E)             address and dereference
    ("cast", T, E)                 any C++ cast by keyword or parentheses
    ("type", T)                    a type where an expression is expected (template argument, typeid)
    ("kw", name, E)  ("star", E)  ("starstar", E)   inside args: Python keyword argument and unpackings
    ("?", text)                    anything else, as source text (at most 200 characters)

Statements, ``S``; a *block* is a tuple of them:

    ("do", E)                                        an expression statement
    ("var", name, T, init, line, column)             a local variable. *init* is None, or ("=", E), ("(", args) or
                                                     ("{", args)
    ("static", S)                                    a local variable that is made once
    ("global", (name, ...))  ("nonlocal", (name, ...))   Python: whose variables the names are in this function
    ("if", line, column, text, E, block, else_line, else_column, block)   *text* is the condition as written, spaces
                                                     collapsed; else_line is 0 without else; ``else if`` is an else
                                                     with one if in it. Python's elif: the else stands at the ``elif``
    ("loop", keyword, line, column, text, block, E or None, block)   keyword for, while or do; block before the first
                                                     turn, condition, then the body
    ("step", E)                                      the step expression, last in the body of a ``for``: ``continue`` goes here
    ("each", line, column, text, name, T, E, block)  range-for and Python for (name "" where it is a pattern)
    ("switch", line, column, text, E, ((E or None, block), ...))      None is default; fall-through is kept: a block
                                                     that does not end in break is followed by the next one's
    ("try", block, ((line, column, text, name, T, block), ...))      handlers: catch, except
    ("pre", ((line, column, text, block), ...))      a preprocessor conditional inside a body: #if, #elif, #else
    ("block", block)                                 a scope of its own
    ("return", E or None)  ("break",)  ("continue",)  ("throw", E or None)
    ("def", name, index)                             a nested Python function
    ("class", name)                                  a nested class, in ``Program.classes`` under its qualified name
    ("import", local name, dotted target)            a Python import inside a function
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

#: A type, an expression, a statement: see the module's text.
Type = Any
Expression = Any
Statement = Any
Block = tuple[Statement, ...]


@dataclass(frozen=True, slots=True)
class Parameter:
    """A function's parameter. Python: *name* starts with ``*`` or ``**`` where it collects; no ``self``."""

    name: str
    type: Type
    default: Expression | None = None


@dataclass(frozen=True, slots=True)
class Function:
    """A function's definition or declaration.

    *name* is qualified by the enclosing namespaces and classes, joined by ``::`` (Python: by ``.``, without the module; ""
    is the module's own body). *owner* is the qualified class as far as the file tells, else ""; for C++ it is all of the name but the
    last part, even where that may be a namespace. *kind*: function, constructor, destructor, lambda, module. *templates* are template
    parameters' names. *inits* are a constructor's ``(member or base name, type, args, line, column)``.
    *body* is None for a declaration; *body_line* and *body_column* are its opening brace's (Python: the ``def``'s).
    *guards* are ``(line, column, text)`` of the ``#if`` lines around it.
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
    inits: tuple[tuple[str, Type, tuple[Expression, ...], int, int], ...] = ()
    guards: tuple[tuple[int, int, str], ...] = ()
    is_static: bool = False
    is_virtual: bool = False
    decorators: tuple[Expression, ...] = ()


@dataclass(frozen=True, slots=True)
class Field:
    """A data member, or a variable at namespace or module scope; *init* as in ("var", ...), *name* qualified there."""

    name: str
    type: Type
    init: Any
    line: int
    column: int
    is_static: bool = False


@dataclass(frozen=True, slots=True)
class Class:
    """A class or struct with its bases and its own data members; its methods are functions with it as owner."""

    name: str
    bases: tuple[Type, ...]
    fields: tuple[Field, ...]
    line: int
    column: int
    templates: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Alias:
    """``using X = T``, ``typedef T X`` (*name* qualified); a namespace alias has marks "namespace" in its type.

    A using-declaration ``using a::b;`` is an alias b of the enclosing scope. Python: an import, *name* local, the type's
    name the dotted target (``rospy``, ``std_msgs.msg.String``; relative imports keep their leading dots).
    """

    name: str
    type: Type
    templates: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Program:
    """One file. *scopes* are using-directives: (qualified enclosing scope, namespace). *includes* are C++'s, as written.

    *macros* are ``(name, parameters or None, body)``; *registered* are calls at namespace scope, such as
    ``PLUGINLIB_EXPORT_CLASS(A, B)``: (macro, arguments as text, line, column). *problems* are (line, message).
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
