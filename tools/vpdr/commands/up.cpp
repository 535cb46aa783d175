// vpdr up: the five services as five processes.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "dataset/recording.hpp"
#include "pdr/core/carry.hpp"
#include "run_export/run_export.hpp"
#include "vpdr/commands/commands.hpp"
#include "vpdr/configuration.hpp"
#include "vpdr/network.hpp"
#include "vpdr/supervisor/supervisor.hpp"
#include "vpdr/walk_watch.hpp"

namespace vpdr::tool {
namespace {

struct UpOptions {
  std::string recording;
  std::string serial;
  std::string camera;
  std::string camera_calibration;
  std::string calibration;  ///< of the board
  bool simulate = false;
  std::uint64_t seed = 1;
  double duration_s = 120.0;
  std::string rate = "1";
  std::string out = "out/up";
  std::string config_dir;
  std::vector<std::string> sets;
  NetworkOptions network;
};

/// What is known of the walk before it begins.
struct WalkFacts {
  TimestampNs begin_ns = 0;
  TimestampNs end_ns = 0;                 ///< of a live board: unknown, 0
  std::vector<std::string> pdr_settings;  ///< of place and walker
};

std::filesystem::path folder_of_programs() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

/// pdr as files and --set have it.
pdr::PdrConfig configured_pdr(const UpOptions& options) {
  std::vector<std::string> sets;
  std::copy_if(options.sets.begin(), options.sets.end(), std::back_inserter(sets),
               [](const std::string& assignment) { return assignment.starts_with("pdr."); });
  std::optional<std::filesystem::path> folder;
  if (!options.config_dir.empty()) folder = options.config_dir;
  return read_configuration(folder, sets).cores.pdr;
}

/// As in `vpdr run`: what is set goes over what the recording says of the walker.
std::vector<std::string> pdr_settings_of(const dataset::About& about, const pdr::PdrConfig& set) {
  std::vector<std::string> settings;
  if (about.declination_rad != 0.0) {
    settings.push_back("pdr.attitude.magnetic.declination_rad=" +
                       std::to_string(about.declination_rad));
  }
  const pdr::Carry carry = pdr::carry_named(about.carry);
  if (carry != pdr::Carry::kUnknown && set.carry == pdr::Carry::kUnknown) {
    settings.push_back(std::string("pdr.carry=") + pdr::name_of(carry));
  }
  if (about.height_m && set.person.height_m == 0.0) {
    settings.push_back("pdr.person.height_m=" + std::to_string(*about.height_m));
  }
  return settings;
}

WalkFacts facts_of(const UpOptions& options) {
  WalkFacts facts;
  if (options.recording.empty()) {
    if (!options.simulate) return facts;
    facts.end_ns = to_ns(options.duration_s);
    dataset::About simulated;
    simulated.carry = "head";
    facts.pdr_settings = pdr_settings_of(simulated, configured_pdr(options));
    return facts;
  }
  dataset::ReadOptions samples_only;
  samples_only.images = false;
  samples_only.truth = false;
  const auto recording = dataset::read_recording(options.recording, samples_only);
  for (const std::string& line : recording.report.lines()) std::cout << line << "\n";
  if (!recording.imu.empty()) {
    facts.begin_ns = recording.imu.front().stamp_ns;
    facts.end_ns = recording.imu.back().stamp_ns;
  }
  facts.pdr_settings = pdr_settings_of(recording.about, configured_pdr(options));
  return facts;
}

/// The services of the walk: vision only where there is something to see.
std::vector<std::string> services_of(const UpOptions& options) {
  std::vector<std::string> services{"recorder", "pdr", "fusion", "imu_gateway"};
  if (options.serial.empty() || !options.camera.empty()) services.emplace_back("vision");
  return services;
}

/// Those that one service is matched with before the walk begins.
std::string others_than(const std::string& service, const UpOptions& options) {
  std::string out;
  for (const std::string& name : services_of(options)) {
    if (name != service) out += (out.empty() ? "" : ",") + name;
  }
  return out;
}

ServicePlan plan_of(const std::string& service, const UpOptions& options) {
  ServicePlan plan{service, {"--until-end", "--wait-for", others_than(service, options)}};
  auto add = [&plan](const std::string& option, const std::string& value) {
    if (value.empty()) return;
    plan.arguments.push_back(option);
    plan.arguments.push_back(value);
  };
  add("--walker", options.network.walker.value_or(""));
  add("--domain", options.network.domain.value_or(""));
  const auto yaml = std::filesystem::path(options.config_dir) / (service + ".yaml");
  if (!options.config_dir.empty() && std::filesystem::exists(yaml)) add("--config", yaml);
  for (const std::string& assignment : options.sets) {
    if (assignment.starts_with(service + ".")) add("--set", assignment);
  }
  return plan;
}

void add_source(ServicePlan& plan, const UpOptions& options) {
  if (!options.recording.empty()) {
    plan.arguments.insert(plan.arguments.end(), {"--recording", options.recording});
  } else if (options.simulate) {
    plan.arguments.insert(plan.arguments.end(),
                          {"--simulate", "--seed", std::to_string(options.seed), "--duration",
                           std::to_string(options.duration_s)});
  }
}

std::vector<ServicePlan> plans_of(const UpOptions& options, const WalkFacts& facts) {
  std::vector<ServicePlan> plans;
  for (const std::string& service : services_of(options)) {
    ServicePlan plan = plan_of(service, options);
    const auto add = [&plan](std::initializer_list<std::string> words) {
      plan.arguments.insert(plan.arguments.end(), words);
    };
    if (service == "recorder") {
      add({"--out", std::filesystem::path(options.out) / "recording.mcap", "--replace"});
    }
    if (service == "pdr") {
      for (const std::string& setting : facts.pdr_settings) add({"--set", setting});
    }
    if (service == "vision" || service == "imu_gateway") add_source(plan, options);
    if (service == "vision" && !options.camera.empty()) {
      add({"--camera", options.camera, "--calibration", options.camera_calibration});
    }
    if (service == "imu_gateway") {
      if (!options.serial.empty()) add({"--serial", options.serial});
      if (!options.calibration.empty()) add({"--calibration", options.calibration});
      add({"--rate", options.rate == "max" ? "0" : options.rate});
    }
    plans.push_back(std::move(plan));
  }
  return plans;
}

void run_up(const UpOptions& options) {
  const int sources = (options.recording.empty() ? 0 : 1) + (options.serial.empty() ? 0 : 1) +
                      (options.simulate ? 1 : 0);
  if (sources != 1) {
    throw Fault(ExitCode::kUsage, "give exactly one of RECORDING, --serial DEV, --simulate");
  }
  if (!options.config_dir.empty()) check_config_folder(options.config_dir);
  for (const std::string& assignment : options.sets) {
    check_service_of(assignment, {"imu_gateway", "pdr", "vision", "fusion", "recorder"});
  }
  const WalkFacts facts = facts_of(options);
  Supervisor supervisor(folder_of_programs(), std::filesystem::path(options.out) / "logs");
  Ending ending;
  {
    WalkWatch progress(participant_options(options.network, "vpdr_up"), facts.begin_ns,
                       facts.end_ns);
    ending = supervisor.run(plans_of(options, facts), [&progress] { return progress.draw(); });
  }
  if (ending.code != ExitCode::kOk) {
    throw Fault(ending.code, ending.failed + "; its last words:\n" + ending.log_tail +
                                 "logs are in " + options.out + "/logs");
  }
  const auto recording = std::filesystem::path(options.out) / "recording.mcap";
  const std::filesystem::path played =
      options.recording.empty() ? "" : std::filesystem::absolute(options.recording);
  run_export::export_run(recording, options.out, {.recording = played});
  std::cout << (ending.interrupted ? "interrupted; " : "") << "recorded " << recording.string()
            << "\n";
}

}  // namespace

void add_up(CLI::App& app) {
  auto options = std::make_shared<UpOptions>();
  CLI::App* up = app.add_subcommand("up", "Runs the five services as five processes.");
  up->add_option("RECORDING", options->recording, "folder of a recorded walk to play");
  up->add_option("--serial", options->serial, "serial port of a board");
  up->add_option("--calibration", options->calibration,
                 "file of the board, written by vpdr calibrate imu|mag|mount");
  auto* camera = up->add_option("--camera", options->camera,
                                "live camera beside --serial: index, device or URL");
  auto* of_camera = up->add_option("--camera-calibration", options->camera_calibration,
                                   "calibration file of that camera");
  camera->needs(of_camera);
  of_camera->needs(camera);
  up->add_flag("--simulate", options->simulate, "a simulated walk, no files needed");
  up->add_option("--seed", options->seed, "seed of the simulated walk")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  up->add_option("--duration", options->duration_s, "its length, s")->capture_default_str();
  up->add_option("--rate", options->rate, "playback speed; 1 is real time, max the fastest")
      ->capture_default_str();
  up->add_option("--out", options->out, "folder of recording and logs")->capture_default_str();
  up->add_option("--config-dir", options->config_dir, "folder with <service>.yaml files");
  up->add_option("--set", options->sets, "service.key=value for one of the services");
  add_network_options(*up, options->network);
  up->callback([options] { run_up(*options); });
}

}  // namespace vpdr::tool
