#include "vpdr/walk_watch.hpp"

#include "dds/convert.hpp"
#include "dds/topics.hpp"

namespace vpdr::tool {
namespace {

app::Health health_of(const diagnostic_msgs::msg::DiagnosticStatus& status) {
  app::Health health;
  for (const auto& value : status.values()) {
    if (value.key() == "reason") health.reason = value.value();
    if (value.key() == "remedy") health.remedy = value.value();
    if (value.key() != "state") continue;
    for (const auto state : {app::ServiceState::kWaiting, app::ServiceState::kDegraded,
                             app::ServiceState::kFinished}) {
      if (value.value() == app::name_of(state)) health.state = state;
    }
  }
  return health;
}

}  // namespace

WalkWatch::WalkWatch(const dds::ParticipantOptions& options, TimestampNs begin_ns,
                     TimestampNs end_ns)
    : begin_ns_(begin_ns),
      end_ns_(end_ns),
      bar_("walking"),
      participant_(options),
      progress_(participant_, dds::topics::kProgress,
                [this](const vpdr_msgs::msg::Progress& message, const dds::SampleInfo&) {
                  if (message.service() == "fusion") {
                    stamp_ns_ = dds::from_msg(message.header().stamp());
                  }
                  began_ = true;
                }),
      diagnostics_(participant_, dds::topics::kDiagnostics,
                   [this](const diagnostic_msgs::msg::DiagnosticArray& message,
                          const dds::SampleInfo&) { hear(message); }) {}

void WalkWatch::hear(const diagnostic_msgs::msg::DiagnosticArray& message) {
  const std::lock_guard lock(mutex_);
  for (const auto& status : message.status()) {
    const auto line = troubles_[status.name()].see(health_of(status));
    if (line) lines_.push_back(status.name() + ": " + line->text);
  }
}

bool WalkWatch::draw() {
  {
    const std::lock_guard lock(mutex_);
    for (const std::string& line : lines_) bar_.say(line);
    lines_.clear();
  }
  const TimestampNs length = end_ns_ - begin_ns_;
  const TimestampNs done = stamp_ns_ - begin_ns_;
  if (length > 0 && stamp_ns_ != 0) {
    bar_.update(static_cast<double>(done) / static_cast<double>(length));
  } else if (end_ns_ == 0 && began_ && !told_) {
    bar_.say("walking; vpdr listen shows the pose, vpdr monitor imu the sensors, Ctrl-C ends it");
    told_ = true;
  }
  return began_;
}

}  // namespace vpdr::tool
