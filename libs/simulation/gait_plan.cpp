#include <algorithm>
#include <cmath>
#include <utility>

#include "simulation/gait.hpp"

namespace vpdr::simulation {
namespace {

constexpr double kGridM = 0.05;
constexpr double kCurvaturePerM = 0.3;     // where a turn begins to slow the walker
constexpr double kSpeedChangeMps2 = 0.55;  // comfortable
constexpr double kFirstSpeedMps = 0.65;    // of the first and last step
constexpr double kFirstShare = 0.6;        // of a step: from rest to walking speed within it
constexpr double kWeakest = 0.7;           // vigour of a short step
constexpr double kFeetTogether = 0.6;      // vigour of the last step before a stand
constexpr double kStairCadenceSpm = 98.0;  // up or down, a tread a step
constexpr double kStairNoiseShare = 0.3;   // of the variation from step to step: the treads guide

/// Speed wished for along a stretch of path that begins and ends at a stand.
class SpeedProfile {
 public:
  SpeedProfile(const WalkingPath& path, const Ground& ground, double from_m, double to_m,
               double preferred_mps)
      : from_m_(from_m) {
    const auto count = static_cast<std::size_t>(std::ceil((to_m - from_m) / kGridM)) + 2;
    for (std::size_t i = 0; i < count; ++i) {
      const PathPoint here = path.at(from_m + static_cast<double>(i) * kGridM);
      const double curvature = here.curvature_per_m / kCurvaturePerM;
      const double level = preferred_mps * std::pow(1.0 + curvature * curvature, -1.0 / 6.0);
      const double stairs = Flight::kGoingM * kStairCadenceSpm / 60.0;
      speed_.push_back(ground.is_stairs(here.position_m) ? std::min(level, stairs) : level);
    }
    speed_.front() = speed_.back() = std::min(kFirstSpeedMps, preferred_mps);
    for (std::size_t i = 1; i < count; ++i) limit(speed_[i], speed_[i - 1]);
    for (std::size_t i = count - 1; i > 0; --i) limit(speed_[i - 1], speed_[i]);
  }

  [[nodiscard]] double at(double s_m) const {
    const auto i = static_cast<std::size_t>(std::max(0.0, (s_m - from_m_) / kGridM));
    return speed_[std::min(i, speed_.size() - 1)];
  }

 private:
  static void limit(double& speed, double neighbour) {
    speed = std::min(speed, std::sqrt(neighbour * neighbour + 2.0 * kSpeedChangeMps2 * kGridM));
  }

  double from_m_;
  std::vector<double> speed_;
};

/// Plans step after step and keeps the walker's slow variation.
class Planner {
 public:
  Planner(const WalkingPath& path, const Ground& ground, const Walker& walker, double last_strike_s,
          Random& random)
      : path_(path),
        ground_(ground),
        walker_(walker),
        last_strike_s_(last_strike_s),
        random_(random),
        length_drift_(random, 15.0, 90.0),
        cadence_drift_(random, 8.0, 60.0) {}

  /// Walks to `stop_m`, or as far as time allows; false when time is up.
  bool walk_to(double stop_m) {
    const SpeedProfile profile(path_, ground_, here_.progress_m, stop_m,
                               walker_.preferred_speed_mps);
    const double onset_m = here_.progress_m;
    here_.vigour = 0.0;
    here_.step_length_m = 0.0;
    plan_.knots.push_back(here_);
    bool in_time = true;
    while (stop_m - here_.progress_m > 1e-6) {
      const Pace pace = pace_at(profile);
      // Time for two more steps: shorten them so that the feet come together with the second.
      if (in_time && here_.t_s + 3.0 * 60.0 / pace.cadence_spm > last_strike_s_) {
        stop_m = std::min(stop_m, here_.progress_m + 1.5 * pace.length_m);
        in_time = stop_m >= path_.length_m() - 1e-6;
      }
      step(pace, stop_m, here_.progress_m == onset_m);
    }
    plan_.knots.back().vigour = kFeetTogether;
    return in_time;
  }

  void stand(double duration_s) {
    here_.vigour = 0.0;
    here_.step_length_m = 0.0;
    here_.t_s += 0.45;  // until the bounce has died away
    plan_.knots.push_back(here_);
    here_.t_s += duration_s;
  }

  [[nodiscard]] double now_s() const { return here_.t_s; }
  GaitPlan& plan() { return plan_; }

 private:
  /// Steps a minute at a speed, by the walk ratio.
  [[nodiscard]] double cadence_spm(double speed_mps) const {
    return std::sqrt(60.0 * speed_mps / walker_.walk_ratio_m_per_spm);
  }

  [[nodiscard]] double length_m(double cadence) const {
    return walker_.walk_ratio_m_per_spm * cadence;
  }

  /// The next step as it is meant.
  struct Pace {
    double cadence_spm;
    double length_m;
    double noise_share;  ///< of the walker's variation
  };

  [[nodiscard]] Pace pace_at(const SpeedProfile& profile) const {
    if (ground_.is_stairs(path_.at(here_.progress_m + 0.5 * Flight::kGoingM).position_m)) {
      return {kStairCadenceSpm, Flight::kGoingM, kStairNoiseShare};
    }
    const double cadence = cadence_spm(profile.at(here_.progress_m + 0.3));
    return {cadence, length_m(cadence), 1.0};
  }

  void step(const Pace& pace, double stop_m, bool first) {
    const double usual_m = pace.length_m, noise = pace.noise_share;
    const double left_m = stop_m - here_.progress_m;
    double length = usual_m * (1.0 + noise * walker_.step_length_drift * length_drift_(here_.t_s)) *
                    (1.0 + noise * random_.normal(walker_.step_length_noise));
    double time = 60.0 / pace.cadence_spm *
                  (1.0 + noise * walker_.cadence_drift * cadence_drift_(here_.t_s)) *
                  (1.0 + noise * random_.normal(walker_.step_time_noise));
    if (first) {  // setting off from a stand
      length *= kFirstShare;
      time *= 1.15;
    }
    if (left_m <= 1.15 * usual_m) {
      length = left_m;
    } else if (left_m <= 2.0 * usual_m) {
      length = 0.55 * left_m;
    }
    here_.t_s += time;
    here_.progress_m = left_m - length < 1e-6 ? stop_m : here_.progress_m + length;
    here_.phase += 1.0;
    here_.step_length_m = length;
    here_.vigour =
        std::clamp(length / length_m(cadence_spm(walker_.preferred_speed_mps)), kWeakest, 1.3);
    plan_.knots.push_back(here_);
  }

  const WalkingPath& path_;
  const Ground& ground_;
  const Walker& walker_;
  double last_strike_s_;
  Random& random_;
  SmoothNoise length_drift_, cadence_drift_;
  GaitKnot here_;
  GaitPlan plan_;
};

bool is_straight(const WalkingPath& path, const Ground& ground, double s_m) {
  for (int i = -8; i <= 8; ++i) {  // two metres before and after
    const PathPoint point = path.at(s_m + 0.25 * i);
    if (std::abs(point.curvature_per_m) > 1e-9 || ground.is_stairs(point.position_m)) return false;
  }
  return true;
}

/// Places to stop on the way, on straight stretches, in order; the path's end is the last.
std::vector<double> draw_stops(const WalkingPath& path, const Ground& ground, const Walker& walker,
                               const Pauses& pauses, Random& random) {
  std::vector<double> stops;
  if (pauses.stop_every_s > 0.0) {
    const double spacing = pauses.stop_every_s * walker.preferred_speed_mps * 0.9;
    double s = spacing * random.uniform(0.5, 1.0);
    while (s < path.length_m() - 6.0) {
      while (s < path.length_m() - 6.0 && !is_straight(path, ground, s)) s += 0.5;
      if (s < path.length_m() - 6.0) stops.push_back(s);
      s += spacing * random.uniform(0.8, 1.2);
    }
  }
  stops.push_back(path.length_m());
  return stops;
}

}  // namespace

GaitPlan plan_gait(const WalkingPath& path, const Ground& ground, const Walker& walker,
                   const Pauses& pauses, double duration_s, Random random) {
  const std::vector<double> stops = draw_stops(path, ground, walker, pauses, random);
  Planner planner(path, ground, walker, duration_s - pauses.final_s, random);
  planner.plan().knots.push_back({});
  planner.stand(std::max(0.1, pauses.initial_s - 0.45));
  double last_strike_s = planner.now_s();
  bool in_time = true;
  for (std::size_t i = 0; i < stops.size() && in_time; ++i) {
    if (planner.now_s() + 3.0 > duration_s - pauses.final_s) {
      in_time = false;
      break;
    }
    in_time = planner.walk_to(stops[i]);
    last_strike_s = planner.now_s();
    planner.stand(in_time && i + 1 < stops.size() ? pauses.stop_s : 0.05);
  }
  GaitPlan plan = std::move(planner.plan());
  plan.end_of_walk_s = last_strike_s;
  plan.reached_end = in_time;
  return plan;
}

std::vector<TrueStep> true_steps(const GaitPlan& plan, TimestampNs start_ns) {
  std::vector<TrueStep> steps;
  for (const GaitKnot& knot : plan.knots) {
    if (knot.step_length_m > 0.0) {
      steps.push_back({start_ns + to_ns(knot.t_s), knot.step_length_m});
    }
  }
  return steps;
}

}  // namespace vpdr::simulation
