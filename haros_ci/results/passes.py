# SPDX-License-Identifier: Apache-2.0
"""The passes that pair findings, the strictest evidence first: which features have to agree in which."""

from __future__ import annotations

from haros_ci.records import dataclass

#: Lines that a mapped line may be off.
NEAR = 3


@dataclass(frozen=True, slots=True)
class MatchPass:
    """Pairs what agrees in all *letters*. *near* asks for a mapped line at most NEAR away, *gone* that the old file is,
    *scoped* that the scope is not the whole file. *edited* asks that the old text is gone and the new one was not
    there, and where the old line's place is known, for that place: an edited line has not moved, too. A place alone is no
    evidence: a finding about another name in a line of another shape is another finding."""

    letters: str
    evidence: str
    near: bool = False
    edited: bool = False
    gone: bool = False
    scoped: bool = False

    @property
    def conditional(self) -> bool:
        """Whether more than the key decides which known findings take part."""
        return self.near or self.edited or self.scoped or "P" not in self.letters

    @property
    def anchor(self) -> str:
        """The few letters that tell soonest what cannot be paired."""
        if "W" in self.letters:
            return "RW"
        return "RT" if "T" in self.letters else "RM" if "M" in self.letters else "RPS"


#: For findings that are about ROS names: those say which finding it is, wherever it stands.
NAMED = (
    MatchPass("RWPLST", "same ROS names at its mapped line"),
    MatchPass("RWPST", "same ROS names, text and scope"),
    MatchPass("RWPT", "same ROS names and text"),
    MatchPass("RWPL", "same ROS names at its mapped line; the line was edited"),
    MatchPass("RWPS", "same ROS names in the same scope; the line was edited", scoped=True),
    MatchPass("RWP", "same ROS names in the same file"),
    MatchPass("RWST", "moved: same ROS names, text and scope in another file"),
    MatchPass("RWN", "moved: same ROS names in a file of the same name"),
    MatchPass("RW", "moved: same ROS names in another file"),
)
IN_FILE = (
    MatchPass("RPLSTX", "same text at its mapped line"),
    MatchPass("RPLSTM", "same text at its mapped line"),
    MatchPass("RPLST", "same text at its mapped line"),
    MatchPass("RPSTXBA", "same text and scope"),
    MatchPass("RPSTMBA", "same text and scope"),
    MatchPass("RPSTMB", "same text and scope"),
    MatchPass("RPSTMA", "same text and scope"),
    MatchPass("RPSTX", "same text and scope"),
    MatchPass("RPSTM", "same text and scope"),
    MatchPass("RPSTB", "same text and scope"),
    MatchPass("RPSTA", "same text and scope"),
    MatchPass("RPST", "same text and scope", scoped=True),
    MatchPass("RPLTM", "same text at its mapped line, in another scope"),
    MatchPass("RPLT", "same text at its mapped line, in another scope"),
    MatchPass("RPTMBA", "same text between the same lines"),
    MatchPass("RPTMB", "same text after the same lines"),
    MatchPass("RPTMA", "same text before the same lines"),
    MatchPass("RPTB", "same text after the same lines"),
    MatchPass("RPTA", "same text before the same lines"),
    MatchPass("RPT", "same text near its mapped line", near=True),
    MatchPass("RPSME", "same message on the file's first line"),
    MatchPass("RPSMBA", "same message between the same lines; the line was edited", edited=True),
    MatchPass("RPSML", "same message at its mapped line; the line was edited", edited=True),
    MatchPass("RPSMB", "same message after the same lines; the line was edited", edited=True),
    MatchPass("RPSMA", "same message before the same lines; the line was edited", edited=True),
    MatchPass("RPSM", "same message near its mapped line; the line was edited", near=True, edited=True),
    MatchPass("RPSMH", "same message and same shape of the line; names were edited", edited=True, scoped=True),
    MatchPass("RPSV", "same metric of the same scope; the line was edited", edited=True),
    MatchPass("RPMBA", "same message between the same lines; scope and line were edited", edited=True),
    MatchPass("RPML", "same message at its mapped line; scope and line were edited", edited=True),
    MatchPass("RPMB", "same message after the same lines; scope and line were edited", edited=True),
    MatchPass("RPMA", "same message before the same lines; scope and line were edited", edited=True),
    MatchPass("RPM", "same message near its mapped line; scope and line were edited", near=True, edited=True),
    MatchPass("RPSH", "same rule and same shape of the line; names were edited", edited=True, scoped=True),
    MatchPass("RPSBA", "same rule between the same lines; the line was edited", edited=True),
    MatchPass("RPSL", "same rule at its mapped line; the line was edited", edited=True),
    MatchPass("RPSMU", "same message in the same scope; the baseline does not tell the text"),
    MatchPass("RPMU", "same message in the same file; the baseline does not tell the text"),
)
MOVED = (
    MatchPass("RSTMBA", "moved: same text and scope in another file"),
    MatchPass("RSTMN", "moved: same text and scope in another file", gone=True),
    MatchPass("RSTM", "moved: same text and scope in another file", scoped=True),
    MatchPass("RST", "moved: same text and scope in another file", scoped=True),
    MatchPass("RTMBA", "moved: same text between the same lines in another file"),
    MatchPass("RTMB", "moved: same text after the same lines in another file", gone=True),
    MatchPass("RTMA", "moved: same text before the same lines in another file", gone=True),
)
RENAMED = (MatchPass("RNSM", "same message in a file of the same name; the old file is gone", gone=True),)
