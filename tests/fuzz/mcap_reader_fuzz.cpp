// libFuzzer target: any bytes as a recording. The reader must stay within its bounds (address and
// undefined-behaviour sanitizers are on) and within its memory limits.
#include <cstddef>
#include <cstdint>
#include <span>

#include "mcap/reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vpdr::mcap;
  ReaderOptions options;
  options.max_chunk_bytes = 1U << 20U;
  options.max_loaded_bytes = 4U << 20U;
  const auto reader = Reader::open(open_bytes(std::as_bytes(std::span(data, size))), options);
  if (!reader) return 0;
  for (const Order order : {Order::kLogTime, Order::kFile}) {
    Selection selection;
    selection.order = order;
    MessageStream stream(reader.value(), selection);
    while (const std::optional<Message> message = stream.next()) {
      static_cast<void>(reader.value().find_channel(message->channel_id));
    }
  }
  return 0;
}
