#include "calibration/mount.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "calibration/rest_intervals.hpp"
#include "calibration/window.hpp"
#include "core/rotation.hpp"
#include "core/samples.hpp"

namespace vpdr::calibration {
namespace {

using Complex = std::complex<double>;

constexpr double kPieceS = 4.0;   ///< of walking, looked at as one rhythm
constexpr double kStepHz = 0.02;  ///< between the rhythms that are tried

/// Acceleration without gravity: along up and along two level axes of the board.
struct Motion {
  TimestampNs stamp_ns = 0;
  double up = 0.0;
  Eigen::Vector2d level = Eigen::Vector2d::Zero();
};

/// Two level axes of the board: any, but right-handed with up.
struct LevelAxes {
  Eigen::Vector3d first;
  Eigen::Vector3d second;
  explicit LevelAxes(const Eigen::Vector3d& up) {
    int least = 0;
    up.cwiseAbs().minCoeff(&least);
    first = up.cross(Eigen::Vector3d::Unit(least)).normalized();
    second = up.cross(first);
  }
};

/// The board's swaying is taken out with the gyroscope: up is carried along by its rates and drawn
/// slowly to the mean force.
std::vector<Motion> motion_of(const SensorStreams& streams, const Eigen::Vector3d& up_at_rest,
                              double levelling_s) {
  const LevelAxes axes(up_at_rest);
  std::vector<Motion> out;
  out.reserve(streams.force_mps2.size());
  Eigen::Vector3d up = up_at_rest;
  std::size_t at = 0;
  for (std::size_t i = 0; i < streams.force_mps2.size(); ++i) {
    const TimedVector& force = streams.force_mps2[i];
    if (i > 0) {
      const double dt_s =
          std::min(0.1, to_seconds(force.stamp_ns - streams.force_mps2[i - 1].stamp_ns));
      while (at + 1 < streams.rate_radps.size() &&
             streams.rate_radps[at].stamp_ns < force.stamp_ns) {
        ++at;
      }
      if (!streams.rate_radps.empty()) {
        up = exp_rotation(-dt_s * streams.rate_radps[at].value) * up;
      }
      up = (up + dt_s / levelling_s * (force.value / kGravityMps2 - up)).normalized();
    }
    const Eigen::Vector3d acceleration = force.value - kGravityMps2 * up;
    // Level in the world, then carried back to the board as it hangs at rest.
    const Eigen::Vector3d level = Eigen::Quaterniond::FromTwoVectors(up, up_at_rest) * acceleration;
    out.push_back(
        {force.stamp_ns, acceleration.dot(up), {axes.first.dot(level), axes.second.dot(level)}});
  }
  return out;
}

/// What one piece of walking holds at one rhythm.
struct Rhythm {
  Complex up;
  Eigen::Vector2cd level = Eigen::Vector2cd::Zero();
};

Rhythm rhythm_at(const std::vector<Motion>& piece, double hz) {
  Rhythm out;
  const auto count = static_cast<double>(piece.size());
  double mean_up = 0.0;
  Eigen::Vector2d mean_level = Eigen::Vector2d::Zero();
  for (const Motion& m : piece) {
    mean_up += m.up / count;
    mean_level += m.level / count;
  }
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const double t_s = to_seconds(piece[i].stamp_ns - piece.front().stamp_ns);
    // Hann's window keeps the stride's rhythm, half of the step's, out.
    const double window = 1.0 - std::cos(2.0 * kPi * (static_cast<double>(i) + 0.5) / count);
    const Complex turn = std::polar(window / count, -2.0 * kPi * hz * t_s);
    out.up += turn * (piece[i].up - mean_up);
    out.level += turn * (piece[i].level - mean_level).cast<Complex>();
  }
  return out;
}

double step_rhythm(const std::vector<Motion>& piece, const MountConfig& config) {
  double best_hz = config.min_step_hz;
  double best = -1.0;
  const int count = static_cast<int>((config.max_step_hz - config.min_step_hz) / kStepHz);
  for (int i = 0; i <= count; ++i) {
    const double hz = config.min_step_hz + kStepHz * i;
    const double size = std::abs(rhythm_at(piece, hz).up);
    if (size <= best) continue;
    best = size;
    best_hz = hz;
  }
  return best_hz;
}

/// Pieces of the recording in which somebody walked.
std::vector<std::vector<Motion>> walking_pieces(const std::vector<Motion>& motion,
                                                const MountConfig& config) {
  std::vector<std::vector<Motion>> pieces;
  std::vector<Motion> piece;
  for (const Motion& m : motion) {
    piece.push_back(m);
    if (to_seconds(m.stamp_ns - piece.front().stamp_ns) < kPieceS) continue;
    double squares = 0.0;
    double mean = 0.0;
    for (const Motion& p : piece) mean += p.up / static_cast<double>(piece.size());
    for (const Motion& p : piece) squares += (p.up - mean) * (p.up - mean);
    const bool walks =
        std::sqrt(squares / static_cast<double>(piece.size())) > config.walking_sigma_mps2;
    if (walks) pieces.push_back(piece);
    piece.clear();
  }
  return pieces;
}

/// Mean force of the standings, weighted by their length, and its scatter.
std::optional<Eigen::Vector3d> up_of(const SensorStreams& streams, const MountConfig& config,
                                     double& tilt_rad) {
  RestConfig rest_config;
  rest_config.force_sigma_mps2 = config.standing_sigma_mps2;
  rest_config.force_step_mps2 = config.standing_sigma_mps2;
  rest_config.rate_sigma_radps = 0.2;
  rest_config.rate_step_radps = 0.2;
  rest_config.min_duration_s = config.rest_s;
  const std::vector<Rest> rests = find_rests(streams, rest_config);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Rest& rest : rests) sum += rest.duration_s() * rest.force_mps2;
  if (sum.isZero()) return std::nullopt;
  const Eigen::Vector3d up = sum.normalized();
  for (const Rest& rest : rests) {
    tilt_rad = std::max(tilt_rad, std::acos(std::min(1.0, rest.force_mps2.normalized().dot(up))));
  }
  return up;
}

}  // namespace

Result<Mount> estimate_mount(const SensorStreams& streams, const MountConfig& config) {
  Mount out;
  const auto up = up_of(streams, config, out.tilt_rad);
  if (!up)
    return Error{"nobody stood still; stand for three seconds with the board worn, then walk"};
  const std::vector<Motion> motion = motion_of(streams, *up, config.levelling_s);
  // For each piece the level rhythm, turned so that the upward one is real and positive.
  Eigen::Matrix2cd spread = Eigen::Matrix2cd::Zero();
  Eigen::Vector2cd sum = Eigen::Vector2cd::Zero();
  for (const auto& piece : walking_pieces(motion, config)) {
    const double hz = step_rhythm(piece, config);
    const Rhythm rhythm = rhythm_at(piece, hz);
    const Eigen::Vector2cd level = rhythm.level * std::conj(rhythm.up) / std::abs(rhythm.up);
    spread += level * level.adjoint();
    sum += level;
    out.step_hz += hz * kPieceS;
    out.walking_s += kPieceS;
  }
  if (out.walking_s < config.min_walking_s) {
    return Error{"nobody walked; after standing still take ten steps straight on"};
  }
  out.step_hz /= out.walking_s;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread.real());
  Eigen::Vector2d forward = axes.eigenvectors().col(1);
  out.straightness = axes.eigenvalues()[1] / axes.eigenvalues().sum();
  Complex along = forward.x() * sum.x() + forward.y() * sum.y();
  if (along.imag() < 0.0) {
    forward = -forward;
    along = -along;
  }
  out.lead_rad = std::arg(along);
  if (out.step_hz > config.running_hz) return Error{"somebody ran; walk at your usual pace"};
  if (out.straightness < config.min_straightness || out.lead_rad < config.min_lead_rad ||
      out.lead_rad > kPi - config.min_lead_rad) {
    return Error{
        "the steps do not tell forward from backward; wear the board tight on the trunk and walk "
        "ten steps straight on"};
  }
  const LevelAxes level_axes(*up);
  const Eigen::Vector3d ahead = forward.x() * level_axes.first + forward.y() * level_axes.second;
  out.body_from_board.row(0) = ahead;
  out.body_from_board.row(1) = up->cross(ahead);
  out.body_from_board.row(2) = *up;
  return out;
}

}  // namespace vpdr::calibration
