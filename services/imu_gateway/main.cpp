#include "app/run_service.hpp"
#include "imu_gateway/app/gateway_service.hpp"

int main(int argc, char** argv) {
  return vpdr::app::run_service(vpdr::imu_gateway::service_entry(), argc, argv);
}
