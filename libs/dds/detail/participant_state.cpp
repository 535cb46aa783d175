#include "dds/detail/participant_state.hpp"

#include <fastrtps/xmlparser/XMLProfileManager.h>

#include <algorithm>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <utility>

#include "core/errors.hpp"
#include "core/host_clock.hpp"
#include "dds/detail/envelope.hpp"
#include "dds/detail/interfaces.hpp"
#include "dds/schema.hpp"

namespace vpdr::dds::detail {
namespace {

constexpr std::size_t kProblemsKept = 64;
constexpr std::uint32_t kHighestDomain = 232;  // its ports would not fit in 16 bits beyond

void check(const ParticipantOptions& options) {
  if (!is_walker_name(options.walker)) {
    throw DdsFault("walker '" + options.walker +
                   "': must be letters, digits and '_', a letter first, at most 100");
  }
  if (options.domain > kHighestDomain) {
    throw DdsFault("DDS domain " + std::to_string(options.domain) + ": must be 0 to 232");
  }
}

/// One way for samples, whether the reader is in this process or on another host.
void switch_off_intraprocess_delivery() {
  using eprosima::fastrtps::xmlparser::XMLProfileManager;
  static std::once_flag once;
  std::call_once(once, [] {
    auto settings = XMLProfileManager::library_settings();
    settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
    XMLProfileManager::library_settings(settings);
  });
}

}  // namespace

Guid to_guid(const eprosima::fastrtps::rtps::GUID_t& guid) {
  Guid bytes{};
  std::copy_n(guid.guidPrefix.value, 12, bytes.begin());
  std::copy_n(guid.entityId.value, 4, bytes.begin() + 12);
  return bytes;
}

ParticipantState::ParticipantState(const ParticipantOptions& options) : options_(options) {
  check(options);
  identity_ = {std::string(idl_hash()), host_now_ns(), options.service, options.walker};
  const auto qos =
      participant_qos(options, addresses_of(options.interfaces), to_user_data(identity_));
  switch_off_intraprocess_delivery();
  auto* factory = fast::DomainParticipantFactory::get_instance();
  // For discovery only (mask none): samples and statuses go to the endpoints' own listeners.
  participant_ = factory->create_participant(options.domain, qos, this, fast::StatusMask::none());
  if (participant_ == nullptr) {
    throw DdsFault("no DDS participant in domain " + std::to_string(options.domain) +
                   ": are its UDP ports free and the interfaces up?");
  }
  publisher_ = participant_->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
  subscriber_ = participant_->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
  if (publisher_ == nullptr || subscriber_ == nullptr) {
    factory->delete_participant(participant_);
    throw DdsFault("no DDS publisher or subscriber in domain " + std::to_string(options.domain));
  }
}

ParticipantState::~ParticipantState() {
  participant_->set_listener(nullptr);
  participant_->delete_contained_entities();
  fast::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

fast::Topic& ParticipantState::topic(const std::string& path, const std::string& ros_type) {
  const std::lock_guard lock(topics_mutex_);
  const std::string wire = wire_type_name(ros_type);
  if (const auto known = topics_.find(path); known != topics_.end()) {
    if (known->second->get_type_name() == wire) return *known->second;
    throw DdsFault("topic " + path + " is in use as " +
                   ros_type_name(known->second->get_type_name()) + ", not as " + ros_type);
  }
  if (participant_->find_type(wire).empty()) {
    fast::TypeSupport(new EnvelopeType(wire)).register_type(participant_);
  }
  auto* made = participant_->create_topic(path, wire, fast::TOPIC_QOS_DEFAULT);
  if (made == nullptr) throw DdsFault("topic " + path + " of type " + ros_type + " was refused");
  topics_.emplace(path, made);
  const std::lock_guard state_lock(mutex_);
  own_types_.emplace(path, ros_type);
  return *made;
}

void ParticipantState::report(const Problem& problem) {
  {
    const std::lock_guard lock(mutex_);
    if (problems_.size() == kProblemsKept) problems_.pop_front();
    problems_.push_back(problem);
  }
  if (options_.on_problem) options_.on_problem(problem);
}

std::vector<Problem> ParticipantState::take_problems() {
  const std::lock_guard lock(mutex_);
  std::vector<Problem> taken(problems_.begin(), problems_.end());
  problems_.clear();
  return taken;
}

bool ParticipantState::wait_for_duplicate(std::chrono::milliseconds timeout) const {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, timeout, [this] { return duplicate_.load(); });
}

std::vector<RemoteParticipant> ParticipantState::remote_participants() const {
  const std::lock_guard lock(mutex_);
  std::vector<RemoteParticipant> list;
  for (const auto& [guid, peer] : peers_) list.push_back(peer);
  return list;
}

bool ParticipantState::wait_for_service(const std::string& service,
                                        std::chrono::milliseconds timeout) const {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, timeout, [&] {
    return std::any_of(peers_.begin(), peers_.end(), [&](const auto& entry) {
      return entry.second.walker == options_.walker && entry.second.service == service;
    });
  });
}

bool ParticipantState::wait_for_participants(std::size_t count,
                                             std::chrono::milliseconds timeout) const {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, timeout, [&] { return peers_.size() >= count; });
}

std::vector<WriterInfo> ParticipantState::writers() const {
  const std::lock_guard lock(mutex_);
  std::vector<WriterInfo> list;
  for (const auto& [guid, writer] : writers_) list.push_back(writer);
  return list;
}

std::vector<WriterEvent> ParticipantState::take_writer_events(std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  if (!std::exchange(events_wanted_, true)) {
    for (const auto& [guid, writer] : writers_) events_.push_back({true, writer});
  }
  changed_.wait_for(lock, timeout, [this] { return !events_.empty(); });
  std::vector<WriterEvent> taken(events_.begin(), events_.end());
  events_.clear();
  return taken;
}

}  // namespace vpdr::dds::detail
