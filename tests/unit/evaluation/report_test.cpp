#include "evaluation/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <regex>
#include <sstream>

#include "core/rotation.hpp"
#include "evaluation/figures.hpp"
#include "evaluation/run_writer.hpp"
#include "tests/support/temporary_folder.hpp"

namespace vpdr::evaluation {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Walks a circle for `seconds` at `rate_hz`, the estimate a little off and noisy.
RunDirectory circle_run(int seconds, int rate_hz) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0.0, 0.02);
  RunDirectory run;
  for (int i = 0; i <= seconds * rate_hz; ++i) {
    const TimestampNs stamp = i * (kNsPerSecond / rate_hz);
    const double angle = 0.1 * to_seconds(stamp);
    const Eigen::Vector3d place(12.0 * std::cos(angle) + normal(random),
                                12.0 * std::sin(angle) + normal(random), 0.0);
    const Eigen::Quaterniond attitude = from_euler({0.0, 0.0, angle + kPi / 2 + normal(random)});
    run.fused.push_back({stamp, place, attitude});
    run.pdr.push_back({stamp, 1.05 * place, attitude});
    StampedCovariance covariance;
    covariance.stamp_ns = stamp;
    covariance.position_m2 = 0.04 * Eigen::Matrix2d::Identity();
    run.covariance.push_back(covariance);
    if (i % rate_hz == 0) {
      run.steps.push_back({stamp, 0.7 + normal(random), angle});
      run.vision_heading.push_back({stamp, normal(random), 0.0, 0.02});
    }
  }
  run.summary = {static_cast<std::uint64_t>(seconds), 0.7 * seconds, 1.0 * seconds, 250.0};
  return run;
}

dataset::Recording circle_truth(const RunDirectory& run) {
  dataset::Recording recording;
  recording.name = "walk";
  recording.mag.resize(1);
  for (std::size_t i = 0; i < run.fused.size(); i += 4) {
    const double angle = 0.1 * to_seconds(run.fused[i].stamp_ns);
    recording.truth.poses.push_back({run.fused[i].stamp_ns,
                                     {12.0 * std::cos(angle), 12.0 * std::sin(angle), 0.0},
                                     from_euler({0.0, 0.0, angle + kPi / 2})});
  }
  return recording;
}

RunInfo rich_info() {
  RunInfo info;
  info.title = "five services";
  info.latencies = {summarize_latency("IMU sample to fused pose", {100, 200, 300, 4000}, 2)};
  info.topics = {{"imu/data_raw", "sensor_msgs/msg/Imu", 24000, 1, 23999}};
  info.services = {{"pdr", "0.1.0", "finished", "step: {a: <1>}\n"}};
  return info;
}

/// The first thing wrong with the nesting of tags, or nothing.
std::string nesting_fault(const std::string& markup) {
  static const std::regex tag("<(/?)([A-Za-z0-9]+)[^>]*?(/?)>");
  std::vector<std::string> open;
  for (std::sregex_iterator it(markup.begin(), markup.end(), tag), end; it != end; ++it) {
    const std::string name = (*it)[2];
    if (name == "meta" || (*it)[3] == "/") continue;
    if ((*it)[1] != "/") {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return "</" + name + "> closes " + (open.empty() ? "nothing" : open.back());
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : open.back() + " stays open";
}

TEST(Report, ShowsEveryPartOfARun) {
  RunDirectory run = circle_run(60, 20);
  run.info = rich_info();
  const dataset::Recording recording = circle_truth(run);
  const std::string html = report_html(run, &recording);
  for (const char* title :
       {"Map", "Position error", "Heading", "Steps", "Latency", "Topics", "Services"}) {
    EXPECT_THAT(html, HasSubstr("<h2>" + std::string(title) + "</h2>"));
  }
  EXPECT_THAT(html, HasSubstr("IMU sample to fused pose"));
  EXPECT_THAT(html, HasSubstr("23999"));
  EXPECT_THAT(html, HasSubstr("step: {a: &lt;1&gt;}"));
  EXPECT_THAT(html, HasSubstr("truth inside the 95 % ellipse"));
  EXPECT_EQ(nesting_fault(html), "");
}

TEST(Report, LoadsNothingFromElsewhere) {
  RunDirectory run = circle_run(20, 20);
  run.info = rich_info();
  const dataset::Recording recording = circle_truth(run);
  const std::string html = report_html(run, &recording);
  for (const char* loader :
       {"<link", "<script", "<img", "<iframe", "src=", "href=", "@import", "@font-face"}) {
    EXPECT_THAT(html, Not(HasSubstr(loader)));
  }
  static const std::regex url("url\\((?!#)|https?://(?!www\\.w3\\.org/2000/svg\")");
  EXPECT_FALSE(std::regex_search(html, url));
  EXPECT_THAT(html, HasSubstr("prefers-color-scheme:dark"));
  EXPECT_THAT(html, HasSubstr("@media print"));
}

TEST(Report, AnHourStaysSmall) {
  RunDirectory run = circle_run(3600, 25);
  const dataset::Recording recording = circle_truth(run);
  EXPECT_LT(report_html(run, &recording).size(), 2'000'000U);
}

TEST(Report, SaysSoWhereThereIsNothingToDraw) {
  const std::string html = report_html(RunDirectory{}, nullptr);
  EXPECT_THAT(html, HasSubstr("no trajectory"));
  EXPECT_EQ(nesting_fault(html), "");
}

TEST(Report, NamesAreTextAndNeverMarkup) {
  const RunDirectory run = circle_run(5, 20);
  dataset::Recording recording = circle_truth(run);
  recording.name = "<script>alert(1)</script>";
  recording.report.notes = {"a & <b>"};
  const std::string html = report_html(run, &recording);
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, HasSubstr("a &amp; &lt;b&gt;"));
}

TEST(MapFigure, EllipsesLieAlongTheirCovariance) {
  // Variance 0.09 along north-east, 0.01 across: semi-axes sqrt(5.991 * 0.09) = 0.7343 m and
  // 0.2448 m, and north-east is 45 degrees anticlockwise, which SVG calls -45.
  RunDirectory run = circle_run(60, 5);
  for (auto& row : run.covariance) row.position_m2 << 0.05, 0.04, 0.04, 0.05;
  const auto svg = map_figure(make_scene(run, nullptr));
  ASSERT_TRUE(svg.has_value());
  const std::string text = svg->inline_element();
  static const std::regex ellipse("rx=\"([0-9.]+)\" ry=\"([0-9.]+)\"[^>]*rotate\\(([-0-9.]+)\\)");
  std::smatch match;
  ASSERT_TRUE(std::regex_search(text, match, ellipse));
  EXPECT_NEAR(std::stod(match[1]) / std::stod(match[2]), 3.0, 0.05);
  const double angle = std::stod(match[3]);
  EXPECT_NEAR(std::abs(std::remainder(angle + 45.0, 180.0)), 0.0, 0.1);
}

TEST(MapFigure, HasOneScaleForBothAxes) {
  RunDirectory run;
  for (int i = 0; i <= 10; ++i) {
    run.fused.push_back({i, {30.0 * i, 0.5 * i, 0.0}, Eigen::Quaterniond::Identity()});
  }
  const std::string text = map_figure(make_scene(run, nullptr))->inline_element();
  // The track rises 5 m on 300 m: on the drawing too.
  static const std::regex track("d=\"M([0-9.]+) ([0-9.]+)L([0-9.]+) ([0-9.]+)\" class=\"fused\"");
  std::smatch match;
  ASSERT_TRUE(std::regex_search(text, match, track));
  const double width = std::stod(match[3]) - std::stod(match[1]);
  const double height = std::stod(match[2]) - std::stod(match[4]);
  EXPECT_NEAR(height / width, 5.0 / 300.0, 3e-4);
}

TEST(WriteReport, FindsTheTruthThroughRunJson) {
  const testing::TemporaryFolder folder;
  folder.write("walk/imu0/data.csv",
               "#timestamp [ns],a_x,a_y,a_z\n0,0,0,9.8\n1000000000,0,0,9.8\n");
  folder.write("walk/waypoints.csv", "#timestamp [ns],x [m],y [m]\n0,5,5\n1000000000,6,5\n");
  RunWriter writer(folder.path() / "run", {});
  PoseEstimate pose;
  writer.add_fused(pose);
  pose.stamp_ns = kNsPerSecond;
  pose.position_m.x() = 3.0;
  writer.add_fused(pose);
  writer.finish({});
  RunInfo info;
  info.recording = folder.path() / "walk";
  write_run_info(folder.path() / "run", info);
  write_report(folder.path() / "run");
  const auto text_of = [](const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  };
  const std::string html = text_of(folder.path() / "run" / "report.html");
  EXPECT_THAT(html, HasSubstr("mean waypoint error</div><div class=\"value\">2.00<"));
  const std::string svg = text_of(folder.path() / "run" / "trajectory.svg");
  EXPECT_THAT(svg, ::testing::StartsWith("<?xml"));
  EXPECT_EQ(nesting_fault(svg.substr(svg.find('\n'))), "");
  EXPECT_THAT(svg, HasSubstr("waypoint 2 at 1.0 s, fused 2.00 m away"));
}

}  // namespace
}  // namespace vpdr::evaluation
