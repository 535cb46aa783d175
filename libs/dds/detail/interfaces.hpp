#pragma once
#include <string>
#include <vector>

namespace vpdr::dds::detail {

/// IPv4 addresses of the interfaces given by name ("lo") or address ("127.0.0.1"). Throws DdsFault
/// that lists those of this host where one is not there: Fast DDS itself would go deaf in silence.
std::vector<std::string> addresses_of(const std::vector<std::string>& interfaces);

}  // namespace vpdr::dds::detail
