#include "simulation/walking_path.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/rotation.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector2d;

constexpr double kTurnBackRad = 2.356;       // 135 degrees
constexpr double kTurnBackHalfWidthM = 0.4;  // a person turns round within one stride

Vector2d direction(double heading) { return {std::cos(heading), std::sin(heading)}; }

double heading_of(const Vector2d& leg) { return std::atan2(leg.y(), leg.x()); }

/// Share of the turn done at share `u` of its length: no jump in curvature or in its derivative.
double turned(double u) { return u * u * u * (10.0 + u * (6.0 * u - 15.0)); }
double turning(double u) { return 30.0 * u * u * (1.0 - u) * (1.0 - u); }

/// Displacement over the first share `u` of a turn of unit length that starts heading east
/// (Gauss-Legendre, three points in each of twelve panels; error below 1e-9 for a half turn).
Vector2d displacement(double turn_rad, double u) {
  constexpr int kPanels = 12;
  const double panel = u / kPanels;
  const double offset = 0.5 * panel * std::sqrt(0.6);
  Vector2d sum = Vector2d::Zero();
  for (int i = 0; i < kPanels; ++i) {
    const double middle = (i + 0.5) * panel;
    sum += 5.0 * direction(turn_rad * turned(middle - offset)) +
           8.0 * direction(turn_rad * turned(middle)) +
           5.0 * direction(turn_rad * turned(middle + offset));
  }
  return sum * (panel / 18.0);
}

/// Distance from the corner to where a turn of unit length begins and ends.
double corner_distance(double turn_rad) {
  return 0.5 * displacement(turn_rad, 1.0).norm() / std::cos(0.5 * turn_rad);
}

/// Replaces each corner where the walker turns back by two, a shoulder's width apart.
std::vector<Vector2d> without_turning_back(const std::vector<Vector2d>& corners) {
  std::vector<Vector2d> result;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i > 0 && i + 1 < corners.size()) {
      const Vector2d in = corners[i] - corners[i - 1];
      const double turn = wrap_pi(heading_of(corners[i + 1] - corners[i]) - heading_of(in));
      if (std::abs(turn) > kTurnBackRad) {
        const Vector2d left = Vector2d(-in.y(), in.x()).normalized() * kTurnBackHalfWidthM;
        result.push_back(corners[i] - left);
        result.push_back(corners[i] + left);
        continue;
      }
    }
    result.push_back(corners[i]);
  }
  return result;
}

}  // namespace

WalkingPath::WalkingPath(const std::vector<Vector2d>& corners_m, double turn_length_m) {
  const std::vector<Vector2d> corners = without_turning_back(corners_m);
  if (corners.size() < 2) throw ConfigurationFault("walk: needs two waypoints at least");
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (!((corners[i] - corners[i - 1]).norm() > 0.1)) {
      throw ConfigurationFault("walk: waypoints " + std::to_string(i) + " and " +
                               std::to_string(i + 1) + " coincide; leave one out");
    }
  }
  pieces_.push_back({0.0, 0.0, corners[0], heading_of(corners[1] - corners[0]), 0.0});
  double used = 0.0;  // of the current leg, by the turn at its beginning
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Vector2d leg = corners[i] - corners[i - 1];
    if (i + 1 == corners.size()) {
      append(leg.norm() - used, 0.0);
      break;
    }
    const Vector2d next = corners[i + 1] - corners[i];
    const double turn = wrap_pi(heading_of(next) - heading_of(leg));
    const double unit_distance = corner_distance(turn);
    const double distance =
        std::min(turn_length_m * unit_distance, 0.48 * std::min(leg.norm(), next.norm()));
    append(leg.norm() - used - distance, 0.0);
    if (std::abs(turn) > 1e-9) append(distance / unit_distance, turn);
    used = std::abs(turn) > 1e-9 ? distance : -distance;
  }
}

void WalkingPath::append(double length_m, double turn_rad) {
  const Piece& last = pieces_.back();
  const PathPoint end = evaluate(last, last.length_m);
  pieces_.push_back({length_m_, length_m, end.position_m, end.heading_rad, turn_rad});
  length_m_ += length_m;
}

PathPoint WalkingPath::evaluate(const Piece& piece, double along_m) {
  PathPoint point;
  if (piece.turn_rad == 0.0) {
    point.position_m = piece.position_m + along_m * direction(piece.heading_rad);
    point.heading_rad = piece.heading_rad;
    return point;
  }
  const double u = along_m / piece.length_m;
  const Vector2d d = displacement(piece.turn_rad, u) * piece.length_m;
  const Vector2d ahead = direction(piece.heading_rad);
  point.position_m = piece.position_m + d.x() * ahead + d.y() * Vector2d(-ahead.y(), ahead.x());
  point.heading_rad = piece.heading_rad + piece.turn_rad * turned(u);
  point.curvature_per_m = piece.turn_rad * turning(u) / piece.length_m;
  return point;
}

PathPoint WalkingPath::at(double s_m) const {
  const double s = std::clamp(s_m, 0.0, length_m_);
  const auto next = std::upper_bound(pieces_.begin(), pieces_.end(), s,
                                     [](double x, const Piece& p) { return x < p.start_m; });
  const Piece& piece = *(next - 1);
  return evaluate(piece, std::min(s - piece.start_m, piece.length_m));
}

}  // namespace vpdr::simulation
