#include <string_view>

#include "app/run_service.hpp"
#include "recorder/app/info_command.hpp"
#include "recorder/app/recorder_service.hpp"

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "info") {
    return vpdr::recorder::run_info_command(argc - 1, argv + 1);
  }
  return vpdr::app::run_service(vpdr::recorder::service_entry(), argc, argv);
}
