#pragma once
// Where on the body the board is. Not needed, but who says it is served better: on the trunk there
// is no handling, so that every bounce of a row is a step, in shuffles about a kitchen too.
#include <cstdint>
#include <optional>
#include <string_view>

namespace vpdr::pdr {

enum class Carry : std::uint8_t { kUnknown, kHand, kPocket, kWaist, kChest, kHead };

/// "unknown", "hand", "pocket", "waist", "chest", "head": as in the settings.
[[nodiscard]] const char* name_of(Carry carry);

/// Worn on waist, chest or head.
[[nodiscard]] bool on_trunk(Carry carry);

/// From words such as "waist (lower back)", "FrontPocket", "hand, flat in front of the body";
/// kUnknown where none of the places is named.
[[nodiscard]] Carry carry_named(std::string_view words);

}  // namespace vpdr::pdr
