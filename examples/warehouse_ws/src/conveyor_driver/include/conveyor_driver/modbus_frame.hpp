// SPDX-License-Identifier: Apache-2.0
#ifndef CONVEYOR_DRIVER__MODBUS_FRAME_HPP_
#define CONVEYOR_DRIVER__MODBUS_FRAME_HPP_

#include <string>
#include <vector>

namespace conveyor_driver
{

/// The ASCII frame that writes `value` into register `address`.
std::string write_frame(unsigned char unit, unsigned address, long value);

/// A frame as the technicians read it in the log: `:01 06 00 1A`.
std::string to_log(const std::vector<unsigned char> & frame);

}  // namespace conveyor_driver

#endif  // CONVEYOR_DRIVER__MODBUS_FRAME_HPP_
