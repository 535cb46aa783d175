#include "imu_gateway/app/gateway_service.hpp"

#include <spdlog/spdlog.h>

#include "calibration_file/calibration_file.hpp"
#include "core/host_clock.hpp"
#include "dds/convert.hpp"

namespace vpdr::imu_gateway {
namespace {

constexpr std::chrono::seconds kHandOverTimeout{5};
constexpr TimestampNs kTemperatureSpacingNs = 100'000'000;

/// What the settings say of the board. A mount in the settings goes over the calibrated one.
calibration::BoardCalibration known_board(const GatewaySettings& settings) {
  if (settings.calibration.empty()) return {};
  calibration::BoardCalibration board = calibration::read_calibration(settings.calibration);
  if (!settings.mount.empty()) board.mount = {};
  return board;
}

StartupCheckConfig check_config(const GatewaySettings& settings) {
  StartupCheckConfig config;
  config.expected_rate_hz = settings.expected_rate_hz;
  return config;
}

}  // namespace

GatewayService::GatewayService(const GatewaySettings& settings, app::ServiceContext& context)
    : opened_(open_source(settings, context.participant())),
      board_(known_board(settings)),
      calibration_publisher_(context.participant(), dds::topics::kCalibration),
      imu_publisher_(context.advertise(dds::topics::kImuRaw)),
      playback_(context, settings.playback_rate, settings.playback_window_s),
      checks_(check_config(settings)) {
  if (!settings.calibration.empty()) correction_.emplace(board_, opened_.body_from_board);
  if (opened_.has_magnetometer) mag_publisher_ = context.advertise(dds::topics::kMag);
  if (opened_.has_pressure) pressure_publisher_ = context.advertise(dds::topics::kPressure);
  if (opened_.has_temperature) {
    // Not waited for: few read it, and each of its samples is like the one before.
    temperature_publisher_ = std::make_unique<dds::Publisher<sensor_msgs::msg::Temperature>>(
        context.participant(), dds::topics::kTemperature);
  }
  if (opened_.refused_rows > 0) {
    spdlog::warn("{} rows of the recording were refused; vpdr run lists them",
                 opened_.refused_rows);
  }
}

GatewayService::~GatewayService() { close(); }

void GatewayService::start() {
  publish_calibration();
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void GatewayService::publish_calibration() {
  calibration::BoardCalibration board = board_;
  board.mount.body_from_board = mount_of(board_, opened_.body_from_board);
  vpdr_msgs::msg::Calibration message;
  dds::to_msg(board, host_now_ns(), message);
  calibration_publisher_.publish(message);
}

void GatewayService::close() {
  if (!thread_.joinable()) return;
  thread_.request_stop();
  thread_.join();
}

void GatewayService::run(const std::stop_token& stop) {
  Reading reading;
  while (!stop.stop_requested()) {
    const SampleSource::State state = opened_.source->next(reading);
    if (!opened_.is_playback) {
      const std::lock_guard lock(mutex_);
      source_health_ = opened_.source->health();
    }
    if (state == SampleSource::State::kEnded) break;
    if (state == SampleSource::State::kIdle) continue;
    if (opened_.is_playback && !playback_.wait(stamp_of(reading), stop)) return;
    if (opened_.is_playback && playback_.out_of_sight(stamp_of(reading))) hand_over();
    publish(reading);
  }
  finish(stop);
}

void GatewayService::publish(Reading& reading) {
  const std::lock_guard lock(mutex_);
  if (auto* imu = std::get_if<ImuSample>(&reading)) {
    if (correction_) correction_->apply(*imu, source_health_.stream.temperature_c);
    publish_checked(*imu, imu_, imu_message_, imu_publisher_.get());
    publish_temperature(imu->stamp_ns);
  } else if (auto* mag = std::get_if<MagSample>(&reading)) {
    if (correction_) correction_->apply(*mag);
    publish_checked(*mag, mag_, mag_message_, mag_publisher_.get());
  } else {
    publish_checked(std::get<PressureSample>(reading), pressure_, pressure_message_,
                    pressure_publisher_.get());
  }
}

template <class Sample, class Message>
void GatewayService::publish_checked(const Sample& sample, StreamReport& stream, Message& message,
                                     dds::Publisher<Message>* publisher) {
  if (!stream.watch(sample) || publisher == nullptr) return;
  if constexpr (!std::is_same_v<Sample, PressureSample>) checks_.see(sample);
  dds::to_msg(sample, message);
  publisher->publish(message);
  if constexpr (std::is_same_v<Sample, ImuSample>) playback_.sent(sample.stamp_ns);
}

/// Temperatures creep: the latest one, ten times a second.
void GatewayService::publish_temperature(TimestampNs stamp_ns) {
  const auto celsius = source_health_.stream.temperature_c;
  if (!celsius || !temperature_publisher_) return;
  if (std::abs(stamp_ns - last_temperature_ns_) < kTemperatureSpacingNs) return;
  last_temperature_ns_ = stamp_ns;
  dds::to_msg(TimedValue{stamp_ns, *celsius}, temperature_message_);
  temperature_publisher_->publish(temperature_message_);
}

void GatewayService::finish(const std::stop_token& stop) {
  playback_.wait_done(stop);
  hand_over();
  ended_ = true;
}

void GatewayService::hand_over() {
  imu_publisher_->wait_for_acknowledgments(kHandOverTimeout);
  if (mag_publisher_) mag_publisher_->wait_for_acknowledgments(kHandOverTimeout);
  if (pressure_publisher_) pressure_publisher_->wait_for_acknowledgments(kHandOverTimeout);
}

void GatewayService::report(app::Health& health) {
  const std::lock_guard lock(mutex_);
  if (!source_health_.reason.empty()) {
    health.degrade(source_health_.reason, source_health_.remedy);
  }
  const bool live = !opened_.is_playback;
  imu_.report(live, health);
  mag_.report(live, health);
  pressure_.report(live, health);
  health.count("recording.refused_rows", opened_.refused_rows);
  if (live) report_source(source_health_, opened_.name, health);
  health.note("calibration", correction_ ? board_.board + " " + board_.serial : "none");
  report_findings(health);
  playback_.report(health);
}

void GatewayService::report_findings(app::Health& health) {
  const auto& findings = checks_.findings();
  for (const StartupFinding& finding : findings) {
    health.note(std::string("check.") + name_of(finding.fault), finding.what);
    health.degrade(finding.what, finding.remedy);
  }
  // The health's own reason is logged with it, but for the last report.
  for (; findings_logged_ < findings.size(); ++findings_logged_) {
    const StartupFinding& finding = findings[findings_logged_];
    if (ended_ || finding.what != health.reason)
      spdlog::warn("{}: {}", finding.what, finding.remedy);
  }
}

app::ServiceEntry service_entry() {
  // The settings live as long as the binder and the service refer to them: to the end of main.
  auto settings = std::make_shared<GatewaySettings>();
  app::ServiceEntry entry;
  entry.name = "imu_gateway";
  entry.summary =
      "Reads the sensor board (or plays a walk in its place) and publishes its samples.";
  entry.bind = [settings](config::Binder& binder) { bind(binder, *settings); };
  entry.shortcuts = {{"--recording", "recording", "folder of a recorded walk to play"},
                     {"--serial", "serial.device", "serial port of the board"},
                     {"--calibration", "calibration", "file of the board's calibration"},
                     {"--ros", "ros.imu", "topic of a ROS 2 driver's sensor_msgs/Imu"},
                     {"--rate", "playback.rate", "playback speed; 1 is real time, 0 the fastest"},
                     {"--seed", "simulation.seed", "seed of the simulated walk"},
                     {"--duration", "simulation.duration_s", "length of the simulated walk, s"}};
  entry.flags = {{"--simulate", "simulation.enabled", "play a simulated walk"}};
  entry.make = [settings](app::ServiceContext& context) {
    return std::make_unique<GatewayService>(*settings, context);
  };
  return entry;
}

}  // namespace vpdr::imu_gateway
