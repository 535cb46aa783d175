#pragma once
// A board that another DDS participant reads: a ROS 2 driver that publishes sensor_msgs/Imu and, if
// it has them, sensor_msgs/MagneticField, FluidPressure and Temperature.
#include <array>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "dds/subscription.hpp"
#include "imu_gateway/core/board_stream.hpp"
#include "imu_gateway/source/sample_source.hpp"

namespace vpdr::imu_gateway {

/// Topics by their ROS names, "/camera/imu"; empty: not read.
struct RosOptions {
  std::string imu_topic;
  std::string magnetometer_topic;
  std::string pressure_topic;
  std::string temperature_topic;
  /// Takes the stamps for a board's clock and maps it to the host's; false: stamps stay as they
  /// are.
  bool restamp = false;
  BoardAxes axes;
  std::function<TimestampNs()> host_clock;  ///< nanoseconds since the epoch
};

/// Reads each topic as its writer offers it, best effort or reliable. Writers may come and go.
/// Messages come in the middleware's thread, next() and health() are for one other thread.
class RosSource : public SampleSource {
 public:
  RosSource(dds::Participant& participant, RosOptions options);

  State next(Reading& out) override;
  [[nodiscard]] SourceHealth health() const override;

 private:
  struct Topic {
    std::string path;  ///< "rt/camera/imu"; empty: not read
    std::string type;
    bool reliable = true;
    std::unique_ptr<dds::RawSubscription> subscription;
  };
  struct Arrival {
    BoardReadings readings;
    TimestampNs arrival_ns = 0;
  };

  void follow_writers();
  void subscribe(Topic& topic, const dds::WriterInfo& writer);
  [[nodiscard]] dds::RawSubscription::Callback callback_of(const Topic& topic);
  template <class Message, class Sample, class Take>
  dds::RawSubscription::Callback callback(Take take);
  void push(const BoardReadings& readings, TimestampNs arrival_ns);

  dds::Participant& participant_;
  RosOptions options_;
  std::array<Topic, 4> topics_;
  std::chrono::steady_clock::time_point followed_at_;  ///< who writes was looked up then
  BoardStream stream_;
  std::vector<Reading> ready_;
  std::size_t next_ready_ = 0;

  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable came_;
  std::deque<Arrival> arrivals_;
  std::uint64_t unreadable_ = 0;
  std::uint64_t pushed_out_ = 0;
};

}  // namespace vpdr::imu_gateway
