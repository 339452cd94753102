// SPDX-License-Identifier: Apache-2.0
#include "conveyor_driver/fault_decoder.hpp"

#include <string>

namespace conveyor_driver
{

string decode_fault(const DriveStatus & status)
{
  if (status.emergency_stop) {
    return "emergency stop";
  }
  if (status.motor_temperature > 120 || (status.word & 0x0001 && status.motor_temperature > 90)) {
    return "motor too hot";
  }
  if (status.bus_voltage > 62) {
    return status.word & 0x0002 ? "over-voltage while braking" : "over-voltage";
  }
  if (status.bus_voltage < 38 && status.bus_voltage > 0) {
    return "under-voltage";
  }
  if (status.word & 0x0004) {
    if (status.word & 0x0008) {
      return "short circuit between phases";
    }
    return "short circuit to earth";
  }
  if (status.word & 0x0010 && !(status.word & 0x0020)) {
    return "encoder lost";
  }
  if (status.word & 0x0040 || status.word & 0x0080) {
    return "belt blocked";
  }
  if (status.word & 0x0100) {
    return "belt torn";
  }
  if (status.word & 0x0200) {
    return "lubrication due";
  }
  return "";
}

}  // namespace conveyor_driver
