#include "vision/app/odometry_settings.hpp"

namespace vpdr::vision {
namespace {

using config::at_least;
using config::between;
using config::Binder;
using config::open;

void bind(Binder& binder, FeatureTrackerConfig& features) {
  binder.integer("features.count", features.max_features, between(20, 2000), "",
                 "points that are followed");
  binder.integer("features.cell_px", features.cell_px, between(8, 400), "px",
                 "grid in which new points are sought, one a cell");
  binder.number("features.min_distance_px", features.min_distance_px, between(1, 200), "px",
                "of two points");
  binder.number("features.min_corner_score", features.min_corner_score, open(0, 1), "",
                "smaller eigenvalue of a corner");
  binder.number("features.clahe_clip", features.clahe_clip, open(0, 100), "",
                "limit of the contrast that is evened out");
  binder.integer("features.clahe_tiles", features.clahe_tiles, between(1, 32), "",
                 "in each direction");
  binder.integer("features.flow_window_px", features.flow_window_px, between(5, 63), "px",
                 "of the optical flow");
  binder.integer("features.flow_levels", features.flow_levels, between(0, 6), "",
                 "of the image pyramid above the full image");
  binder.number("features.max_return_px", features.max_return_px, open(0, 10), "px",
                "by which the way forth and back may miss the start");
}

void bind(Binder& binder, MetricScaleConfig& scale) {
  binder.number(
      "odometry.camera_height_m", scale.camera_height_m, between(0, 5), "m",
      "of the camera above the floor; 0: the calibration's height_m, or where it has none, "
      "steps give the scale");
  binder.number("odometry.height_share", scale.height_share, open(0, 1), "",
                "its uncertainty as a share of it, gait included");
  binder.number("odometry.floor_share", scale.floor_share, open(0, 1), "",
                "spread of the heights of the floor's points");
  binder.number("odometry.min_floor_points", scale.min_floor_points, at_least(1), "",
                "on the way ahead that agree on a height");
  binder.number("odometry.way_half_width", scale.way_half_width, open(0, 5), "",
                "of the walker's way, as a share of the camera's height");
  binder.number("odometry.scale_wander_share", scale.wander_share, between(0, 1), "",
                "of the map's unit, for each metre's square root");
  binder.number("odometry.step_share", scale.step_share, open(0, 1), "",
                "uncertainty of the length of a few steps");
  binder.number("odometry.floor_patience_s", scale.floor_patience_s, at_least(0), "s",
                "without a look at the floor before steps give the scale");
}

void bind(Binder& binder, MapTrackerConfig& map) {
  binder.number("odometry.start_parallax_rad", map.start_parallax_rad, open(0, 1), "rad",
                "between the two frames that start a map");
  binder.number("odometry.key_parallax_rad", map.key_parallax_rad, open(0, 1), "rad",
                "since the last key frame that makes another one");
  binder.number("odometry.key_share", map.key_share, open(0, 1), "",
                "of a frame's points that the last key frame has; fewer make another one");
  binder.number("odometry.max_acceleration_mps2", map.most_acceleration_mps2, open(0, 1000),
                "m/s^2", "of the camera");
  binder.integer("odometry.lost_frames", map.lost_frames, between(1, 1000), "",
                 "without a pose that is believed give the map up");
}

}  // namespace

void bind_odometry(Binder& binder, OdometryConfig& config) {
  bind(binder, config.tracker);
  bind(binder, config.scale);
  bind(binder, config.map);
  binder.number("odometry.gyro_bias_sigma_radps", config.gyro.bias_sigma_radps, open(0, 1), "rad/s",
                "of the gyroscope's remaining bias before it is learnt");
  binder.number("odometry.pixel_sigma_px", config.pixel_sigma_px, open(0, 20), "px",
                "of a followed point, each direction");
  binder.number("odometry.covariance_factor", config.covariance_factor, between(1, 20), "",
                "on standard deviations, for points err together");
  binder.number("odometry.max_gap_s", config.max_gap_s, open(0, 10), "s",
                "frames further apart are not compared");
  binder.number("odometry.still_px", config.stillness.still_px, open(0, 20), "px",
                "within which the points of a still camera stay");
  binder.number("odometry.still_s", config.stillness.still_s, open(0, 10), "s",
                "so long before stillness is believed");
}

}  // namespace vpdr::vision
