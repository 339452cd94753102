// SPDX-License-Identifier: Apache-2.0
#ifndef AGV_BASE_ODOMETRY_H
#define AGV_BASE_ODOMETRY_H

namespace agv_base
{

/// Dead reckoning of a two-wheeled base.
class Odometry
{
public:
  Odometry(double wheel_base);  // haros:ignore-line

  void update(double left, double right);

  /// Blend an outside pose into the estimate.
  void correct(double px, double py, double heading, double var_x, double var_y, double var_yaw, double gain);

  double x() const { return x_; }
  double y() const { return y_; }
  double yaw() const { return yaw_; }

private:
  double wheel_base_;
  double x_;
  double y_;
  double yaw_;
};

}  // namespace agv_base

#endif  // AGV_BASE_ODOMETRY_H
