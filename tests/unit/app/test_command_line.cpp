#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/command_line.hpp"

namespace vpdr::app {
namespace {

struct Outcome {
  CommandLineOutcome outcome;
  CommonSettings common;
  double rate = 1.0;
  bool simulate = false;
  std::string out;
};

Outcome read(std::vector<std::string> arguments) {
  Outcome result;
  ServiceEntry entry;
  entry.name = "gateway";
  entry.summary = "A service for this test.";
  entry.bind = [&result](config::Binder& binder) {
    binder.number("rate", result.rate, config::at_least(0), "", "speed");
    binder.flag("simulate", result.simulate, "play a simulated walk");
  };
  entry.shortcuts = {{"--rate", "rate", "speed"}};
  entry.flags = {{"--simulate", "simulate", "play a simulated walk"}};
  arguments.insert(arguments.begin(), "gateway");
  std::vector<char*> raw;
  for (std::string& argument : arguments) raw.push_back(argument.data());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const auto released = [] {
    return testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
  };
  try {
    result.outcome =
        read_command_line(entry, result.common, static_cast<int>(raw.size()), raw.data());
  } catch (...) {
    released();
    throw;
  }
  result.out = released();
  return result;
}

TEST(CommandLine, DefaultsStayWithoutArguments) {
  const Outcome r = read({});
  EXPECT_FALSE(r.outcome.exit);
  EXPECT_EQ(r.common.walker, "walker");
  EXPECT_EQ(r.rate, 1.0);
}

std::string fault_of(const std::vector<std::string>& arguments) {
  try {
    read(arguments);
  } catch (const ConfigurationFault& fault) {
    return fault.what();
  }
  return "no fault";
}

TEST(CommandLine, AWalkerNameThatCannotBeATopicsIsRefused) {
  for (const std::string& bad : {std::string("a b"), std::string("\xc3\xbcn\xc3\xaf"),
                                 std::string("7up"), std::string(), std::string(101, 'a')}) {
    EXPECT_THAT(fault_of({"--walker", bad}),
                testing::HasSubstr("gateway.service.walker: must be letters, digits and _, a "
                                   "letter first, at most 100 (got \"" +
                                   bad + "\")"));
  }
  EXPECT_EQ(read({"--walker", std::string(100, 'a')}).common.walker, std::string(100, 'a'));
}

TEST(CommandLine, AnEmptyFlagIsNotTheDefault) {
  EXPECT_THAT(fault_of({"--domain", ""}), testing::HasSubstr("gateway.service.domain"));
  EXPECT_THAT(fault_of({"--log-level", ""}), testing::HasSubstr("gateway.service.log_level"));
}

TEST(CommandLine, FlagsGoOverSets) {
  const Outcome r =
      read({"--set", "gateway.service.walker=bob", "--set", "rate=2", "--walker", "ada", "--rate",
            "0", "--simulate", "--until-end", "--wait-for", "pdr,fusion"});
  EXPECT_FALSE(r.outcome.exit);
  EXPECT_EQ(r.common.walker, "ada");
  EXPECT_EQ(r.rate, 0.0);
  EXPECT_TRUE(r.simulate);
  EXPECT_TRUE(r.common.until_end);
  EXPECT_EQ(r.common.wait_for, (std::vector<std::string>{"pdr", "fusion"}));
}

TEST(CommandLine, UnknownOptionIsAUsageError) {
  EXPECT_EQ(read({"--rat", "1"}).outcome.exit, static_cast<int>(ExitCode::kUsage));
  EXPECT_EQ(read({"--help"}).outcome.exit, 0);
}

TEST(CommandLine, WrongValueIsAConfigurationFault) {
  EXPECT_THROW(read({"--rate", "-1"}), ConfigurationFault);
  EXPECT_THROW(read({"--domain", "x"}), ConfigurationFault);
  EXPECT_THROW(read({"--config", "/nonexistent.yaml"}), ConfigurationFault);
}

TEST(CommandLine, PrintsItsConfiguration) {
  const Outcome r = read({"--print-config", "--rate", "3"});
  EXPECT_EQ(r.outcome.exit, 0);
  EXPECT_THAT(r.out, testing::HasSubstr("gateway:\n"));
  EXPECT_THAT(r.out, testing::HasSubstr("rate: 3"));
}

}  // namespace
}  // namespace vpdr::app
