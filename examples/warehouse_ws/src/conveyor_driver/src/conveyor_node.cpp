// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "conveyor_driver/belt_encoder.hpp"
#include "conveyor_driver/fault_decoder.hpp"
#include "conveyor_driver/modbus_frame.hpp"
#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/float64.hpp"
#include "std_srvs/srv/trigger.hpp"
#include "warehouse_msgs/msg/belt_state.hpp"

namespace conveyor_driver
{

/// A stretch of the belt with a speed limit of its own.
struct Zone
{
  double begin;
  double end;
  double max_speed;
};

class ConveyorNode : public rclcpp::Node
{
public:
  ConveyorNode()
  : Node("conveyor"), encoder_(declare_parameter("counts_per_metre", 4096.0))
  {
    state_pub_ = create_publisher<warehouse_msgs::msg::BeltState>("belt_state", 10);
    command_sub_ = create_subscription<std_msgs::msg::Float64>(
      "belt_command", 10, std::bind(&ConveyorNode::on_command, this, std::placeholders::_1));
    stop_srv_ = create_service<std_srvs::srv::Trigger>(
      "stop_belt",
      std::bind(&ConveyorNode::on_stop, this, std::placeholders::_1, std::placeholders::_2));
    timer_ = create_wall_timer(
      std::chrono::milliseconds(50), std::bind(&ConveyorNode::on_timer, this));
  }

private:
  const Zone * zone_at(double travel) const
  {
    for (const Zone & zone : zones_) {
      if (travel >= zone.begin && travel < zone.end) {
        return &zone;
      }
    }
    return nullptr;
  }

  void on_command(const std_msgs::msg::Float64::SharedPtr message)
  {
    const Zone * zone = zone_at(encoder_.travel());
    if (zone == nullptr) {
      ++commands_outside_;
    }
    target_ = std::min(message->data, zone->max_speed);
  }

  void on_stop(
    const std::shared_ptr<std_srvs::srv::Trigger::Request>,
    std::shared_ptr<std_srvs::srv::Trigger::Response> response)
  {
    target_ = 0.0;
    response->success = true;
    response->message = "belt stops";
  }

  /// Mean load per parcel in grams.
  int mean_load(int total_load, int parcels)
  {
    if (parcels == 0) {
      ++empty_cycles_;
    }
    return total_load / parcels;
  }

  void on_timer()
  {
    std::string fault;
    if (status_.word != 0 || status_.emergency_stop) {
      fault = decode_fault(status_);
    }
    // haros: ignore[nullPointer] the publisher is made in the constructor
    warehouse_msgs::msg::BeltState state;
    state.header.stamp = now();
    state.speed = encoder_.speed();
    state.travel = encoder_.travel();
    state.fault = fault;
    state_pub_->publish(state);
    if (mean_load(load_, parcels_) > 2500) {
      RCLCPP_WARN(get_logger(), "heavy parcels on the belt");
    }
  }

  BeltEncoder encoder_;
  DriveStatus status_;
  std::vector<Zone> zones_ = {{0.0, 4.0, 0.8}, {4.0, 9.5, 1.6}};
  double target_ = 0.0;
  int load_ = 0;
  int parcels_ = 0;
  int commands_outside_ = 0;
  int empty_cycles_ = 0;
  rclcpp::Publisher<warehouse_msgs::msg::BeltState>::SharedPtr state_pub_;
  rclcpp::Subscription<std_msgs::msg::Float64>::SharedPtr command_sub_;
  rclcpp::Service<std_srvs::srv::Trigger>::SharedPtr stop_srv_;
  rclcpp::TimerBase::SharedPtr timer_;
};

}  // namespace conveyor_driver

int main(int argc, char ** argv)
{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<conveyor_driver::ConveyorNode>());
  rclcpp::shutdown();
  return 0;
}
