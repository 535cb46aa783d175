#include "calibration/gyroscope.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "calibration/window.hpp"

namespace vpdr::calibration {
namespace {

/// One piece of a rest.
struct Piece {
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();
  Eigen::Vector3d noise = Eigen::Vector3d::Zero();  ///< standard error by the scatter of samples
  double temperature_c = 0.0;
  double duration_s = 0.0;
};

/// Of the readings within; where there are none, as before a board's first one, the nearest. 0 for
/// a board that tells none.
double mean_temperature(const std::vector<TimedValue>& stream, TimestampNs begin, TimestampNs end) {
  double sum = 0.0;
  double count = 0.0;
  for (const TimedValue& sample : stream) {
    if (sample.stamp_ns < begin || sample.stamp_ns >= end) continue;
    sum += sample.value;
    count += 1.0;
  }
  if (count > 0.0) return sum / count;
  const auto after =
      std::find_if(stream.begin(), stream.end(), [&](const auto& s) { return s.stamp_ns >= end; });
  if (after == stream.begin()) return stream.empty() ? 0.0 : after->value;
  const auto before = std::prev(after);
  const bool later = after != stream.end() && after->stamp_ns - end < begin - before->stamp_ns;
  return later ? after->value : before->value;
}

std::vector<Piece> pieces_of(const SensorStreams& streams, const std::vector<Rest>& rests,
                             double bin_s) {
  std::vector<Piece> pieces;
  for (const Rest& rest : rests) {
    const double count = std::max(1.0, std::floor(rest.duration_s() / bin_s));
    const auto length_ns = to_ns(rest.duration_s() / count);
    for (TimestampNs at = rest.begin_ns; at + length_ns <= rest.end_ns; at += length_ns) {
      const auto window = window_of(streams.rate_radps, at, at + length_ns);
      if (window.size() < 3) continue;
      Piece piece;
      piece.rate = moments_of(window).mean;
      for (const TimedVector& sample : window) {
        piece.noise += (sample.value - piece.rate).cwiseAbs2();
      }
      piece.noise = piece.noise.cwiseSqrt() / static_cast<double>(window.size());
      piece.temperature_c = mean_temperature(streams.temperature_c, at, at + length_ns);
      piece.duration_s = to_seconds(length_ns);
      pieces.push_back(piece);
    }
  }
  return pieces;
}

/// Straight line by least squares, weighted by duration; the slope has a prior about zero in units
/// of the pieces' scatter, so that a hundredth of a degree does not make one.
void fit_line(const std::vector<Piece>& pieces, double slope_sigma, GyroscopeBias& out) {
  double weight = 0.0;
  for (const Piece& p : pieces) weight += p.duration_s;
  for (const Piece& p : pieces) {
    out.bias_radps += p.duration_s / weight * p.rate;
    out.temperature_c += p.duration_s / weight * p.temperature_c;
    out.noise_radps += p.duration_s / weight * p.noise;
  }
  double spread = 0.0;
  Eigen::Vector3d product = Eigen::Vector3d::Zero();
  Eigen::Vector3d scatter = Eigen::Vector3d::Zero();
  for (const Piece& p : pieces) {
    const double t = p.temperature_c - out.temperature_c;
    const Eigen::Vector3d r = p.rate - out.bias_radps;
    spread += t * t;
    product += t * r;
    scatter += r.cwiseAbs2();
  }
  const auto count = static_cast<double>(pieces.size());
  out.wander_radps = (scatter / count).cwiseSqrt();
  const Eigen::Vector3d prior = scatter / count / (slope_sigma * slope_sigma);
  out.slope_radps_per_c = product.cwiseQuotient((prior.array() + spread + 1e-12).matrix());
  Eigen::Vector3d rest = Eigen::Vector3d::Zero();
  for (const Piece& p : pieces) rest += (p.rate - out.at(p.temperature_c)).cwiseAbs2();
  out.residual_radps = (rest / count).cwiseSqrt();
}

}  // namespace

Result<GyroscopeBias> calibrate_gyroscope(const SensorStreams& streams,
                                          const std::vector<Rest>& rests,
                                          const GyroscopeConfig& config) {
  const std::vector<Piece> pieces = pieces_of(streams, rests, config.bin_s);
  GyroscopeBias out;
  double lowest = pieces.empty() ? 0.0 : pieces.front().temperature_c;
  double highest = lowest;
  for (const Piece& piece : pieces) {
    out.rest_s += piece.duration_s;
    lowest = std::min(lowest, piece.temperature_c);
    highest = std::max(highest, piece.temperature_c);
  }
  out.temperature_span_c = highest - lowest;
  if (out.rest_s < config.min_rest_s) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(1) << "the board lay still for " << out.rest_s
         << " s in all; let it lie for a minute to learn the gyroscope's bias";
    return Error{text.str()};
  }
  fit_line(pieces, config.slope_sigma_radps, out);
  if (out.bias_radps.norm() > config.max_bias_radps) {
    return Error{"the gyroscope reads " + std::to_string(out.bias_radps.norm()) +
                 " rad/s at rest: no bias is so large; are its rates in degrees, or did the board "
                 "turn evenly?"};
  }
  return out;
}

}  // namespace vpdr::calibration
