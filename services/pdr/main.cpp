#include "app/run_service.hpp"
#include "pdr/app/pdr_service.hpp"

int main(int argc, char** argv) {
  return vpdr::app::run_service(vpdr::pdr::service_entry(), argc, argv);
}
