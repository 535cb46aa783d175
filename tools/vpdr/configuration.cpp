#include "vpdr/configuration.hpp"

#include <algorithm>
#include <array>

#include "app/settings.hpp"
#include "config/binder.hpp"
#include "config/nearest_name.hpp"
#include "core/errors.hpp"
#include "fusion/app/fusion_settings.hpp"
#include "pdr/app/pdr_settings.hpp"
#include "vision/app/vision_settings.hpp"

namespace vpdr::tool {
namespace {

const std::vector<std::string> kServices{"imu_gateway", "pdr", "vision", "fusion", "recorder"};

/// One service's keys, its network settings among them, though nothing here uses a network.
struct ServiceBinder {
  explicit ServiceBinder(const char* name) : binder(name) {}
  app::CommonSettings common;
  config::Binder binder;
};

void load(const std::filesystem::path& folder, config::Binder& binder) {
  const std::filesystem::path file = folder / (binder.root() + ".yaml");
  if (std::filesystem::exists(file)) binder.load_file(file);
}

void assign(const std::string& assignment, const std::array<ServiceBinder*, 3>& services) {
  std::vector<std::string> names;
  for (ServiceBinder* service : services) names.push_back(service->binder.root());
  check_service_of(assignment, names);
  for (ServiceBinder* service : services) {
    if (assignment.starts_with(service->binder.root() + ".")) service->binder.assign(assignment);
  }
}

std::string joined(const std::vector<std::string>& names, const std::string& suffix) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name + suffix;
  return text;
}

}  // namespace

void check_config_folder(const std::filesystem::path& folder) {
  const std::string option = "--config-dir " + folder.string() + ": ";
  if (!std::filesystem::is_directory(folder)) {
    throw ConfigurationFault(option + "no such folder; give the one that holds pdr.yaml");
  }
  bool found = false;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    const std::string stem = entry.path().stem().string();
    const bool is_service = std::find(kServices.begin(), kServices.end(), stem) != kServices.end();
    const std::string nearest = is_service ? stem : config::nearest_name(stem, kServices);
    const std::string extension = entry.path().extension().string();
    if (nearest.empty() || (extension != ".yaml" && extension != ".yml")) continue;
    if (file != nearest + ".yaml") {
      throw ConfigurationFault(option + "nothing reads " + file + "; did you mean " + nearest +
                               ".yaml?");
    }
    found = true;
  }
  if (!found) {
    throw ConfigurationFault(option + "holds none of " + joined(kServices, ".yaml"));
  }
}

void check_service_of(const std::string& assignment, const std::vector<std::string>& services) {
  const std::string root = assignment.substr(0, assignment.find_first_of(".="));
  if (std::find(services.begin(), services.end(), root) != services.end()) return;
  const std::string nearest = config::nearest_name(root, services);
  throw ConfigurationFault("--set " + assignment + ": unknown service '" + root + "'; " +
                           (nearest.empty() ? "keys begin with one of " + joined(services, "")
                                            : "did you mean '" + nearest + "'?"));
}

Configuration read_configuration(const std::optional<std::filesystem::path>& folder,
                                 const std::vector<std::string>& assignments) {
  if (folder) check_config_folder(*folder);
  Configuration out;
  ServiceBinder pdr("pdr");
  ServiceBinder vision("vision");
  ServiceBinder fusion("fusion");
  pdr::bind(pdr.binder, out.cores.pdr);
  vision::bind(vision.binder, out.frames);
  vision::bind(vision.binder, out.cores.vision);
  fusion::bind(fusion.binder, out.cores.fusion);
  const std::array services{&pdr, &vision, &fusion};
  for (ServiceBinder* service : services) {
    app::bind(service->binder, service->common);
    if (folder) load(*folder, service->binder);
  }
  for (const std::string& assignment : assignments) assign(assignment, services);
  for (ServiceBinder* service : services) {
    out.services.push_back({.name = service->binder.root(),
                            .version = VPDR_VERSION,
                            .state = "finished",
                            .config = service->binder.print_yaml()});
  }
  return out;
}

}  // namespace vpdr::tool
