# SPDX-License-Identifier: Apache-2.0
"""Which packages a target of ROS 2 is compiled with: those that it and its libraries name, and what these bring."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.checking.project import ProjectPackage
from haros_ci.model.build import Target
from haros_ci.regex import regex

_VARIABLE = regex(r"\$\{(\w+?)_(?:LIBRARIES|LIBRARY|TARGETS|LIBS|INCLUDE_DIRS|INCLUDE_DIR|INCLUDES)\}")
#: Libraries of the system that bring no headers of ROS.
_SYSTEM = regex(r"-.*|pthread|dl|m|rt|atomic|stdc\+\+fs|stdc\+\+|GL|GLU|X11|yaml-cpp|tinyxml2?|curl|z|util|gomp|fmt|")
_SCOPES = frozenset(("PUBLIC", "PRIVATE", "INTERFACE", "SYSTEM", "BEFORE", "AFTER"))


class Using:
    """The packages that the targets of one package use; None wherever that is not known for sure."""

    def __init__(self, package: ProjectPackage) -> None:
        self.package = package
        self.cmake = package.cmake
        self._brought: dict[str, frozenset[str] | None] = {}
        finds = package.commands("find_package")
        self._found = {package.name, *package.declared, *(c.arguments[0] for c in finds if c.arguments)}

    def of(self, target: Target) -> frozenset[str] | None:
        """What *target* is compiled with: packages by name, those included that others bring."""
        named: set[str] = set()
        for name in self._named(target):
            if name is None:
                return None
            named.add(name)
        found: set[str] = set()
        for name in named:
            brought = self._brings(name)
            if brought is None:
                return None
            found |= brought
        return frozenset(found)

    def _named(self, target: Target) -> Iterator[str | None]:
        """The packages that the target and its libraries name; None for each word that may stand for anything."""
        if self.package.commands("link_libraries", "link_directories"):
            yield None
        todo, seen = [(target, True)], {target.name}
        while todo:
            other_target, is_first = todo.pop()
            if other_target.name in self.cmake.mentioned or other_target.kind in ("imported", "alias"):
                yield None
            if self._is_auto(other_target):
                yield from self._declared()
            words = [link.word for link in self.cmake.links.get(other_target.name, ()) if is_first or link.is_public]
            if any(library.name == other_target.name for library in self.package.build.parameter_libraries):
                words.append("generate_parameter_library::it")
            for word in words:
                own = self.cmake.real(word.removeprefix(f"{self.package.name}::"))
                if own in self.cmake.targets:
                    if own not in seen:
                        seen.add(own)
                        todo.append((self.cmake.targets[own], False))
                else:
                    yield from self._word(word)
        for word in self.cmake.include_words(target):
            if "$" in word and not word.startswith(("${ROOT}", "${BUILD}")) and "$<" not in word:
                found = _VARIABLE.fullmatch(word)
                yield found[1] if found is not None and found[1] in self._found else None
            elif word.startswith("/"):
                yield None
        for command in self.package.commands("rosidl_target_interfaces"):
            if command.arguments[:1] and self.cmake.real(command.arguments[0]) in seen:
                yield from self._declared()

    def _word(self, word: str) -> Iterator[str | None]:
        """What one word of a link names."""
        name, colons, _ = word.partition("::")
        variable = _VARIABLE.fullmatch(word)
        if colons and "$" not in name:
            yield name
        elif variable is not None:
            yield variable[1] if variable[1] in self._found else None
        elif "__rosidl" in word:
            yield from self._declared()
        elif "$" in word or not _SYSTEM.fullmatch(word):
            yield word if self.package.project.package(word) is not None or word in self.package.declared else None

    def _is_auto(self, target: Target) -> bool:
        return any(
            command.arguments[:1] == (target.name,)
            for command in self.package.commands(
                "ament_auto_add_library", "ament_auto_add_executable", "ament_auto_add_gtest"
            )
        )

    def _declared(self) -> Iterator[str]:
        yield from self.package.declared

    def _brings(self, name: str) -> frozenset[str] | None:
        """*name* and all that it depends on; None if that is not known."""
        if name not in self._brought:
            project = self.package.project
            found: set[str] = set()
            todo = [name]
            while todo:
                item = todo.pop()
                if item in found:
                    continue
                found.add(item)
                inner = project.package(item)
                if inner is not None:
                    todo += [d.name for d in inner.raw.dependencies if d.kind != "test_depend"]
                    continue
                outer = project.knowledge.depends(item, 2)
                if outer is None and project.knowledge.is_package(item) is not False:
                    self._brought[name] = None
                    break
                todo += outer or ()
            else:
                self._brought[name] = frozenset(found)
        return self._brought[name]
