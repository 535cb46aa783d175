#include "app/run_service.hpp"
#include "vision/app/vision_service.hpp"

int main(int argc, char** argv) {
  return vpdr::app::run_service(vpdr::vision::service_entry(), argc, argv);
}
