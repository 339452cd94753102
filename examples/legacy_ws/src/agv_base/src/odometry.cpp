// SPDX-License-Identifier: Apache-2.0
#include "agv_base/odometry.h"

#include <cmath>

namespace agv_base
{

Odometry::Odometry(double wheel_base) : wheel_base_(wheel_base), x_(0.0), y_(0.0), yaw_(0.0)
{
}

void Odometry::update(double left, double right)
{
  const double travel = (left + right) / 2.0;
  yaw_ += (right - left) / wheel_base_;
  x_ += travel * std::cos(yaw_);
  y_ += travel * std::sin(yaw_);
}

void Odometry::correct(double px, double py, double heading, double var_x, double var_y, double var_yaw, double gain)
{
  x_ += gain / (1.0 + var_x) * (px - x_);
  y_ += gain / (1.0 + var_y) * (py - y_);
  yaw_ += gain / (1.0 + var_yaw) * (heading - yaw_);
}

}  // namespace agv_base
