#include "app/service.hpp"

#include <algorithm>

#include "app/consumers.hpp"

namespace vpdr::app {

ServiceContext::ServiceContext(dds::Participant& participant, const CommonSettings& common)
    : participant_(participant), common_(common) {}

bool ServiceContext::waits_for(const std::string& service) const {
  const auto& names = common_.wait_for;
  return std::find(names.begin(), names.end(), service) != names.end();
}

std::size_t ServiceContext::waited_readers_of(const dds::TopicInfo& topic) const {
  const auto readers = readers_of(topic.name);
  return static_cast<std::size_t>(
      std::count_if(readers.begin(), readers.end(), [this](std::string_view reader) {
        return reader != participant_.options().service && waits_for(std::string(reader));
      }));
}

bool ServiceContext::matched() const {
  return std::all_of(requirements_.begin(), requirements_.end(),
                     [](const auto& requirement) { return requirement(); });
}

void ServiceContext::request_stop(ExitCode code, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  if (!stop_) stop_ = StopRequest{code, reason};
}

std::optional<ServiceContext::StopRequest> ServiceContext::stop_request() const {
  const std::lock_guard lock(mutex_);
  return stop_;
}

}  // namespace vpdr::app
