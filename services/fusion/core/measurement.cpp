#include "fusion/core/measurement.hpp"

#include <cmath>
#include <tuple>

namespace vpdr::fusion {
namespace {

auto key(const HeadingRate& m) {
  return std::tuple(m.interval_start_ns, m.rate_radps, m.sigma_radps);
}
auto key(const HeadingEstimate& m) {
  return std::tuple(m.yaw_rad, m.yaw_sigma_rad, m.yaw_is_absolute, m.yaw_zero_sigma_rad,
                    m.yaw_revision_rad);
}
auto key(const StepEvent& m) {
  return std::tuple(m.index, m.length_m, m.length_sigma_m, m.frequency_hz, m.yaw_rad,
                    m.yaw_sigma_rad, m.yaw_revision_rad, m.status, m.probability);
}

}  // namespace

TimestampNs stamp_of(const Measurement& measurement) {
  if (const auto* step = std::get_if<StepEvent>(&measurement)) {
    return step->stamp_ns - (step->frequency_hz > 0.0 ? to_ns(0.5 / step->frequency_hz) : 0);
  }
  return std::visit([](const auto& m) { return m.stamp_ns; }, measurement);
}

bool comes_before(const Measurement& a, const Measurement& b) {
  const TimestampNs stamp_a = stamp_of(a);
  const TimestampNs stamp_b = stamp_of(b);
  if (stamp_a != stamp_b) return stamp_a < stamp_b;
  if (a.index() != b.index()) return a.index() < b.index();
  return std::visit(
      [&b](const auto& m) { return key(m) < key(*std::get_if<std::decay_t<decltype(m)>>(&b)); }, a);
}

bool is_finite(const Measurement& measurement) {
  return std::visit(
      [](const auto& m) {
        return std::apply([](auto... v) { return (std::isfinite(static_cast<double>(v)) && ...); },
                          key(m));
      },
      measurement);
}

bool is_in_range(const Measurement& measurement) {
  if (const auto* rate = std::get_if<HeadingRate>(&measurement)) {
    return rate->sigma_radps > 0.0 && rate->interval_start_ns < rate->stamp_ns;
  }
  if (const auto* heading = std::get_if<HeadingEstimate>(&measurement)) {
    return heading->yaw_sigma_rad > 0.0 && heading->yaw_zero_sigma_rad >= 0.0;
  }
  const auto& step = std::get<StepEvent>(measurement);
  return step.length_m >= 0.0 && (step.frequency_hz == 0.0 || step.frequency_hz > 0.05) &&
         step.length_sigma_m >= 0.0 && step.yaw_sigma_rad > 0.0 && step.probability >= 0.0 &&
         step.probability <= 1.0;
}

}  // namespace vpdr::fusion
