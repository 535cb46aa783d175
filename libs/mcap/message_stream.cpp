#include <algorithm>
#include <queue>
#include <utility>

#include "mcap/reader.hpp"

namespace vpdr::mcap {
namespace {

struct Entry {
  TimestampNs time_ns = 0;
  Content content;
};

/// A loaded segment and how far it has been given out.
struct Open {
  LoadedSegment loaded;
  std::vector<Entry> entries;
  std::size_t next = 0;
  std::size_t order = 0;  ///< place of the segment in the file

  [[nodiscard]] std::uint64_t bytes() const {
    return loaded.file_bytes.size() + loaded.plain_bytes.size();
  }
  [[nodiscard]] bool finished() const { return next == entries.size(); }
  [[nodiscard]] TimestampNs time_ns() const { return entries[next].time_ns; }
};

struct Later {
  bool operator()(const std::unique_ptr<Open>& a, const std::unique_ptr<Open>& b) const {
    if (a->time_ns() != b->time_ns()) return a->time_ns() > b->time_ns();
    return a->order > b->order;
  }
};

}  // namespace

class MessageStream::Implementation {
 public:
  Implementation(const Reader& reader, Selection selection);
  std::optional<Message> next();
  [[nodiscard]] const std::vector<Damage>& damage() const { return damage_; }

 private:
  [[nodiscard]] bool wants(const Segment& segment) const;
  [[nodiscard]] bool next_segment_is_due() const;
  void open_segment(std::size_t order);
  void collect(Open& open) const;
  void put_back(std::unique_ptr<Open> open);

  const Reader& reader_;
  Selection selection_;
  std::set<std::uint16_t> channels_;
  std::vector<std::size_t> pending_;  ///< segments to open, the last first
  std::vector<std::unique_ptr<Open>> heap_;
  std::unique_ptr<Open> current_;  ///< gave the last message
  std::uint64_t loaded_bytes_ = 0;
  std::vector<Damage> damage_;
};

MessageStream::Implementation::Implementation(const Reader& reader, Selection selection)
    : reader_(reader), selection_(std::move(selection)) {
  const Contents& contents = reader_.contents();
  for (const auto& [id, channel] : contents.channels) {
    const bool all = selection_.topics.empty();
    if (all || selection_.topics.contains(channel.topic)) channels_.insert(id);
  }
  for (std::size_t i = 0; i < contents.segments.size(); ++i) {
    if (wants(contents.segments[i])) pending_.push_back(i);
  }
  if (selection_.order == Order::kLogTime) {
    std::stable_sort(pending_.begin(), pending_.end(), [&](std::size_t a, std::size_t b) {
      return contents.segments[a].start_ns < contents.segments[b].start_ns;
    });
  }
  std::reverse(pending_.begin(), pending_.end());
}

bool MessageStream::Implementation::wants(const Segment& segment) const {
  if (segment.end_ns < selection_.from_ns || segment.start_ns > selection_.until_ns) return false;
  const auto wanted = [this](std::uint16_t id) { return channels_.contains(id); };
  return segment.channels.empty() ||
         std::any_of(segment.channels.begin(), segment.channels.end(), wanted);
}

bool MessageStream::Implementation::next_segment_is_due() const {
  if (pending_.empty()) return false;
  if (heap_.empty()) return true;
  return selection_.order == Order::kLogTime &&
         reader_.contents().segments[pending_.back()].start_ns <= heap_.front()->time_ns();
}

void MessageStream::Implementation::collect(Open& open) const {
  Content rest = open.loaded.records;
  while (const std::optional<RecordView> record = take_record(rest)) {
    if (record->opcode != Opcode::kMessage) continue;
    const std::optional<Message> message = parse_message(record->content);
    if (!message || !channels_.contains(message->channel_id)) continue;
    const TimestampNs time = message->log_time_ns;
    if (time < selection_.from_ns || time > selection_.until_ns) continue;
    open.entries.push_back({time, record->content});
  }
  if (selection_.order == Order::kFile) return;
  std::stable_sort(open.entries.begin(), open.entries.end(),
                   [](const Entry& a, const Entry& b) { return a.time_ns < b.time_ns; });
}

void MessageStream::Implementation::open_segment(std::size_t order) {
  const Segment& segment = reader_.contents().segments[order];
  const ReaderOptions& options = reader_.options();
  auto open = std::make_unique<Open>();
  open->order = order;
  Status status = load(reader_.source(), segment, options, open->loaded);
  if (status && loaded_bytes_ > 0 && loaded_bytes_ + open->bytes() > options.max_loaded_bytes) {
    status = Error{"too many chunks overlap in time for the memory limit"};
  }
  if (!status) {
    damage_.push_back({segment.offset, segment.length, status.error().message});
    return;
  }
  collect(*open);
  if (open->finished()) return;
  loaded_bytes_ += open->bytes();
  heap_.push_back(std::move(open));
  std::push_heap(heap_.begin(), heap_.end(), Later{});
}

void MessageStream::Implementation::put_back(std::unique_ptr<Open> open) {
  if (open->finished()) {
    loaded_bytes_ -= open->bytes();
    return;
  }
  heap_.push_back(std::move(open));
  std::push_heap(heap_.begin(), heap_.end(), Later{});
}

std::optional<Message> MessageStream::Implementation::next() {
  if (current_) put_back(std::move(current_));
  while (next_segment_is_due()) {
    const std::size_t order = pending_.back();
    pending_.pop_back();
    open_segment(order);
  }
  if (heap_.empty()) return std::nullopt;
  std::pop_heap(heap_.begin(), heap_.end(), Later{});
  current_ = std::move(heap_.back());
  heap_.pop_back();
  return parse_message(current_->entries[current_->next++].content);
}

MessageStream::MessageStream(const Reader& reader, Selection selection)
    : implementation_(std::make_unique<Implementation>(reader, std::move(selection))) {}
MessageStream::MessageStream(MessageStream&&) noexcept = default;
MessageStream& MessageStream::operator=(MessageStream&&) noexcept = default;
MessageStream::~MessageStream() = default;

std::optional<Message> MessageStream::next() { return implementation_->next(); }
const std::vector<Damage>& MessageStream::damage() const { return implementation_->damage(); }

}  // namespace vpdr::mcap
