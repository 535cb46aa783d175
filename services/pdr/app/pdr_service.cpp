#include "pdr/app/pdr_service.hpp"

#include <cmath>
#include <iomanip>
#include <sstream>

#include "dds/convert.hpp"
#include "pdr/app/pdr_settings.hpp"

namespace vpdr::pdr {
namespace {

constexpr std::chrono::seconds kHandOverTimeout{5};

std::string with_digits(double value, int digits) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

void count_stream(app::Health& health, const std::string& name, const SampleGate& gate,
                  const dds::ReaderCounts& counts) {
  health.count(name + ".received", counts.received);
  health.count(name + ".lost", counts.lost);
  health.count(name + ".deadline_missed", counts.deadline_missed);
  health.count_refusals(name, gate);
}

}  // namespace

PdrService::PdrService(const PdrConfig& config, app::ServiceContext& context)
    : pdr_(config),
      attitude_publisher_(context.advertise(dds::topics::kAttitude)),
      step_publisher_(context.advertise(dds::topics::kStep)),
      heading_publisher_(context.advertise(dds::topics::kHeading)),
      odometry_publisher_(context.advertise(dds::topics::kPdrOdometry)),
      progress_(context) {
  calibration_subscription_ = context.subscribe_optional(
      dds::topics::kCalibration,
      [this](const vpdr_msgs::msg::Calibration& m, const dds::SampleInfo&) { take(m); });
  mag_subscription_ = context.subscribe_optional(
      dds::topics::kMag,
      [this](const sensor_msgs::msg::MagneticField& m, const dds::SampleInfo&) { take(m); });
  pressure_subscription_ = context.subscribe_optional(
      dds::topics::kPressure,
      [this](const sensor_msgs::msg::FluidPressure& m, const dds::SampleInfo&) { take(m); });
  imu_subscription_ = context.subscribe(
      dds::topics::kImuRaw,
      [this](const sensor_msgs::msg::Imu& m, const dds::SampleInfo&) { take(m); });
}

void PdrService::take(const vpdr_msgs::msg::Calibration& message) {
  calibration::BoardCalibration board;
  dds::from_msg(message, board);
  const std::lock_guard lock(mutex_);
  pdr_.expect_field(board.magnetometer.field_ut, board.magnetometer.dip_rad);
}

void PdrService::take(const sensor_msgs::msg::MagneticField& message) {
  const std::lock_guard lock(mutex_);
  dds::from_msg(message, mag_);
  pdr_.process(mag_);
}

void PdrService::take(const sensor_msgs::msg::FluidPressure& message) {
  const std::lock_guard lock(mutex_);
  dds::from_msg(message, pressure_);
  pdr_.process(pressure_);
}

void PdrService::take(const sensor_msgs::msg::Imu& message) {
  const std::lock_guard lock(mutex_);
  dds::from_msg(message, imu_);
  if (pdr_.process(imu_, output_) == Refusal::kNone) publish();
  progress_.done(imu_.stamp_ns);
}

void PdrService::publish() {
  if (output_.attitude) {
    dds::to_msg(*output_.attitude, attitude_message_);
    attitude_publisher_->publish(attitude_message_);
  }
  if (output_.step) {
    dds::to_msg(*output_.step, step_message_);
    step_publisher_->publish(step_message_);
  }
  if (output_.heading) {
    dds::to_msg(*output_.heading, heading_message_);
    heading_publisher_->publish(heading_message_);
  }
  if (output_.odometry) {
    dds::to_msg(*output_.odometry, dds::Frame::kOdom, odometry_message_);
    odometry_publisher_->publish(odometry_message_);
  }
}

void PdrService::report(app::Health& health) {
  const std::lock_guard lock(mutex_);
  count_stream(health, "imu", pdr_.imu_gate(), imu_subscription_->counts());
  count_stream(health, "mag", pdr_.mag_gate(), mag_subscription_->counts());
  health.count("mag.too_late", pdr_.attitude().dropped_fields());
  health.count("mag.outliers", pdr_.field().outliers());
  count_stream(health, "pressure", pdr_.pressure_gate(), pressure_subscription_->counts());
  health.count("steps", pdr_.step_count());
  health.note("walking", pdr_.walking() ? "true" : "false");
  report_height(health);
  if (imu_subscription_->counts().received > 0 && imu_subscription_->alive_count() == 0) {
    health.degrade("imu_gateway is silent", "start it again or look at the board's cable");
  }
}

void PdrService::report_height(app::Health& health) const {
  const BarometricHeight& height = pdr_.height();
  if (!height.known()) return;
  const FloorTracker& floors = height.floors();
  health.note("height_m", with_digits(height.height_m(imu_.stamp_ns), 2));
  health.note("height_sigma_m", with_digits(std::sqrt(height.variance_m2(imu_.stamp_ns)), 2));
  health.note("vertical", name_of(floors.state()));
  health.note("floor", std::to_string(floors.floor()));
  health.count("floor_changes", floors.changes());
}

void PdrService::close() {
  attitude_publisher_->wait_for_acknowledgments(kHandOverTimeout);
  step_publisher_->wait_for_acknowledgments(kHandOverTimeout);
  heading_publisher_->wait_for_acknowledgments(kHandOverTimeout);
  odometry_publisher_->wait_for_acknowledgments(kHandOverTimeout);
}

app::ServiceEntry service_entry() {
  auto config = std::make_shared<PdrConfig>();
  app::ServiceEntry entry;
  entry.name = "pdr";
  entry.summary = "Attitude, steps, walking direction and dead-reckoned position.";
  entry.bind = [config](config::Binder& binder) { bind(binder, *config); };
  entry.make = [config](app::ServiceContext& context) {
    return std::make_unique<PdrService>(*config, context);
  };
  return entry;
}

}  // namespace vpdr::pdr
