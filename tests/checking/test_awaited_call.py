# SPDX-License-Identifier: Apache-2.0
"""blocking-wait-in-callback names the call whose future is waited for."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

NODE = """#include <rclcpp/rclcpp.hpp>
class Asker : public rclcpp::Node
{{
public:
  Asker() : Node("asker")
  {{
    timer_ = create_wall_timer(std::chrono::seconds(1), [this]() {{ tick(); }});
  }}
private:
  void tick()
  {{
    {body}
  }}
  rclcpp::TimerBase::SharedPtr timer_;
}};
int main(int argc, char ** argv)
{{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Asker>());
}}
"""
SPIN = "rclcpp::spin_until_future_complete(get_node_base_interface(), {});"


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("auto done = client_->async_cancel_goal(goal_); " + SPIN.format("done"), "async_cancel_goal"),
        ("auto done = client_->async_send_goal(goal_, options_); " + SPIN.format("done"), "async_send_goal"),
        (SPIN.format("client_->async_get_result(goal_)"), "async_get_result"),
        ("auto sent = client_->async_send_request(request_); " + SPIN.format("sent.future"), "async_send_request"),
        (SPIN.format("done_"), "async_send_request"),
        ("rclcpp::spin_some(get_node_base_interface());", "async_send_request"),
    ],
)
def test_the_call_that_is_waited_for(body: str, expected: str, tmp_path: Path) -> None:
    check = next(check for check in checks() if check.id == "blocking-wait-in-callback")
    (result,) = said(check, Example("", True, {"src/asker.cpp": NODE.format(body=body)}), tmp_path)
    assert f"pass a callback to {expected}, or" in result.message
