#pragma once
// Height and vertical speed of a walker out of barometric heights, which are honest over a minute
// and wrong by metres within seconds or hours: doors, wind, ventilation and weather all move them.
//
//   y = h + weather + gust + white       all in metres
//
//   weather   random walk                  ventilation, weather, warming of the sensor
//   gust      first-order Gauss-Markov     wind, and air that the walking body pushes about
//
// A person is on the level most of the time, and there h does not change. So these models run
// side by side, an interacting multiple model estimator (Blom and Bar-Shalom, "The interacting
// multiple model algorithm for systems with Markovian switching coefficients", IEEE Transactions on
// Automatic Control 33, 1988):
//
//   level       h stays, v = 0: whatever the pressure does slowly is weather
//   up, down    h' = v, v a Gauss-Markov process about the usual speed of stairs, or of lifts where
//               nobody steps
//   disturbed   the air's pressure jumps: a door, an air lock; h goes on as it did
//
// Each one's probability follows from how well it foretold the pressure. SI; time in seconds
// between readings. Not thread-safe; allocates nothing; no errors.
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

namespace vpdr::pdr {

struct VerticalConfig {
  double gust_sigma_m = 0.35;      ///< m of height, of gusts; (0, 10)
  double gust_time_s = 2.0;        ///< s, over which a gust lasts; (0, 60)
  double weather_m_sqrt_s = 0.04;  ///< m per sqrt(s), of slow changes; (0, 1)
  double floor_m_sqrt_s = 0.01;    ///< m per sqrt(s) of walking: floors are not quite level; (0, 1)
  double stairs_mps = 0.28;        ///< m/s, vertical speed of who steps while climbing; (0, 3)
  double stairs_sigma_mps = 0.12;  ///< m/s, its spread; (0, 3)
  double lift_mps = 0.8;           ///< m/s, of who does not step; (0, 20)
  double lift_sigma_mps = 0.8;     ///< m/s, its spread; (0, 20)
  double speed_time_s = 1.5;       ///< s, in which it is reached; (0, 60)
  double level_time_s = 120.0;     ///< s, mean time between climbs; (1, 1e5)
  double climb_time_s = 15.0;      ///< s, mean length of a climb; (1, 1000)
  double jump_m = 3.0;  ///< m of height, of a jump of the air's pressure, as a gust; (0, 100)
  double lasting_jump_m = 1.0;  ///< m, of what stays of it; (0, 100)
  double jump_every_s = 120.0;  ///< s, mean time between jumps; (1, 1e5)
};

class VerticalFilter {
 public:
  explicit VerticalFilter(const VerticalConfig& config) : config_(config) {}

  /// The first reading: its height counts as the one that is known to that variance.
  void start(double height_m, double variance_m2, double reading_m, double noise_m2);
  /// A reading `dt_s` after the last, with the variance of its white noise. Where `walking` is
  /// false a climb is a lift's or an escalator's.
  void add(double reading_m, double noise_m2, double dt_s, bool walking);

  [[nodiscard]] double height_m() const { return mean_[kHeight]; }
  [[nodiscard]] double speed_mps() const { return mean_[kSpeed]; }
  [[nodiscard]] double height_variance_m2() const { return covariance_(kHeight, kHeight); }
  [[nodiscard]] double speed_variance_m2ps2() const { return covariance_(kSpeed, kSpeed); }
  /// Probability that the height changes.
  [[nodiscard]] double climbing() const {
    return models_[kUp].probability + models_[kDown].probability;
  }

 private:
  enum State : std::uint8_t { kHeight, kSpeed, kWeather, kGust, kSize };
  enum ModelIndex : std::uint8_t { kLevel, kUp, kDown, kDisturbed, kModels };
  static constexpr std::array<ModelIndex, kModels> kAll{kLevel, kUp, kDown, kDisturbed};
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  struct Model {
    Vector x = Vector::Zero();
    Matrix p = Matrix::Zero();
    double probability = 0.0;
  };
  using Models = std::array<Model, kModels>;
  using Switching = Eigen::Matrix<double, kModels, kModels>;

  [[nodiscard]] Switching switching(double dt_s) const;
  void pass(double dt_s, bool walking);
  void mix(const Switching& switching);
  void predict(ModelIndex index, double dt_s, bool walking);
  void climb(Model& model, double mean_mps, double sigma_mps, double dt_s) const;
  /// Likelihood of the reading under the model, which is corrected by it.
  static double correct(Model& model, double reading_m, double noise_m2);
  void combine();

  VerticalConfig config_;
  Models models_{};
  Vector mean_ = Vector::Zero();
  Matrix covariance_ = Matrix::Zero();
};

}  // namespace vpdr::pdr
