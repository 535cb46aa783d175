#pragma once
// What can be set about step detection.
#include <cstdint>

namespace vpdr::pdr {

enum class DetectorKind : std::uint8_t {
  kGait,      ///< peaks that belong to a walk: even strides, each like the one before
  kPeaks,     ///< S3.1: filtered peaks a minimum interval apart
  kSwing,     ///< S1.12: |a_max - a_min| over a threshold
  kSpectrum,  ///< S1.1: the strongest frequency of the spectrum
};

struct StepConfig {
  DetectorKind detector = DetectorKind::kGait;
  double gap_s = 2.2;  ///< s, a walk goes on through a silence up to this; (0.05, 10)

  // gait and peaks
  double cutoff_hz = 3.0;       ///< Hz, Butterworth low-pass; (0.5, 20)
  int filter_order = 4;         ///< 2 or 4
  double drift_time_s = 1.0;    ///< s, over which the slow mean follows; (0.1, 60)
  double min_interval_s = 0.3;  ///< s, between two steps, swing too; (0.1, 2)
  double threshold_mps2 = 0.5;  ///< m/s^2, least height of a peak; (0, 20)

  // gait
  double max_interval_s = 1.5;   ///< s, a longer pause ends the walk; (0.3, 5)
  double threshold_share = 0.4;  ///< of the recent peaks' height; (0, 1)
  int confirming_steps = 4;      ///< even peaks that make a walk; 4 to 8
  int confirming_on_trunk = 3;   ///< peaks in a row that do on waist, chest or head; 2 to 8
  double firm_mps2 = 1.0;     ///< m/s^2, height of a peak that is a step by itself there; (0, 20)
  double lateral_mps2 = 0.5;  ///< m/s^2, across a walker whom one leg carries; (0, 20)
  double evenness = 0.15;     ///< largest relative change from stride to stride; (0.02, 2)
  double resemblance = 0.7;   ///< least correlation of a stride with the one before; (-1, 1)
  double lasting_resemblance = 0.2;  ///< the same while a walk goes on; (-1, 1)
  double longest_stride_s = 1.8;     ///< s, of a walk that begins; (0.6, 6)
  /// Turning faster than base + per_swing x (a_max - a_min) is handling: limbs that swing the
  /// board bounce it as well.
  double largest_rate_radps = 4.5;  ///< rad/s, r.m.s. over a second; faster is no walk; (0.5, 50)
  double rate_base_radps = 0.8;     ///< rad/s, r.m.s. over a second; (0, 50)
  double rate_per_swing = 0.45;     ///< rad/s for each m/s^2; (0, 10)
  double largest_tilt_rad = 0.4;    ///< rad, of the board against a stride before; (0, 3.2)
  double lasting_tilt_rad = 0.7;    ///< rad, the same while a walk goes on; (0, 3.2)

  double swing_threshold_mps2 = 3.0;     ///< m/s^2, a_max - a_min of a step (S1.12); (0, 50)
  double spectrum_threshold_mps2 = 0.7;  ///< m/s^2, amplitude of the strongest frequency (S1.1)
};

}  // namespace vpdr::pdr
