#pragma once
// Which service reads which topic: what a service that waits for others has to be matched with.
#include <string_view>
#include <vector>

namespace vpdr::app {

/// The services that subscribe to the topic ("imu/data_raw"). The recorder reads every topic.
std::vector<std::string_view> readers_of(std::string_view topic);

/// Whether the name is one of vpdr's five services.
bool is_service(std::string_view name);

}  // namespace vpdr::app
