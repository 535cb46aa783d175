// How quickly and how cheaply a board's samples get through imu_gateway, for each kind of board:
//   bench_board_latency [SECONDS] [KIND...]
// A board on a pseudo-terminal sends acceleration and rate 1000 times a second and the field every
// tenth time to the real imu_gateway; latency is from before the write on the pseudo-terminal to
// the callback of a DDS reader in another process. For comparison, the same samples over DDS alone,
// and the gateway's share of one core. Wants an idle machine: other work on it counts as latency.
#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "app/diagnostics.hpp"
#include "core/samples.hpp"
#include "dds/convert.hpp"
#include "dds/participant.hpp"
#include "dds/publisher.hpp"
#include "dds/subscription.hpp"
#include "diagnostic_msgs.h"
#include "sensor_msgs.h"
#include "tests/support/boards.hpp"
#include "tests/support/pty_board.hpp"
#include "vpdr/supervisor/child_process.hpp"

namespace {

using namespace vpdr;                   // NOLINT: a program, not a header
using namespace vpdr::testing_support;  // NOLINT
using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kDomain = 134;
constexpr std::int64_t kPeriodNs = 1'000'000;
/// Magnetometers are ten times slower.
constexpr int kFieldEvery = 10;
constexpr int kMost = 30'000;  ///< distinguishable values of the angular rate
constexpr double kRateStep_dps = 2000.0 / 32768.0;
/// Sent before the measurement begins, while the gateway is starting to read.
constexpr int kWarmUp = 1000;
constexpr std::chrono::seconds kPatience{30};
/// Of an inertial sample, headers included.
constexpr std::size_t kBytesOnTheWire = 456;

Measurement measurement(int i) {
  Measurement m;
  m.time_us = static_cast<std::uint64_t>(i) * 1000;
  m.acceleration_g = {0.01 * (i % 7), 0.02 * (i % 5), 1.0};
  m.rate_dps = {kRateStep_dps * i, 0.1 * (i % 3), 0.0};
  m.has_field = i % kFieldEvery == 0;
  m.field_ut = {20.0, 0.1 * (i % 50), -40.0};
  return m;
}

/// When each sample was sent and how long it took to the reader. Those of the warm-up do not count.
class Stopwatch {
 public:
  explicit Stopwatch(int count) : sent_(static_cast<std::size_t>(count)) {
    latencies_us_.reserve(sent_.size());
  }
  void sent(int i) { sent_[static_cast<std::size_t>(i)] = Clock::now(); }
  void received(const sensor_msgs::msg::Imu& message) {
    const auto now = Clock::now();
    const double rate_dps = message.angular_velocity().x() * 180.0 / M_PI;
    const auto index = static_cast<std::size_t>(std::lround(rate_dps / kRateStep_dps));
    if (index < kWarmUp || index >= sent_.size()) return;
    latencies_us_.push_back(std::chrono::duration<double, std::micro>(now - sent_[index]).count());
    ++received_;
  }
  [[nodiscard]] int count() const { return received_; }
  /// Once everything has come.
  double percentile(double share) {
    std::sort(latencies_us_.begin(), latencies_us_.end());
    if (latencies_us_.empty()) return 0.0;
    return latencies_us_[static_cast<std::size_t>(share *
                                                  static_cast<double>(latencies_us_.size() - 1))];
  }

 private:
  std::vector<Clock::time_point> sent_;
  std::vector<double> latencies_us_;
  std::atomic<int> received_{0};
};

double seconds_on(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// User and system time of a process, seconds.
double cpu_seconds(pid_t pid) {
  clockid_t clock = 0;
  return clock_getcpuclockid(pid, &clock) == 0 ? seconds_on(clock) : 0.0;
}

dds::ParticipantOptions options_of(const std::string& service) {
  dds::ParticipantOptions options;
  options.domain = kDomain;
  options.service = service;
  options.interfaces = {"127.0.0.1"};
  return options;
}

void wait_for(const Stopwatch& stopwatch, int count) {
  const auto deadline = Clock::now() + kPatience;
  while (stopwatch.count() < count - kWarmUp && Clock::now() < deadline) usleep(1000);
}

void print_row(const char* name, Stopwatch& stopwatch, int count, double cpu_percent) {
  std::printf("| %-22s | %6d | %6d | %6.0f | %6.0f | %6.0f | ", name, count - kWarmUp,
              count - kWarmUp - stopwatch.count(), stopwatch.percentile(0.5),
              stopwatch.percentile(0.99), stopwatch.percentile(1.0));
  if (cpu_percent >= 0.0) {
    std::printf("%5.1f |\n", cpu_percent);
  } else {
    std::printf("      |\n");
  }
}

void measure_dds_alone(int count) {
  Stopwatch stopwatch(count);
  dds::Participant writer_side(options_of("writer"));
  dds::Participant reader_side(options_of("reader"));
  dds::Publisher publisher(writer_side, dds::topics::kImuRaw);
  dds::Subscription reader(reader_side, dds::topics::kImuRaw,
                           [&](const auto& message, const auto&) { stopwatch.received(message); });
  publisher.wait_for_matched(1, kPatience);
  sensor_msgs::msg::Imu message;
  send_regularly(count, kPeriodNs, [&](int i) {
    ImuSample sample;
    sample.stamp_ns = i * kPeriodNs;
    sample.angular_velocity_radps.x() = measurement(i).rate_dps[0] * M_PI / 180.0;
    stopwatch.sent(i);
    dds::to_msg(sample, message);
    publisher.publish(message);
  });
  wait_for(stopwatch, count);
  print_row("DDS alone", stopwatch, count, -1.0);
}

double thread_cpu_seconds() { return seconds_on(CLOCK_THREAD_CPUTIME_ID); }

/// A socket on the loopback interface, its address in `own`.
int loopback_socket(sockaddr_in& own) {
  const int made = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  own = {};
  own.sin_family = AF_INET;
  own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  bind(made, reinterpret_cast<sockaddr*>(&own), sizeof own);
  socklen_t size = sizeof own;
  getsockname(made, reinterpret_cast<sockaddr*>(&own), &size);
  return made;
}

/// Hands each message of the board on as a datagram of a sample's size; an empty one ends it.
double relay(const std::string& device, int from, const sockaddr_in& to, int count) {
  const int port = open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  std::array<char, kBytesOnTheWire> buffer{};
  const auto* address = reinterpret_cast<const sockaddr*>(&to);
  const double before = thread_cpu_seconds();
  for (int got = 0; got < count;) {
    pollfd request{port, POLLIN, 0};
    if (poll(&request, 1, 1000) <= 0) break;
    const ssize_t bytes = read(port, buffer.data(), buffer.size());
    if (bytes <= 0) break;
    sendto(from, buffer.data(), buffer.size(), 0, address, sizeof to);
    got += static_cast<int>(std::count(buffer.begin(), buffer.begin() + bytes, '\n'));
  }
  const double spent = thread_cpu_seconds() - before;
  sendto(from, nullptr, 0, 0, address, sizeof to);
  close(port);
  return spent;
}

void measure_system_alone(int count, const std::filesystem::path& folder) {
  sockaddr_in from{};
  sockaddr_in to{};
  const int sender = loopback_socket(from);
  const int receiver = loopback_socket(to);
  PtyBoard board(folder / "board");
  double cpu_s = 0.0;
  std::thread relaying([&] { cpu_s = relay(folder / "board", sender, to, count); });
  std::thread receiving([&] {
    std::array<char, kBytesOnTheWire> datagram{};
    while (recv(receiver, datagram.data(), datagram.size(), 0) > 0) continue;
  });
  send_regularly(count, kPeriodNs, [&](int i) { board.send(text_bytes(measurement(i))); });
  relaying.join();
  receiving.join();
  close(sender);
  close(receiver);
  std::printf("| %-22s | %6d | %6s | %6s | %6s | %6s | %5.1f |\n", "system alone", count, "", "",
              "", "", 100.0 * cpu_s / (1e-9 * kPeriodNs * count));
}

struct BoardKind {
  const char* name;
  std::vector<std::string> settings;
  std::function<std::string(int)> bytes;
};

/// Whether the gateway says so.
bool is_running(const diagnostic_msgs::msg::DiagnosticArray& report) {
  const auto& statuses = report.status();
  return std::any_of(statuses.begin(), statuses.end(), [](const auto& status) {
    return status.name() == "imu_gateway" && status.message().starts_with("running");
  });
}

void measure(const BoardKind& kind, int count, const std::filesystem::path& folder) {
  Stopwatch stopwatch(count);
  dds::Participant participant(options_of("observer"));
  dds::Publisher<diagnostic_msgs::msg::DiagnosticArray> diagnostics(participant,
                                                                    dds::topics::kDiagnostics);
  dds::Subscription reader(participant, dds::topics::kImuRaw,
                           [&](const auto& message, const auto&) { stopwatch.received(message); });
  dds::Subscription field(participant, dds::topics::kMag, [](const auto&, const auto&) {});
  dds::Subscription pressure(participant, dds::topics::kPressure, [](const auto&, const auto&) {});
  std::atomic<bool> running = false;
  dds::Subscription reports(participant, dds::topics::kDiagnostics,
                            [&](const auto& report, const auto&) {
                              if (is_running(report)) running = true;
                            });
  PtyBoard board(folder / "board");
  std::vector<std::string> arguments{
      "--serial",     folder / "board", "--domain",   std::to_string(kDomain),
      "--interfaces", "127.0.0.1",      "--wait-for", "observer"};
  for (const std::string& setting : kind.settings) {
    arguments.insert(arguments.end(), {"--set", setting});
  }
  const auto program =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "imu_gateway";
  tool::ChildProcess gateway("imu_gateway", program, arguments, folder / "gateway.log");
  // It reads the board once it knows that every reader is there; one of the readers of diagnostics
  // is the bench's own.
  bool came = reader.wait_for_matched(1, kPatience) && diagnostics.wait_for_matched(2, kPatience);
  diagnostics.publish(app::to_diagnostics({}, "observer", "walker"));
  came = came && reports.wait_for([&](const auto&) { return running.load(); }, kPatience);
  if (!came) {
    std::printf("| %-22s | imu_gateway did not come: %s\n", kind.name,
                gateway.last_lines(3).c_str());
    return;
  }
  const double cpu_before = cpu_seconds(gateway.pid());
  send_regularly(count, kPeriodNs, [&](int i) {
    const std::string bytes = kind.bytes(i);
    stopwatch.sent(i);
    board.send(bytes);
  });
  wait_for(stopwatch, count);
  const double cpu_s = cpu_seconds(gateway.pid()) - cpu_before;
  print_row(kind.name, stopwatch, count, 100.0 * cpu_s / (1e-9 * kPeriodNs * count));
  gateway.signal(SIGTERM);
  gateway.wait(kPatience);
}

}  // namespace

int main(int argc, char** argv) {
  const int seconds = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 10;
  const int count = std::min(kWarmUp + 1000 * seconds, kMost);
  const auto folder =
      std::filesystem::temp_directory_path() / ("vpdr_board_latency_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::vector<BoardKind> kinds{
      {"text",
       {std::string("serial.lines=[\"") + kTextColumns + "\", \"" + kTextInertialColumns + "\"]"},
       [](int i) { return text_bytes(measurement(i)); }},
      {"xio", {"serial.protocol=xio"}, [](int i) { return xio_bytes(measurement(i)); }},
      {"wit", {"serial.protocol=wit"}, [](int i) { return wit_bytes(measurement(i)); }},
      {"vpdr", {"serial.protocol=vpdr"}, [](int i) {
         return vpdr_bytes(measurement(i), static_cast<std::uint16_t>(i));
       }}};
  std::printf("| %-22s | %6s | %6s | %6s | %6s | %6s | %5s |\n", "board at 1 kHz", "sent", "lost",
              "p50 us", "p99 us", "max us", "CPU %");
  std::printf("|---|---|---|---|---|---|---|\n");
  measure_dds_alone(count);
  measure_system_alone(count, folder);
  const std::vector<std::string> asked(argv + std::min(argc, 2), argv + argc);
  for (const BoardKind& kind : kinds) {
    const bool wanted = asked.empty() || std::count(asked.begin(), asked.end(), kind.name) > 0;
    if (wanted) measure(kind, count, folder);
  }
  std::filesystem::remove_all(folder);
  return 0;
}
