#include "dds/detail/interfaces.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <netinet/in.h>

#include <memory>
#include <utility>

#include "core/errors.hpp"

namespace vpdr::dds::detail {
namespace {

using NameAndAddress = std::pair<std::string, std::string>;

std::vector<NameAndAddress> host_interfaces() {
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return {};
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> owner(list, freeifaddrs);
  std::vector<NameAndAddress> found;
  for (const ifaddrs* entry = list; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    const auto* address = reinterpret_cast<const sockaddr_in*>(entry->ifa_addr);
    char text[INET_ADDRSTRLEN];
    inet_ntop(AF_INET, &address->sin_addr, text, sizeof(text));
    found.emplace_back(entry->ifa_name, text);
  }
  return found;
}

}  // namespace

std::vector<std::string> addresses_of(const std::vector<std::string>& interfaces) {
  if (interfaces.empty()) return {};
  const auto present = host_interfaces();
  std::vector<std::string> addresses;
  for (const auto& wanted : interfaces) {
    const auto before = addresses.size();
    for (const auto& [name, address] : present) {
      if (wanted == name || wanted == address) addresses.push_back(address);
    }
    if (addresses.size() > before) continue;
    std::string known;
    for (const auto& [name, address] : present) known += " " + name + " (" + address + ")";
    throw DdsFault("network interface '" + wanted + "' is not on this host; choose from:" + known);
  }
  return addresses;
}

}  // namespace vpdr::dds::detail
