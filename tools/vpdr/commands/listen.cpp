// vpdr listen: the fused pose as it comes, from any host of the network.
#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <condition_variable>
#include <iomanip>
#include <iostream>
#include <memory>
#include <mutex>

#include "core/errors.hpp"
#include "core/rotation.hpp"
#include "dds/convert.hpp"
#include "dds/subscription.hpp"
#include "vpdr/commands/commands.hpp"
#include "vpdr/network.hpp"
#include "vpdr_msgs.h"

namespace vpdr::tool {
namespace {

struct ListenOptions {
  NetworkOptions network;
  std::size_t count = 0;
  double timeout_s = 60.0;
};

void print(const FusedPose& fused) {
  const auto& p = fused.pose.position_m;
  std::cout << std::fixed << std::setprecision(3) << to_seconds(fused.pose.stamp_ns) << " s  x "
            << p.x() << " m  y " << p.y() << " m (1 sigma " << std::setprecision(2)
            << std::sqrt(fused.pose.covariance(0, 0)) << " m, "
            << std::sqrt(fused.pose.covariance(1, 1)) << " m)  yaw " << std::setprecision(1)
            << to_degrees(fused.yaw_rad) << " deg  walked " << fused.distance_m << " m  "
            << name_of(fused.mode) << std::endl;
}

void listen(const ListenOptions& options) {
  dds::Participant participant(participant_options(options.network, "vpdr_listen"));
  std::mutex mutex;
  std::condition_variable received;
  std::size_t poses = 0;
  dds::Subscription state(participant, dds::topics::kFusionState,
                          [&](const vpdr_msgs::msg::FusionState& message, const dds::SampleInfo&) {
                            FusedPose fused;
                            dds::from_msg(message, fused);
                            const std::lock_guard lock(mutex);
                            if (options.count > 0 && poses >= options.count) return;
                            print(fused);
                            ++poses;
                            received.notify_all();
                          });
  std::unique_lock lock(mutex);
  while (options.count == 0 || poses < options.count) {
    const std::size_t before = poses;
    const bool came = received.wait_for(lock, std::chrono::duration<double>(options.timeout_s),
                                        [&] { return poses > before; });
    if (!came) {
      throw DdsFault("no fused pose for " + fmt::format("{:g}", options.timeout_s) +
                     " s; is fusion running for walker " + participant.options().walker +
                     " in domain " + std::to_string(participant.options().domain) + "?");
    }
  }
}

}  // namespace

void add_listen(CLI::App& app) {
  auto options = std::make_shared<ListenOptions>();
  CLI::App* listen_command =
      app.add_subcommand("listen", "Prints the fused pose of a walker as it comes.");
  add_network_options(*listen_command, options->network);
  listen_command->add_option("--count", options->count, "leave after so many; 0: never");
  listen_command->add_option("--timeout", options->timeout_s, "leave after so long a silence, s")
      ->capture_default_str();
  listen_command->callback([options] { listen(*options); });
}

}  // namespace vpdr::tool
