# SPDX-License-Identifier: Apache-2.0
"""Look-ups of transforms (tf2, tf), and what catches their exceptions."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.code import kinds
from haros_ci.code.body import Around, Call
from haros_ci.code.calls import called
from haros_ci.code.codebase import Codebase, Routine

#: Classes whose lookupTransform and transform throw (docs.ros.org: tf2_ros, tf).
BUFFERS = frozenset(
    "tf2_ros::Buffer tf2_ros::BufferInterface tf2::BufferCore tf2_ros::BufferClient tf::TransformListener tf::Transformer "
    "tf2_ros.Buffer tf2_ros.buffer.Buffer tf2_ros.BufferInterface tf.TransformListener tf.TransformerROS".split()
)
LOOKUPS = frozenset(("lookupTransform", "lookup_transform", "lookupTransformFull", "lookup_transform_full"))
CONVERSIONS = frozenset(("transform", "transformPose", "transformPoint", "transformVector", "transformPointCloud"))
#: What is asked or waited for before.
ASKED = frozenset("canTransform can_transform waitForTransform wait_for_transform wait_for_transform_async".split())
#: Exceptions that have nothing to do with transforms.
OTHERS = frozenset(
    "KeyboardInterrupt ROSInterruptException ROSException ServiceException ValueError KeyError IndexError TypeError "
    "AttributeError ImportError OSError IOError ExternalShutdownException CvBridgeError out_of_range bad_alloc "
    "bad_cast filesystem_error invalid_argument".split()
)


def is_lookup(code: Codebase, routine: Routine, call: Call) -> bool:
    """Whether a call asks a transform buffer for what it may not have: it throws then."""
    if call.name not in LOOKUPS and call.name not in CONVERSIONS or call.receiver is None:
        return False
    if called(code, routine, call.whole):
        return False
    return kinds.type_name(code, routine, call.receiver) in BUFFERS


def is_caught(around: Around) -> bool:
    """Whether a handler around it may catch what a look-up throws."""
    tried = (place.statement for place in around if isinstance(place.statement, syntax.Try))
    return any(any(map(_may_catch, try_.handlers)) for try_ in tried)


def _may_catch(handler: syntax.Handler) -> bool:
    kind = handler.type
    kinds = (
        [argument for argument in kind.arguments if isinstance(argument, syntax.Type)]
        if kind.name == "Union"
        else [kind]
    )
    names = [kind.name for kind in kinds]
    return any(name.rpartition("::")[2].rpartition(".")[2] not in OTHERS for name in names)
