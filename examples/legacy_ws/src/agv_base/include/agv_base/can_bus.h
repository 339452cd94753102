// SPDX-License-Identifier: Apache-2.0
#ifndef AGV_BASE_CAN_BUS_H
#define AGV_BASE_CAN_BUS_H

namespace {

const int kMaxTicks = 4000;

}  // namespace

namespace agv_base
{

/// Send one wheel command over the CAN bus; ticks beyond kMaxTicks are cut.
void sendWheels(int left, int right);

}  // namespace agv_base

#endif  // AGV_BASE_CAN_BUS_H
