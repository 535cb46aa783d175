#include "app/run_service.hpp"
#include "fusion/app/fusion_service.hpp"

int main(int argc, char** argv) {
  return vpdr::app::run_service(vpdr::fusion::service_entry(), argc, argv);
}
