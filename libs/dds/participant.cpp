#include "dds/participant.hpp"

#include "dds/detail/participant_state.hpp"

namespace vpdr::dds {

Participant::Participant(const ParticipantOptions& options)
    : state_(std::make_shared<detail::ParticipantState>(options)) {}

const ParticipantOptions& Participant::options() const { return state_->options(); }
Guid Participant::guid() const { return state_->guid(); }
std::vector<Problem> Participant::take_problems() { return state_->take_problems(); }
bool Participant::is_duplicate() const { return state_->is_duplicate(); }

bool Participant::wait_for_duplicate(std::chrono::milliseconds timeout) const {
  return state_->wait_for_duplicate(timeout);
}

std::vector<RemoteParticipant> Participant::remote_participants() const {
  return state_->remote_participants();
}

bool Participant::wait_for_service(const std::string& service,
                                   std::chrono::milliseconds timeout) const {
  return state_->wait_for_service(service, timeout);
}

bool Participant::wait_for_participants(std::size_t count,
                                        std::chrono::milliseconds timeout) const {
  return state_->wait_for_participants(count, timeout);
}

std::vector<WriterInfo> Participant::writers() const { return state_->writers(); }

std::vector<WriterEvent> Participant::take_writer_events(std::chrono::milliseconds timeout) {
  return state_->take_writer_events(timeout);
}

}  // namespace vpdr::dds
