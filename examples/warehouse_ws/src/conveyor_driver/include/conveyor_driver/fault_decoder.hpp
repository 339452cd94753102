// SPDX-License-Identifier: Apache-2.0
#ifndef CONVEYOR_DRIVER__FAULT_DECODER_HPP_
#define CONVEYOR_DRIVER__FAULT_DECODER_HPP_

#include <cstdint>
#include <string>

using namespace std;

namespace conveyor_driver
{

/// The drive's status register.
struct DriveStatus
{
  std::uint16_t word = 0;
  int motor_temperature = 0;  ///< degrees Celsius
  int bus_voltage = 0;        ///< volts
  bool emergency_stop = false;
};

/// Say in words what is wrong with the drive; empty when all is well.
string decode_fault(const DriveStatus & status);

}  // namespace conveyor_driver

#endif  // CONVEYOR_DRIVER__FAULT_DECODER_HPP_
