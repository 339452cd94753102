// SPDX-License-Identifier: Apache-2.0
#include "conveyor_driver/modbus_frame.hpp"

#include <cstdio>
#include <string>
#include <vector>

namespace conveyor_driver
{

std::string write_frame(unsigned char unit, unsigned address, long value)
{
  char text[32];
  sprintf(text, ":%02X06%04X%08lX", unit, address, value);
  return text;
}

std::string to_log(const std::vector<unsigned char> & frame)
{
  char pair[4];
  std::string line = ":";
  for (const unsigned char byte : frame) {
    // haros: ignore[runtime/printf] two digits and a blank always fit into four bytes
    sprintf(pair, "%02X ", byte);
    line += pair;
  }
  return line;
}

}  // namespace conveyor_driver
