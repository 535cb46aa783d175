#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/errors.hpp"
#include "evaluation/run_info.hpp"
#include "tests/support/temporary_folder.hpp"

namespace vpdr::evaluation {
namespace {

std::vector<double> shuffled(int last) {
  std::vector<double> values;
  for (int i = 1; i <= last; ++i) values.push_back(i);
  std::shuffle(values.begin(), values.end(), std::mt19937(3));
  return values;
}

TEST(Latency, PercentilesAreNearestRank) {
  const LatencyReport report = summarize_latency("path", shuffled(1000), 4);
  EXPECT_EQ(report.count, 1000U);
  EXPECT_EQ(report.lost, 4U);
  EXPECT_DOUBLE_EQ(report.p50_us, 500.0);
  EXPECT_DOUBLE_EQ(report.p99_us, 990.0);
  EXPECT_DOUBLE_EQ(report.p999_us, 999.0);
  EXPECT_DOUBLE_EQ(report.max_us, 1000.0);
}

TEST(Latency, OneSampleIsEveryPercentile) {
  const LatencyReport report = summarize_latency("path", {42.0}, 0);
  EXPECT_DOUBLE_EQ(report.p50_us, 42.0);
  EXPECT_DOUBLE_EQ(report.p999_us, 42.0);
}

TEST(Latency, HistogramHoldsEverySampleInItsBin) {
  const LatencyReport report = summarize_latency("path", shuffled(1000), 0);
  std::uint64_t sum = 0;
  for (const LatencyBin& bin : report.histogram) {
    const double expected = std::ceil(bin.upper_us - 1e-9) - std::ceil(bin.lower_us - 1e-9);
    if (bin.upper_us <= 1000.0) {
      EXPECT_DOUBLE_EQ(static_cast<double>(bin.count), expected);
    }
    sum += bin.count;
  }
  EXPECT_EQ(sum, 1000U);
  EXPECT_NEAR(report.histogram.front().upper_us, std::pow(10.0, 0.125), 1e-12);
}

TEST(Latency, WhatIsNoLatencyIsLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(summarize_latency("path", {nan, -1.0, 5.0}, 0).count, 1U);
  const LatencyReport none = summarize_latency("path", {}, 9);
  EXPECT_EQ(none.count, 0U);
  EXPECT_TRUE(none.histogram.empty());
}

TEST(RunInfo, SurvivesTheDisk) {
  const testing::TemporaryFolder folder;
  RunInfo info;
  info.title = "five services";
  info.recording = "/data/walk 1";
  info.latencies = {summarize_latency("IMU sample to fused pose", {100.0, 200.0}, 1)};
  info.topics = {{"imu/data_raw", "sensor_msgs/Imu", 10, 1, 9}};
  info.services = {{"pdr", "0.1.0", "finished", "step:\n  min_interval_s: 0.3\n"}};
  write_run_info(folder.path(), info);
  const RunInfo read = read_run_info(folder.path());
  EXPECT_EQ(read.title, info.title);
  EXPECT_EQ(read.recording, info.recording);
  ASSERT_EQ(read.latencies.size(), 1U);
  EXPECT_DOUBLE_EQ(read.latencies[0].p50_us, 100.0);
  EXPECT_EQ(read.latencies[0].histogram.size(), 2U);
  ASSERT_EQ(read.topics.size(), 1U);
  EXPECT_EQ(read.topics[0].lost, 1U);
  ASSERT_EQ(read.services.size(), 1U);
  EXPECT_EQ(read.services[0].config, info.services[0].config);
}

TEST(RunInfo, AbsentIsEmptyAndWrongIsNamed) {
  const testing::TemporaryFolder folder;
  EXPECT_TRUE(read_run_info(folder.path()).topics.empty());
  folder.write("run.json", "{\"topics\": 3}");
  EXPECT_THROW(read_run_info(folder.path()), FileFault);
}

}  // namespace
}  // namespace vpdr::evaluation
