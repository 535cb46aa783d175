#pragma once
// Real service processes on a domain of the test's own, and what crosses their topics. Nothing here
// sleeps: every wait is for a message, a match or the end of a process.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/diagnostics.hpp"
#include "dds/participant.hpp"
#include "dds/publisher.hpp"
#include "dds/subscription.hpp"
#include "dds/topics.hpp"
#include "diagnostic_msgs.h"
#include "vpdr/supervisor/child_process.hpp"

namespace vpdr::testing_support {

using namespace std::chrono_literals;

/// Generous: sanitizers on two busy cores are slow. A test that passes never waits so long.
inline constexpr auto kPatience = 60s;

/// A folder that goes with the test.
class Scratch {
 public:
  Scratch() {
    static std::atomic<int> count{0};
    path_ = std::filesystem::temp_directory_path() /
            ("vpdr_test_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(path_);
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Gathers the messages of one topic.
template <class T>
class Collector {
 public:
  Collector(dds::Participant& participant, const dds::Topic<T>& topic)
      : subscription_(participant, topic, [this](const T& message, const dds::SampleInfo& info) {
          const std::lock_guard lock(mutex_);
          messages_.push_back(message);
          lost_ += info.lost_before;
          changed_.notify_all();
        }) {}

  /// Waits until `enough(messages)`; whether it came to that.
  template <class Predicate>
  bool wait(Predicate enough, std::chrono::milliseconds timeout = kPatience) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, timeout, [&] { return enough(messages_); });
  }
  bool wait_count(std::size_t count, std::chrono::milliseconds timeout = kPatience) {
    return wait([count](const std::vector<T>& m) { return m.size() >= count; }, timeout);
  }
  std::vector<T> messages() {
    const std::lock_guard lock(mutex_);
    return messages_;
  }
  std::uint64_t lost() {
    const std::lock_guard lock(mutex_);
    return lost_;
  }
  dds::Subscription<T>& subscription() { return subscription_; }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<T> messages_;
  std::uint64_t lost_ = 0;
  dds::Subscription<T> subscription_;
};

/// The value of one key of a service's newest report; empty where there is none.
inline std::string diagnostic(const std::vector<diagnostic_msgs::msg::DiagnosticArray>& reports,
                              const std::string& service, const std::string& key) {
  for (auto report = reports.rbegin(); report != reports.rend(); ++report) {
    for (const auto& status : report->status()) {
      if (status.name() != service) continue;
      for (const auto& value : status.values()) {
        if (value.key() == key) return value.value();
      }
      return "";
    }
  }
  return "";
}

/// One domain with its observer and its services.
class TestDomain {
 public:
  explicit TestDomain(std::uint32_t domain)
      : domain_(domain),
        participant_([domain] {
          dds::ParticipantOptions options;
          options.domain = domain;
          options.service = "observer";
          options.interfaces = {"127.0.0.1"};
          return options;
        }()),
        diagnostics_(participant_, dds::topics::kDiagnostics),
        diagnostics_publisher_(participant_, dds::topics::kDiagnostics) {}

  tool::ChildProcess start(const std::string& service, std::vector<std::string> arguments) {
    arguments.insert(arguments.end(),
                     {"--domain", std::to_string(domain_), "--interfaces", "127.0.0.1"});
    return tool::ChildProcess(service, std::filesystem::path(VPDR_BIN_DIR) / service, arguments,
                              scratch_.path() / (service + std::to_string(started_++) + ".log"));
  }
  /// Says, as a service would, that the observer is ready: what `--wait-for observer` waits for.
  void say_running() {
    // One of the two readers is the observer's own.
    ASSERT_TRUE(diagnostics_publisher_.wait_for_matched(2, kPatience));
    say("observer", app::ServiceState::kRunning);
  }
  /// Reports a state in the name of a service.
  void say(const std::string& service, app::ServiceState state) {
    app::Health health;
    health.state = state;
    diagnostics_publisher_.publish(app::to_diagnostics(health, service, "walker"));
    EXPECT_TRUE(diagnostics_publisher_.wait_for_acknowledgments(kPatience));
  }
  dds::Participant& participant() { return participant_; }
  /// Waits until a service's newest report has this value; on failure the test shows all of it.
  testing::AssertionResult wait_diagnostic(const std::string& service, const std::string& key,
                                           const std::string& value,
                                           std::chrono::milliseconds timeout = kPatience) {
    const bool came = diagnostics_.wait(
        [&](const auto& reports) { return diagnostic(reports, service, key) == value; }, timeout);
    if (came) return testing::AssertionSuccess();
    return testing::AssertionFailure() << describe(service);
  }
  /// The newest report of a service in words.
  std::string describe(const std::string& service) {
    const auto reports = diagnostics_.messages();
    for (auto report = reports.rbegin(); report != reports.rend(); ++report) {
      for (const auto& status : report->status()) {
        if (status.name() != service) continue;
        std::string text = service + ": " + status.message();
        for (const auto& v : status.values()) text += "\n  " + v.key() + " = " + v.value();
        return text;
      }
    }
    return service + " has not reported";
  }
  std::string diagnostic_of(const std::string& service, const std::string& key) {
    return diagnostic(diagnostics_.messages(), service, key);
  }
  [[nodiscard]] const std::filesystem::path& folder() const { return scratch_.path(); }
  [[nodiscard]] std::uint32_t domain() const { return domain_; }

 private:
  std::uint32_t domain_;
  Scratch scratch_;
  dds::Participant participant_;
  Collector<diagnostic_msgs::msg::DiagnosticArray> diagnostics_;
  dds::Publisher<diagnostic_msgs::msg::DiagnosticArray> diagnostics_publisher_;
  int started_ = 0;
};

}  // namespace vpdr::testing_support
