#pragma once
// The recorder on the network: every topic of the walker in, one MCAP file out.
#include <map>
#include <memory>
#include <set>
#include <string>
#include <thread>

#include "app/progress.hpp"
#include "app/service.hpp"
#include "dds/subscription.hpp"
#include "recorder/app/file_writer.hpp"
#include "recorder/app/recorder_settings.hpp"
#include "recorder/app/topic_table.hpp"
#include "recorder/core/topic_statistics.hpp"

namespace vpdr::recorder {

/// Three threads beside the main one: the middleware's receive thread puts samples in a queue, one
/// thread follows the discovery of topics, one writes the file.
class RecorderService : public app::Service {
 public:
  /// Creates the file; throws FileFault.
  RecorderService(const RecorderSettings& settings, app::ServiceContext& context);
  ~RecorderService() override;

  void report(app::Health& health) override;
  [[nodiscard]] std::vector<std::string> upstream() const override {
    return {"imu_gateway", "pdr", "vision", "fusion"};
  }
  void close() override;

 private:
  void follow_discovery(const std::stop_token& stop);
  void consider(const dds::WriterInfo& writer);
  void subscribe(const std::string& name, const dds::WriterInfo& writer);
  void take(std::size_t topic, bool paces, std::span<const std::byte> payload,
            const dds::SampleInfo& info);
  void report_space(app::Health& health);

  const RecorderSettings settings_;
  app::ServiceContext& context_;
  TopicTable topics_;
  app::ProgressReporter progress_;
  FileWriter file_;
  RecentGrowth losses_;
  RecentGrowth waits_;
  // Made and destroyed by the discovery thread and close() only.
  std::map<std::string, dds::RawSubscription> subscriptions_;
  std::set<std::string> weaker_topics_;  ///< told once
  std::jthread discovery_;
};

/// What main.cpp runs.
app::ServiceEntry service_entry();

}  // namespace vpdr::recorder
