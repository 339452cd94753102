// SPDX-License-Identifier: Apache-2.0
#ifndef CONVEYOR_DRIVER__BELT_ENCODER_HPP_
#define CONVEYOR_DRIVER__BELT_ENCODER_HPP_

#include <cstdint>

namespace conveyor_driver
{

/// Turns raw encoder counts into travel and speed of the belt.
class BeltEncoder
{
public:
  explicit BeltEncoder(double counts_per_metre);

  /// Take in the counter's value, `elapsed` seconds after the last call.
  void update(std::int32_t counts, double elapsed);

  double travel() const {return travel_;}
  double speed() const {return speed_;}

private:
  double counts_per_metre_;
  std::int32_t last_counts_;
  double travel_;
  double speed_;
};

}  // namespace conveyor_driver

#endif  // CONVEYOR_DRIVER__BELT_ENCODER_HPP_
