// vpdr vanishing-points: the three directions of the building in each image of a folder.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <vector>

#include "core/errors.hpp"
#include "core/rotation.hpp"
#include "vision/source/make_camera.hpp"
#include "vpdr/camera/image_directions.hpp"
#include "vpdr/camera/image_folder.hpp"
#include "vpdr/commands/commands.hpp"

namespace vpdr::tool {
namespace {

struct VanishingPointsOptions {
  std::filesystem::path folder;
  std::filesystem::path camera;
  std::vector<double> up;
  double up_sigma_deg = 1.0;
  std::filesystem::path draw;
};

void print(const VanishingPointsOptions& options) {
  ImageDirectionsOptions wanted;
  wanted.draw = options.draw;
  if (!options.up.empty()) {
    const Eigen::Vector3d up(options.up[0], options.up[1], options.up[2]);
    if (!up.allFinite() || !(up.norm() > 1e-6)) {
      throw ConfigurationFault("--gravity: must be a direction; upright is 0,-1,0");
    }
    wanted.vertical = vision::VerticalPrior{up.normalized(), to_radians(options.up_sigma_deg)};
  }
  const vision::CameraModel camera =
      vision::make_camera(dataset::read_camera_calibration(options.camera));
  print_directions(images_in(options.folder), camera, wanted, std::cout, std::cerr);
}

}  // namespace

void add_vanishing_points(CLI::App& app) {
  auto options = std::make_shared<VanishingPointsOptions>();
  CLI::App* command = app.add_subcommand(
      "vanishing-points",
      "Print the three directions of the building in each image, a line of JSON each: unit vectors "
      "in camera axes (x right, y down, z forward).");
  command->add_option("FOLDER", options->folder, "folder of images")->required();
  command
      ->add_option("--camera", options->camera,
                   "calibration: camchain.yaml, EuRoC sensor.yaml or ROS camera_info")
      ->required();
  command
      ->add_option("--gravity", options->up,
                   "the up direction in camera axes, x,y,z, where it is known: upright is 0,-1,0")
      ->delimiter(',')
      ->expected(3);
  command->add_option("--gravity-sigma", options->up_sigma_deg, "how well it is known, deg")
      ->check(CLI::Range(0.01, 45.0))
      ->capture_default_str();
  command->add_option("--draw", options->draw,
                      "folder for the images with their segments coloured by direction");
  command->callback([options] { print(*options); });
}

}  // namespace vpdr::tool
