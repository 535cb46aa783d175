#include "vision/app/vision_settings.hpp"

#include "vision/app/odometry_settings.hpp"

namespace vpdr::vision {
namespace {

using config::at_least;
using config::between;
using config::Binder;
using config::open;

void bind(Binder& binder, LineConfig& lines) {
  binder.integer("lines.working_width_px", lines.working_width_px, between(160, 4096), "px",
                 "wider images are first reduced to this width");
  EdgeLineConfig& edges = lines.edges;
  binder.number("lines.min_contrast", edges.min_contrast, open(0, 256), "",
                "grey levels: the height of a step whose edge is just seen");
  binder.number("lines.seed_contrast", edges.seed_contrast, open(0, 256), "",
                "grey levels of the step that a segment grows from");
  binder.number("lines.angle_rad", edges.angle_rad, open(0, 1.5), "rad",
                "between an edge point's gradient and the normal of its line");
  binder.number("lines.distance_px", edges.distance_px, open(0, 20), "px",
                "of an edge point from its line");
  binder.integer("lines.gap_px", edges.gap_px, between(0, 50), "px",
                 "missing edge points that a segment may bridge");
  binder.number("lines.min_length_fraction", lines.min_length_fraction, between(0, 0.5), "",
                "shortest segment as share of the image diagonal");
  binder.integer("lines.max_segments", lines.max_segments, between(10, 5000), "",
                 "the longest ones are kept");
  binder.number("lines.endpoint_sigma_px", lines.endpoint_sigma_px, open(0, 20), "px",
                "of an end point across its line");
}

void bind(Binder& binder, SearchConfig& search) {
  binder.number("search.inlier_angle_rad", search.refine.inlier_angle_rad, open(0, 0.3), "rad",
                "between a segment and the line to its vanishing point");
  binder.number("search.model_sigma_rad", search.refine.model_sigma_rad, at_least(0), "rad",
                "how far a building's edges are from its three directions");
  binder.integer("search.iterations", search.refine.iterations, between(1, 100), "",
                 "of the refinement");
  binder.number("search.vertical_angle_rad", search.vertical_angle_rad, open(0, 0.5), "rad",
                "segments this close to the vertical have no say on heading");
  binder.number("search.max_roll_rad", search.max_roll_rad, between(0, 1.2), "rad",
                "searched without an attitude");
  binder.number("search.max_pitch_rad", search.max_pitch_rad, between(0, 1.2), "rad",
                "searched without an attitude");
  binder.number("search.grid_step_rad", search.grid_step_rad, between(0.01, 0.2), "rad",
                "of that search");
  binder.number("search.roll_sigma_rad", search.roll_sigma_rad, open(0, 3), "rad",
                "belief, without an attitude, that the camera is upright");
  binder.number("search.pitch_sigma_rad", search.pitch_sigma_rad, open(0, 3), "rad",
                "belief, without an attitude, that the camera is level");
}

void bind(Binder& binder, TrackerConfig& tracker) {
  binder.number("tracker.max_disagreement_rad", tracker.max_disagreement_rad, open(0, 0.785), "rad",
                "from the turn that the gyroscope saw, else refused");
  binder.integer("tracker.frames_to_anchor", tracker.frames_to_anchor, between(1, 1000), "",
                 "refused frames that agree make a new direction");
  binder.number("tracker.anchor_spread_rad", tracker.anchor_spread_rad, open(0, 0.785), "rad",
                "within which they agree");
  binder.number("tracker.max_rate_interval_s", tracker.max_rate_interval_s, open(0, 10), "s",
                "no heading rate between frames further apart");
  binder.number("tracker.max_rate_radps", tracker.max_rate_radps, open(0, 100), "rad/s",
                "no heading rate beyond");
}

void bind(Binder& binder, FrameCheckConfig& check) {
  binder.number("frame_check.dark_level", check.dark_level, between(0, 255), "",
                "grey level that the brightest hundredth of a dark frame stays below");
  binder.number("frame_check.saturated_level", check.saturated_level, between(0, 255), "",
                "grey level that nine tenths of a saturated frame are above");
  binder.number("frame_check.min_contrast", check.min_contrast, between(0, 255), "",
                "grey levels between the 5 % and the 95 % quantile");
  binder.number("frame_check.max_blur", check.max_blur, between(0, 1), "",
                "share of the squared change between pixels that smoothing over seven leaves in "
                "the sharper of rows and columns; 1: no frame is refused for blur");
  binder.number("frame_check.torn_fraction", check.torn_fraction, open(0, 1), "",
                "of the rows, at the bottom, filled by the decoder");
}

void bind(Binder& binder, AttitudeTrackConfig& attitude) {
  binder.number("attitude.mounting_sigma_rad", attitude.mounting_sigma_rad, open(0, 1), "rad",
                "of the camera on the body, each tilt");
  binder.number("attitude.max_gap_s", attitude.max_gap_s, open(0, 10), "s",
                "attitudes further apart are not interpolated");
}

void bind(Binder& binder, VisionConfig& config) {
  bind(binder, config.directions.lines);
  bind(binder, config.directions.search);
  binder.number("search.orthogonality_sigma_rad", config.directions.free.orthogonality_sigma_rad,
                open(0, 1), "rad", "how far each single direction may be from the frame of three");
  bind(binder, config.tracker);
  bind(binder, config.directions.frame_check);
  bind(binder, config.attitude);
  binder.choice(
      "angle_form", config.angle_form,
      {{"unit_ray", AngleForm::kUnitRay},
       {"as_printed", AngleForm::kAsPrinted},
       {"triplet", AngleForm::kTriplet}},
      "how the angles follow from the vanishing directions; as_printed: the survey's "
      "arcsines of the main point, for small angles; triplet: the survey's roll, pitch and "
      "yaw from all three");
  binder.integer("min_inliers", config.directions.min_inliers, at_least(3), "",
                 "segments along the two horizontal directions");
  binder.number("min_support", config.directions.min_support, at_least(0), "",
                "their summed length over the image diagonal");
  binder.number("min_explained", config.directions.min_explained, between(0, 1), "",
                "share of the segments' length that the directions explain");
  binder.number("min_contrast", config.directions.min_contrast, at_least(1), "",
                "score of the best heading over the mean of all");
  binder.number("max_sigma_rad", config.directions.max_sigma_rad, open(0, 3), "rad",
                "a vaguer heading is not given out");
  binder.number("sigma_factor", config.directions.sigma_factor, between(1, 10), "",
                "on the uncertainty from the segments, for edges err in bundles");
  binder.number("noise_floor_rad", config.directions.noise_floor_rad, open(0, 1), "rad",
                "of the heading of one frame against the next");
  binder.number("sigma_floor_rad", config.directions.sigma_floor_rad, open(0, 1), "rad",
                "calibration, mounting, walls not quite square: no heading is better than this");
}

}  // namespace

void bind(Binder& binder, AnalysisConfig& config) {
  bind(binder, config.heading);
  binder.number("heading_period_s", config.heading_period_s, open(0, 10), "s",
                "between frames that are searched for vanishing points");
  bind_odometry(binder, config.odometry);
}

}  // namespace vpdr::vision
