#pragma once
// Straight line segments from the edges of a grey image, faster than LSD and to a smaller fraction
// of a pixel: edge points are local maxima of the gradient, found between pixels by a parabola;
// a segment grows from its strongest point along the edge both ways for as long as points lie on
// one line and their gradients point across it, over small gaps too; its line is the total least
// squares fit to all its points. Pixel (0, 0) is the centre of the upper left pixel. No random
// choice: the same image gives the same segments. Not thread-safe; allocates nothing once warm.
#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

namespace vpdr::vision {

/// A segment as detected, in pixels of the full image, lens distortion still in it.
struct LineSegment {
  Eigen::Vector2d start_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d end_px = Eigen::Vector2d::Zero();
};

struct EdgeLineConfig {
  double min_contrast = 5.0;    ///< grey levels: the height of a step whose edge is just seen
  double seed_contrast = 12.0;  ///< of the point that a segment grows from
  double angle_rad = 0.39;      ///< between a point's gradient and the normal of the line
  double distance_px = 0.8;     ///< of a point from the line
  int gap_px = 3;               ///< missing points that a segment may bridge
};

class EdgeLines {
 public:
  explicit EdgeLines(const EdgeLineConfig& config);

  /// Segments of an 8-bit grey image of at least five points, in the order of their strongest
  /// ones. The reference holds until the next call.
  const std::vector<LineSegment>& detect(const cv::Mat& grey);

 private:
  struct Edge {
    Eigen::Vector2f at;      ///< pixels
    Eigen::Vector2f normal;  ///< unit gradient
    float strength = 0.0F;   ///< gradient
    std::size_t cell = 0;    ///< of the image, row by row
  };
  /// Moments of the points of a growing segment about its first one, and the line through them.
  struct Line {
    Eigen::Vector2d origin = Eigen::Vector2d::Zero();
    double count = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
    Eigen::Vector2d through = Eigen::Vector2d::Zero();
    Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  ///< the bright side keeps its side
    void add(const Eigen::Vector2d& point);
    void fit();
    [[nodiscard]] Eigen::Vector2d foot(const Eigen::Vector2d& point) const;
    [[nodiscard]] double distance(const Eigen::Vector2d& point) const;
  };

  void measure_gradient(const cv::Mat& grey);
  void find_edges();
  void add_edge(int row, int column, float before, float here, float after, bool across_columns);
  void order_seeds();
  void grow(std::size_t seed);
  std::size_t extend(std::size_t from, double sense, Line& line);
  [[nodiscard]] std::optional<std::size_t> next(std::size_t from, double sense,
                                                const Line& line) const;
  [[nodiscard]] bool fits(const Edge& edge, const Line& line) const;

  EdgeLineConfig config_;
  double min_alignment_;
  int width_ = 0;
  int height_ = 0;
  cv::Mat gradient_x_, gradient_y_, gradient_;
  std::vector<std::int32_t> edge_at_;  ///< of each pixel; negative for none, or one already used
  std::vector<Edge> edges_;
  std::vector<std::size_t> seeds_, bins_;
  std::vector<LineSegment> segments_;
};

}  // namespace vpdr::vision
