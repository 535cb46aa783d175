#pragma once
// The boundary check of every sample stream: one bad sample never poisons a filter.
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/samples.hpp"

namespace vpdr {

/// Why a sample was refused.
enum class Refusal : std::uint8_t {
  kNone,
  kNonFinite,
  kDuplicate,
  kBackwardInTime,
  kOutOfRange,
  kTimeJump,  ///< a stamp far from all others
};
inline constexpr std::size_t kRefusalCount = 6;
/// All reasons, for reports.
inline constexpr std::array<Refusal, kRefusalCount - 1> kRefusals = {
    Refusal::kNonFinite, Refusal::kDuplicate, Refusal::kBackwardInTime, Refusal::kOutOfRange,
    Refusal::kTimeJump};

/// Name for diagnostics: "non_finite", "duplicate", "backward_in_time", "out_of_range",
/// "time_jump".
const char* name_of(Refusal refusal);

/// Bounds beyond which a reading is no measurement of a walking person's board.
struct SampleLimits {
  double specific_force_mps2 = 400.0;
  double angular_velocity_radps = 100.0;
  double field_ut = 10000.0;
  double pressure_min_pa = 30000.0;
  double pressure_max_pa = 120000.0;
  double time_jump_s = 10.0;  ///< a stamp further from the last must be borne out by the next
};

/// Checks one stream of samples and counts what it refuses. Not thread-safe; allocates nothing.
///
/// A stamp that jumps is refused until the next sample follows on from it: one wrong stamp in the
/// far future costs one sample, a real silence costs one too. A stream whose very first stamp was
/// wrong goes back to where all the others are. Likewise an inertial reading that jumps further
/// than a body can be jerked is out of range until the next one bears it out: a bit that flipped on
/// the bus costs one sample, a blow one too.
class SampleGate {
 public:
  explicit SampleGate(const SampleLimits& limits = {}) : limits_(limits) {}

  /// kNone: the sample may pass, and its stamp is the newest from now on.
  Refusal check(const ImuSample& sample);
  Refusal check(const MagSample& sample);
  Refusal check(const PressureSample& sample);

  [[nodiscard]] std::uint64_t accepted() const { return counts_[0]; }
  [[nodiscard]] std::uint64_t refused(Refusal reason) const {
    return counts_[static_cast<std::size_t>(reason)];
  }
  [[nodiscard]] std::uint64_t refused() const;

 private:
  Refusal judge(TimestampNs stamp_ns, bool finite, bool in_range);
  Refusal judge_time(TimestampNs stamp_ns);
  bool is_spike(const ImuSample& sample);

  SampleLimits limits_;
  std::optional<TimestampNs> last_ns_;
  std::optional<TimestampNs> jumped_to_ns_;
  std::optional<ImuSample> last_imu_;     ///< accepted
  std::optional<ImuSample> doubted_imu_;  ///< refused as a spike since
  std::array<std::uint64_t, kRefusalCount> counts_{};
};

}  // namespace vpdr
