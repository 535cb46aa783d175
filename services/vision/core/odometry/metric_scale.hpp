#pragma once
// How many metres the map's unit is. One camera cannot see it; the floor tells it to a camera whose
// height above the floor is known (S1.9: the seed lays a chessboard on the floor and calls the
// camera's height T_cp), and the walker's steps where the floor is not in view. The logarithm of
// the scale is filtered: the map's unit wanders as points are handed over. Not thread-safe;
// allocates nothing once its buffers have grown.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/estimates.hpp"
#include "core/time.hpp"
#include "vision/core/odometry/landmark_map.hpp"

namespace vpdr::vision {

struct MetricScaleConfig {
  double camera_height_m = 0.0;     ///< above the floor; 0: the calibration's, if it has one
  double height_share = 0.03;       ///< uncertainty of the height as a share of it, gait included
  double floor_share = 0.05;        ///< points of the floor are within this of one height
  double min_floor_points = 4.0;    ///< on the way ahead, that agree on the floor's height
  double way_half_width = 0.35;     ///< of the walker's way, as a share of the camera's height
  double least_down_rad = 0.12;     ///< flatter rays say little about the floor
  double most_sigma_share = 0.15;   ///< vaguer points are not looked at
  double measurement_share = 0.04;  ///< of one look at the floor beyond what its points say
  double wander_share = 0.03;       ///< of the unit, for each metre's square root
  double step_share = 0.15;         ///< of the length of a few steps
  int steps = 4;                    ///< so many are compared with the camera's path
  double step_wait_s = 0.5;         ///< until a step counts: messages come in any order
  double floor_patience_s = 3.0;    ///< without a look at the floor before steps count
  double gate = 3.0;                ///< sigmas beyond which a measurement is refused
  int refusals_to_restart = 6;      ///< refused in a row before the scale is believed wrong
};

/// Height of the camera above the floor in the map's unit.
struct FloorHeight {
  double height = 0.0;
  double sigma_share = 0.0;
  std::size_t points = 0;
};

class MetricScale {
 public:
  explicit MetricScale(const MetricScaleConfig& config) : config_(config) {}

  /// The map begins anew, in another unit; steps and times are kept.
  void restart();
  /// The camera has moved on by `length` units.
  void wander(double length);
  /// A look at the points of a key frame. `up`: unit, map axes; `up_sigma_rad`: of its tilt.
  void look(const std::vector<Landmark>& landmarks, const FeatureTracks& frame,
            const CameraPose& pose, const Eigen::Vector3d& up, double up_sigma_rad);
  /// A step of the walker, as pdr sees it.
  void add(const StepEvent& step);
  /// Where the camera was, in map units; frames in order of time.
  void follow(TimestampNs stamp_ns, const Eigen::Vector3d& position);

  /// Metres a unit; nothing while unknown.
  [[nodiscard]] std::optional<double> metres() const;
  /// Uncertainty of metres() as a share of it.
  [[nodiscard]] double sigma_share() const;
  [[nodiscard]] std::uint64_t floor_looks() const { return floor_looks_; }
  [[nodiscard]] std::uint64_t step_looks() const { return step_looks_; }
  [[nodiscard]] std::uint64_t refused() const { return refused_; }

  /// The height that most points below the camera share.
  std::optional<FloorHeight> floor_height(const std::vector<Landmark>& landmarks,
                                          const FeatureTracks& frame, const CameraPose& pose,
                                          const Eigen::Vector3d& up, double up_sigma_rad);

 private:
  struct Below {
    double log_height, sigma, weight;
    double noise;  ///< sigma but for the tilt of the vertical
    double ahead;  ///< along the way, over the height
  };
  void gather_below(const std::vector<Landmark>& landmarks, const FeatureTracks& frame,
                    const CameraPose& pose, const Eigen::Vector3d& up, double up_sigma_rad);
  [[nodiscard]] double usual_log_height() const;
  [[nodiscard]] std::optional<FloorHeight> fit_floor(double log_height, double up_sigma_rad) const;
  bool measure(double log_metres, double sigma);
  [[nodiscard]] Eigen::Vector3d way_ahead(const CameraPose& pose) const;
  void compare_with_steps(std::size_t newest);
  [[nodiscard]] std::optional<Eigen::Vector3d> position_at(TimestampNs stamp_ns) const;

  MetricScaleConfig config_;
  bool known_ = false;
  double log_metres_ = 0.0;
  double variance_ = 0.0;
  int refused_in_a_row_ = 0;
  std::optional<TimestampNs> last_floor_ns_;
  std::uint64_t floor_looks_ = 0, step_looks_ = 0, refused_ = 0;
  std::vector<Below> below_;
  struct Place {
    TimestampNs stamp_ns;
    Eigen::Vector3d position;
  };
  std::vector<Place> path_;  ///< the last seconds, a ring
  std::size_t path_count_ = 0;
  std::vector<StepEvent> steps_;   ///< the last few, oldest first
  std::size_t waiting_steps_ = 0;  ///< of them, the newest ones
};

}  // namespace vpdr::vision
