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
  const auto reads = [&](const std::string& name) {
    if (name == participant_.options().service) return false;
    // A name that is none of vpdr's is a program of the user's, which reads all that is published.
    return !is_service(name) || std::find(readers.begin(), readers.end(), name) != readers.end();
  };
  const auto& waited = common_.wait_for;
  return static_cast<std::size_t>(std::count_if(waited.begin(), waited.end(), reads));
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
