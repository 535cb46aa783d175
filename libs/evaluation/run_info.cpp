#include "evaluation/run_info.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "dataset/text_file.hpp"
#include "evaluation/output_file.hpp"

namespace vpdr::evaluation {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(LatencyBin, lower_us, upper_us, count)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(LatencyReport, name, count, lost, p50_us, p99_us,
                                                p999_us, max_us, histogram)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(TopicCount, topic, type, received, lost, written)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(ServiceInfo, name, version, state, config)

namespace {

using Json = nlohmann::json;

constexpr double kBinsPerDecade = 8.0;
constexpr const char* kFileName = "run.json";

double nearest_rank(const std::vector<double>& sorted, double fraction) {
  if (sorted.empty()) return 0.0;
  const double rank = std::ceil(fraction * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

double bin_edge(int bin) { return std::pow(10.0, bin / kBinsPerDecade); }

std::vector<LatencyBin> logarithmic_histogram(const std::vector<double>& sorted) {
  std::vector<LatencyBin> bins;
  for (const double value : sorted) {
    const int bin =
        static_cast<int>(std::floor(std::log10(std::max(value, 1e-3)) * kBinsPerDecade));
    const double lower = bin_edge(bin);
    if (bins.empty() || bins.back().lower_us < lower) bins.push_back({lower, bin_edge(bin + 1), 0});
    ++bins.back().count;
  }
  return bins;
}

}  // namespace

LatencyReport summarize_latency(std::string name, std::vector<double> latencies_us,
                                std::uint64_t lost) {
  std::erase_if(latencies_us, [](double v) { return !std::isfinite(v) || v < 0.0; });
  std::sort(latencies_us.begin(), latencies_us.end());
  LatencyReport report;
  report.name = std::move(name);
  report.count = latencies_us.size();
  report.lost = lost;
  report.p50_us = nearest_rank(latencies_us, 0.5);
  report.p99_us = nearest_rank(latencies_us, 0.99);
  report.p999_us = nearest_rank(latencies_us, 0.999);
  report.max_us = latencies_us.empty() ? 0.0 : latencies_us.back();
  report.histogram = logarithmic_histogram(latencies_us);
  return report;
}

void write_run_info(const std::filesystem::path& folder, const RunInfo& info) {
  const Json json = {{"title", info.title},
                     {"recording", info.recording.string()},
                     {"latencies", info.latencies},
                     {"topics", info.topics},
                     {"services", info.services}};
  OutputFile file(folder / kFileName);
  file.write(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  file.close();
}

RunInfo read_run_info(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kFileName;
  RunInfo info;
  if (!std::filesystem::exists(path)) return info;
  try {
    const Json json = Json::parse(dataset::read_text_file(path).text);
    info.title = json.value("title", "");
    info.recording = json.value("recording", "");
    info.latencies = json.value("latencies", std::vector<LatencyReport>{});
    info.topics = json.value("topics", std::vector<TopicCount>{});
    info.services = json.value("services", std::vector<ServiceInfo>{});
  } catch (const Json::exception& error) {
    throw dataset::fault_at(path, 0, 0, error.what(), "run again, or remove the file");
  }
  return info;
}

}  // namespace vpdr::evaluation
