#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evaluation/evaluation.hpp"

namespace vpdr::evaluation {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Evaluation full() {
  Evaluation evaluation;
  evaluation.recording = "walk";
  evaluation.summary = {14, 10.5, 12.0, 640.0};
  evaluation.attitude = AttitudeRmse{3.5, 3.0, 1.25, 900, false};
  evaluation.steps = StepErrors{16, 14, 12.5, std::nullopt};
  evaluation.waypoints = WaypointErrors{2.0, 4.0, 3.0, 7.5, 40.0, {0.0, 1.0, 3.0}};
  PositionErrors position;
  position.ate_m = 0.75;
  position.path_m = 11.0;
  position.start_aligned = {0.5, 1.5, 1.25, 11.5};
  position.inside_95_percent = 96.0;
  evaluation.position = position;
  return evaluation;
}

TEST(ToJson, HasTheKeysOthersRead) {
  const std::string json = to_json(full());
  EXPECT_THAT(json,
              HasSubstr("\"attitude_rmse_deg\": {\n    \"total\": 3.5,\n    \"heading\": 3.0,\n"
                        "    \"inclination\": 1.25,"));
  EXPECT_THAT(json, HasSubstr("\"steps\": {\n    \"true\": 16,\n    \"counted\": 14,\n"
                              "    \"error_percent\": 12.5\n"));
  EXPECT_THAT(json, HasSubstr("\"mean_m\": 2.0,\n    \"final_m\": 3.0,\n"
                              "    \"final_percent\": 7.5,\n    \"max_m\": 4.0"));
  EXPECT_THAT(json, HasSubstr("\"ate_m\": 0.75,\n    \"rpe_percent\": null"));
  EXPECT_THAT(json, HasSubstr("\"inside_95_percent\": 96.0"));
}

TEST(ToJson, LeavesOutWhatHasNoTruth) {
  Evaluation evaluation;
  evaluation.recording = "a \"name\"\n";
  const std::string json = to_json(evaluation);
  for (const char* key : {"attitude_rmse_deg", "waypoints", "position"}) {
    EXPECT_THAT(json, Not(HasSubstr(key)));
  }
  EXPECT_THAT(json, HasSubstr("a \\\"name\\\"\\n"));
}

TEST(ToTable, SaysTheFiguresInWords) {
  const std::string table = to_table(full());
  EXPECT_THAT(table, HasSubstr("10.5 m in 12.0 s, 14 steps"));
  EXPECT_THAT(table, HasSubstr("14 counted, 16 true, error 12.5 %"));
  EXPECT_THAT(table, HasSubstr("mean 2.00 m, max 4.00 m, final 3.00 m (7.50 % of 40.0 m)"));
  EXPECT_THAT(table, HasSubstr("truth in the 95 % ellipse    96.0 % of the time"));
  EXPECT_THAT(to_table(Evaluation{}), HasSubstr("the recording has none"));
}

TEST(Evaluate, TruthOfAnotherTimeIsNotTakenForNone) {
  dataset::Recording recording;
  recording.truth.poses = {{0, {0.0, 0.0, 0.0}, {}}, {kNsPerSecond, {1.0, 0.0, 0.0}, {}}};
  RunDirectory run;
  run.fused = {{50 * kNsPerSecond, {}, {}}, {51 * kNsPerSecond, {}, {}}};
  EXPECT_THAT(to_table(evaluate(run, recording)),
              HasSubstr("none within the run's time; is it the recording this run was made from?"));
  recording.truth.poses.clear();
  EXPECT_THAT(to_table(evaluate(run, recording)), HasSubstr("the recording has none"));
}

TEST(Evaluate, TakesWhateverTruthThereIs) {
  dataset::Recording recording;
  recording.name = "w";
  recording.about.true_steps = 2.0;
  recording.truth.waypoints = {{0, {0.0, 0.0}}, {kNsPerSecond, {1.0, 0.0}}};
  RunDirectory run;
  run.steps.resize(2);
  run.fused = {{0, {5.0, 5.0, 0.0}, {}}, {kNsPerSecond, {6.0, 5.0, 0.0}, {}}};
  const Evaluation evaluation = evaluate(run, recording);
  EXPECT_DOUBLE_EQ(evaluation.steps->error_percent, 0.0);
  EXPECT_DOUBLE_EQ(evaluation.waypoints->mean_m, 0.0);
  EXPECT_FALSE(evaluation.attitude.has_value());
  EXPECT_FALSE(evaluation.position.has_value());
}

}  // namespace
}  // namespace vpdr::evaluation
