#pragma once
// How a person walks a path: when each foot strikes, how long each step is, and how a board worn on
// head, chest or waist moves with it. Amplitudes and relations are those of healthy adults.
#include <vector>

#include "core/time.hpp"
#include "simulation/curve.hpp"
#include "simulation/random.hpp"
#include "simulation/stairs.hpp"
#include "simulation/walking_path.hpp"

namespace vpdr::simulation {

/// Where the board is worn.
enum class WornAt { kHead, kChest, kWaist };
/// "head", "chest", "waist".
const char* name_of(WornAt worn);

/// The person. Cadence c (steps/min) and step length L follow from speed v by the walk ratio
/// W = L / c, nearly constant over an adult's speeds (Sekiya and Nagasaki 1998): c = sqrt(60 v /
/// W).
struct Walker {
  double height_m = 1.72;
  double preferred_speed_mps = 1.36;
  double walk_ratio_m_per_spm = 0.0065;  ///< step length over cadence in steps per minute
  double step_length_noise = 0.025;      ///< of one step, relative standard deviation
  double step_time_noise = 0.015;        ///< of one step, relative standard deviation
  double step_length_drift = 0.02;       ///< slow, relative standard deviation
  double cadence_drift = 0.015;          ///< slow, relative standard deviation
  double lateral_wander_m = 0.10;        ///< off the corridor's centre line, standard deviation
};

/// A walker drawn from the adult population: height 1.72 +- 0.09 m, preferred speed 1.36 +- 0.12
/// m/s, walk ratio 0.0065 m/(steps/min) in proportion to height, +- 6 %.
Walker draw_walker(Random& random);

/// When the walker stands still.
struct Pauses {
  double initial_s = 3.0;      ///< at the start, so that filters initialise
  double final_s = 2.0;        ///< at the end, at least
  double stop_every_s = 50.0;  ///< mean time between stops on the way; 0: none
  double stop_s = 3.0;         ///< length of a stop
};

/// One true step.
struct TrueStep {
  TimestampNs stamp_ns = 0;  ///< heel strike
  double length_m = 0.0;     ///< level progress along the way since the last heel strike
};

/// The walk in time: an instant where progress and step phase are known.
struct GaitKnot {
  double t_s = 0.0;
  double progress_m = 0.0;     ///< along the path
  double phase = 0.0;          ///< steps done; a whole number at each heel strike
  double vigour = 0.0;         ///< 0 standing, 1 a step of the preferred length
  double step_length_m = 0.0;  ///< of the step that ends here; 0 at the onset of walking
};

struct GaitPlan {
  std::vector<GaitKnot> knots;
  double end_of_walk_s = 0.0;  ///< the last heel strike
  bool reached_end = false;    ///< of the path, before time was up
};

/// Plans the steps of a walk of `duration_s` along `path`: stands, sets off, slows in turns with
/// the cube root of curvature (two-thirds power law, Hicheur et al. 2005), stops on straight
/// stretches now and then, and comes to a stand at the path's end or in time. On stairs each step
/// takes a tread.
GaitPlan plan_gait(const WalkingPath& path, const Ground& ground, const Walker& walker,
                   const Pauses& pauses, double duration_s, Random random);

/// The motion of the board that follows from the steps: inverted-pendulum bounce, speed ripple,
/// lateral and angular sway at half the step frequency, heel-strike transient, slow wander of the
/// head, sway while standing; all above the ground. Controls every 5 ms.
MotionSpline move_board(const WalkingPath& path, const Ground& ground, const GaitPlan& plan,
                        const Walker& walker, WornAt worn, double duration_s, Random random);

/// The heel strikes of a plan.
std::vector<TrueStep> true_steps(const GaitPlan& plan, TimestampNs start_ns);

}  // namespace vpdr::simulation
