#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "core/errors.hpp"
#include "core/rotation.hpp"
#include "tests/support/recordings.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/vision/corridor_image.hpp"
#include "vpdr/camera/image_directions.hpp"
#include "vpdr/camera/image_folder.hpp"

namespace vpdr::tool {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using vision::CameraModel;
using vision::testing::draw_corridor;
using vision::testing::looking;
using vision::testing::plain_camera;

std::vector<json> lines_of(const fs::path& folder, const CameraModel& camera,
                           const ImageDirectionsOptions& options, std::string* problems = nullptr) {
  std::ostringstream out;
  std::ostringstream complaints;
  print_directions(images_in(folder), camera, options, out, complaints);
  if (problems != nullptr) *problems = complaints.str();
  std::vector<json> lines;
  std::istringstream in(out.str());
  for (std::string line; std::getline(in, line);) lines.push_back(json::parse(line));
  return lines;
}

Eigen::Vector3d vector_of(const json& v) {
  return {v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
}

TEST(ImageDirections, OneLineForEachImageInTheOrderOfNames) {
  const testing::TemporaryFolder folder;
  const CameraModel camera(plain_camera());
  const Eigen::Matrix3d r = looking(0.3, -0.1, 0.04);
  cv::imwrite((folder.path() / "b.png").string(), draw_corridor(camera, r));
  cv::imwrite((folder.path() / "a.PNG").string(), cv::Mat(480, 640, CV_8UC1, cv::Scalar(0)));
  std::ofstream(folder.path() / "c.jpg") << "no image";
  std::ofstream(folder.path() / "notes.txt") << "left alone";
  std::string problems;
  const auto lines = lines_of(folder.path(), camera, {}, &problems);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].at("image"), "a");
  EXPECT_TRUE(lines[0].at("directions").empty());
  EXPECT_EQ(lines[0].at("reason"), "dark");
  EXPECT_EQ(lines[1].at("image"), "b");
  ASSERT_EQ(lines[1].at("directions").size(), 3U) << lines[1];
  ASSERT_EQ(lines[1].at("sigma_rad").size(), 3U);
  ASSERT_EQ(lines[1].at("inliers").size(), 3U);
  EXPECT_GT(lines[1].at("time_ms").get<double>(), 0.0);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d d = vector_of(lines[1].at("directions").at(static_cast<std::size_t>(i)));
    EXPECT_NEAR(d.norm(), 1.0, 1e-9);
    EXPECT_GT(std::abs(d.dot(r.col(i))), std::cos(to_radians(0.5))) << i;
    EXPECT_LT(lines[1].at("sigma_rad").at(static_cast<std::size_t>(i)).get<double>(), 0.05);
  }
  EXPECT_EQ(lines[2].at("image"), "c");
  EXPECT_TRUE(lines[2].at("directions").empty());
  EXPECT_NE(problems.find("c.jpg"), std::string::npos);
}

TEST(ImageDirections, AKnownVerticalIsUsedAndDrawingsAreWritten) {
  const testing::TemporaryFolder folder;
  const CameraModel camera(plain_camera());
  // Lies on its side: beyond what is searched without knowing the vertical.
  const Eigen::Matrix3d r = looking(0.2, 0.0, 1.4);
  cv::imwrite((folder.path() / "side.png").string(), draw_corridor(camera, r));
  ImageDirectionsOptions options;
  options.vertical = vision::VerticalPrior{r.col(2), to_radians(1.0)};
  options.draw = folder.path() / "drawn";
  const auto lines = lines_of(folder.path(), camera, options);
  ASSERT_EQ(lines.size(), 1U);
  ASSERT_EQ(lines[0].at("directions").size(), 3U) << lines[0];
  EXPECT_GT(std::abs(vector_of(lines[0].at("directions").at(2)).dot(r.col(2))),
            std::cos(to_radians(0.5)));
  const cv::Mat drawing = cv::imread((options.draw / "side.png").string());
  ASSERT_EQ(drawing.size(), cv::Size(640, 480));
  std::vector<cv::Mat> channels;
  cv::split(drawing, channels);
  EXPECT_GT(cv::countNonZero(channels[0] != channels[2]), 1000);  // coloured
}

TEST(ImageDirections, AFolderWithoutImagesIsAFault) {
  const testing::TemporaryFolder folder;
  EXPECT_THROW(static_cast<void>(images_in(folder.path())), FileFault);
  EXPECT_THROW(static_cast<void>(images_in(folder.path() / "absent")), FileFault);
}

// Half of a public set of buildings; the goals are those of the whole set.
TEST(ImageDirections, YorkUrban) {
  VPDR_REQUIRE_RECORDINGS(data);
  const fs::path york = data / "vision/york_urban_vp";
  if (!fs::exists(york)) GTEST_SKIP() << "skipped: no data";
  std::map<std::string, std::vector<Eigen::Vector3d>> truth;
  std::ifstream in(york / "gt_vanishing_directions.csv");
  for (std::string line; std::getline(in, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream cells(line);
    std::string name;
    int index = 0;
    Eigen::Vector3d d;
    if (cells >> name >> index >> d.x() >> d.y() >> d.z() && index < 3) {
      truth[name].push_back(d.normalized());
    }
  }
  vision::CameraParameters p;
  p.fx_px = p.fy_px = 674.917;
  p.cx_px = 307.551;
  p.cy_px = 251.454;
  std::vector<double> errors;
  int within = 0;
  int images = 0;
  for (const json& line : lines_of(york / "images", CameraModel(p), {})) {
    ++images;
    double worst = line.at("directions").empty() ? 180.0 : 0.0;
    for (const json& d : line.at("directions")) {
      double nearest = 180.0;
      for (const Eigen::Vector3d& t : truth.at(line.at("image"))) {
        nearest =
            std::min(nearest, to_degrees(std::acos(std::min(1.0, std::abs(vector_of(d).dot(t))))));
      }
      errors.push_back(nearest);
      worst = std::max(worst, nearest);
    }
    within += worst <= 5.0;
  }
  ASSERT_GT(images, 40);
  ASSERT_FALSE(errors.empty());
  std::nth_element(errors.begin(), errors.begin() + static_cast<long>(errors.size() / 2),
                   errors.end());
  EXPECT_LT(errors[errors.size() / 2], 1.0);
  EXPECT_GE(within, 0.95 * images);
}

}  // namespace
}  // namespace vpdr::tool
