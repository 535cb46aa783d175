#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/binder.hpp"
#include "config/nearest_name.hpp"

namespace vpdr::config {
namespace {

using testing::HasSubstr;

enum class Method { kPeaks, kSpectrum };

struct Settings {
  double interval_s = 0.3;
  std::uint32_t order = 4;
  bool enabled = true;
  std::string name = "walker";
  std::vector<std::string> interfaces;
  Method method = Method::kPeaks;
  double axis[3] = {1.0, 0.0, 0.0};
};

Binder bound(Settings& s) {
  Binder binder("pdr");
  binder.text("name", s.name, "name of the walker");
  binder.number("step.min_interval_s", s.interval_s, above(0.0), "s", "shortest step");
  binder.integer("step.order", s.order, between(1, 8), "", "filter order");
  binder.choice("step.method", s.method,
                {{"peaks", Method::kPeaks}, {"spectrum", Method::kSpectrum}}, "detector");
  binder.flag("magnetometer.enabled", s.enabled, "use the magnetometer");
  binder.text_list("interfaces", s.interfaces, "addresses to use");
  binder.numbers("axis", s.axis, 3, "", "forward axis");
  return binder;
}

std::string fault_of(const std::string& yaml) {
  Settings s;
  Binder binder = bound(s);
  try {
    binder.load_text(yaml, "pdr.yaml");
  } catch (const ConfigurationFault& fault) {
    EXPECT_EQ(fault.code(), ExitCode::kConfiguration);
    return fault.what();
  }
  return "";
}

TEST(Binder, ReadsEveryKind) {
  Settings s;
  Binder binder = bound(s);
  binder.load_text(
      "pdr:\n  name: ada\n  step: {min_interval_s: 0.25, order: 2, method: spectrum}\n"
      "  magnetometer:\n    enabled: false\n  interfaces: [127.0.0.1, ::1]\n  axis: [0, 1, 0]\n",
      "x");
  EXPECT_EQ(s.name, "ada");
  EXPECT_EQ(s.interval_s, 0.25);
  EXPECT_EQ(s.order, 2U);
  EXPECT_EQ(s.method, Method::kSpectrum);
  EXPECT_FALSE(s.enabled);
  EXPECT_EQ(s.interfaces, (std::vector<std::string>{"127.0.0.1", "::1"}));
  EXPECT_EQ(s.axis[1], 1.0);
}

TEST(Binder, EmptyFileLeavesTheDefaults) {
  EXPECT_EQ(fault_of(""), "");
  EXPECT_EQ(fault_of("# nothing\n"), "");
  EXPECT_EQ(fault_of("pdr:\n"), "");
}

TEST(Binder, NamesFileLineColumnKeyAndValue) {
  EXPECT_EQ(fault_of("pdr:\n  step:\n    min_interval_s: -1\n"),
            "pdr.yaml:3:21: pdr.step.min_interval_s: must be > 0 (got -1)");
}

TEST(Binder, ReportsEveryMistakeAtOnce) {
  const std::string text = fault_of(
      "pdr:\n  step:\n    min_intervall_s: 1\n    order: 2.5\n    order: 3\n    method: peak\n"
      "  magnetometer: {enabled: yes}\n  axis: [1, 2]\n  interfaces: lo\nfusion: {}\n");
  EXPECT_THAT(text, HasSubstr("pdr.yaml:3:5: pdr.step.min_intervall_s: unknown key; did you mean "
                              "pdr.step.min_interval_s?"));
  EXPECT_THAT(text, HasSubstr("pdr.step.order: must be a whole number (got 2.5)"));
  EXPECT_THAT(text, HasSubstr("pdr.yaml:5:5: pdr.step.order: stands twice"));
  EXPECT_THAT(text, HasSubstr("must be one of peaks, spectrum (got peak); did you mean peaks?"));
  EXPECT_THAT(text, HasSubstr("pdr.magnetometer.enabled: must be true or false (got yes)"));
  EXPECT_THAT(text, HasSubstr("pdr.axis: must be a list of 3 numbers (got 2)"));
  EXPECT_THAT(text, HasSubstr("pdr.interfaces: must be a list"));
  EXPECT_THAT(text, HasSubstr("fusion: unknown key"));
}

TEST(Binder, RefusesNonFiniteNumbers) {
  for (const char* bad : {"nan", "inf", "-inf", ".nan", ".inf", "1e999", "0x10", "1 m", ""}) {
    EXPECT_NE(fault_of(std::string("pdr: {step: {min_interval_s: ") + bad + "}}"), "") << bad;
  }
}

TEST(Binder, RefusesBrokenYamlWithItsPlace) {
  EXPECT_THAT(fault_of("pdr:\n  step: [1,\n"), HasSubstr("pdr.yaml:3:1: not valid YAML"));
  EXPECT_THAT(fault_of(","), HasSubstr("must hold one document"));
  EXPECT_THAT(fault_of("pdr:\n---\npdr:\n"), HasSubstr("must hold one document"));
  EXPECT_THAT(fault_of("- a\n"), HasSubstr("must be a map"));
  EXPECT_THAT(fault_of("pdr:\n  step: 3\n"), HasSubstr("is a section"));
  EXPECT_THAT(fault_of("pdr:\n  step: {order: {a: 1}}\n"), HasSubstr("is a key, not a section"));
}

TEST(Binder, MissingFileIsAConfigurationFault) {
  Settings s;
  Binder binder = bound(s);
  EXPECT_THROW(binder.load_file("/nonexistent/pdr.yaml"), ConfigurationFault);
}

TEST(Binder, AssignsFromTheCommandLine) {
  Settings s;
  Binder binder = bound(s);
  binder.assign("pdr.step.order=6");
  binder.assign("interfaces=[127.0.0.1]");
  EXPECT_EQ(s.order, 6U);
  EXPECT_EQ(s.interfaces.size(), 1U);
  EXPECT_THROW(binder.assign("pdr.step.order=60"), ConfigurationFault);
  EXPECT_THROW(binder.assign("pdr.step.ordr=6"), ConfigurationFault);
  EXPECT_THROW(binder.assign("pdr.step.order"), ConfigurationFault);
}

TEST(Binder, PrintedConfigurationReadsBackTheSame) {
  Settings s;
  s.interval_s = 0.1;
  s.name = "a \"b\" # c";
  s.interfaces = {"127.0.0.1"};
  const std::string printed = bound(s).print_yaml();
  Settings back;
  Binder binder = bound(back);
  binder.load_text(printed, "printed");
  EXPECT_EQ(binder.print_yaml(), printed);
  EXPECT_EQ(back.name, s.name);
}

TEST(Binder, TableHasARowForEachKey) {
  Settings s;
  EXPECT_THAT(bound(s).markdown_table(),
              HasSubstr("| `pdr.step.min_interval_s` | `0.3` | s | > 0 | shortest step |"));
}

TEST(NearestName, CountsEdits) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(nearest_name("orde", {"order", "name"}), "order");
  EXPECT_EQ(nearest_name("xyzzy", {"order", "name"}), "");
}

}  // namespace
}  // namespace vpdr::config
