// How fast the renderer makes pictures, on one core; processor time:
//   bench_render_speed
// items_per_second is frames a second: a simulated walk through 640x480 (the goal is 20), the same
// with people and with motion blur, and a furnished room through a 512x512 fisheye.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/rotation.hpp"
#include "simulation/render/room_around.hpp"
#include "simulation/walk_camera.hpp"

namespace {

using namespace vpdr;              // NOLINT: a program, not a header
using namespace vpdr::simulation;  // NOLINT

void film(benchmark::State& state, const Film& film) {
  std::size_t frame = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(film.image(frame));
    frame = (frame + 37) % film.count();
  }
  state.SetItemsProcessed(state.iterations());
}

void walk(benchmark::State& state, const FilmOptions& options) {
  WalkOptions walk;
  walk.duration_s = 40.0;
  film(state, WalkCamera(simulate_walk(walk), options).film());
}

void corridor(benchmark::State& state) { walk(state, {}); }

void corridor_with_people(benchmark::State& state) {
  FilmOptions options;
  options.passers_by_per_min = 20.0;
  walk(state, options);
}

void corridor_with_motion_blur(benchmark::State& state) {
  FilmOptions options;
  options.exposure_s = 0.01;
  walk(state, options);
}

void furnished_room_through_a_fisheye(benchmark::State& state) {
  // Around a circle of 3 m, looking ahead.
  std::vector<PathPose> poses;
  for (int k = 0; k < 400; ++k) {
    const double angle = 2.0 * kPi * k / 400.0;
    poses.push_back({k * 25'000'000LL,
                     {1.5 * std::cos(angle), 1.5 * std::sin(angle), 1.4},
                     from_euler({0.0, 0.0, angle + 0.5 * kPi})});
  }
  const ReferencePath path(poses);
  const Surroundings room = surround(path, {});
  Camera camera;
  camera.lens = Lens::kEquidistant;
  camera.width = camera.height = 512;
  camera.fx = camera.fy = 190.0;
  camera.cx = camera.cy = 255.5;
  camera.distortion = {};
  std::vector<TimestampNs> frames;
  for (int k = 10; k < 390; k += 2) frames.push_back(k * 25'000'000LL);
  film(state, Film(shot_in(room, path, camera, 1, frames)));
}

BENCHMARK(corridor)->Unit(benchmark::kMillisecond);
BENCHMARK(corridor_with_people)->Unit(benchmark::kMillisecond);
BENCHMARK(corridor_with_motion_blur)->Unit(benchmark::kMillisecond);
BENCHMARK(furnished_room_through_a_fisheye)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
