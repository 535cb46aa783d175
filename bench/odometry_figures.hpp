#pragma once
// What the program that measures visual odometry needs: true motions, errors, lengths from depth
// images, times.
#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

#include "bench/true_motion.hpp"
#include "pdr/core/pdr.hpp"
#include "vision/core/attitude_track.hpp"
#include "vision/core/odometry/visual_odometry.hpp"

namespace vpdr::bench {

/// What pdr says of the attitude, and its steps, played beside the frames.
class AttitudesOf {
 public:
  AttitudesOf(const std::vector<ImuSample>& imu, const std::vector<MagSample>& mag,
              pdr::Carry carry = pdr::Carry::kUnknown)
      : imu_(imu), mag_(mag), pdr_(worn(carry)) {}
  /// At a frame; frames in order of time.
  std::optional<vision::AttitudePrior> at(TimestampNs stamp_ns);
  /// Steps seen until then and not yet given out.
  std::vector<StepEvent> steps;

 private:
  static pdr::PdrConfig worn(pdr::Carry carry);

  const std::vector<ImuSample>& imu_;
  const std::vector<MagSample>& mag_;
  std::size_t next_ = 0, next_mag_ = 0;
  pdr::Pdr pdr_;
  pdr::PdrOutput out_;
  vision::AttitudeTrack track_;
};

/// Errors of motions between frames.
struct MotionErrors {
  void add(const MotionEstimate& motion, const TrueMotion& truth, double speed_mps,
           std::ofstream* csv);
  void print() const;
  std::vector<double> rotation_deg, direction_deg, rotation_nees, length_ratio;
};

/// Processor time of each frame, and of OpenCV's calls alone on the same images.
struct OdometryTimes {
  vision::OdometryOutput operator()(vision::VisualOdometry& odometry,
                                    const vision::OdometryInput& input);
  void print() const;
  std::vector<double> ms, bare_ms;

 private:
  cv::Mat last_;
  std::vector<cv::Point2f> points_;
};

/// Height of the camera above the floor, from the depth images of the first frames.
struct FloorSeen {
  double height_m = 0.0;
  int frames = 0;
};
FloorSeen floor_from_depth(const std::filesystem::path& folder, const vision::CameraModel& camera,
                           const std::vector<std::filesystem::path>& images, int frames);

/// True motion between images with depth: points placed by the depth of one are seen in the next
/// (OpenCV's PnP).
class DepthReference {
 public:
  DepthReference(std::filesystem::path folder, const vision::CameraModel& camera)
      : folder_(std::move(folder)), camera_(camera) {}
  /// Way of the camera since the last image that had depth; nothing where this has none.
  std::optional<double> follow(const std::filesystem::path& image,
                               const vision::FeatureTracks& tracks);

 private:
  std::filesystem::path folder_;
  vision::CameraModel camera_;
  vision::FeatureTracks last_;
  cv::Mat last_depth_;
};

/// Lengths against lengths.
struct ScaleErrors {
  void add(const vision::OdometryOutput& out, const std::optional<double>& truth_m);
  void print() const;

 private:
  Eigen::Isometry3d since_ = Eigen::Isometry3d::Identity();
  bool whole_ = false;
  std::vector<double> seen_m_, true_m_;
};

/// How far odometry wanders off along a way.
struct DriftErrors {
  void add(const PoseEstimate& estimate, const Eigen::Isometry3d& truth);
  void print() const;

 private:
  struct Place {
    Eigen::Isometry3d truth = Eigen::Isometry3d::Identity();
    Eigen::Isometry3d estimate = Eigen::Isometry3d::Identity();
    double way_m = 0.0;
  };
  std::vector<Place> places_;
};

void print_outcomes(const vision::VisualOdometry& odometry);

}  // namespace vpdr::bench
