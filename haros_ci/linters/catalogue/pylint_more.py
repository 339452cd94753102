# SPDX-License-Identifier: Apache-2.0
"""The rest of pylint's messages that a profile enables: what ages, what is unused, what a careful team may want."""

from __future__ import annotations

from haros_ci.linters.catalogue.group import Group

# The second letter is pylint's category: E error, W warning, R refactor, C convention.
GROUPS: tuple[Group, ...] = (
    Group(
        "The next Python or ROS distribution may no longer have it (distutils is gone since Python 3.12). Use what its"
        " documentation names instead; in a package's setup.py, setuptools.",
        ("deprecation",),
        (
            ("deprecated-argument", "RW", "No deprecated argument is used."),
            ("deprecated-attribute", "RW", "No deprecated attribute is used."),
            ("deprecated-class", "RW", "No deprecated class is used."),
            ("deprecated-decorator", "RW", "No deprecated decorator is used."),
            ("deprecated-method", "RW", "No deprecated method is used."),
            ("deprecated-module", "RW", "No deprecated module is imported."),
        ),
    ),
    Group(
        "An import that nothing uses is a dependency of the package for nothing, and slows the start of the node."
        " Remove it, or list it in `__all__` if it is meant for others.",
        ("redundancy", "imports"),
        (
            ("unused-import", "SW", "An imported name is used."),
            ("reimported", "SW", "A module is imported once."),
            ("wildcard-import", "SW", "Imported names are listed."),
            ("cyclic-import", "SR", "Modules do not import each other in a circle."),
            ("consider-using-from-import", "SR", "A submodule is imported with from."),
        ),
    ),
    Group(
        "Unused code misleads the reader and often points at a slip. Remove it; a part of a tuple that is not needed"
        " is named `_`.",
        ("redundancy", "unused-code"),
        (
            ("unused-private-member", "SW", "A private member is used."),
            ("unused-variable", "SW", "A variable is used."),
            ("possibly-unused-variable", "SW", "A variable is used other than through locals()."),
            ("unnecessary-pass", "SW", "pass stands only where a block would be empty."),
            ("pointless-string-statement", "SW", "A string that is not a docstring is a comment."),
            ("useless-parent-delegation", "SW", "A method does more than call its parent."),
            ("unnecessary-lambda", "SW", "A function is passed without a lambda around it."),
            ("unnecessary-comprehension", "SR", "A copy is made with list(), dict() or set()."),
        ),
    ),
    Group(
        "Debugging left behind stops the node, as nobody answers the prompt.",
        ("correctness", "debugging"),
        (("forgotten-debug-statement", "RW", "No breakpoint is left in the code."),),
    ),
    Group(
        "Running text as code gives whoever can write the text (a parameter, a launch argument, a message) the"
        " rights of the node. Parse it, or look it up in a table.",
        ("robustness",),
        (
            ("eval-used", "SW", "No text is evaluated as Python."),
            ("exec-used", "SW", "No text is executed as Python."),
        ),
    ),
    Group(
        "A resource that is not closed, a call that never returns, an error code that nobody reads: it works until"
        " it does not.",
        ("robustness", "resources"),
        (
            ("consider-using-with", "SR", "A resource is opened in a with statement."),
            ("method-cache-max-size-none", "SW", "A cache on a method has a limit, as it keeps every object alive."),
            ("missing-timeout", "SW", "A network request has a timeout."),
            (
                "subprocess-popen-preexec-fn",
                "SW",
                "A process is started without preexec_fn, which is unsafe with threads.",
            ),
            ("subprocess-run-check", "SW", "subprocess.run says whether a failure raises."),
            ("unspecified-encoding", "SW", "A text file is opened with an encoding."),
        ),
    ),
    Group(
        "A subclass that behaves unlike its base surprises whoever calls it through the base.",
        ("classes",),
        (
            ("abstract-method", "SW", "A class overrides the abstract methods of its bases."),
            ("arguments-differ", "SW", "An override has the parameters of the method that it overrides."),
            ("bad-classmethod-argument", "SC", "The first parameter of a class method is cls."),
            ("bad-mcs-classmethod-argument", "SC", "The first parameter of a metaclass's class method is named so."),
            ("bad-mcs-method-argument", "SC", "The first parameter of a metaclass's method is cls."),
            ("bad-staticmethod-argument", "SW", "A static method does not call its first parameter self."),
            ("invalid-overridden-method", "SW", "An override is of the same kind as what it overrides."),
            ("non-parent-init-called", "SW", "__init__ of a direct base is called."),
            ("redefined-slots-in-subclass", "SW", "A slot is declared once."),
            ("signature-differs", "SW", "An override can be called like the method that it overrides."),
            ("super-init-not-called", "SW", "__init__ calls that of its base."),
        ),
    ),
    Group(
        "A convention that keeps mistakes visible.",
        ("readability",),
        (
            ("bad-file-encoding", "SC", "Source text is UTF-8."),
            ("inconsistent-return-statements", "SR", "A function returns a value on every path or on none."),
            ("named-expr-without-context", "SW", "An assignment expression stands where its value is used."),
            ("non-ascii-name", "SC", "Names are ASCII."),
            ("non-ascii-module-import", "SC", "Names of modules are ASCII."),
            ("redefined-argument-from-local", "SR", "A loop or with statement does not rebind a parameter."),
            ("redefined-builtin", "SW", "A name does not hide a built-in one."),
            ("simplifiable-condition", "SR", "A condition is as simple as it can be."),
            ("simplifiable-if-expression", "SR", "A boolean is not chosen by a conditional expression."),
            ("simplify-boolean-expression", "SR", "A boolean expression is as simple as it can be."),
            ("singleton-comparison", "SC", "None, True and False are compared with is."),
            ("too-many-nested-blocks", "SR", "Blocks are not nested more than five deep."),
            ("unidiomatic-typecheck", "SC", "A type is tested with isinstance."),
            ("unnecessary-dunder-call", "SC", "A special method is called through its operator."),
        ),
    ),
    Group(
        "Say what a caller needs to know: units, frames, threads, what is published and when.",
        ("documentation",),
        (
            ("empty-docstring", "SC", "A docstring says something."),
            ("missing-class-docstring", "SC", "A public class has a docstring."),
            ("missing-function-docstring", "SC", "A public function has a docstring."),
            ("missing-module-docstring", "SC", "A module has a docstring."),
        ),
    ),
)
