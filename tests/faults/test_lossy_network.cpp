// A network that loses datagrams: nothing that is reliable is lost, and the walk is the same.
#include <gtest/gtest.h>
#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "integration/one_algorithm.hpp"

namespace vpdr::testing_support {
namespace {

/// One datagram of twenty: a bad wireless link.
constexpr const char* kLoseSome =
    "iptables -A INPUT -p udp -m statistic --mode random --probability 0.05 -j DROP";

bool set_loopback_up() {
  const int any = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ifreq request{};
  std::strncpy(request.ifr_name, "lo", sizeof request.ifr_name - 1);
  bool up = ioctl(any, SIOCGIFFLAGS, &request) == 0;
  request.ifr_flags |= IFF_UP;
  up = up && ioctl(any, SIOCSIFFLAGS, &request) == 0;
  close(any);
  return up;
}

/// A network of this process and its children alone, which loses datagrams. Says what is in the way
/// where there can be none.
std::string enter_lossy_network() {
  // Only of a process with one thread: the others would stay where they are.
  if (unshare(CLONE_NEWNET) != 0) {
    return std::string("no network of its own: ") + std::strerror(errno) + "; needs root";
  }
  if (!set_loopback_up()) return "the loopback interface does not come up";
  if (std::system(kLoseSome) != 0) return "iptables loses no datagrams; is it installed?";
  return "";
}

class LossyNetwork : public OneAlgorithm {
 protected:
  static void SetUpTestSuite() {
    in_the_way_ = enter_lossy_network();
    OneAlgorithm::SetUpTestSuite();
    setenv("VPDR_DOMAIN", "168", 1);
  }
  void SetUp() override {
    if (!in_the_way_.empty()) GTEST_SKIP() << "skipped: " << in_the_way_;
  }

 private:
  static inline std::string in_the_way_;
};

TEST_F(LossyNetwork, TheWalkIsTheSame) {
  vpdr({"simulate", "--out", folder() / "walk", "--duration", "20", "--seed", "7"});
  // Played faster than life, a field that is sent again comes too late to be used, which is
  // counted: the heading rests on fewer of them.
  expect_same(folder() / "walk", {.direction_rad = 0.1, .position_m = 0.5});
}

}  // namespace
}  // namespace vpdr::testing_support
