#pragma once
// run.json: what was run and, where services ran, how their messages travelled. The side that knows
// fills it; the report shows it.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vpdr::evaluation {

/// One bar of a histogram: latencies in [lower_us, upper_us).
struct LatencyBin {
  double lower_us = 0.0;
  double upper_us = 0.0;
  std::uint64_t count = 0;
};

/// Latency of one path through the services, microseconds.
struct LatencyReport {
  std::string name;  ///< "IMU sample to fused pose"
  std::uint64_t count = 0;
  std::uint64_t lost = 0;  ///< samples that never arrived
  double p50_us = 0.0;
  double p99_us = 0.0;
  double p999_us = 0.0;
  double max_us = 0.0;
  std::vector<LatencyBin> histogram;  ///< logarithmic bins, rising
};

/// Percentiles (nearest rank) and a logarithmic histogram (eight bins a decade) of
/// latencies in microseconds; not finite and negative ones are left out.
LatencyReport summarize_latency(std::string name, std::vector<double> latencies_us,
                                std::uint64_t lost);

/// What the recorder counted of one topic.
struct TopicCount {
  std::string topic;
  std::string type;
  std::uint64_t received = 0;
  std::uint64_t lost = 0;
  std::uint64_t written = 0;
};

/// One service that took part.
struct ServiceInfo {
  std::string name;
  std::string version;
  std::string state;   ///< last state it reported, in words
  std::string config;  ///< its configuration in full, YAML; may be empty
};

/// run.json. All parts may be empty.
struct RunInfo {
  std::string title;                ///< "vpdr run", "five services over DDS", ...
  std::filesystem::path recording;  ///< absolute, so that the report finds the truth again
  std::vector<LatencyReport> latencies;
  std::vector<TopicCount> topics;
  std::vector<ServiceInfo> services;
};

/// Writes DIR/run.json; throws FileFault.
void write_run_info(const std::filesystem::path& folder, const RunInfo& info);

/// Reads DIR/run.json; an absent file is an empty RunInfo. Throws FileFault where it is no such
/// JSON.
RunInfo read_run_info(const std::filesystem::path& folder);

}  // namespace vpdr::evaluation
