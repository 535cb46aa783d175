#pragma once
// The straight line under a stream of points: how a clock shows through arrivals that come late by
// anything but never early. A mean would follow the delays; the line that touches the points from
// below follows those that waited least.
//
// Of all lines under the points of the window it is the one with the least sum of vertical
// distances, which is the edge of the lower convex hull over the points' mean x (Zhang, Liu, Xia,
// INFOCOM 2002). Two hulls begun at different times take turns, so that between one and two
// windows are looked back on (Harrison and Newman's TICSync, ICRA 2011). Pure; bounded memory;
// allocates nothing once the hulls have grown.
#include <cstddef>
#include <optional>
#include <vector>

namespace vpdr::imu_gateway {

class LowerEnvelope {
 public:
  struct Line {
    double slope = 0.0;
    double level = 0.0;  ///< at x = 0
    [[nodiscard]] double at(double x) const { return level + slope * x; }
  };
  struct Options {
    double window = 20.0;  ///< x looked back on at least, once there is as much
    double min_slope = -1.0;
    double max_slope = 1.0;
    double first_span = 0.0;  ///< x after which a slope is told from the points; 0 before
    double trust_span = 5.0;  ///< x after which the points' own slope replaces a given one
  };

  explicit LowerEnvelope(const Options& options) : options_(options) {}

  /// Forgets all points. A slope known from before holds until the new points span trust_span.
  void restart(std::optional<double> slope = std::nullopt);
  /// x must not be less than before.
  void add(double x, double y);
  /// Of no use before the first point.
  [[nodiscard]] const Line& line() const { return line_; }
  [[nodiscard]] std::size_t count() const { return older_.count + younger_.count; }
  /// Whether the slope is the points' own and they span trust_span.
  [[nodiscard]] bool slope_is_trusted() const { return older_.span() >= options_.trust_span; }
  /// The points' own slope once it is trusted, else the given one.
  [[nodiscard]] std::optional<double> known_slope() const {
    return slope_is_trusted() ? std::optional(line_.slope) : given_slope_;
  }

 private:
  struct Point {
    double x = 0.0;
    double y = 0.0;
  };
  struct Hull {
    std::vector<Point> points;  ///< left to right, convex from below
    std::size_t count = 0;      ///< points seen
    double first_x = 0.0;
    double last_x = 0.0;
    double sum_from_first = 0.0;  ///< of x - first_x

    void clear();
    void add(const Point& point);
    [[nodiscard]] double span() const { return count == 0 ? 0.0 : last_x - first_x; }
    [[nodiscard]] std::optional<double> slope() const;
    [[nodiscard]] double level_under(double slope) const;
  };
  void fit();

  Options options_;
  std::optional<double> given_slope_;
  Hull older_;
  Hull younger_;
  Line line_;
};

}  // namespace vpdr::imu_gateway
