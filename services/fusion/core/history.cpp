#include "fusion/core/history.hpp"

#include <algorithm>

namespace vpdr::fusion {

namespace {
/// A confirmation or withdrawal of what was tentative; the first such word stands.
bool is_last_word(const Measurement& later, const Measurement& earlier) {
  return std::get<StepEvent>(earlier).status == StepStatus::kTentative &&
         std::get<StepEvent>(later).status != StepStatus::kTentative;
}
}  // namespace

History::History(const FusionConfig& config)
    : filter_(config),
      entries_(std::max<std::size_t>(config.history.capacity, 1)),
      base_(filter_.initial()) {}

const FilterState& History::state() const { return size_ == 0 ? base_ : at(size_ - 1).after; }

Refusal History::insert(const Measurement& measurement) {
  if (last_dropped_ && !comes_before(*last_dropped_, measurement)) return Refusal::kBackwardInTime;
  std::size_t changed = size_;
  if (const auto said = find_step(measurement)) {
    if (!is_last_word(measurement, at(*said).measurement)) return Refusal::kDuplicate;
    changed = *said;
    erase(changed);
  }
  std::size_t place = size_;
  while (place > 0 && comes_before(measurement, at(place - 1).measurement)) --place;
  if (place > 0 && !comes_before(at(place - 1).measurement, measurement)) {
    return Refusal::kDuplicate;
  }
  if (size_ == entries_.size()) {
    if (place == 0) return Refusal::kBackwardInTime;
    drop_oldest();
    --place;
  }
  for (std::size_t i = size_; i > place; --i) at(i).measurement = at(i - 1).measurement;
  at(place).measurement = measurement;
  changed = std::min(changed, place);
  reapplied_ += size_ - changed;
  ++size_;
  for (std::size_t i = changed; i < size_; ++i) {
    at(i).after = i == 0 ? base_ : at(i - 1).after;
    filter_.apply(at(i).measurement, at(i).after);
  }
  return Refusal::kNone;
}

/// Where a step of the same stamp is.
std::optional<std::size_t> History::find_step(const Measurement& measurement) const {
  const auto* step = std::get_if<StepEvent>(&measurement);
  if (step == nullptr) return std::nullopt;
  for (std::size_t i = size_; i > 0; --i) {
    const auto* kept = std::get_if<StepEvent>(&at(i - 1).measurement);
    if (kept != nullptr && kept->stamp_ns == step->stamp_ns) return i - 1;
  }
  return std::nullopt;
}

void History::erase(std::size_t place) {
  for (std::size_t i = place; i + 1 < size_; ++i) at(i).measurement = at(i + 1).measurement;
  --size_;
}

void History::forget_before(TimestampNs stamp_ns) {
  while (size_ > 0 && stamp_of(at(0).measurement) < stamp_ns) drop_oldest();
}

void History::drop_oldest() {
  base_ = at(0).after;
  last_dropped_ = at(0).measurement;
  head_ = (head_ + 1) % entries_.size();
  --size_;
}

}  // namespace vpdr::fusion
