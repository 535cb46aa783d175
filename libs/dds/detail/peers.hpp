#pragma once
// What a vpdr participant tells of itself in its USER_DATA.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace vpdr::dds::detail {

struct Identity {
  std::string idl_hash;
  std::int64_t start_ns = 0;
  std::string service;
  std::string walker;
};

/// "vpdr;idl=<hash>;start=<ns>;service=<s>;walker=<w>".
std::string to_user_data(const Identity& identity);

/// None where the text is not of a vpdr participant. Unknown keys are left aside.
std::optional<Identity> parse_user_data(std::string_view text);

}  // namespace vpdr::dds::detail
