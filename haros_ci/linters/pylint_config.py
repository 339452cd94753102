# SPDX-License-Identifier: Apache-2.0
"""The part of a workspace's pylint configuration that cannot run code, read without pylint.

File names and sections as in pylint's documentation, "Configuration": pylintrc, .pylintrc, pyproject.toml, setup.cfg,
tox.ini.
"""

from __future__ import annotations

from collections.abc import Iterator
from posixpath import dirname, join

from haros_ci.linters import settings_files
from haros_ci.model.workspace import Workspace

NAMES = ("pylintrc", ".pylintrc", "pyproject.toml", "setup.cfg", "tox.ini")

#: Options that only switch, count or name things. All others are left out: some execute code (init-hook, load-plugins,
#: extension-pkg-allow-list, evaluation), widen the import path (source-roots), or write files and change the output.
INERT = frozenset(
    """
    disable enable ignore ignore-patterns ignore-paths confidence py-version
    max-line-length ignore-long-lines max-module-lines indent-string indent-after-paren expected-line-ending-format
    single-line-if-stmt single-line-class-stmt
    max-args max-positional-arguments max-locals max-returns max-branches max-statements max-parents max-attributes
    min-public-methods max-public-methods max-bool-expr max-nested-blocks ignored-parents exclude-too-few-public-methods
    good-names good-names-rgxs bad-names bad-names-rgxs name-group include-naming-hint property-classes
    no-docstring-rgx docstring-min-length
    module-naming-style const-naming-style class-naming-style function-naming-style method-naming-style
    attr-naming-style argument-naming-style variable-naming-style class-attribute-naming-style
    class-const-naming-style inlinevar-naming-style
    module-rgx const-rgx class-rgx function-rgx method-rgx attr-rgx argument-rgx variable-rgx class-attribute-rgx
    class-const-rgx inlinevar-rgx typevar-rgx paramspec-rgx typevartuple-rgx typealias-rgx
    dummy-variables-rgx ignored-argument-names additional-builtins callbacks allowed-redefined-builtins init-import
    allow-global-unused-variables redefining-builtins-modules
    ignored-modules ignored-classes generated-members ignore-mixin-members ignored-checks-for-mixins mixin-class-rgx
    ignore-none ignore-on-opaque-inference missing-member-hint contextmanager-decorators
    defining-attr-methods exclude-protected valid-classmethod-first-arg valid-metaclass-classmethod-first-arg
    check-protected-access-in-special-methods overgeneral-exceptions
    notes notes-rgx logging-modules logging-format-style
    deprecated-modules preferred-modules known-standard-library known-third-party allow-any-import-level
    allow-wildcard-with-all allow-reexport-from-package analyse-fallback-blocks
    never-returning-functions max-nested-functions check-str-concat-over-line-jumps check-quote-consistency
    suggest-join-with-non-empty-separator timeout-methods
    """.split()
)


def config_path(workspace: Workspace, directory: str) -> str | None:
    """The nearest file with pylint settings, from *directory* up to the workspace's root."""
    for name in NAMES:
        path = join(directory, name)
        if _has_settings(name, workspace.setting(path)):
            return path
    return config_path(workspace, dirname(directory)) if directory else None


def inert_options(name: str, text: str) -> dict[str, str]:
    """The inert options of a configuration file called *name*. Raises ValueError if it cannot be read.

    Values are as in an INI file: lists are joined by commas.
    """
    options: dict[str, str] = {}
    for key, value in _options(name, text):
        key = key.strip().lower().replace("_", "-")
        if key in INERT:
            options[key] = value
    return options


def _has_settings(name: str, text: str) -> bool:
    if name.endswith("pylintrc"):
        return bool(text.strip())
    return ("[tool.pylint" if name == "pyproject.toml" else "[pylint") in text.replace("[tool:pylint", "[pylint")


def _options(name: str, text: str) -> Iterator[tuple[str, str]]:
    if name == "pyproject.toml":
        yield from _toml_options(text)
        return
    for section, options in settings_files.ini(text).items():
        if name.endswith("pylintrc") or section.startswith(("pylint", "tool:pylint")):
            yield from ((key, str(value)) for key, value in options.items())


def _toml_options(text: str) -> Iterator[tuple[str, str]]:
    for key, value in settings_files.toml(text).get("pylint", {}).items():
        for option, value_given in value.items() if isinstance(value, dict) else ((key, value),):
            if isinstance(value_given, bool):
                yield option, "yes" if value_given else "no"
            elif isinstance(value_given, list):
                yield option, ",".join(str(item) for item in value_given if isinstance(item, (str, int, float)))
            elif isinstance(value_given, (str, int, float)):
                yield option, str(value_given)
