#include <gtest/gtest.h>

#include "app/health_log.hpp"

namespace vpdr::app {
namespace {

Health degraded(const std::string& reason) {
  Health health;
  health.degrade(reason, "do this");
  return health;
}

TEST(HealthLog, SaysATroubleOnceWhileItLasts) {
  HealthLog log;
  EXPECT_FALSE(log.see({}).has_value());
  const auto line = log.see(degraded("only 17 MiB are free"));
  ASSERT_TRUE(line.has_value());
  EXPECT_TRUE(line->warning);
  EXPECT_EQ(line->text, "only 17 MiB are free: do this");
  EXPECT_FALSE(log.see(degraded("only -9.5 MiB are free")).has_value()) << "another number";
  EXPECT_TRUE(log.see(degraded("the board vanished")).has_value()) << "another trouble";
}

TEST(HealthLog, SaysItsEndAndItsReturn) {
  HealthLog log;
  log.see(degraded("the board vanished"));
  const auto line = log.see({});
  ASSERT_TRUE(line.has_value());
  EXPECT_FALSE(line->warning);
  EXPECT_EQ(line->text, "running again");
  EXPECT_TRUE(log.see(degraded("the board vanished")).has_value());
}

TEST(HealthLog, WhoHasFinishedIsNotRunningAgain) {
  HealthLog log;
  log.see(degraded("the board vanished"));
  Health finished;
  finished.state = ServiceState::kFinished;
  EXPECT_FALSE(log.see(finished).has_value());
}

}  // namespace
}  // namespace vpdr::app
