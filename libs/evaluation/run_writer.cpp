#include "evaluation/run_writer.hpp"

#include <nlohmann/json.hpp>

#include "dataset/decimal_time.hpp"
#include "dataset/text_file.hpp"

namespace vpdr::evaluation {
namespace {

constexpr int kDecimals = 9;

std::filesystem::path created(std::filesystem::path folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw dataset::fault_at(folder, 0, 0, "cannot create the folder: " + error.message(),
                            "choose another with --out");
  }
  return folder;
}

}  // namespace

RunWriter::RunWriter(std::filesystem::path folder, const Options& options)
    : folder_(created(std::move(folder))),
      fused_(folder_ / "trajectory.tum"),
      covariance_(folder_ / "trajectory_covariance.csv"),
      pdr_(folder_ / "pdr.tum"),
      attitude_(folder_ / "attitude.csv"),
      steps_(folder_ / "steps.csv") {
  covariance_.file.write("#timestamp [ns],var_x [m^2],var_y [m^2],cov_xy [m^2],var_yaw [rad^2]\n");
  attitude_.file.write("#timestamp [ns],q_w,q_x,q_y,q_z\n");
  steps_.file.write("#timestamp [ns],length [m],yaw [rad]\n");
  // What an earlier run left behind must not be taken for this one's.
  for (const char* stale : {"vision.tum", "vision_heading.csv", "summary.json", "run.json"}) {
    std::error_code ignored;
    std::filesystem::remove(folder_ / stale, ignored);
  }
  if (options.vision_heading) {
    vision_heading_ = std::make_unique<Table>(folder_ / "vision_heading.csv");
    vision_heading_->file.write("#timestamp [ns],heading [rad],pitch [rad],sigma [rad]\n");
  }
}

bool RunWriter::is_newer(Table& table, TimestampNs stamp_ns) {
  if (table.last_ns && stamp_ns <= *table.last_ns) {
    ++left_out_;
    return false;
  }
  table.last_ns = stamp_ns;
  return true;
}

void RunWriter::add_tum_row(Table& table, const PoseEstimate& pose) {
  line_.text(dataset::format_decimal_seconds(pose.stamp_ns));
  for (const double value : pose.position_m) line_.text(" ").fixed(value, kDecimals);
  for (const double value : pose.world_from_body.coeffs()) line_.text(" ").fixed(value, kDecimals);
  table.file.write(line_.text("\n").take());
}

void RunWriter::add_fused(const PoseEstimate& pose) {
  if (!is_newer(fused_, pose.stamp_ns)) return;
  add_tum_row(fused_, pose);
  line_.integer(pose.stamp_ns);
  for (const double value : {pose.covariance(0, 0), pose.covariance(1, 1), pose.covariance(0, 1),
                             pose.covariance(5, 5)}) {
    line_.text(",").fixed(value, kDecimals);
  }
  covariance_.file.write(line_.text("\n").take());
}

void RunWriter::add_pdr(const PoseEstimate& pose) {
  if (is_newer(pdr_, pose.stamp_ns)) add_tum_row(pdr_, pose);
}

void RunWriter::add_vision(const PoseEstimate& pose) {
  if (!vision_) vision_ = std::make_unique<Table>(folder_ / "vision.tum");
  if (is_newer(*vision_, pose.stamp_ns)) add_tum_row(*vision_, pose);
}

void RunWriter::add_attitude(const AttitudeEstimate& attitude) {
  if (!is_newer(attitude_, attitude.stamp_ns)) return;
  const Eigen::Quaterniond& q = attitude.world_from_body;
  line_.integer(attitude.stamp_ns);
  for (const double value : {q.w(), q.x(), q.y(), q.z()}) line_.text(",").fixed(value, kDecimals);
  attitude_.file.write(line_.text("\n").take());
}

void RunWriter::add_step(const StepEvent& step) {
  if (step.status != StepStatus::kConfirmed || !is_newer(steps_, step.stamp_ns)) return;
  line_.integer(step.stamp_ns).text(",").fixed(step.length_m, kDecimals);
  line_.text(",").fixed(step.yaw_rad, kDecimals);
  steps_.file.write(line_.text("\n").take());
  ++written_.steps;
  written_.distance_m += step.length_m;
}

void RunWriter::add_vision_heading(const CorridorHeading& heading) {
  if (!vision_heading_ || !heading.found || !is_newer(*vision_heading_, heading.stamp_ns)) return;
  line_.integer(heading.stamp_ns);
  for (const double value : {heading.heading_rad, heading.pitch_rad, heading.sigma_rad}) {
    line_.text(",").fixed(value, kDecimals);
  }
  vision_heading_->file.write(line_.text("\n").take());
}

void RunWriter::finish(Summary summary) {
  if (summary.steps == 0) summary.steps = written_.steps;
  if (summary.distance_m == 0.0) summary.distance_m = written_.distance_m;
  for (Table* table : {&fused_, &covariance_, &pdr_, &attitude_, &steps_}) table->file.close();
  for (const auto& table : {vision_.get(), vision_heading_.get()}) {
    if (table != nullptr) table->file.close();
  }
  write_summary(folder_, summary);
}

void write_summary(const std::filesystem::path& folder, const Summary& summary) {
  const nlohmann::ordered_json json = {{"steps", summary.steps},
                                       {"distance_m", summary.distance_m},
                                       {"duration_s", summary.duration_s},
                                       {"speed_factor", summary.speed_factor}};
  OutputFile file(folder / "summary.json");
  file.write(json.dump(2) + "\n");
  file.close();
}

}  // namespace vpdr::evaluation
