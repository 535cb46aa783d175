#include "vpdr/board/calibration_session.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <iostream>

#include "calibration_file/calibration_file.hpp"
#include "core/errors.hpp"
#include "dataset/board_log.hpp"
#include "dataset/recording.hpp"
#include "vpdr/board/live_board.hpp"

namespace vpdr::tool {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using calibration::BoardCalibration;
using calibration::Calibrated;

constexpr std::chrono::milliseconds kRefresh{500};
constexpr std::chrono::seconds kSilence{10};
constexpr int kRefreshesPerAttempt = 4;

std::string now_utc() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

bool is_recording(const fs::path& folder) {
  return fs::exists(folder / "imu0") || fs::exists(folder / "mav0");
}

SensorStreams streams_of(const dataset::Recording& recording) {
  SensorStreams streams;
  for (const ImuSample& s : recording.imu) {
    streams.force_mps2.push_back({s.stamp_ns, s.specific_force_mps2});
    if (s.has_angular_velocity)
      streams.rate_radps.push_back({s.stamp_ns, s.angular_velocity_radps});
  }
  for (const MagSample& s : recording.mag) streams.field_ut.push_back({s.stamp_ns, s.field_ut});
  return streams;
}

/// The logs in a folder, by name.
std::vector<fs::path> logs_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const auto extension = entry.path().extension();
    if (extension == ".csv" || extension == ".txt" || extension == ".xz") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  if (files.empty())
    throw FileFault(folder.string() + ": neither a recording nor a folder of logs");
  return files;
}

/// One line over the one before, where standard error is a terminal.
void show(const std::string& line) {
  if (isatty(STDERR_FILENO) == 1) std::cerr << "\r\033[K" << line << std::flush;
}

Result<Calibrated> calibrate_live(const CalibrationKind& kind, const CalibrationChoices& choices,
                                  const BoardCalibration& known,
                                  const calibration::CalibrationOptions& options,
                                  const dds::ParticipantOptions& network) {
  dds::Participant participant(network);
  LiveBoard board(participant);
  std::cerr << kind.instruction << "\n";
  if (!board.wait_for_sample(kSilence)) {
    throw DeviceFault("no samples of walker " + network.walker + " in domain " +
                      std::to_string(network.domain) +
                      " for 10 s; is imu_gateway running (imu_gateway --serial DEV)?");
  }
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(choices.duration_s));
  auto next = Clock::now();
  Result<Calibrated> found = Error{"no samples"};
  for (int refresh = 0; Clock::now() < end; ++refresh) {
    next += kRefresh;
    while (Clock::now() < next && board.wait_for_sample(kRefresh)) {
    }
    const SensorStreams streams = board.streams();
    show(kind.progress(streams, known));
    if (refresh % kRefreshesPerAttempt != kRefreshesPerAttempt - 1) continue;
    found = kind.calibrate(streams, known, options);
    if (found && kind.is_enough(found.value())) break;
    const bool silent = !board.wait_for_sample(kSilence);
    if (silent) break;  // the board has gone: what came has to do
  }
  show("");
  return kind.calibrate(board.streams(), known, options);
}

}  // namespace

SensorStreams read_sources(const std::vector<fs::path>& sources) {
  if (sources.size() == 1 && fs::is_directory(sources.front()) && is_recording(sources.front())) {
    return streams_of(
        dataset::read_recording(sources.front(), {.images = false, .truth = false, .mount = {}}));
  }
  std::vector<fs::path> files;
  for (const fs::path& source : sources) {
    if (!fs::is_directory(source)) {
      files.push_back(source);
      continue;
    }
    if (is_recording(source)) {
      throw FileFault(source.string() + ": a recording is calibrated by itself; give one only");
    }
    const auto logs = logs_in(source);
    files.insert(files.end(), logs.begin(), logs.end());
  }
  return dataset::read_board_logs(files).streams;
}

Calibrated run_calibration(const CalibrationKind& kind, const CalibrationChoices& choices,
                           calibration::CalibrationOptions options,
                           const std::function<dds::ParticipantOptions()>& participant_options) {
  BoardCalibration known;
  if (fs::exists(choices.out)) known = calibration::read_calibration(choices.out);
  if (!choices.board.empty()) known.board = choices.board;
  if (!choices.serial.empty()) known.serial = choices.serial;
  options.date = now_utc();
  const bool live = choices.sources.empty();
  const Result<Calibrated> found =
      live ? calibrate_live(kind, choices, known, options, participant_options())
           : kind.calibrate(read_sources(choices.sources), known, options);
  if (!found) {
    const std::string message = "not calibrated: " + found.error().message;
    if (live) throw DeviceFault(message);
    throw FileFault(message);
  }
  calibration::write_calibration(found.value().board, choices.out);
  return found.value();
}

}  // namespace vpdr::tool
