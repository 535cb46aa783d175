#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "fusion/app/fusion_settings.hpp"

namespace vpdr::fusion {
namespace {

TEST(FusionSettings, DefaultsAreWithinTheirOwnRanges) {
  FusionConfig config;
  config::Binder binder("fusion");
  bind(binder, config);
  const std::string defaults = binder.print_yaml();
  EXPECT_NO_THROW(binder.load_text(defaults, "fusion.yaml"));
  EXPECT_EQ(binder.print_yaml(), defaults);
}

TEST(FusionSettings, KeysReachTheirFields) {
  FusionConfig config;
  config::Binder binder("fusion");
  bind(binder, config);
  binder.assign("fusion.heading.correlation_time_s=0.625");
  EXPECT_EQ(config.heading.correlation_time_s, 0.625);
  EXPECT_THROW(binder.assign("fusion.heading.gate_sigmas=0"), ConfigurationFault);
}

}  // namespace
}  // namespace vpdr::fusion
