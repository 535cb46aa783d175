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
  const std::string root = assignment.substr(0, assignment.find('.'));
  std::vector<std::string> names;
  for (ServiceBinder* service : services) {
    if (service->binder.root() == root) return service->binder.assign(assignment);
    names.push_back(service->binder.root());
  }
  const std::string nearest = config::nearest_name(root, names);
  throw ConfigurationFault("--set " + assignment + ": unknown service '" + root + "'; " +
                           (nearest.empty() ? "keys begin with pdr, vision or fusion"
                                            : "did you mean '" + nearest + "'?"));
}

}  // namespace

Configuration read_configuration(const std::optional<std::filesystem::path>& folder,
                                 const std::vector<std::string>& assignments) {
  if (folder && !std::filesystem::is_directory(*folder)) {
    throw ConfigurationFault("--config-dir " + folder->string() +
                             ": no such folder; give the one that holds pdr.yaml");
  }
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
