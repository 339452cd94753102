# SPDX-License-Identifier: Apache-2.0
"""The interfaces that an action is made of, by the names that they have inside of it."""

from __future__ import annotations

import pytest

from haros_ci.index.ros_types import ros2_type
from haros_ci.syntax import Type


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("p::action::Dock::Impl::FeedbackMessage", "p/action/Dock_FeedbackMessage"),
        ("p::action::Dock::Impl::FeedbackMessage::ConstSharedPtr", "p/action/Dock_FeedbackMessage"),
        ("p::action::Dock::Impl::SendGoalService", "p/action/Dock_SendGoal"),
        ("p::action::Dock::Impl::SendGoalService::Request", "p/action/Dock_SendGoal"),
        ("p::action::Dock::Impl::GetResultService", "p/action/Dock_GetResult"),
        ("p::action::Dock::Impl::CancelGoalService", "action_msgs/srv/CancelGoal"),
        ("p::action::Dock::Impl::GoalStatusMessage", "action_msgs/msg/GoalStatusArray"),
        ("p.action.Dock.Impl.FeedbackMessage", "p/action/Dock_FeedbackMessage"),
        ("p.action._dock.Dock.Impl.GetResultService", "p/action/Dock_GetResult"),
        ("p::action::Dock::Impl::Other", None),
        ("p::action::Dock::Impl", None),
        ("p::msg::Dock::Impl::FeedbackMessage", None),
    ],
)
def test_what_an_action_is_made_of(written: str, meant: str | None) -> None:
    assert ros2_type(Type(written)) == meant
