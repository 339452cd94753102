// SPDX-License-Identifier: Apache-2.0
#include "conveyor_driver/belt_encoder.hpp"

namespace conveyor_driver
{

BeltEncoder::BeltEncoder(double counts_per_metre)
: counts_per_metre_(counts_per_metre), travel_(0.0), speed_(0.0)
{
}

void BeltEncoder::update(std::int32_t counts, double elapsed)
{
  const double moved = (counts - last_counts_) / counts_per_metre_;
  last_counts_ = counts;
  travel_ += moved;
  if (elapsed > 0.0) {
    speed_ = moved / elapsed;
  }
}

}  // namespace conveyor_driver
