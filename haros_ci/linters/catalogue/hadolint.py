# SPDX-License-Identifier: Apache-2.0
"""The rules of hadolint; its SC… codes are ShellCheck's, for the commands of RUN."""

from __future__ import annotations

from dataclasses import replace

from haros_ci.linters.catalogue import shellcheck
from haros_ci.linters.catalogue.table import Group, Rule, Table


def _address(rule: str) -> str:
    return (
        f"https://www.shellcheck.net/wiki/{rule}"
        if rule.startswith("SC")
        else f"https://github.com/hadolint/hadolint/wiki/{rule}"
    )


TABLE = Table(
    "hadolint",
    "`# hadolint ignore=CODE` on the line before the instruction",
    _address,
    (
        Group(
            "The image is not built, or is not what the file says.",
            ("correctness",),
            (
                ("DL3011", "Be", "A port that is exposed is one of 0 to 65535."),
                ("DL3012", "Re", "A stage has one HEALTHCHECK."),
                ("DL3014", "Rw", "apt-get install has -y, without which it waits for an answer."),
                ("DL3021", "Be", "The target of a COPY of several files ends with a slash."),
                ("DL3022", "Rw", "COPY --from names a stage that stands above."),
                ("DL3023", "Be", "COPY --from names another stage than its own."),
                ("DL3024", "Be", "Each stage has a name of its own."),
                ("DL3030", "Rw", "yum install has -y."),
                ("DL3034", "Rw", "zypper install has -y."),
                ("DL3038", "Rw", "dnf install has -y."),
                ("DL3043", "Be", "ONBUILD triggers neither ONBUILD nor FROM nor MAINTAINER."),
                ("DL3044", "Be", "An ENV does not refer to a variable that it sets itself."),
                ("DL3061", "Be", "A Dockerfile begins with FROM, ARG or a comment."),
                ("DL3063", "Rw", "The name of a stage is no reserved word."),
                ("DL4003", "Rw", "A stage has one CMD: the last one counts."),
                ("DL4004", "Re", "A stage has one ENTRYPOINT: the last one counts."),
            ),
        ),
        Group(
            "A command that fails is not noticed, or the image behaves otherwise than at a terminal.",
            ("robustness",),
            (
                ("DL3000", "Re", "WORKDIR is absolute."),
                ("DL3002", "Sw", "The last USER is not root."),
                ("DL3003", "Sw", "WORKDIR changes the directory."),
                ("DL3004", "Re", "sudo is not used while an image is built, where one is root anyway."),
                ("DL3025", "Sw", "CMD and ENTRYPOINT are JSON, so that signals reach the program."),
                ("DL3045", "Sw", "COPY to a relative target follows a WORKDIR."),
                ("DL3046", "Sw", "useradd with a high number has -l."),
                ("DL4005", "Sw", "SHELL sets the default shell."),
                (
                    "DL4006",
                    "Sw",
                    "A RUN with a pipe follows a SHELL with -o pipefail, without which failures before the pipe pass.",
                ),
            ),
        ),
        Group(
            "What is installed is what is newest on the day of the build. For ROS packages the distribution's snapshot or the"
            " base image is what pins them.",
            ("reproducibility",),
            (
                ("DL3006", "Sw", "The base image has a tag."),
                ("DL3007", "Sw", "The tag of the base image is not latest."),
                ("DL3008", "-w", "apt-get installs versions that are told."),
                ("DL3013", "-w", "pip installs versions that are told."),
                ("DL3016", "-w", "npm installs versions that are told."),
                ("DL3018", "-w", "apk installs versions that are told."),
                ("DL3028", "-w", "gem installs versions that are told."),
                ("DL3033", "-w", "yum installs versions that are told."),
                ("DL3037", "-w", "zypper installs versions that are told."),
                ("DL3041", "-w", "dnf installs versions that are told."),
                ("DL3062", "-w", "go installs versions that are told."),
                ("DL3029", "Sw", "FROM has no fixed --platform."),
                ("DL3065", "Sn", "FROM has no --platform that is the default anyway."),
            ),
        ),
        Group(
            "What is left in a layer stays in the image, whatever later layers delete.",
            ("size",),
            (
                ("DL3009", "Sn", "The lists of apt are deleted in the layer that fetched them."),
                ("DL3010", "Sn", "ADD extracts archives."),
                ("DL3015", "Sn", "apt-get installs no recommended packages."),
                ("DL3019", "Sn", "apk keeps no cache."),
                ("DL3032", "Sw", "yum's cache is deleted in the layer that filled it."),
                ("DL3036", "Sw", "zypper's cache is deleted in the layer that filled it."),
                ("DL3040", "Sw", "dnf's cache is deleted in the layer that filled it."),
                ("DL3042", "-w", "pip keeps no cache."),
                ("DL3047", "-n", "wget draws no progress bar into the log."),
                ("DL3059", "-n", "RUN instructions that follow each other are one."),
                ("DL3060", "Sn", "yarn's cache is deleted in the layer that filled it."),
                ("DL3067", "Sw", "COPY --from takes less than the whole file system."),
            ),
        ),
        Group(
            "",
            ("maintainability",),
            (
                ("DL1001", "-n", "No comment silences hadolint."),
                ("DL3001", "-n", "No command is run that makes no sense in a container."),
                ("DL3020", "Sw", "COPY copies files; ADD also fetches and extracts."),
                ("DL3026", "Se", "The base image comes from a registry that is allowed."),
                ("DL3027", "Sw", "apt-get is used rather than apt, whose interface is for people."),
                ("DL3035", "Sw", "The distribution is not upgraded."),
                ("DL3048", "-n", "The key of a label is valid."),
                ("DL3049", "Sn", "A label that the configuration asks for is there."),
                ("DL3050", "Sn", "There is no label that the configuration does not know."),
                ("DL3051", "Sw", "A label has a value."),
                ("DL3052", "Sw", "A label that holds an address holds a valid one."),
                ("DL3053", "Sw", "A label that holds a time has the form of RFC 3339."),
                ("DL3054", "Sw", "A label that holds a licence has its SPDX identifier."),
                ("DL3055", "Sw", "A label that holds a commit holds its hash."),
                ("DL3056", "Sw", "A label that holds a version holds a semantic one."),
                ("DL3057", "-n", "There is a HEALTHCHECK."),
                ("DL3058", "Sw", "A label that holds an address of mail holds a valid one."),
                ("DL3066", "-n", "USER is a number."),
                ("DL4000", "Sw", "The maintainer is told in a LABEL; MAINTAINER is deprecated."),
                ("DL4001", "-w", "Either wget or curl is used."),
            ),
        ),
        Group(
            "What ARG and ENV hold can be read in the image. Use a secret mount: `RUN --mount=type=secret`.",
            ("secrets",),
            (("DL3064", "Rw", "No ARG or ENV is called like a password or a key."),),
            precision="medium",
        ),
    ),
    cwe={"DL3064": (312,)},
    security={"DL3064": "5.0"},
)
_OTHER = Group("", (), (), precision="medium")


def rules() -> dict[str, Rule]:
    """The rules of hadolint's own."""
    return TABLE.rules()


def invented(identifier: str) -> Rule:
    """A rule for another code: ShellCheck's under hadolint's name, or one that a newer hadolint has."""
    if not identifier.startswith("SC"):
        return TABLE.rule(identifier, "Sw", f"Hadolint's {identifier} finds nothing.", _OTHER)
    known = shellcheck.rules().get(identifier) or shellcheck.invented(identifier)
    own = TABLE.rule(identifier, "Sw", known.summary, _OTHER)
    return replace(
        own, level=known.level, profiles=known.profiles, tags=("code-standards", "hadolint", *known.tags[1:])
    )
