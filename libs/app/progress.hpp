#pragma once
// Flow control of a played recording. pdr says up to which sensor stamp it is done; fusion and
// vision pass that on once they are done too; imu_gateway never runs further ahead of them than its
// window. So nothing is lost at any speed, and services on several hosts stay in step by sensor
// time alone.
#include <memory>
#include <optional>
#include <string>

#include "app/service.hpp"
#include "core/time.hpp"
#include "dds/convert.hpp"
#include "vpdr_msgs.h"

namespace vpdr::app {

/// Says how far this service is, at most once in 20 ms of sensor time. Used by one thread.
class ProgressReporter {
 public:
  explicit ProgressReporter(ServiceContext& context);
  /// Everything up to `stamp_ns` is processed and handed on.
  void done(TimestampNs stamp_ns);

 private:
  std::unique_ptr<dds::Publisher<vpdr_msgs::msg::Progress>> publisher_;
  vpdr_msgs::msg::Progress message_;
  std::optional<TimestampNs> last_ns_;
};

/// Calls `callback(stamp_ns)`, in the listener's thread, with each report of the named service.
template <class Callback>
auto subscribe_progress(ServiceContext& context, const std::string& service, Callback callback) {
  return context.subscribe(
      dds::topics::kProgress,
      [service, callback](const vpdr_msgs::msg::Progress& message, const dds::SampleInfo&) {
        if (message.service() == service) callback(dds::from_msg(message.header().stamp()));
      });
}

}  // namespace vpdr::app
