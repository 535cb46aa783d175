// vpdr calibrate camera: lens, height above the floor, place and time relative to the inertial
// sensor, into one camchain file.
#include <fnmatch.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>

#include "core/errors.hpp"
#include "vision/source/make_camera.hpp"
#include "vpdr/camera/board_images.hpp"
#include "vpdr/camera/hand_wave.hpp"
#include "vpdr/camera/image_folder.hpp"
#include "vpdr/camera/live_boards.hpp"
#include "vpdr/commands/commands.hpp"
#include "vpdr/progress_bar.hpp"

namespace vpdr::tool {
namespace {

namespace fs = std::filesystem;

struct CameraOptions {
  fs::path folder;
  std::string device;
  std::string match = "*";
  std::string board = "9x6";
  double square_m = 0.025;
  std::string lens = "radtan";
  bool third_radial = false;
  std::size_t views = 25;
  fs::path camera;
  fs::path floor;
  fs::path wave;
  fs::path out;
};

vision::Chessboard board_of(const CameraOptions& options) {
  vision::Chessboard board;
  char x = 0;
  std::istringstream text(options.board);
  if (!(text >> board.columns >> x >> board.rows) || x != 'x' || !text.eof() || board.columns < 3 ||
      board.rows < 3) {
    throw ConfigurationFault("--board: '" + options.board +
                             "' is not COLUMNSxROWS of inner corners, each at least 3: 9x6 for a "
                             "board of 10 x 7 squares");
  }
  board.square_m = options.square_m;
  return board;
}

BoardImages views_of(const CameraOptions& options, const vision::Chessboard& board) {
  if (!options.device.empty()) {
    std::cerr << "hold the board before the camera: near and far, tilted each way, in every corner "
                 "of the image\n";
    const auto grabber = vision::make_camera_grabber(options.device, 0, 0);
    LiveBoardsOptions live;
    live.views = options.views;
    return watch_boards(*grabber, options.device, board, live,
                        [](const std::string& line) { std::cerr << line << "\n"; });
  }
  std::vector<fs::path> files = images_in(options.folder);
  std::erase_if(files, [&](const fs::path& file) {
    return fnmatch(options.match.c_str(), file.filename().c_str(), 0) != 0;
  });
  if (files.empty()) throw FileFault("--match '" + options.match + "': no image is called so");
  ProgressBar bar("looking for the board");
  return find_boards(files, board, [&bar](double share) { bar.update(share); });
}

vision::IntrinsicsCalibration lens_of(const CameraOptions& options,
                                      const vision::Chessboard& board) {
  const BoardImages found = views_of(options, board);
  for (const std::string& why : found.without) std::cerr << "left out: " << why << "\n";
  vision::IntrinsicsConfig config;
  config.third_radial = options.third_radial;
  if (options.lens == "equidistant") config.lens = vision::Distortion::kEquidistant;
  auto result = vision::calibrate_intrinsics(found.views, board, found.size, config);
  if (!result) throw FileFault("calibration: " + result.error().message);
  return std::move(result.value());
}

void calibrate(const CameraOptions& options) {
  const vision::Chessboard board = board_of(options);
  std::vector<std::string> remarks{"Camera calibration by vpdr calibrate camera."};
  const auto tell = [&](const std::string& text) {
    std::cout << text;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) remarks.push_back(line);
  };
  dataset::CameraCalibration camera;
  if (options.camera.empty()) {
    const vision::IntrinsicsCalibration lens = lens_of(options, board);
    tell(describe(lens));
    camera = to_file(lens.camera);
  } else {
    camera = dataset::read_camera_calibration(options.camera);
  }
  if (!options.floor.empty()) {
    const vision::FloorView floor = floor_in(options.floor, board, vision::make_camera(camera));
    tell(describe(floor));
    camera.height_m = floor.height_m;
    camera.pitch_rad = floor.pitch_rad;
  }
  if (!options.wave.empty()) {
    ProgressBar bar("following the wave");
    const vision::CameraImuCalibration mounting =
        calibrate_hand_wave(options.wave, camera, [&bar](double share) { bar.update(share); });
    tell(describe(mounting));
    set_mounting(mounting, camera);
  }
  dataset::write_camchain(camera, remarks, options.out);
  std::cout << "written to " << options.out.string() << "\n";
}

void add_board_options(CLI::App& command, CameraOptions& options) {
  command.add_option("--board", options.board, "inner corners of the chessboard, COLUMNSxROWS")
      ->capture_default_str();
  command.add_option("--square", options.square_m, "side of its squares, m")
      ->check(CLI::Range(1e-4, 10.0))
      ->capture_default_str();
  command.add_option("--lens", options.lens, "radtan: pinhole; equidistant: fisheye")
      ->check(CLI::IsMember({"radtan", "equidistant"}))
      ->capture_default_str();
  command.add_flag("--k3", options.third_radial,
                   "a third radial coefficient, for wide pinhole lenses; Kalibr has none");
}

}  // namespace

void add_calibrate_camera(CLI::App& calibrate_app) {
  auto options = std::make_shared<CameraOptions>();
  CLI::App* command = calibrate_app.add_subcommand(
      "camera",
      "Lens from chessboard images, height from a chessboard on the floor, into camchain.yaml.");
  auto* folder = command->add_option("FOLDER", options->folder, "folder of chessboard images");
  auto* device =
      command->add_option("--device", options->device, "live camera instead: index, device or URL");
  auto* camera = command->add_option("--camera", options->camera,
                                     "a calibrated lens instead, to which the rest is added");
  folder->excludes(device)->excludes(camera);
  device->excludes(camera);
  command->add_option("--match", options->match, "only images called so, as 'left*.jpg'");
  command->add_option("--views", options->views, "to take from a live camera")
      ->check(CLI::Range(5, 1000))
      ->capture_default_str();
  add_board_options(*command, *options);
  command->add_option("--floor", options->floor,
                      "image of the chessboard lying on the floor, the camera as it is worn");
  command->add_option("--wave", options->wave,
                      "recording of camera and inertial sensor waved by hand for half a minute, "
                      "turned about all three axes");
  command->add_option("--out", options->out, "file to write: camchain.yaml")->required();
  command->callback([=] {
    if (folder->count() + device->count() + camera->count() == 0) {
      throw CLI::RequiredError("FOLDER, --device or --camera");
    }
    calibrate(*options);
  });
}

}  // namespace vpdr::tool
