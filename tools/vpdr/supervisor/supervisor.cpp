#include "vpdr/supervisor/supervisor.hpp"

#include <array>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/errors.hpp"

namespace vpdr::tool {
namespace {

constexpr timespec kTick{0, 100'000'000};
/// ChildProcess's exit codes of a death by signal are above it.
constexpr int kDeathBySignal = 128;
/// What is asked of services that do not end with the walk, and when.
constexpr std::array<std::pair<std::chrono::seconds, int>, 3> kPatience{
    {{std::chrono::seconds(8), SIGTERM},
     {std::chrono::seconds(16), SIGTERM},
     {std::chrono::seconds(20), SIGKILL}}};

sigset_t stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

}  // namespace

Supervisor::Supervisor(std::filesystem::path programs, std::filesystem::path logs)
    : programs_(std::move(programs)), logs_(std::move(logs)) {
  std::error_code error;
  std::filesystem::create_directories(logs_, error);
  if (error) {
    throw FileFault(logs_.string() + ": cannot create the folder: " + error.message() +
                    "; choose another with --out");
  }
  const sigset_t signals = stop_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

bool Supervisor::signalled() {
  const sigset_t signals = stop_signals();
  return sigtimedwait(&signals, nullptr, &kTick) > 0;
}

Ending Supervisor::run(const std::vector<ServicePlan>& plans, const std::function<bool()>& tick) {
  for (const ServicePlan& plan : plans) {
    children_.emplace_back(plan.name, programs_ / plan.name, plan.arguments,
                           logs_ / (plan.name + ".log"));
  }
  Ending ending;
  while (!all_ended(ending)) {
    const bool walking = tick();
    if (signalled()) ending.interrupted = true;
    if (ending.interrupted || ending.code != ExitCode::kOk) stop_walk(walking);
    stop_stragglers();
  }
  return ending;
}

bool Supervisor::all_ended(Ending& ending) {
  bool all = true;
  for (ChildProcess& child : children_) {
    const auto code = child.exit_code();
    if (!code) {
      all = false;
    } else if (*code != 0 && ending.code == ExitCode::kOk) {
      ending.code = *code > kDeathBySignal ? ExitCode::kInternal : static_cast<ExitCode>(*code);
      ending.failed = child.name() + " " + how_it_ended(*code);
      ending.log_tail = child.last_lines(5);
    }
  }
  return all;
}

std::string Supervisor::how_it_ended(int code) const {
  if (code <= kDeathBySignal) return "ended with code " + std::to_string(code);
  const int number = code - kDeathBySignal;
  if (number != SIGKILL) {
    return "was killed by signal " + std::to_string(number) + " (" + strsignal(number) + ")";
  }
  const bool by_us = next_signal_ == static_cast<int>(kPatience.size());
  return by_us ? "did not end when it was asked to" : "was killed by signal 9 (out of memory?)";
}

void Supervisor::stop_walk(bool walking) {
  if (stopping_) return;
  stopping_ = true;
  stopping_since_ = Clock::now();
  // The end of the walk reaches only those that walk: the others wait for each other.
  for (const ChildProcess& child : children_) {
    if (!walking || child.name() == "imu_gateway") child.signal(SIGTERM);
  }
}

void Supervisor::stop_stragglers() {
  if (!stopping_ || next_signal_ >= static_cast<int>(kPatience.size())) return;
  const auto& [after, number] = kPatience[static_cast<std::size_t>(next_signal_)];
  if (Clock::now() - stopping_since_ < after) return;
  ++next_signal_;
  // The recorder last: it keeps what the others still say.
  const bool recorder_too = next_signal_ > 1;
  for (const ChildProcess& child : children_) {
    if (child.name() != "recorder" || recorder_too) child.signal(number);
  }
}

}  // namespace vpdr::tool
