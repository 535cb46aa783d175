// vpdr monitor imu: rate, jitter, loss, temperature, and the lengths of force and field.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <condition_variable>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "app/health.hpp"
#include "core/errors.hpp"
#include "dds/convert.hpp"
#include "dds/subscription.hpp"
#include "diagnostic_msgs.h"
#include "sensor_msgs.h"
#include "vpdr/board/stream_statistics.hpp"
#include "vpdr/commands/commands.hpp"
#include "vpdr/network.hpp"

namespace vpdr::tool {
namespace {

struct MonitorOptions {
  NetworkOptions network;
  double period_s = 1.0;
  double timeout_s = 10.0;
  bool once = false;
  bool json = false;
};

/// What is shown of one period.
struct View {
  StreamFigures imu;
  StreamFigures mag;
  StreamFigures pressure;
  std::string state;              ///< of the gateway, with its reason and remedy
  std::optional<double> celsius;  ///< nullopt: the board does not tell
};

/// Gathers the gateway's topics.
class GatewayWatch {
 public:
  explicit GatewayWatch(dds::Participant& participant)
      : imu_topic_(participant, dds::topics::kImuRaw,
                   [this](const sensor_msgs::msg::Imu& message, const dds::SampleInfo& info) {
                     ImuSample sample;
                     dds::from_msg(message, sample);
                     add(imu_, sample.stamp_ns, info, sample.specific_force_mps2.norm());
                   }),
        mag_topic_(
            participant, dds::topics::kMag,
            [this](const sensor_msgs::msg::MagneticField& message, const dds::SampleInfo& info) {
              MagSample sample;
              dds::from_msg(message, sample);
              add(mag_, sample.stamp_ns, info, sample.field_ut.norm());
            }),
        pressure_topic_(
            participant, dds::topics::kPressure,
            [this](const sensor_msgs::msg::FluidPressure& message, const dds::SampleInfo& info) {
              PressureSample sample;
              dds::from_msg(message, sample);
              add(pressure_, sample.stamp_ns, info, sample.pressure_pa);
            }),
        temperature_topic_(
            participant, dds::topics::kTemperature,
            [this](const sensor_msgs::msg::Temperature& message, const dds::SampleInfo&) {
              const std::lock_guard lock(mutex_);
              celsius_ = message.temperature();
            }),
        diagnostics_topic_(participant, dds::topics::kDiagnostics,
                           [this](const diagnostic_msgs::msg::DiagnosticArray& message,
                                  const dds::SampleInfo&) { hear(message); }) {}

  /// Waits for the first sample, or until the gateway says why there is none, then for a period;
  /// nullopt where neither comes in time.
  std::optional<View> wait(std::chrono::duration<double> timeout,
                           std::chrono::duration<double> period) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, timeout, [this] { return samples_ > 0 || degraded_; });
    if (samples_ == 0 && !heard_) return std::nullopt;
    changed_.wait_for(lock, period, [] { return false; });
    samples_ = 0;
    heard_ = degraded_ = false;
    return View{imu_.take(), mag_.take(), pressure_.take(), state_, celsius_};
  }

 private:
  void add(StreamStatistics& stream, TimestampNs stamp_ns, const dds::SampleInfo& info,
           double length) {
    const std::lock_guard lock(mutex_);
    stream.add(stamp_ns, info.reception_timestamp_ns, info.lost_before, length);
    ++samples_;
    changed_.notify_all();
  }

  void hear(const diagnostic_msgs::msg::DiagnosticArray& message) {
    const std::lock_guard lock(mutex_);
    for (const auto& status : message.status()) {
      if (status.name() != "imu_gateway") continue;
      state_ = status.message();
      heard_ = true;
      degraded_ = state_.starts_with(app::name_of(app::ServiceState::kDegraded));
      changed_.notify_all();
      for (const auto& value : status.values()) {
        if (value.key() == "remedy" && !value.value().empty()) state_ += "; " + value.value();
      }
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t samples_ = 0;
  bool heard_ = false;     ///< the gateway, since the last view
  bool degraded_ = false;  ///< and something is wrong with it
  StreamStatistics imu_;
  StreamStatistics mag_;
  StreamStatistics pressure_;
  std::string state_ = "not heard yet";
  std::optional<double> celsius_;
  dds::Subscription<sensor_msgs::msg::Imu> imu_topic_;
  dds::Subscription<sensor_msgs::msg::MagneticField> mag_topic_;
  dds::Subscription<sensor_msgs::msg::FluidPressure> pressure_topic_;
  dds::Subscription<sensor_msgs::msg::Temperature> temperature_topic_;
  dds::Subscription<diagnostic_msgs::msg::DiagnosticArray> diagnostics_topic_;
};

nlohmann::json json_of(const StreamFigures& f) {
  return {{"samples", f.samples},
          {"rate_hz", f.rate_hz},
          {"stamp_jitter_ms", f.stamp_jitter_ms},
          {"arrival_jitter_ms", f.arrival_jitter_ms},
          {"longest_gap_ms", f.longest_gap_ms},
          {"lost", f.lost},
          {"mean", f.length_mean},
          {"sigma", f.length_sigma}};
}

void print_json(const View& view) {
  nlohmann::json out{{"imu", json_of(view.imu)},
                     {"mag", json_of(view.mag)},
                     {"pressure", json_of(view.pressure)},
                     {"gateway", view.state}};
  if (view.celsius) out["temperature_c"] = *view.celsius;
  std::cout << out.dump() << std::endl;
}

std::string line_of(const char* name, const StreamFigures& f, const char* unit, int decimals) {
  std::ostringstream text;
  text << std::left << std::setw(9) << name << std::right << std::fixed;
  if (f.samples == 0) {
    text << "none";
    return text.str();
  }
  text << std::setprecision(1) << std::setw(7) << f.rate_hz << " Hz   jitter "
       << std::setprecision(2) << std::setw(6) << f.stamp_jitter_ms << " ms, on arrival "
       << std::setw(6) << f.arrival_jitter_ms << " ms   longest gap " << std::setprecision(1)
       << std::setw(6) << f.longest_gap_ms << " ms   lost " << f.lost << "   "
       << std::setprecision(decimals) << f.length_mean << " +- " << f.length_sigma << " " << unit;
  return text.str();
}

void print_text(const View& view, bool again) {
  constexpr int kLines = 4;
  if (again) std::cout << "\033[" << kLines << "A";
  std::ostringstream celsius;
  if (view.celsius) celsius << std::fixed << std::setprecision(2) << "   " << *view.celsius << " C";
  for (const std::string& line :
       {line_of("imu", view.imu, "m/s^2", 3) + celsius.str(), line_of("mag", view.mag, "uT", 2),
        line_of("pressure", view.pressure, "Pa", 1), "gateway  " + view.state}) {
    std::cout << line << (again ? "\033[K" : "") << "\n";
  }
  std::cout << std::flush;
}

void monitor(const MonitorOptions& options) {
  dds::Participant participant(participant_options(options.network, "vpdr_monitor"));
  GatewayWatch watch(participant);
  const bool refresh = isatty(STDOUT_FILENO) == 1;
  for (bool first = true;; first = false) {
    const auto view = watch.wait(std::chrono::duration<double>(options.timeout_s),
                                 std::chrono::duration<double>(options.period_s));
    if (!view) {
      throw DdsFault("no samples of walker " + participant.options().walker + " in domain " +
                     std::to_string(participant.options().domain) + "; is imu_gateway running?");
    }
    if (options.json) {
      print_json(*view);
    } else {
      print_text(*view, refresh && !first);
    }
    if (options.once) return;
  }
}

}  // namespace

void add_monitor_imu(CLI::App& parent) {
  auto options = std::make_shared<MonitorOptions>();
  CLI::App* command = parent.add_subcommand(
      "imu", "Rate, jitter, loss, temperature, and the lengths of force and field.");
  add_network_options(*command, options->network);
  command->add_option("--period", options->period_s, "time between two views, s")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->add_option("--timeout", options->timeout_s, "leave after so long a silence, s")
      ->capture_default_str();
  command->add_flag("--once", options->once, "one view, then leave");
  command->add_flag("--json", options->json, "a line of JSON for each view");
  command->callback([options] { monitor(*options); });
}

}  // namespace vpdr::tool
