// The motion of the worn board. Amplitudes: vertical excursion about half of the compass-gait
// pendulum's (Gard and Childress 2001), head and trunk sway after Kavanagh and Menz 2008, waist
// rotation after Whittle and Levine 1999.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/rotation.hpp"
#include "simulation/gait.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kControlIntervalS = 0.005;

/// How a place on the body moves at the preferred speed.
struct Place {
  double height_share;      ///< of the body height, standing
  Vector3d lever_m;         ///< board from the axis it turns about, body axes
  double bounce_share;      ///< of the pendulum's excursion
  double forward_ripple_m;  ///< amplitude at step frequency
  double lateral_sway_m;    ///< amplitude at half the step frequency
  double strike_mps2;       ///< first peak of the heel-strike transient
  Vector3d sway_rad;        ///< roll (half frequency), pitch (step frequency), yaw (half)
  double lean_rad;          ///< mean pitch, positive forward-down
  double lead_s;            ///< how early it turns into a corner
  Vector3d wander_rad;      ///< slow variation, standard deviation
};

constexpr double rad(double degrees) { return to_radians(degrees); }

const Place& place_of(WornAt worn) {
  static const std::array<Place, 3> kPlaces = {{
      {0.935,
       {0.09, 0.0, 0.08},
       0.52,
       0.006,
       0.020,
       0.5,
       {rad(0.9), rad(1.1), rad(1.3)},
       rad(2.0),
       0.25,
       {rad(0.7), rad(1.4), rad(1.8)}},
      {0.74,
       {0.11, 0.0, 0.0},
       0.56,
       0.008,
       0.018,
       1.1,
       {rad(1.2), rad(1.2), rad(2.6)},
       rad(-6.0),
       0.10,
       {rad(0.5), rad(0.6), rad(0.8)}},
      {0.58,
       {0.12, 0.0, 0.0},
       0.58,
       0.011,
       0.017,
       1.3,
       {rad(2.0), rad(1.3), rad(3.4)},
       rad(4.0),
       0.0,
       {rad(0.4), rad(0.6), rad(0.6)}},
  }};
  return kPlaces[static_cast<std::size_t>(worn)];
}

/// The step plan as functions of time.
struct Timeline {
  explicit Timeline(const GaitPlan& plan) {
    for (const GaitKnot& knot : plan.knots) t.push_back(knot.t_s);
  }
  template <class Member>
  MonotoneCurve curve(const GaitPlan& plan, Member GaitKnot::*member) const {
    std::vector<double> y;
    for (const GaitKnot& knot : plan.knots) y.push_back(knot.*member);
    return MonotoneCurve(t, y);
  }
  std::vector<double> t;
};

/// Displacement whose acceleration is a damped ring of about 11 Hz; `age_s` since the heel strike.
double strike_displacement(double age_s) {
  if (age_s <= 0.0 || age_s > 0.4) return 0.0;
  constexpr double kOmega = 2.0 * kPi * 11.0;
  constexpr double kDecayS = 0.028;
  const double rise = 1.0 - std::exp(-age_s / 0.008);
  return -rise * rise * rise * std::exp(-age_s / kDecayS) * std::sin(kOmega * age_s) /
         (0.33 * kOmega * kOmega);
}

class BoardMotion {
 public:
  BoardMotion(const WalkingPath& path, const Ground& ground, const GaitPlan& plan,
              const Walker& walker, WornAt worn, Random& random)
      : path_(path),
        ground_(ground),
        plan_(plan),
        walker_(walker),
        place_(place_of(worn)),
        timeline_(plan),
        progress_(timeline_.curve(plan, &GaitKnot::progress_m)),
        phase_(timeline_.curve(plan, &GaitKnot::phase)),
        vigour_(timeline_.curve(plan, &GaitKnot::vigour)),
        offset_(random, 6.0, 40.0),
        wander_{SmoothNoise(random, 3.0, 25.0), SmoothNoise(random, 3.0, 25.0),
                SmoothNoise(random, 3.0, 25.0)},
        still_{SmoothNoise(random, 1.2, 8.0), SmoothNoise(random, 1.2, 8.0),
               SmoothNoise(random, 0.8, 6.0), SmoothNoise(random, 1.0, 7.0),
               SmoothNoise(random, 1.0, 7.0)} {
    const auto steps = static_cast<std::size_t>(plan.knots.back().phase) + 2;
    for (std::size_t i = 0; i < steps; ++i) {
      step_gain_.push_back(1.0 + random.normal(0.05));
      strike_gain_.push_back(1.0 + random.normal(0.22));
    }
    asymmetry_ = random.normal(0.04);
  }

  [[nodiscard]] MotionSpline::Control at(double t_s) const;

 private:
  [[nodiscard]] double step_gain(double phase) const;
  [[nodiscard]] double bounce(double phase, double vigour) const;
  [[nodiscard]] double strikes(double t_s) const;
  [[nodiscard]] Vector3d angles(double t_s, double phase, double vigour) const;
  [[nodiscard]] double pendulum_m() const;

  const WalkingPath& path_;
  const Ground& ground_;
  const GaitPlan& plan_;
  const Walker& walker_;
  const Place& place_;
  Timeline timeline_;
  MonotoneCurve progress_, phase_, vigour_;
  SmoothNoise offset_;
  std::array<SmoothNoise, 3> wander_;
  std::array<SmoothNoise, 5> still_;
  std::vector<double> step_gain_, strike_gain_;
  double asymmetry_ = 0.0;
};

/// Bounce of each step relative to the mean, blended from heel strike to heel strike.
double BoardMotion::step_gain(double phase) const {
  const auto i = std::min(static_cast<std::size_t>(phase), step_gain_.size() - 2);
  const double u = phase - static_cast<double>(i);
  const double blend = u * u * (3.0 - 2.0 * u);
  const double uneven = asymmetry_ * std::cos(kPi * phase);
  return (1.0 - blend) * step_gain_[i] + blend * step_gain_[i + 1] + uneven;
}

/// Half the excursion of the stiff-legged pendulum, l - sqrt(l^2 - (L/2)^2), at the preferred
/// speed.
double BoardMotion::pendulum_m() const {
  const double leg = 0.53 * walker_.height_m;
  const double cadence =
      std::sqrt(60.0 * walker_.preferred_speed_mps / walker_.walk_ratio_m_per_spm);
  const double half_step = 0.5 * walker_.walk_ratio_m_per_spm * cadence;
  return 0.5 * (leg - std::sqrt(std::max(0.0, leg * leg - half_step * half_step)));
}

double BoardMotion::bounce(double phase, double vigour) const {
  // Lowest in early double support, a tenth of a step after the heel strike.
  const double angle = 2.0 * kPi * (phase - 0.10);
  // Short steps, as those of setting off and stopping, bounce more than a pendulum of their length:
  // recorded ones peak at three quarters of a full step.
  const double amplitude =
      place_.bounce_share * pendulum_m() * std::pow(vigour, 1.3) * step_gain(phase);
  return -amplitude * (1.0 + std::cos(angle) + 0.05 * std::cos(2.0 * angle - 0.6) +
                       0.010 * std::cos(3.0 * angle + 0.4));
}

double BoardMotion::strikes(double t_s) const {
  double sum = 0.0;
  const auto newest = std::upper_bound(timeline_.t.begin(), timeline_.t.end(), t_s);
  auto i = newest - timeline_.t.begin() - 1;
  for (int back = 0; back < 2 && i >= 0; ++back, --i) {
    const GaitKnot& knot = plan_.knots[static_cast<std::size_t>(i)];
    if (knot.step_length_m <= 0.0) continue;
    const double gain = strike_gain_[static_cast<std::size_t>(knot.phase)];
    sum += gain * knot.vigour * strike_displacement(t_s - knot.t_s);
  }
  return place_.strike_mps2 * sum;
}

Vector3d BoardMotion::angles(double t_s, double phase, double vigour) const {
  const double half = kPi * phase, full = 2.0 * kPi * phase;
  const double still = 1.0 - 0.7 * std::min(1.0, vigour);
  // A person who stands looks at one thing.
  const Vector3d wander = (0.25 + 0.75 * std::min(1.0, vigour)) * place_.wander_rad;
  const double roll = vigour * place_.sway_rad[0] * std::sin(half - 0.4) +
                      wander[0] * wander_[0](t_s) + still * rad(0.25) * still_[3](t_s);
  const double pitch =
      place_.lean_rad +
      vigour * place_.sway_rad[1] * (std::sin(full - 0.5) + 0.25 * std::sin(2.0 * full + 0.8)) +
      wander[1] * wander_[1](t_s) + still * rad(0.3) * still_[4](t_s);
  const double yaw =
      vigour * place_.sway_rad[2] * (std::sin(half + 0.7) + 0.15 * std::sin(3.0 * half)) +
      wander[2] * wander_[2](t_s);
  return {roll, pitch, yaw};
}

MotionSpline::Control BoardMotion::at(double t_s) const {
  const double s = progress_(t_s), phase = phase_(t_s), vigour = vigour_(t_s);
  const PathPoint here = path_.at(s);
  const double ahead_s = progress_(t_s + place_.lead_s);
  const PathPoint ahead = path_.at(ahead_s);
  const double speed = (progress_(t_s + 0.05) - progress_(t_s - 0.05)) / 0.1;
  const double still = 1.0 - 0.7 * std::min(1.0, vigour);

  Vector3d turn = angles(t_s, phase, vigour);
  // Leaning into the turn, about half of what would balance the sideways force.
  turn[0] -= 0.5 * speed * speed * here.curvature_per_m / 9.8;
  // Who strays from the middle of the corridor turns that way: nobody walks sideways.
  turn[2] += ahead.heading_rad + std::atan(walker_.lateral_wander_m * offset_.slope(ahead_s));
  const double along =
      vigour * place_.forward_ripple_m *
          (std::sin(2.0 * kPi * (phase - 0.05)) + 0.12 * std::sin(4.0 * kPi * phase + 0.5)) +
      still * 0.003 * still_[0](t_s);
  const double across = vigour * place_.lateral_sway_m *
                            (std::sin(kPi * phase) + 0.09 * std::sin(3.0 * kPi * phase + 0.3)) +
                        walker_.lateral_wander_m * offset_(s) + still * 0.003 * still_[1](t_s);
  const Vector2d forward(std::cos(here.heading_rad), std::sin(here.heading_rad));
  const Vector2d left(-forward.y(), forward.x());

  Vector3d position;
  position.head<2>() = here.position_m + along * forward + across * left;
  position.z() = ground_.at(here.position_m) + place_.height_share * walker_.height_m +
                 bounce(phase, vigour) + strikes(t_s) + still * 0.0008 * still_[2](t_s);
  position += from_euler({turn[0], turn[1], turn[2]}) * place_.lever_m;
  MotionSpline::Control control;
  control << position, turn;
  return control;
}

}  // namespace

const char* name_of(WornAt worn) {
  constexpr std::array<const char*, 3> kNames = {"head", "chest", "waist"};
  return kNames[static_cast<std::size_t>(worn)];
}

Walker draw_walker(Random& random) {
  Walker walker;
  walker.height_m += random.normal(0.09);
  walker.preferred_speed_mps += random.normal(0.12);
  walker.walk_ratio_m_per_spm *= walker.height_m / 1.72 * (1.0 + random.normal(0.06));
  return walker;
}

MotionSpline move_board(const WalkingPath& path, const Ground& ground, const GaitPlan& plan,
                        const Walker& walker, WornAt worn, double duration_s, Random random) {
  const BoardMotion motion(path, ground, plan, walker, worn, random);
  const auto count = static_cast<std::size_t>(std::ceil(duration_s / kControlIntervalS)) + 3;
  std::vector<MotionSpline::Control> controls;
  controls.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    controls.push_back(motion.at((static_cast<double>(k) - 1.0) * kControlIntervalS));
  }
  return {kControlIntervalS, std::move(controls)};
}

}  // namespace vpdr::simulation
