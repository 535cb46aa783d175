#include "vision/core/heading/manhattan_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::vision {
namespace {

constexpr int kYawBins = 90;  // one degree each, modulo 90
constexpr double kBinRad = 0.5 * kPi / kYawBins;
constexpr double kCoarseFactor = 2.0;   // the search's inlier angle over the refinement's
constexpr std::size_t kRefined = 4;     // candidates that are refined
constexpr double kApartRad = 0.09;      // candidates closer than this are one
constexpr double kWidestVoteRad = 0.2;  // a segment that fits every yaw has no vote

// Columns: forward (the optical axis made horizontal), left, up.
std::optional<Eigen::Matrix3d> level_axes(const Eigen::Vector3d& up) {
  const Eigen::Vector3d forward = Eigen::Vector3d::UnitZ() - up.z() * up;
  if (forward.norm() < 0.1) return std::nullopt;
  Eigen::Matrix3d axes;
  axes.col(0) = forward.normalized();
  axes.col(1) = up.cross(axes.col(0));
  axes.col(2) = up;
  return axes;
}

double kernel(double off, double with, double limit) {
  const double off2 = off * off;
  return std::max(0.0, 1.0 - off2 / (limit * (off2 + with * with) + 1e-12));
}

double modulo_quarter(double angle) {
  const double quarter = 0.5 * kPi;
  const double m = std::fmod(angle, quarter);
  return m < 0.0 ? m + quarter : m;
}

double quarter_distance(double a, double b) {
  const double d = modulo_quarter(a - b);
  return std::min(d, 0.5 * kPi - d);
}

double total_support(const ManhattanFrame& f) { return f.support[0] + f.support[1] + f.support[2]; }

// A camera on a person is seldom rolled, and nods a little more.
double likelihood_of_upright(const Eigen::Vector3d& up, const SearchConfig& config) {
  const double roll = std::atan2(up.x(), -up.y()) / config.roll_sigma_rad;
  const double pitch = std::asin(std::clamp(up.z(), -1.0, 1.0)) / config.pitch_sigma_rad;
  return std::exp(-0.5 * (roll * roll + pitch * pitch));
}

}  // namespace

std::optional<ManhattanFrame> ManhattanSearch::search(const std::vector<SphereSegment>& segments,
                                                      const std::optional<VerticalPrior>& prior,
                                                      const Eigen::Vector3d& usual_up) {
  if (segments.size() < 3) return std::nullopt;
  Best best;
  propose_yaws(segments, prior ? prior->up : usual_up);
  refine_candidates(segments, prior, best);
  if (!prior) {
    propose_verticals(segments);
    refine_candidates(segments, prior, best);
  }
  if (!best.frame) return std::nullopt;
  ManhattanFrame frame = face_forward(*best.frame);
  const double mean =
      score_yaws(segments, frame.camera_from_corridor, config_.refine.inlier_angle_rad);
  frame.contrast = mean > 0.0 ? votes_[0] / mean : 0.0;
  return frame;
}

void ManhattanSearch::refine_candidates(const std::vector<SphereSegment>& segments,
                                        const std::optional<VerticalPrior>& prior, Best& best) {
  const VerticalPrior belief =
      prior.value_or(VerticalPrior{-Eigen::Vector3d::UnitY(), config_.pitch_sigma_rad});
  keep_best_apart();
  for (const Candidate& c : candidates_) {
    const std::optional<Eigen::Matrix3d> axes = level_axes(c.up);
    if (!axes) continue;
    const Eigen::Matrix3d start =
        *axes * Eigen::AngleAxisd(c.yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const ManhattanFrame frame = refine_frame(segments, start, belief, config_.refine);
    const double plausible =
        prior ? 1.0 : likelihood_of_upright(frame.camera_from_corridor.col(2), config_);
    const double score = total_support(frame) * plausible;
    if (!best.frame || score > best.score) best = {frame, score};
  }
}

// Score of every yaw about `up`, into votes_; returns the mean.
double ManhattanSearch::score_yaws(const std::vector<SphereSegment>& segments,
                                   const Eigen::Matrix3d& axes, double inlier_angle_rad) {
  const double vertical_limit = std::pow(std::sin(config_.vertical_angle_rad), 2);
  const double limit = std::pow(std::sin(inlier_angle_rad), 2);
  level_.clear();
  for (const SphereSegment& s : segments) {
    if (squared_sine_to(s, axes.col(2)) < vertical_limit) continue;
    level_.push_back({s.normal.dot(axes.col(0)), s.normal.dot(axes.col(1)),
                      s.along.dot(axes.col(0)), s.along.dot(axes.col(1)), s.weight});
  }
  votes_.assign(kYawBins, 0.0);
  double sum = 0.0;
  for (int bin = 0; bin < kYawBins; ++bin) {
    const double c = std::cos(bin * kBinRad);
    const double s = std::sin(bin * kBinRad);
    double score = 0.0;
    for (const LevelSegment& l : level_) {
      const double first = kernel(c * l.normal_forward + s * l.normal_left,
                                  c * l.along_forward + s * l.along_left, limit);
      const double second = kernel(c * l.normal_left - s * l.normal_forward,
                                   c * l.along_left - s * l.along_forward, limit);
      score += l.weight * std::max(first, second);
    }
    votes_[static_cast<std::size_t>(bin)] = score;
    sum += score;
  }
  return sum / kYawBins;
}

// The vertical is known: every yaw is a candidate.
void ManhattanSearch::propose_yaws(const std::vector<SphereSegment>& segments,
                                   const Eigen::Vector3d& up) {
  candidates_.clear();
  const std::optional<Eigen::Matrix3d> axes = level_axes(up);
  if (!axes) return;
  score_yaws(segments, *axes, kCoarseFactor * config_.refine.inlier_angle_rad);
  for (int bin = 0; bin < kYawBins; ++bin) {
    candidates_.push_back({up, bin * kBinRad, votes_[static_cast<std::size_t>(bin)]});
  }
}

void ManhattanSearch::propose_verticals(const std::vector<SphereSegment>& segments) {
  candidates_.clear();
  const int rolls = static_cast<int>(config_.max_roll_rad / config_.grid_step_rad);
  const int pitches = static_cast<int>(config_.max_pitch_rad / config_.grid_step_rad);
  for (int i = -rolls; i <= rolls; ++i) {
    for (int j = -pitches; j <= pitches; ++j) {
      const double pitch = j * config_.grid_step_rad;
      const Eigen::Vector3d level_roll(0.0, -std::cos(pitch), std::sin(pitch));
      const Eigen::Vector3d up =
          Eigen::AngleAxisd(i * config_.grid_step_rad, Eigen::Vector3d::UnitZ()) * level_roll;
      candidates_.push_back(vote(segments, up));
    }
  }
}

// One candidate vertical: support of the vertical itself plus the best yaw of the others' votes.
ManhattanSearch::Candidate ManhattanSearch::vote(const std::vector<SphereSegment>& segments,
                                                 const Eigen::Vector3d& up) {
  const std::optional<Eigen::Matrix3d> axes = level_axes(up);
  Candidate candidate{up, 0.0, 0.0};
  if (!axes) return candidate;
  const double tolerance = kCoarseFactor * config_.refine.inlier_angle_rad;
  const double limit = std::pow(std::sin(tolerance), 2);
  votes_.assign(kYawBins + 1, 0.0);
  double vertical = 0.0;
  for (const SphereSegment& s : segments) {
    const double squared_sine = squared_sine_to(s, up);
    if (squared_sine < limit) {
      vertical += s.weight * (1.0 - squared_sine / limit);
      continue;
    }
    const Eigen::Vector3d meeting = s.normal.cross(up);
    // A tilt of the segment by e moves the meeting point by e |up . middle| / |n x up|^2.
    const double half_width =
        tolerance * std::abs(up.dot(s.middle)) / std::max(1e-6, meeting.squaredNorm()) +
        0.5 * kBinRad;
    if (half_width > kWidestVoteRad) continue;
    const double yaw = modulo_quarter(
        std::atan2(meeting.dot(axes->col(1)), meeting.dot(axes->col(0))) - half_width);
    const int first = std::min(kYawBins - 1, static_cast<int>(yaw / kBinRad));
    const int last = first + static_cast<int>(2.0 * half_width / kBinRad);
    votes_[static_cast<std::size_t>(first)] += s.weight;
    // A vote past the last bin goes on at the first one.
    if (last >= kYawBins) votes_[0] += s.weight;
    votes_[static_cast<std::size_t>(last >= kYawBins ? last - kYawBins + 1 : last + 1)] -= s.weight;
  }
  double running = 0.0;
  double best = 0.0;
  for (int bin = 0; bin < kYawBins; ++bin) {
    running += votes_[static_cast<std::size_t>(bin)];
    if (running > best) {
      best = running;
      candidate.yaw_rad = (bin + 0.5) * kBinRad;
    }
  }
  candidate.score = (vertical + best) * likelihood_of_upright(up, config_);
  return candidate;
}

// Moves the best few candidates that are not the same one twice to the front, and drops the rest.
void ManhattanSearch::keep_best_apart() {
  std::size_t kept = 0;
  while (kept < kRefined && kept < candidates_.size()) {
    const auto rest = candidates_.begin() + static_cast<std::ptrdiff_t>(kept);
    const auto best =
        std::max_element(rest, candidates_.end(),
                         [](const Candidate& a, const Candidate& b) { return a.score < b.score; });
    if (best->score <= 0.0) break;
    std::iter_swap(rest, best);
    const Candidate chosen = candidates_[kept++];
    const auto same = [&](const Candidate& c) {
      return (chosen.up - c.up).norm() < kApartRad &&
             quarter_distance(chosen.yaw_rad, c.yaw_rad) < kApartRad;
    };
    const auto after = candidates_.begin() + static_cast<std::ptrdiff_t>(kept);
    candidates_.erase(std::remove_if(after, candidates_.end(), same), candidates_.end());
  }
  candidates_.resize(kept);
}

}  // namespace vpdr::vision
