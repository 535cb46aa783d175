// A process for the tests to kill: it sends one step to the first reader and waits. Argument: the
// domain.
#include <unistd.h>

#include <cstdlib>

#include "dds/publisher.hpp"
#include "tests/unit/dds/loopback.hpp"
#include "vpdr_msgs.h"

int main(int argc, char** argv) {
  using namespace vpdr::dds;
  if (argc != 2) return EXIT_FAILURE;
  auto options = test::loopback(static_cast<std::uint32_t>(std::atoi(argv[1])), "silent_peer");
  options.lease_s = 3.0;
  const Participant participant(options);
  Publisher steps(participant, topics::kStep);
  if (!steps.wait_for_matched(1, test::kPatience)) return EXIT_FAILURE;
  steps.publish({});
  pause();
  return EXIT_SUCCESS;
}
