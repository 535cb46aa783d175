#include "core/estimates.hpp"

namespace vpdr {

const char* name_of(FusionMode mode) {
  switch (mode) {
    case FusionMode::kWaiting:
      return "waiting";
    case FusionMode::kInertial:
      return "inertial";
    case FusionMode::kWithVision:
      return "with vision";
    case FusionMode::kCoasting:
      return "coasting";
  }
  return "unknown";
}

}  // namespace vpdr
