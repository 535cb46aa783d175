#include "app/peer_watch.hpp"

#include <algorithm>
#include <array>

#include "diagnostic_msgs.h"

namespace vpdr::app {
namespace {

std::optional<ServiceState> state_named(const std::string& name) {
  static constexpr std::array<ServiceState, 4> kStates{
      ServiceState::kWaiting, ServiceState::kRunning, ServiceState::kDegraded,
      ServiceState::kFinished};
  for (const ServiceState state : kStates) {
    if (name == name_of(state)) return state;
  }
  return std::nullopt;
}

/// The last four bytes tell the endpoints of a participant apart.
bool of_one_participant(const dds::Guid& a, const dds::Guid& b) {
  return std::equal(a.begin(), a.begin() + 12, b.begin());
}

}  // namespace

PeerWatch::PeerWatch(dds::Participant& participant) : participant_(participant) {
  subscription_ = std::make_unique<dds::Subscription<diagnostic_msgs::msg::DiagnosticArray>>(
      participant, dds::topics::kDiagnostics,
      [this](const diagnostic_msgs::msg::DiagnosticArray& message, const dds::SampleInfo& info) {
        take(message, info.writer);
      });
}

void PeerWatch::take(const diagnostic_msgs::msg::DiagnosticArray& message,
                     const dds::Guid& writer) {
  const std::lock_guard lock(mutex_);
  for (const auto& status : message.status()) {
    if (status.name() == participant_.options().service) continue;
    if (spoken_for(status.name(), writer)) continue;
    for (const auto& value : status.values()) {
      if (value.key() != "state") continue;
      if (const auto state = state_named(value.value())) reports_[status.name()] = {writer, *state};
    }
  }
}

bool PeerWatch::spoken_for(const std::string& service, const dds::Guid& writer) const {
  const auto known = reports_.find(service);
  if (known == reports_.end()) return false;
  const dds::Guid& first = known->second.writer;
  if (of_one_participant(first, writer)) return false;
  const auto peers = participant_.remote_participants();
  return std::any_of(peers.begin(), peers.end(),
                     [&](const auto& peer) { return of_one_participant(peer.guid, first); });
}

void PeerWatch::refresh() {
  const auto participants = participant_.remote_participants();
  const std::lock_guard lock(mutex_);
  for (auto& [service, present] : present_) present = false;
  for (const auto& peer : participants) {
    if (peer.walker != participant_.options().walker || peer.service.empty()) continue;
    if (peer.service == participant_.options().service) continue;
    present_[peer.service] = true;
  }
}

std::optional<ServiceState> PeerWatch::state_of(const std::string& service) const {
  const std::lock_guard lock(mutex_);
  const auto found = reports_.find(service);
  return found == reports_.end() ? std::nullopt : std::optional(found->second.state);
}

bool PeerWatch::all_running(const std::vector<std::string>& services) const {
  return std::all_of(services.begin(), services.end(), [this](const std::string& service) {
    const auto state = state_of(service);
    return state && *state != ServiceState::kWaiting;
  });
}

bool PeerWatch::lost(const std::string& service) const {
  const std::lock_guard lock(mutex_);
  const auto present = present_.find(service);
  const auto report = reports_.find(service);
  const bool finished = report != reports_.end() && report->second.state == ServiceState::kFinished;
  return present != present_.end() && !present->second && !finished;
}

bool PeerWatch::over(const std::string& service) const {
  return state_of(service) == ServiceState::kFinished || lost(service);
}

std::vector<std::string> PeerWatch::seen() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names;
  for (const auto& [service, present] : present_) names.push_back(service);
  for (const auto& [service, report] : reports_) {
    if (!present_.contains(service)) names.push_back(service);
  }
  return names;
}

}  // namespace vpdr::app
