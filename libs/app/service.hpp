#pragma once
// What a service is to run_service, and what run_service gives it.
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/health.hpp"
#include "app/settings.hpp"
#include "config/binder.hpp"
#include "core/errors.hpp"
#include "dds/participant.hpp"
#include "dds/publisher.hpp"
#include "dds/subscription.hpp"
#include "dds/topics.hpp"

namespace vpdr::app {

/// The network and the life of one service. Thread-safe where marked so.
class ServiceContext {
 public:
  ServiceContext(dds::Participant& participant, const CommonSettings& common);

  dds::Participant& participant() { return participant_; }
  [[nodiscard]] const CommonSettings& common() const { return common_; }
  /// Whether the named service was to be waited for.
  [[nodiscard]] bool waits_for(const std::string& service) const;

  /// An end of a topic that counts for readiness: the service is ready when each of its endpoints
  /// is matched with every service that it waits for and that uses the topic.
  template <class T>
  std::unique_ptr<dds::Publisher<T>> advertise(const dds::Topic<T>& topic);
  template <class T, class Callback>
  std::unique_ptr<dds::Subscription<T>> subscribe(const dds::Topic<T>& topic, Callback callback);
  /// The same for a topic that a service may have or not, as a board without a magnetometer:
  /// matched or not, the service is ready.
  template <class T, class Callback>
  std::unique_ptr<dds::Subscription<T>> subscribe_optional(const dds::Topic<T>& topic,
                                                           Callback callback) {
    return std::make_unique<dds::Subscription<T>>(participant_, topic, std::move(callback));
  }

  /// Whether every endpoint is matched as told above.
  [[nodiscard]] bool matched() const;

  /// Ends the service from any of its threads; the first call counts. Thread-safe.
  void request_stop(ExitCode code, const std::string& reason);

  struct StopRequest {
    ExitCode code = ExitCode::kOk;
    std::string reason;
  };
  /// The stop that was asked for, if any. Thread-safe.
  [[nodiscard]] std::optional<StopRequest> stop_request() const;

 private:
  void require(std::function<bool()> matched) { requirements_.push_back(std::move(matched)); }
  [[nodiscard]] std::size_t waited_readers_of(const dds::TopicInfo& topic) const;

  dds::Participant& participant_;
  const CommonSettings& common_;
  std::vector<std::function<bool()>> requirements_;
  mutable std::mutex mutex_;
  std::optional<StopRequest> stop_;
};

/// One service of the walker.
class Service {
 public:
  virtual ~Service() = default;
  /// Everything waited for is there: called once, before anything is published.
  virtual void start() {}
  /// Fills one diagnostics report; called once a second.
  virtual void report(Health& health) = 0;
  /// Whether the service itself is the end of the walk, as a played recording is.
  [[nodiscard]] virtual bool at_end() { return false; }
  /// The services whose end is this one's end.
  [[nodiscard]] virtual std::vector<std::string> upstream() const { return {}; }
  /// Hands on what is left and stops the threads. Called once; may take some seconds.
  virtual void close() {}
};

/// A command-line option that stands for a key of the service.
struct Shortcut {
  std::string option;  ///< "--rate"
  std::string key;     ///< "playback.rate"
  std::string help;
};

/// What a service's main.cpp hands to run_service.
struct ServiceEntry {
  std::string name;     ///< "pdr"; also the root key of its YAML file
  std::string summary;  ///< one line for --help
  std::function<void(config::Binder&)> bind;
  std::vector<Shortcut> shortcuts;  ///< options with a value
  std::vector<Shortcut> flags;      ///< options that set their key to true
  std::function<std::unique_ptr<Service>(ServiceContext&)> make;
};

template <class T>
std::unique_ptr<dds::Publisher<T>> ServiceContext::advertise(const dds::Topic<T>& topic) {
  auto publisher = std::make_unique<dds::Publisher<T>>(participant_, topic);
  const std::size_t needed = waited_readers_of(topic.info);
  if (needed > 0) {
    require([raw = publisher.get(), needed] { return raw->matched_count() >= needed; });
  }
  return publisher;
}

template <class T, class Callback>
std::unique_ptr<dds::Subscription<T>> ServiceContext::subscribe(const dds::Topic<T>& topic,
                                                                Callback callback) {
  auto subscription =
      std::make_unique<dds::Subscription<T>>(participant_, topic, std::move(callback));
  if (waits_for(std::string(topic.info.from))) {
    require([raw = subscription.get()] { return raw->matched_count() > 0; });
  }
  return subscription;
}

}  // namespace vpdr::app
