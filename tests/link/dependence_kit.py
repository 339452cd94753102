# SPDX-License-Identifier: Apache-2.0
"""The dependence in small workspaces in memory."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from follow_kit import Nothing, cpp_files, main, python_files, script, workspace

from haros_ci.analysis.architecture import varied
from haros_ci.analysis.code_of import code_of
from haros_ci.analysis.dependence import with_dependence
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Architecture
from haros_ci.model.dependence import Cause, Dependence, Output


def architecture(files: Mapping[str, str], ros: int | None = None) -> Architecture:
    whole = workspace(files, ros)
    settings = Settings(root=Path("/nowhere"))
    made = varied(whole, settings, Nothing(), environment={}, known_nodes=False)
    return with_dependence(made.architecture, code_of(made, whole))


def dependence(files: Mapping[str, str], ros: int | None = None) -> Dependence:
    (configuration,) = architecture(files, ros).configurations
    assert configuration.dependence is not None
    return configuration.dependence


def outputs(files: Mapping[str, str], ros: int | None = None) -> dict[str, Output]:
    """What is sent, by name, of all nodes."""
    return {one.name: one for node in dependence(files, ros).nodes for one in node.outputs}


def said(output: Output) -> dict[str, str]:
    """What is said of each input of an output: ``state x, y`` for one through state, ``?`` before what may be; and why there may be more."""
    found = {cause.name or cause.kind: word(cause) for cause in output.causes}
    return {**found, "more": output.reason} if output.reason else found


def word(cause: Cause) -> str:
    text = f"state {', '.join(cause.state)}" if cause.state else "direct"
    return f"? {text}" if cause.how == "perhaps" else text


def cpp(body: str, before: str = "", launch: str = "") -> dict[str, Output]:
    return outputs(cpp_files(main(body, before).replace("SUB(", "nh.subscribe("), launch))


def python(body: str, launch: str = "") -> dict[str, Output]:
    return outputs(python_files(script(body), launch))


def of_class(callbacks: str, members: str = "", more: str = "", before: str = "") -> dict[str, str]:
    """``SUB(`` stands for the call that subscribes on the handle. The causes of ``/out``, of a class with the callbacks ``one`` of /one, ``two`` of /two, and ``tick`` of a timer."""
    given = {"one": "", "two": "", "tick": "", "send": "pub_.publish(m_);", **_parsed(callbacks)}
    message = "const std_msgs::String& m"
    text = f"""{before}
struct A {{
  A(ros::NodeHandle& nh) {{
    pub_ = ADV("/out", 1);
    one_ = SUB("/one", 1, &A::one, this);
    two_ = SUB("/two", 1, &A::two, this);
    timer_ = nh.createTimer(ros::Duration(0.1), &A::tick, this);
    {more}
  }}
  void one({message}) {{ {given["one"]} }}
  void two({message}) {{ {given["two"]} }}
  void tick(const ros::TimerEvent&) {{ {given["tick"]} }}
  void send() {{ {given["send"]} }}
  {members}
  std_msgs::String m_; bool ready_ = false; int count_ = 0;
  ros::Publisher pub_; ros::Timer timer_; ros::Subscriber one_, two_;
}};"""
    return said(cpp("A a(nh); ros::spin();", text)["/out"])


def _parsed(text: str) -> dict[str, str]:
    found = {}
    for part in text.split("@")[1:]:
        name, _, body = part.partition(" ")
        found[name] = body.strip()
    return found
