#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>
#include <sstream>
#include <string_view>

#include "core/rotation.hpp"
#include "evaluation/figures.hpp"
#include "evaluation/report.hpp"
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
  std::vector<std::string> open;
  for (auto at = markup.find('<'); at != markup.npos; at = markup.find('<', at + 1)) {
    const auto end = markup.find('>', at);
    if (end == markup.npos) return "a tag has no end";
    const bool closes = markup[at + 1] == '/';
    const auto begin = at + (closes ? 2 : 1);
    const std::string name = markup.substr(begin, markup.find_first_of(" />\n", begin) - begin);
    if (name.starts_with('!') || name == "meta" || markup[end - 1] == '/') continue;
    if (!closes) {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return "</" + name + "> closes " + (open.empty() ? "nothing" : open.back());
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : open.back() + " stays open";
}

/// The text that follows each place where `mark` stands.
std::vector<std::string> after_each(const std::string& text, std::string_view mark) {
  std::vector<std::string> found;
  for (auto at = text.find(mark); at != text.npos; at = text.find(mark, at + 1)) {
    found.push_back(text.substr(at + mark.size(), 100));
  }
  return found;
}

/// The first path that has `css_class`.
std::string path_of_class(const std::string& svg, const std::string& css_class) {
  for (auto at = svg.find("<path"); at != svg.npos; at = svg.find("<path", at + 1)) {
    const std::string element = svg.substr(at, svg.find('>', at) - at + 1);
    if (element.find("class=\"" + css_class + "\"") != element.npos) return element;
  }
  return {};
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
  for (const std::string& url : after_each(html, "url(")) EXPECT_EQ(url.front(), '#');
  for (const std::string& place : after_each(html, "://")) {
    EXPECT_THAT(place, ::testing::StartsWith("www.w3.org/2000/svg\""));  // a name, not a place
  }
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
  double radius_1 = 0.0;
  double radius_2 = 0.0;
  double angle = 0.0;
  const auto ellipses = after_each(svg->inline_element(), "<ellipse");
  ASSERT_FALSE(ellipses.empty());
  ASSERT_EQ(std::sscanf(ellipses.back().c_str(),
                        " rx=\"%lf\" ry=\"%lf\" transform=\"translate(%*f %*f) rotate(%lf",
                        &radius_1, &radius_2, &angle),
            3);
  EXPECT_NEAR(radius_1 / radius_2, 3.0, 0.05);
  EXPECT_NEAR(std::abs(std::remainder(angle + 45.0, 180.0)), 0.0, 0.1);
}

TEST(MapFigure, HasOneScaleForBothAxes) {
  RunDirectory run;
  for (int i = 0; i <= 10; ++i) {
    run.fused.push_back({i, {30.0 * i, 0.5 * i, 0.0}, Eigen::Quaterniond::Identity()});
  }
  const std::string text = map_figure(make_scene(run, nullptr))->inline_element();
  // The track rises 5 m on 300 m: on the drawing too.
  Point from;
  Point to;
  ASSERT_EQ(std::sscanf(path_of_class(text, "fused").c_str(), "<path d=\"M%lf %lfL%lf %lf\"",
                        &from.x, &from.y, &to.x, &to.y),
            4);
  EXPECT_NEAR((from.y - to.y) / (to.x - from.x), 5.0 / 300.0, 3e-4);
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
