#include "core/reading.hpp"

#include <algorithm>

namespace vpdr {

std::vector<Reading> merge_by_stamp(const std::vector<ImuSample>& imu,
                                    const std::vector<MagSample>& mag,
                                    const std::vector<PressureSample>& pressure) {
  std::vector<Reading> all;
  all.reserve(imu.size() + mag.size() + pressure.size());
  all.insert(all.end(), mag.begin(), mag.end());
  all.insert(all.end(), pressure.begin(), pressure.end());
  all.insert(all.end(), imu.begin(), imu.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const Reading& a, const Reading& b) { return stamp_of(a) < stamp_of(b); });
  return all;
}

}  // namespace vpdr
