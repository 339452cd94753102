# SPDX-License-Identifier: Apache-2.0
"""Where what holds data may change: assignments, methods that change it, functions that it is given to."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.code import classes, kinds
from haros_ci.code.body import Call, last_part
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.dependence.targets import targets
from haros_ci.dependence.uses import LOG, NUMBER, Use, uses, uses_of
from haros_ci.dependence.variables import Held
from haros_ci.records import dataclass

#: Methods of containers, pointers, messages, times and ROS objects that change nothing of what they are called on.
LOOKING = frozenset(
    "size length empty at front back begin end cbegin cend rbegin rend find count contains get data c_str str value has_value "
    "value_or load toSec toNSec seconds nanoseconds to_msg isZero is_zero find_first_of substr compare keys values items copy "
    "startswith endswith split strip lower upper format index encode decode join now get_clock get_logger get_name getTopic "
    "get_topic_name get_namespace getNamespace getNumSubscribers getNumPublishers get_subscription_count get_num_connections "
    "exists wait_for_service wait_for_server waitForServer waitForExistence service_is_ready server_is_ready publish "
    "sendTransform getParam param hasParam ok rows cols norm dot cross x y z w transpose inverse squaredNorm isValid isNull "
    "total_seconds tolist astype mean sum min max any all what expired use_count joinable is_set is_alive isEnabled "
    "use_sim_time is_activated".split()
)
#: Methods that change what they are called on.
CHANGING = frozenset(
    "push_back emplace_back push emplace insert clear erase resize assign pop pop_back pop_front push_front reserve fill store "
    "exchange swap append extend remove add discard update setdefault popleft appendleft sort reverse put set reset setZero "
    "setIdentity set_value notify_all notify_one setValue stop start cancel setPeriod shutdown header".split()
)
#: What changes whether callbacks of a timer or subscription run.
SWITCHING = frozenset("stop start cancel reset setPeriod shutdown destroy".split())
#: Types whose methods change nothing that a publication is made of.
QUIET = frozenset(
    "ros::NodeHandle ros::Publisher ros::ServiceClient ros::ServiceServer rclcpp::Publisher rclcpp::Client rclcpp::Service "
    "rclcpp::Logger rclcpp::Clock rclcpp::Node rclcpp_lifecycle::LifecycleNode rclcpp_lifecycle::LifecyclePublisher "
    "std::mutex std::recursive_mutex std::shared_mutex boost::mutex std::unique_lock std::lock_guard std::scoped_lock "
    "rclpy.publisher.Publisher rclpy.client.Client rclpy.node.Node rospy.Publisher rospy.ServiceProxy rospy.Rate rospy.Service "
    "cv_bridge.CvBridge threading.Lock threading.RLock ros::Rate ros::WallRate rclcpp::Rate rclcpp::WallRate "
    "rclcpp::CallbackGroup tf::TransformBroadcaster tf2_ros::TransformBroadcaster tf2_ros.TransformBroadcaster "
    "tf.TransformBroadcaster image_transport::Publisher image_transport::ImageTransport rclpy.timer.Rate".split()
)
#: Those that only a call that switches them changes.
SWITCHES = frozenset(
    "ros::Timer ros::WallTimer ros::SteadyTimer rclcpp::TimerBase rclcpp::Subscription ros::Subscriber rclpy.timer.Timer "
    "rclpy.subscription.Subscription rospy.Timer rospy.Subscriber".split()
)
#: Functions that keep or change none of their arguments.
PURE = frozenset(
    "abs fabs sqrt pow exp log sin cos tan asin acos atan atan2 hypot floor ceil round fmod fmax fmin min max clamp isnan isinf "
    "isfinite std to_string len float int str bool range isinstance sorted sum any all zip enumerate list dict tuple set repr "
    "type print format hasattr getattr make_pair make_tuple copysign signbit toMsg to_msg norm dot cross array deepcopy copy "
    "radians degrees distance find count size equal publish sendTransform Duration Time toSec fromSec from_seconds sleep "
    "duration_cast milliseconds seconds nanoseconds stoi stod stof strcmp strlen quaternion_from_euler euler_from_quaternion "
    "getYaw get_yaw allclose mean linalg sign not_none static_pointer_cast dynamic_pointer_cast ok cout cerr endl "
    "isZero exp2 log10 lround all_of any_of none_of find_if count_if accumulate".split()
)
#: What makes an object that may keep what it is given, and what keeps a function with its arguments.
MAKERS = frozenset(("make_shared", "make_unique", "reset", "emplace", "bind", "partial", "thread", "Thread", "async"))


@dataclass(frozen=True, slots=True, eq=False)
class Write:
    """A use that changes what is held, with the reason why that is not certain; "" if it is."""

    routine: Routine
    use: Use
    reason: str


@dataclass(frozen=True, slots=True, eq=False)
class Writes:
    """All that may change a thing; *reason* says why there may be more, "" if these are all."""

    found: tuple[Write, ...]
    reason: str = ""


def writes(code: Codebase, what: Held, is_python: bool) -> Writes:
    """All places where *what* may change."""
    key = ("writes", what, is_python)
    if key not in code.kept:
        found: list[Write] = []
        hidden = _by_text(code, what) if is_python else ""
        for routine, use in uses_of(code, what, is_python):
            reason = change(code, routine, use)
            if reason is not None:
                found.append(Write(routine, use, reason))
            hidden = hidden or _hidden(code, routine, use)
        code.kept[key] = Writes(tuple(found), hidden)
    known: Writes = code.kept[key]
    return known


def _by_text(code: Codebase, what: Held) -> str:
    """Why an attribute may be set by a name that is a text; "" if its file does not do that."""
    path = what.owner.partition(":")[0]
    text = code.text(path) if what.kind == "member" else ""
    return f"{path} sets attributes by their names" if "setattr(" in text or "__dict__" in text else ""


def change(code: Codebase, routine: Routine, use: Use) -> str | None:
    """Whether a use changes what it is about: "" if it does, a reason if it may, None if it does not."""
    if use.role in ("whole", "set"):
        return ""
    if use.role == "called":
        return _called(code, routine, use)
    return _given(code, routine, use) if use.role == "given" else None


def _called(code: Codebase, routine: Routine, use: Use) -> str | None:
    call = use.call
    if call is None or call.receiver is None or call.name in LOOKING:
        return None
    name = kinds.type_name(code, routine, call.receiver)
    if name in SWITCHES:
        return "" if call.name in SWITCHING else None
    if name in QUIET or LOG.fullmatch(call.name):
        return None
    if call.name in CHANGING or use.what.kind == "local":
        return ""
    return f"{routine.title} calls {call.name} on {use.what.title}"


def _given(code: Codebase, routine: Routine, use: Use) -> str | None:
    call = use.call
    if call is None or call.name in PURE or syntax.name_of(call.callee).startswith("std::chrono::"):
        return None
    sure = [target for target, reason in targets(code, routine, call) if target.function.kind != "lambda"]
    if sure:
        found = [_parameter_changes(code, target, use) for target in sure]
        return next((reason for reason in found if reason is not None), None)
    if _is_constant(code, routine, use) or last_part(call.callee)[:1].isupper():
        return None
    return f"{routine.title} gives {use.what.title} to {call.name or 'a function'}"


def _is_constant(code: Codebase, routine: Routine, use: Use) -> bool:
    """Whether a function in Python is given a number, a text or a truth value."""
    if not routine.is_python:
        return False
    every = [value for what, value in _values(code, use.what) if what is not None]
    return bool(every) and all(isinstance(value, (syntax.Number, syntax.String, syntax.Boolean)) for value in every)


def _values(code: Codebase, what: Held) -> list[tuple[Held, syntax.Expression]]:
    found: list[tuple[Held, syntax.Expression]] = []
    for _, use in uses_of(code, what, True):
        if use.role == "whole":
            for value in use.step.values:
                if isinstance(value, syntax.Assignment):
                    found.append((what, value.value))
    return found


def _parameter_changes(code: Codebase, target: Routine, use: Use) -> str | None:
    """Whether a function of the workspace changes the argument that it is given."""
    parameters = target.function.parameters
    if isinstance(use.argument, int):
        fitting = parameters[use.argument : use.argument + 1] or parameters[-1:]
    else:
        fitting = tuple(one for one in parameters if one.name == use.argument)
    for parameter in fitting:
        if not target.is_python and _is_copied(parameter.type):
            return None
        key = ("parameter changes", id(target), parameter.name)
        if key not in code.kept:
            code.kept[key] = None  # while it is looked at: functions that call each other
            code.kept[key] = _changes(code, target, parameter.name)
            code.kept["keep", id(target)] = target
        found: str | None = code.kept[key]
        if found is not None:
            return found
    return None


def _is_copied(kind: syntax.Type) -> bool:
    """Whether a parameter in C++ is a copy, or may not be changed."""
    is_pointer = "*" in kind.marks or "Ptr" in kind.name or "_ptr" in kind.name
    if not is_pointer and ("&" not in kind.marks or "c" in kind.marks):
        return True
    return NUMBER.fullmatch(kind.name) is not None and not {"&", "*"} & set(kind.marks)


def _changes(code: Codebase, target: Routine, name: str) -> str | None:
    found: str | None = None
    for use in uses(code, target):
        if use.what.kind == "local" and use.what.name == name and not (use.role == "whole" and target.is_python):
            reason = change(code, target, use)
            if reason == "":
                return ""
            found = found if reason is None else reason
    return found


def _hidden(code: Codebase, routine: Routine, use: Use) -> str:
    """Why a thing may change where it is not seen: another object has it; "" if that is not so."""
    if not use.is_direct or use.what.kind == "local":
        return ""
    if use.role == "returned":
        is_shared = _is_returned_itself(code, routine, use)
        return f"{routine.title} gives {use.what.title} to its callers" if is_shared else ""
    call = use.call
    if use.role != "kept" and not (use.role == "given" and call is not None and _keeps(call)):
        return ""
    if routine.is_python:
        shared = not _is_constant(code, routine, use) and not _is_message(code, routine, call)
    else:
        kind = kinds.type_of(code, routine, syntax.Name(use.what.name))
        shared = kind is None or "*" in kind.marks or "ptr" in kind.name.lower() or "&" in kind.marks
    return f"{routine.title} gives {use.what.title} to another object" if shared else ""


def _is_returned_itself(code: Codebase, routine: Routine, use: Use) -> bool:
    """Whether a function returns the thing itself, so that its callers can change it."""
    marks = routine.function.returns.marks
    if (routine.is_python and not _is_constant(code, routine, use)) or "*" in marks:
        return True
    return "&" in marks and "c" not in marks


def _keeps(call: Call) -> bool:
    """Whether a call makes an object that may keep what it is given."""
    return call.name in MAKERS or call.name[:1].isupper()


def _is_message(code: Codebase, routine: Routine, call: object) -> bool:
    """Whether a call makes an object of a class that is not in the workspace: a message, or one of a library."""
    callee = getattr(call, "callee", None)
    if not isinstance(callee, (syntax.Name, syntax.Member)):
        return False
    owner = classes.class_named(code, kinds.dotted(code, routine, callee), routine.source)
    return owner is None
