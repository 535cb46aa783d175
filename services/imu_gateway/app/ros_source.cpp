#include "imu_gateway/app/ros_source.hpp"

#include <utility>

#include "dds/convert.hpp"
#include "dds/serialize.hpp"
#include "sensor_msgs.h"

namespace vpdr::imu_gateway {
namespace {

constexpr std::chrono::milliseconds kWait{100};
/// Two seconds of the fastest board; more is a gateway that has stopped reading.
constexpr std::size_t kMostWaiting = 4000;

/// ROS 2 puts "rt" before the names of topics.
std::string path_of(const std::string& name) {
  if (name.empty() || name.starts_with("rt/")) return name;
  return (name.starts_with('/') ? "rt" : "rt/") + name;
}

}  // namespace

RosSource::RosSource(dds::Participant& participant, RosOptions options)
    : participant_(participant), options_(std::move(options)), stream_(options_.axes) {
  topics_[0].path = path_of(options_.imu_topic);
  topics_[0].type = "sensor_msgs/msg/Imu";
  topics_[1].path = path_of(options_.magnetometer_topic);
  topics_[1].type = "sensor_msgs/msg/MagneticField";
  topics_[2].path = path_of(options_.pressure_topic);
  topics_[2].type = "sensor_msgs/msg/FluidPressure";
  topics_[3].path = path_of(options_.temperature_topic);
  topics_[3].type = "sensor_msgs/msg/Temperature";
}

void RosSource::push(const BoardReadings& readings, TimestampNs arrival_ns) {
  const std::lock_guard lock(mutex_);
  if (arrivals_.size() == kMostWaiting) {
    arrivals_.pop_front();
    ++pushed_out_;
  }
  arrivals_.push_back({readings, arrival_ns});
  came_.notify_one();
}

template <class Message, class Sample, class Take>
dds::RawSubscription::Callback RosSource::callback(Take take) {
  return [this, take, message = std::make_shared<Message>()](std::span<const std::byte> payload,
                                                             const dds::SampleInfo&) {
    const TimestampNs arrival_ns = options_.host_clock();
    if (!dds::deserialize(payload, *message)) {
      const std::lock_guard lock(mutex_);
      ++unreadable_;
      return;
    }
    Sample sample;
    dds::from_msg(*message, sample);
    BoardReadings readings;
    // A driver that has no clock leaves the stamp at zero.
    if (sample.stamp_ns != 0) readings.board_stamp_ns = sample.stamp_ns;
    take(sample, readings);
    push(readings, arrival_ns);
  };
}

dds::RawSubscription::Callback RosSource::callback_of(const Topic& topic) {
  if (&topic == &topics_[0]) {
    return callback<sensor_msgs::msg::Imu, ImuSample>([](const ImuSample& s, BoardReadings& out) {
      out.specific_force_mps2 = s.specific_force_mps2;
      if (s.has_angular_velocity) out.angular_velocity_radps = s.angular_velocity_radps;
    });
  }
  if (&topic == &topics_[1]) {
    return callback<sensor_msgs::msg::MagneticField, MagSample>(
        [](const MagSample& s, BoardReadings& out) { out.field_ut = s.field_ut; });
  }
  if (&topic == &topics_[2]) {
    return callback<sensor_msgs::msg::FluidPressure, PressureSample>(
        [](const PressureSample& s, BoardReadings& out) { out.pressure_pa = s.pressure_pa; });
  }
  return callback<sensor_msgs::msg::Temperature, TimedValue>(
      [](const TimedValue& s, BoardReadings& out) { out.temperature_c = s.value; });
}

void RosSource::subscribe(Topic& topic, const dds::WriterInfo& writer) {
  topic.reliable = writer.reliable;
  topic.subscription.reset();
  topic.subscription =
      std::make_unique<dds::RawSubscription>(participant_, writer, callback_of(topic));
}

/// A driver of one sensor may come long after that of another.
void RosSource::follow_writers() {
  const auto now = std::chrono::steady_clock::now();
  if (now - followed_at_ < kWait) return;
  followed_at_ = now;
  for (const auto& event : participant_.take_writer_events(std::chrono::milliseconds(0))) {
    if (!event.appeared) continue;
    for (Topic& topic : topics_) {
      if (topic.path != event.writer.topic || topic.type != event.writer.type) continue;
      // A best-effort reader hears every writer, a reliable one only those that are.
      const bool hears = topic.subscription && (!topic.reliable || event.writer.reliable);
      if (!hears) subscribe(topic, event.writer);
    }
  }
}

SampleSource::State RosSource::next(Reading& out) {
  if (next_ready_ == ready_.size()) {
    ready_.clear();
    next_ready_ = 0;
    std::deque<Arrival> arrivals;
    {
      std::unique_lock lock(mutex_);
      came_.wait_for(lock, kWait, [this] { return !arrivals_.empty(); });
      arrivals.swap(arrivals_);
    }
    follow_writers();
    for (const Arrival& arrival : arrivals) {
      if (options_.restamp || !arrival.readings.board_stamp_ns) {
        stream_.accept(arrival.readings, arrival.arrival_ns, ready_);
      } else {
        stream_.accept_as_stamped(arrival.readings, ready_);
      }
    }
  }
  if (next_ready_ == ready_.size()) return State::kIdle;
  out = ready_[next_ready_++];
  return State::kReading;
}

SourceHealth RosSource::health() const {
  SourceHealth health;
  const Topic& imu = topics_[0];
  health.connected = imu.subscription && imu.subscription->matched_count() > 0;
  if (!health.connected) {
    health.reason = "nobody writes " + imu.type + " on " + imu.path;
    health.remedy = "is the driver running, in this domain and on these interfaces?";
  }
  for (const Topic& topic : topics_) {
    if (topic.subscription) health.parser.lost += topic.subscription->counts().lost;
  }
  health.stream = stream_.health();
  const std::lock_guard lock(mutex_);
  health.parser.malformed = unreadable_;
  health.parser.lost += pushed_out_;
  return health;
}

}  // namespace vpdr::imu_gateway
