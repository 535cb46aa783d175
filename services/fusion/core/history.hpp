#pragma once
// Bounded history of measurements with the filter's state after each: a late measurement is put in
// its place and what follows it is applied again, so the state depends on what was measured and
// not on when it arrived. All memory is taken at construction. Not thread-safe.
#include <cstddef>
#include <optional>
#include <vector>

#include "core/sample_gate.hpp"
#include "fusion/core/walker_filter.hpp"

namespace vpdr::fusion {

class History {
 public:
  /// Throws nothing but std::bad_alloc. `config.history.capacity` must be at least 1.
  explicit History(const FusionConfig& config);

  /// kNone: the measurement is in. kDuplicate: it was there already. kBackwardInTime: it is older
  /// than the oldest that is kept.
  Refusal insert(const Measurement& measurement);
  /// Forgets the measurements before `stamp_ns`; what they said stays in the state.
  void forget_before(TimestampNs stamp_ns);

  [[nodiscard]] const FilterState& state() const;
  [[nodiscard]] const WalkerFilter& filter() const { return filter_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Measurements applied a second time because of late ones.
  [[nodiscard]] std::uint64_t reapplied() const { return reapplied_; }

 private:
  struct Entry {
    Measurement measurement;
    FilterState after;
  };

  [[nodiscard]] Entry& at(std::size_t i) { return entries_[(head_ + i) % entries_.size()]; }
  [[nodiscard]] const Entry& at(std::size_t i) const {
    return entries_[(head_ + i) % entries_.size()];
  }
  [[nodiscard]] std::optional<std::size_t> find_step(const Measurement& measurement) const;
  void erase(std::size_t place);
  void drop_oldest();

  WalkerFilter filter_;
  std::vector<Entry> entries_;
  std::size_t head_ = 0;
  std::size_t size_ = 0;
  FilterState base_;  ///< before the oldest entry
  std::optional<Measurement> last_dropped_;
  std::uint64_t reapplied_ = 0;
};

}  // namespace vpdr::fusion
