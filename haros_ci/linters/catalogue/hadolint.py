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
                ("DL3011", "Be", "Exposed port outside 0 to 65535."),
                ("DL3012", "Re", "Several HEALTHCHECK instructions in one stage."),
                ("DL3014", "Rw", "apt-get install without -y, which waits for input."),
                ("DL3021", "Be", "COPY of several files to a target without a final slash."),
                ("DL3022", "Rw", "COPY --from an unknown stage."),
                ("DL3023", "Be", "COPY --from its own stage."),
                ("DL3024", "Be", "Duplicate stage name."),
                ("DL3030", "Rw", "yum install without -y."),
                ("DL3034", "Rw", "zypper install without -y."),
                ("DL3038", "Rw", "dnf install without -y."),
                ("DL3043", "Be", "ONBUILD with ONBUILD, FROM or MAINTAINER."),
                ("DL3044", "Be", "ENV that refers to a variable of the same instruction."),
                ("DL3061", "Be", "Dockerfile that begins with an instruction other than FROM or ARG."),
                ("DL3063", "Rw", "Reserved word as a stage name."),
                ("DL4003", "Rw", "Several CMD instructions, of which only the last counts."),
                ("DL4004", "Re", "Several ENTRYPOINT instructions, of which only the last counts."),
            ),
        ),
        Group(
            "A command that fails is not noticed, or the image behaves otherwise than at a terminal.",
            ("robustness",),
            (
                ("DL3000", "Re", "Relative WORKDIR."),
                ("DL3002", "Sw", "root as the last USER."),
                ("DL3003", "Sw", "cd instead of WORKDIR."),
                ("DL3004", "Re", "sudo in a Dockerfile."),
                ("DL3025", "Sw", "CMD or ENTRYPOINT not in JSON form, so signals do not reach the program."),
                ("DL3045", "Sw", "COPY to a relative path without WORKDIR."),
                ("DL3046", "Sw", "useradd with a high user id without -l."),
                ("DL4005", "Sw", "Default shell changed without SHELL."),
                (
                    "DL4006",
                    "Sw",
                    "RUN with a pipe without pipefail, which hides failures before the pipe.",
                ),
            ),
        ),
        Group(
            "What is installed is what is newest on the day of the build. For ROS packages the distribution's snapshot or the"
            " base image is what pins them.",
            ("reproducibility",),
            (
                ("DL3006", "Sw", "Base image without a tag."),
                ("DL3007", "Sw", "Base image with the tag latest."),
                ("DL3008", "-w", "apt-get install without a version."),
                ("DL3013", "-w", "pip install without a version."),
                ("DL3016", "-w", "npm install without a version."),
                ("DL3018", "-w", "apk add without a version."),
                ("DL3028", "-w", "gem install without a version."),
                ("DL3033", "-w", "yum install without a version."),
                ("DL3037", "-w", "zypper install without a version."),
                ("DL3041", "-w", "dnf install without a version."),
                ("DL3062", "-w", "go install without a version."),
                ("DL3029", "Sw", "FROM with a fixed --platform."),
                ("DL3065", "Sn", "FROM with a redundant --platform."),
            ),
        ),
        Group(
            "What is left in a layer stays in the image, whatever later layers delete.",
            ("size",),
            (
                ("DL3009", "Sn", "apt lists not deleted in their layer."),
                ("DL3010", "Sn", "Archive extracted without ADD."),
                ("DL3015", "Sn", "apt-get install without --no-install-recommends."),
                ("DL3019", "Sn", "apk add without --no-cache."),
                ("DL3032", "Sw", "yum cache not deleted in its layer."),
                ("DL3036", "Sw", "zypper cache not deleted in its layer."),
                ("DL3040", "Sw", "dnf cache not deleted in its layer."),
                ("DL3042", "-w", "pip install without --no-cache-dir."),
                ("DL3047", "-n", "wget with a progress bar in the log."),
                ("DL3059", "-n", "Consecutive RUN instructions."),
                ("DL3060", "Sn", "yarn cache not deleted in its layer."),
                ("DL3067", "Sw", "COPY --from of the whole file system."),
            ),
        ),
        Group(
            "",
            ("maintainability",),
            (
                ("DL1001", "-n", "Comment that disables hadolint rules."),
                ("DL3001", "-n", "Command without use in a container."),
                ("DL3020", "Sw", "ADD instead of COPY for plain files."),
                ("DL3026", "Se", "Base image from a registry that is not allowed."),
                ("DL3027", "Sw", "apt instead of apt-get."),
                ("DL3035", "Sw", "Upgrade of the whole distribution."),
                ("DL3048", "-n", "Invalid label key."),
                ("DL3049", "Sn", "Missing label that the configuration requires."),
                ("DL3050", "Sn", "Label that the configuration does not know."),
                ("DL3051", "Sw", "Empty label."),
                ("DL3052", "Sw", "Invalid URL in a label."),
                ("DL3053", "Sw", "Time in a label that does not follow RFC 3339."),
                ("DL3054", "Sw", "Licence in a label that is not an SPDX identifier."),
                ("DL3055", "Sw", "Label that is not a Git commit hash."),
                ("DL3056", "Sw", "Version in a label that is not a semantic version."),
                ("DL3057", "-n", "Missing HEALTHCHECK."),
                ("DL3058", "Sw", "Invalid e-mail address in a label."),
                ("DL3066", "-n", "USER given by name instead of number."),
                ("DL4000", "Sw", "Deprecated MAINTAINER instead of a label."),
                ("DL4001", "-w", "Both wget and curl."),
            ),
        ),
        Group(
            "What ARG and ENV hold can be read in the image. Use a secret mount: `RUN --mount=type=secret`.",
            ("secrets",),
            (("DL3064", "Rw", "Secret in ARG or ENV."),),
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
        return TABLE.rule(identifier, "Sw", f"Finding of hadolint's rule {identifier}.", _OTHER)
    known = shellcheck.rules().get(identifier) or shellcheck.invented(identifier)
    own = TABLE.rule(identifier, "Sw", known.summary, _OTHER)
    return replace(
        own, level=known.level, profiles=known.profiles, tags=("code-standards", "hadolint", *known.tags[1:])
    )
