#pragma once
// What the programs that measure vision's accuracy share: statistics, timing, rows of a table.
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "core/rotation.hpp"
#include "vision/core/heading/vanishing_point_heading.hpp"

namespace vpdr::bench {

inline constexpr double kQuarter = 0.5 * kPi;

/// Processor time of this thread: what one core would need, whatever else it does.
double cpu_ms();
/// NaN of an empty list.
double quantile(std::vector<double> values, double share);
double rms(const std::vector<double>& values);
/// Difference to the nearest multiple of 90 degrees, radians.
double quarter_wrapped(double angle_rad);

/// Errors and how they compare with the uncertainty that was claimed.
struct Errors {
  std::vector<double> deg;
  std::vector<double> normalised;
  void add(double error_rad, double sigma_rad);
  void print(const char* what) const;
};

/// Runs frames and keeps the processor time of each: what one core would need.
struct Timed {
  std::vector<double> ms;
  vision::VisionOutput operator()(vision::VanishingPointHeading& heading, const cv::Mat& image,
                                  TimestampNs stamp,
                                  const std::optional<vision::AttitudePrior>& prior);
  void print() const;
};

/// What an attitude filter gives: one degree of tilt, and a yaw that drifts.
vision::AttitudePrior disturbed(const Eigen::Quaterniond& truth, double turned_rad,
                                std::size_t frame);

/// One line of the table for --csv; nothing where `csv` is null or no directions were found.
void write_row(std::ofstream* csv, const std::string& set, TimestampNs stamp,
               const vision::VisionOutput& out, double truth_rad);

/// Where the heading (degrees, one a frame) changes little over 15 frames the walker goes straight:
/// spread about the mean of those frames, that is noise plus the sway of the hand that holds the
/// camera, and the median heading in each corridor.
void print_straights(const std::vector<double>& headings);

}  // namespace vpdr::bench
