// SPDX-License-Identifier: Apache-2.0
#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>

#include "agv_base/can_bus.h"
#include "agv_base/odometry.h"

namespace
{

const int kGears[3] = {40, 90, 160};

/// Ticks per metre in a gear, 1 to 3.
int ticksPerMetre(int gear)
{
  if (gear == 3)
  {
    return kGears[gear];
  }
  return kGears[0];
}

class Base
{
public:
  Base() : private_("~"), odometry_(private_.param("wheel_base", 0.6))
  {
    odom_pub_ = node_.advertise<nav_msgs::Odometry>("odom", 50);
    cmd_sub_ = node_.subscribe("cmd_vel", 10, &Base::onCommand, this);
  }

  void step()
  {
    nav_msgs::Odometry message;
    message.header.stamp = ros::Time::now();
    message.pose.pose.position.x = odometry_.x();
    message.pose.pose.position.y = odometry_.y();
    odom_pub_.publish(message);
  }

private:
  void onCommand(const geometry_msgs::Twist::ConstPtr& command)
  {
    const int ticks = ticksPerMetre(2);
    int* wheels = new int[2];
    wheels[0] = static_cast<int>(command->linear.x * ticks);
    wheels[1] = static_cast<int>(command->linear.x * ticks);
    agv_base::sendWheels(wheels[0], wheels[1]);
  }

  ros::NodeHandle node_;
  ros::NodeHandle private_;
  agv_base::Odometry odometry_;
  ros::Publisher odom_pub_;
  ros::Subscriber cmd_sub_;
};

}  // namespace

int main(int argc, char** argv)
{
  ros::init(argc, argv, "base");
  Base base;
  ros::Rate rate(20);
  while (ros::ok())
  {
    base.step();
    ros::spinOnce();
    rate.sleep();
  }
  return 0;
}
