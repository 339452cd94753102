// SPDX-License-Identifier: Apache-2.0
#include <functional>
#include <memory>
#include <string>

#include "map_keeper/grid_file.hpp"
#include "nav_msgs/msg/occupancy_grid.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_components/register_node_macro.hpp"
#include "warehouse_msgs/srv/save_map.hpp"

namespace map_keeper
{

class MapKeeper : public rclcpp::Node
{
public:
  MapKeeper(const rclcpp::NodeOptions & options)
  : Node("map_keeper", options)
  {
    map_sub_ = create_subscription<nav_msgs::msg::OccupancyGrid>(
      "map", rclcpp::QoS(1).transient_local(),
      std::bind(&MapKeeper::on_map, this, std::placeholders::_1));
    save_srv_ = create_service<warehouse_msgs::srv::SaveMap>(
      "save_map",
      std::bind(&MapKeeper::on_save, this, std::placeholders::_1, std::placeholders::_2));
  }

private:
  void on_map(const nav_msgs::msg::OccupancyGrid::SharedPtr message)
  {
    grid_.width = static_cast<int>(message->info.width);
    grid_.height = static_cast<int>(message->info.height);
    grid_.cells.assign(message->data.begin(), message->data.end());
  }

  void on_save(
    const std::shared_ptr<warehouse_msgs::srv::SaveMap::Request> request,
    std::shared_ptr<warehouse_msgs::srv::SaveMap::Response> response)
  {
    response->success = write_grid(request->path, grid_);
    response->message = std::to_string(occupied_percent(grid_)) + " % occupied";
  }

  Grid grid_;
  rclcpp::Subscription<nav_msgs::msg::OccupancyGrid>::SharedPtr map_sub_;
  rclcpp::Service<warehouse_msgs::srv::SaveMap>::SharedPtr save_srv_;
};

}  // namespace map_keeper

RCLCPP_COMPONENTS_REGISTER_NODE(map_keeper::MapKeeper)
