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
            ("deprecated-argument", "RW", "Deprecated argument."),
            ("deprecated-attribute", "RW", "Deprecated attribute."),
            ("deprecated-class", "SW", "Deprecated class."),
            ("deprecated-decorator", "RW", "Deprecated decorator."),
            ("deprecated-method", "SW", "Deprecated method."),
            ("deprecated-module", "SW", "Deprecated module."),
        ),
    ),
    Group(
        "An import that nothing uses is a dependency of the package for nothing, and slows the start of the node."
        " Remove it, or list it in `__all__` if it is meant for others.",
        ("redundancy", "imports"),
        (
            ("unused-import", "SW", "Unused import."),
            ("reimported", "SW", "Module imported twice."),
            ("wildcard-import", "SW", "Import of everything (*)."),
            ("cyclic-import", "SR", "Cyclic import."),
            ("consider-using-from-import", "SR", "Submodule imported without from."),
        ),
    ),
    Group(
        "Unused code misleads the reader and often points at a slip. Remove it; a part of a tuple that is not needed"
        " is named `_`.",
        ("redundancy", "unused-code"),
        (
            ("unused-private-member", "SW", "Unused private member."),
            ("unused-variable", "SW", "Unused variable."),
            ("possibly-unused-variable", "SW", "Variable used only through locals()."),
            ("unnecessary-pass", "SW", "Unnecessary pass."),
            ("pointless-string-statement", "SW", "String statement without effect."),
            ("useless-parent-delegation", "SW", "Override that only calls its parent."),
            ("unnecessary-lambda", "SW", "Unnecessary lambda."),
            ("unnecessary-comprehension", "SR", "Unnecessary comprehension."),
        ),
    ),
    Group(
        "Debugging left behind stops the node, as nobody answers the prompt.",
        ("correctness", "debugging"),
        (("forgotten-debug-statement", "RW", "Breakpoint in the code."),),
    ),
    Group(
        "Running text as code gives whoever can write the text (a parameter, a launch argument, a message) the"
        " rights of the node. Parse it, or look it up in a table.",
        ("robustness",),
        (
            ("eval-used", "SW", "Use of eval."),
            ("exec-used", "SW", "Use of exec."),
        ),
    ),
    Group(
        "A resource that is not closed, a call that never returns, an error code that nobody reads: it works until"
        " it does not.",
        ("robustness", "resources"),
        (
            ("consider-using-with", "SR", "Resource opened without a with statement."),
            ("method-cache-max-size-none", "SW", "Unlimited cache on a method, which keeps its objects alive."),
            ("missing-timeout", "SW", "Network request without a timeout."),
            (
                "subprocess-popen-preexec-fn",
                "SW",
                "preexec_fn of a process, which is unsafe with threads.",
            ),
            ("subprocess-run-check", "SW", "subprocess.run without check."),
            ("unspecified-encoding", "SW", "Text file opened without an encoding."),
        ),
    ),
    Group(
        "A subclass that behaves unlike its base surprises whoever calls it through the base.",
        ("classes",),
        (
            ("abstract-method", "SW", "Abstract method that a class does not override."),
            ("arguments-differ", "SW", "Override with other parameters."),
            ("bad-classmethod-argument", "SC", "Class method whose first parameter is not cls."),
            ("bad-mcs-classmethod-argument", "SC", "Class method of a metaclass with a wrong first parameter."),
            ("bad-mcs-method-argument", "SC", "Method of a metaclass whose first parameter is not cls."),
            ("bad-staticmethod-argument", "SW", "Static method with the first parameter self."),
            ("invalid-overridden-method", "SW", "Override of another kind than the overridden member."),
            ("non-parent-init-called", "SW", "__init__ call of a class that is not a direct base."),
            ("redefined-slots-in-subclass", "SW", "Slot redeclared in a subclass."),
            ("signature-differs", "SW", "Override with an incompatible signature."),
            ("super-init-not-called", "SW", "__init__ without a call of the base's __init__."),
        ),
    ),
    Group(
        "A convention that keeps mistakes visible.",
        ("readability",),
        (
            ("bad-file-encoding", "SC", "Source text that is not UTF-8."),
            ("inconsistent-return-statements", "SR", "Function with and without return values."),
            ("named-expr-without-context", "SW", "Assignment expression used as a statement."),
            ("non-ascii-name", "SC", "Name that is not ASCII."),
            ("non-ascii-module-import", "SC", "Module name that is not ASCII."),
            ("redefined-argument-from-local", "SR", "Parameter rebound by a loop or with statement."),
            ("redefined-builtin", "SW", "Name that hides a built-in."),
            ("simplifiable-condition", "SR", "Condition that can be simplified."),
            ("simplifiable-if-expression", "SR", "Conditional expression that chooses between booleans."),
            ("simplify-boolean-expression", "SR", "Boolean expression that can be simplified."),
            ("singleton-comparison", "SC", "None, True or False compared with ==."),
            ("too-many-nested-blocks", "SR", "Blocks nested more than five deep."),
            ("unidiomatic-typecheck", "SC", "Type tested without isinstance."),
            ("unnecessary-dunder-call", "SC", "Direct call of a special method."),
        ),
    ),
    Group(
        "Say what a caller needs to know: units, frames, threads, what is published and when.",
        ("documentation",),
        (
            ("empty-docstring", "SC", "Empty docstring."),
            ("missing-class-docstring", "SC", "Public class without a docstring."),
            ("missing-function-docstring", "SC", "Public function without a docstring."),
            ("missing-module-docstring", "SC", "Module without a docstring."),
        ),
    ),
)
