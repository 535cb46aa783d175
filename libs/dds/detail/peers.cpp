#include "dds/detail/peers.hpp"

#include <charconv>

namespace vpdr::dds::detail {
namespace {

constexpr std::string_view kMark = "vpdr";

std::string_view next_field(std::string_view& rest) {
  const auto end = rest.find(';');
  const auto field = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  return field;
}

}  // namespace

std::string to_user_data(const Identity& identity) {
  std::string text(kMark);
  text += ";idl=" + identity.idl_hash + ";start=" + std::to_string(identity.start_ns);
  text += ";service=" + identity.service + ";walker=" + identity.walker;
  return text;
}

std::optional<Identity> parse_user_data(std::string_view text) {
  if (next_field(text) != kMark) return std::nullopt;
  Identity identity;
  while (!text.empty()) {
    const auto field = next_field(text);
    const auto equals = field.find('=');
    if (equals == std::string_view::npos) continue;
    const auto key = field.substr(0, equals);
    const auto value = field.substr(equals + 1);
    if (key == "idl") identity.idl_hash = value;
    if (key == "service") identity.service = value;
    if (key == "walker") identity.walker = value;
    if (key == "start") {
      std::from_chars(value.data(), value.data() + value.size(), identity.start_ns);
    }
  }
  return identity;
}

}  // namespace vpdr::dds::detail
