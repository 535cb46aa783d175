#include "app/progress.hpp"

#include "dds/convert.hpp"

namespace vpdr::app {
namespace {

constexpr TimestampNs kSpacingNs = 20'000'000;

}  // namespace

ProgressReporter::ProgressReporter(ServiceContext& context)
    : publisher_(context.advertise(dds::topics::kProgress)) {
  message_.service(context.participant().options().service);
}

void ProgressReporter::done(TimestampNs stamp_ns) {
  if (last_ns_ && stamp_ns >= *last_ns_ && stamp_ns - *last_ns_ < kSpacingNs) return;
  last_ns_ = stamp_ns;
  dds::to_msg(stamp_ns, message_.header().stamp());
  publisher_->publish(message_);
}

}  // namespace vpdr::app
