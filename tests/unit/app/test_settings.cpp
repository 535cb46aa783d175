#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "app/diagnostics.hpp"
#include "app/settings.hpp"

namespace vpdr::app {
namespace {

class Environment : public testing::Test {
 protected:
  void TearDown() override {
    for (const char* name : {"VPDR_WALKER", "VPDR_DOMAIN", "VPDR_INTERFACES"}) unsetenv(name);
  }
  void SetUp() override { TearDown(); }
};

TEST_F(Environment, GoesOverTheFile) {
  setenv("VPDR_WALKER", "ada", 1);
  setenv("VPDR_DOMAIN", "42", 1);
  setenv("VPDR_INTERFACES", "127.0.0.1,lo", 1);
  CommonSettings s;
  config::Binder binder("pdr");
  bind(binder, s);
  binder.load_text("pdr: {service: {walker: bob, domain: 1}}", "pdr.yaml");
  apply_environment(binder);
  EXPECT_EQ(s.walker, "ada");
  EXPECT_EQ(s.domain, 42U);
  EXPECT_EQ(s.interfaces, (std::vector<std::string>{"127.0.0.1", "lo"}));
}

TEST_F(Environment, NamesTheVariableThatIsWrong) {
  setenv("VPDR_DOMAIN", "300", 1);
  CommonSettings s;
  config::Binder binder("pdr");
  bind(binder, s);
  try {
    apply_environment(binder);
    FAIL() << "took domain 300";
  } catch (const ConfigurationFault& fault) {
    EXPECT_THAT(fault.what(), testing::HasSubstr("VPDR_DOMAIN"));
    EXPECT_THAT(fault.what(), testing::HasSubstr("<= 232"));
  }
}

TEST(Health, TellsStateReasonRemedyAndCounters) {
  Health health;
  health.degrade("the port vanished", "plug it in");
  health.degrade("a later reason", "ignored");
  health.count("imu.received", 7);
  const auto message = to_diagnostics(health, "imu_gateway", "ada");
  ASSERT_EQ(message.status().size(), 1U);
  const auto& status = message.status().front();
  EXPECT_EQ(status.level(), 1);
  EXPECT_EQ(status.name(), "imu_gateway");
  EXPECT_EQ(status.hardware_id(), "ada");
  EXPECT_EQ(status.message(), "degraded: the port vanished");
  EXPECT_EQ(status.values().at(2).value(), "plug it in");
  EXPECT_EQ(status.values().back().key(), "imu.received");
  EXPECT_EQ(status.values().back().value(), "7");
}

}  // namespace
}  // namespace vpdr::app
