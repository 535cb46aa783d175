#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "pdr/app/pdr_settings.hpp"

namespace vpdr::pdr {
namespace {

TEST(PdrSettings, DefaultsAreWithinTheirOwnRanges) {
  PdrConfig config;
  config::Binder binder("pdr");
  bind(binder, config);
  const std::string defaults = binder.print_yaml();
  EXPECT_NO_THROW(binder.load_text(defaults, "pdr.yaml"));
  EXPECT_EQ(binder.print_yaml(), defaults);
}

TEST(PdrSettings, KeysReachTheirFields) {
  PdrConfig config;
  config::Binder binder("pdr");
  bind(binder, config);
  binder.assign("pdr.step.min_interval_s=0.625");
  EXPECT_EQ(config.step.min_interval_s, 0.625);
  EXPECT_THROW(binder.assign("pdr.step.filter_order=3"), ConfigurationFault);
}

}  // namespace
}  // namespace vpdr::pdr
