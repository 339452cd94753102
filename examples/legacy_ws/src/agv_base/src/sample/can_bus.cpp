// The vendor's sample code: the project file leaves it out, so its defect is not reported.
#include "agv_base/can_bus.h"

#include <algorithm>
#include <cstdio>

namespace agv_base
{

void sendWheels(int left, int right)
{
  char frame[32];
  sprintf(frame, "W%+05d%+05d\n", std::min(left, kMaxTicks), std::min(right, kMaxTicks));
  fputs(frame, stdout);
}

}  // namespace agv_base
