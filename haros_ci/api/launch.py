# SPDX-License-Identifier: Apache-2.0
"""What launch files say (docs/adding-a-check.md)."""

from __future__ import annotations

from haros_ci.checking.distributions import depends_on_distribution
from haros_ci.checking.launch_edits import renamed_keyword
from haros_ci.checking.launching import included_by, is_end_of_longer, is_nested, meant, owner, said_by
from haros_ci.checking.map_images import LostImage, lost_images
from haros_ci.checking.old_distributions import is_called_old, is_tried, told_of
from haros_ci.checking.optional import is_optional
from haros_ci.checking.outside_arguments import outside_file
from haros_ci.checking.share_uses import share_uses
from haros_ci.checking.started import started_programs
from haros_ci.checking.unread_values import is_undeclared_value, is_unread_argument, unread_parameter
from haros_ci.checking.yaml_texts import yaml_fault
from haros_ci.model.launch_facts import (
    ArgumentDeclaration,
    ArgumentRead,
    CommandUse,
    Comparison,
    ConditionUse,
    ConstructUse,
    FileUse,
    IncludeUse,
    LaunchFact,
    NodePattern,
    PackageUse,
    ParameterFileUse,
    PassedArgument,
    PathUse,
    ProgramUse,
)
from haros_ci.model.program_words import may_make_program
from haros_ci.model.similar_files import similar_files, similar_names

__all__ = [
    "ArgumentDeclaration",
    "ArgumentRead",
    "CommandUse",
    "Comparison",
    "ConditionUse",
    "ConstructUse",
    "FileUse",
    "IncludeUse",
    "LaunchFact",
    "NodePattern",
    "PackageUse",
    "ParameterFileUse",
    "PassedArgument",
    "PathUse",
    "ProgramUse",
    "depends_on_distribution",
    "included_by",
    "is_called_old",
    "is_end_of_longer",
    "is_nested",
    "is_optional",
    "is_tried",
    "is_undeclared_value",
    "is_unread_argument",
    "may_make_program",
    "meant",
    "outside_file",
    "owner",
    "renamed_keyword",
    "said_by",
    "LostImage",
    "lost_images",
    "share_uses",
    "similar_files",
    "similar_names",
    "started_programs",
    "told_of",
    "unread_parameter",
    "yaml_fault",
]
