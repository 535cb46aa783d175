#include "app/run_service.hpp"

#include <spdlog/spdlog.h>

#include <csignal>
#include <exception>
#include <iostream>

#include "app/command_line.hpp"
#include "app/service_loop.hpp"

namespace vpdr::app {
namespace {

/// By then every participant of the network has answered one that is new.
constexpr std::chrono::milliseconds kDiscoveryTakes{500};

/// SIGINT and SIGTERM are waited for by the service's loop; threads made later inherit the mask.
void block_stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

dds::ParticipantOptions participant_options(const ServiceEntry& entry,
                                            const CommonSettings& common) {
  dds::ParticipantOptions options;
  options.walker = common.walker;
  options.service = entry.name;
  options.domain = common.domain;
  options.interfaces = common.interfaces;
  options.peers = common.peers;
  return options;
}

int run(const ServiceEntry& entry, int argc, char** argv) {
  CommonSettings common;
  const CommandLineOutcome outcome = read_command_line(entry, common, argc, argv);
  if (outcome.exit) return *outcome.exit;
  spdlog::set_level(spdlog::level::from_str(common.log_level));
  spdlog::set_pattern("%Y-%m-%d %H:%M:%S.%e [" + entry.name + "] %^%l%$ %v");
  block_stop_signals();
  dds::Participant participant(participant_options(entry, common));
  // Before the first endpoint is made: a second instance is not even seen by the walk of the first.
  participant.wait_for_duplicate(kDiscoveryTakes);
  refuse_second_instance(participant);
  ServiceContext context(participant, common);
  const std::unique_ptr<Service> service = entry.make(context);
  return static_cast<int>(ServiceLoop(context, *service).run());
}

}  // namespace

int run_service(const ServiceEntry& entry, int argc, char** argv) {
  try {
    return run(entry, argc, argv);
  } catch (const Fault& fault) {
    std::cerr << entry.name << ": " << fault.what() << "\n";
    return static_cast<int>(fault.code());
  } catch (const std::exception& error) {
    std::cerr << entry.name << ": internal error, please report: " << error.what() << "\n";
    return static_cast<int>(ExitCode::kInternal);
  }
}

}  // namespace vpdr::app
