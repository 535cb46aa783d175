#include <fastrtps/utils/IPLocator.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include "core/errors.hpp"
#include "core/time.hpp"
#include "dds/detail/peers.hpp"
#include "dds/detail/qos.hpp"
#include "dds/publisher.hpp"
#include "dds/schema.hpp"
#include "dds/subscription.hpp"
#include "diagnostic_msgs.h"
#include "tests/unit/dds/loopback.hpp"
#include "vpdr_msgs.h"

extern char** environ;

namespace vpdr::dds::test {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

constexpr std::uint32_t kDomain = 103;

/// A participant that collects its problems.
struct Watched {
  explicit Watched(ParticipantOptions options)
      : participant([&] {
          options.on_problem = [this](const Problem& problem) { problems.add(problem); };
          return options;
        }()) {}

  Collected<Problem> problems;
  Participant participant;
};

TEST(Participant, RefusesWhatCannotBe) {
  auto options = loopback(kDomain, "pdr");
  options.walker = "no/slash";
  EXPECT_THROW(Participant{options}, DdsFault);
  options = loopback(233, "pdr");
  EXPECT_THROW(Participant{options}, DdsFault);
  options = loopback(kDomain, "pdr");
  options.interfaces = {"203.0.113.7"};
  try {
    const Participant participant(options);
    FAIL() << "an interface that is not there was accepted";
  } catch (const DdsFault& fault) {
    EXPECT_EQ(fault.code(), ExitCode::kDds);
    EXPECT_THAT(fault.what(), HasSubstr("'203.0.113.7' is not on this host"));
    EXPECT_THAT(fault.what(), HasSubstr("lo (127.0.0.1)"));
  }
}

TEST(Participant, InterfaceMayBeGivenByName) {
  auto options = loopback(kDomain, "pdr");
  options.interfaces = {"lo"};
  const Participant by_name(options);
  const Participant by_address(loopback(kDomain, "fusion"));
  EXPECT_TRUE(by_name.wait_for_service("fusion", kPatience));
  EXPECT_TRUE(by_address.wait_for_service("pdr", kPatience));
}

// The other one is deaf to multicast and says nothing by itself: only the address given finds it.
TEST(Participant, PeersAreFoundByTheirAddress) {
  auto qos =
      detail::participant_qos(loopback(kDomain, "far"), {"127.0.0.1"},
                              detail::to_user_data({std::string(idl_hash()), 1, "far", "w"}));
  constexpr int kParticipantId = 7;
  qos.wire_protocol().participant_id = kParticipantId;
  eprosima::fastrtps::rtps::Locator_t own;
  eprosima::fastrtps::rtps::IPLocator::setIPv4(own, "127.0.0.1");
  own.port = 7400 + 250 * kDomain + 10 + 2 * kParticipantId;  // RTPS 2.2, section 9.6.1.1
  qos.wire_protocol().builtin.metatrafficUnicastLocatorList.push_back(own);
  auto nowhere = own;
  nowhere.port = 9;
  qos.wire_protocol().builtin.initialPeersList.push_back(nowhere);
  auto* factory = eprosima::fastdds::dds::DomainParticipantFactory::get_instance();
  auto* far = factory->create_participant(kDomain, qos);
  ASSERT_NE(far, nullptr);
  const Participant by_multicast(loopback(kDomain, "a"));
  auto options = loopback(kDomain, "b");
  options.peers = {"127.0.0.1"};
  const Participant by_address(options);
  const bool found = by_address.wait_for_participants(2, kPatience);
  const auto seen_by_multicast = by_multicast.remote_participants().size();
  factory->delete_participant(far);
  EXPECT_TRUE(found);
  EXPECT_EQ(seen_by_multicast, 1U) << "b only";
}

TEST(Participant, TellsWhoItIs) {
  const Participant pdr(loopback(kDomain, "pdr"));
  const Participant fusion(loopback(kDomain, "fusion"));
  ASSERT_TRUE(fusion.wait_for_service("pdr", kPatience));
  EXPECT_FALSE(fusion.wait_for_service("vision", milliseconds(1)));
  const auto peers = fusion.remote_participants();
  ASSERT_EQ(peers.size(), 1U);
  EXPECT_EQ(peers[0].guid, pdr.guid());
  EXPECT_EQ(peers[0].name, "vpdr/tester/pdr");
  EXPECT_EQ(peers[0].walker, "tester");
  EXPECT_EQ(peers[0].service, "pdr");
  EXPECT_EQ(peers[0].idl_hash, idl_hash());
  EXPECT_GT(peers[0].start_ns, 1'700'000'000 * kNsPerSecond);
}

TEST(Participant, SecondInstanceLearnsThatItIsOne) {
  Watched first(loopback(kDomain, "pdr"));
  Watched second(loopback(kDomain, "pdr"));
  Watched other(loopback(kDomain, "fusion"));
  ASSERT_TRUE(second.problems.wait_for(1));
  EXPECT_TRUE(second.participant.is_duplicate());
  const auto problem = second.problems.items()[0];
  EXPECT_EQ(problem.kind, ProblemKind::kDuplicateInstance);
  EXPECT_THAT(problem.text, HasSubstr("service 'pdr' runs already for walker 'tester'"));
  // By the time the first has seen them both it has had the chance to complain.
  ASSERT_TRUE(first.participant.wait_for_service("pdr", kPatience));
  ASSERT_TRUE(first.participant.wait_for_service("fusion", kPatience));
  ASSERT_TRUE(other.participant.wait_for_service("pdr", kPatience));
  EXPECT_FALSE(first.participant.is_duplicate());
  EXPECT_FALSE(other.participant.is_duplicate());
  EXPECT_TRUE(first.problems.items().empty());
  EXPECT_TRUE(other.problems.items().empty());
}

TEST(Participant, SameServiceOfAnotherWalkerIsNoDuplicate) {
  Watched ann(loopback(kDomain, "pdr"));
  auto options = loopback(kDomain, "pdr");
  options.walker = "bob";
  Watched bob(options);
  ASSERT_TRUE(bob.participant.wait_for_participants(1, kPatience));
  EXPECT_FALSE(bob.participant.is_duplicate());
  EXPECT_TRUE(bob.problems.items().empty());
}

TEST(Participant, PeerWithOtherMessageDefinitionsIsReportedWithBothHashes) {
  Watched watched(loopback(kDomain, "fusion"));
  const auto options = loopback(kDomain, "pdr");
  const auto user_data = detail::to_user_data({"0123456789abcdef", 1, "pdr", "tester"});
  auto* factory = eprosima::fastdds::dds::DomainParticipantFactory::get_instance();
  auto* stranger = factory->create_participant(
      kDomain, detail::participant_qos(options, {"127.0.0.1"}, user_data));
  ASSERT_NE(stranger, nullptr);
  const bool reported = watched.problems.wait_for(1);
  factory->delete_participant(stranger);
  ASSERT_TRUE(reported);
  const auto problem = watched.problems.items()[0];
  EXPECT_EQ(problem.kind, ProblemKind::kIdlMismatch);
  EXPECT_THAT(problem.text, HasSubstr("vpdr/tester/pdr"));
  EXPECT_THAT(problem.text, HasSubstr("0123456789abcdef"));
  EXPECT_THAT(problem.text, HasSubstr(std::string(idl_hash())));
  EXPECT_THAT(problem.text, HasSubstr("install the same version"));
}

TEST(Participant, WritersAppearAndGo) {
  const Participant sender(loopback(kDomain, "pdr"));
  Participant recorder(loopback(kDomain, "recorder"));
  std::vector<WriterEvent> events;
  const auto wait_for_events = [&](std::size_t count) {
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (events.size() < count && std::chrono::steady_clock::now() < deadline) {
      for (auto& event : recorder.take_writer_events(kPatience)) events.push_back(event);
    }
    return events.size() == count;
  };
  auto own = std::make_unique<Publisher<diagnostic_msgs::msg::DiagnosticArray>>(
      recorder, topics::kDiagnostics);
  ASSERT_TRUE(wait_for_events(1));
  EXPECT_EQ(events[0].writer.participant, "vpdr/tester/recorder");
  EXPECT_EQ(events[0].writer.topic, "rt/tester/diagnostics");
  {
    Publisher steps(sender, topics::kStep);
    ASSERT_TRUE(wait_for_events(2));
    EXPECT_TRUE(events[1].appeared);
    EXPECT_EQ(events[1].writer.topic, "rt/tester/pdr/step");
    EXPECT_EQ(events[1].writer.type, "vpdr_msgs/msg/Step");
    EXPECT_EQ(events[1].writer.participant, "vpdr/tester/pdr");
    EXPECT_TRUE(events[1].writer.reliable);
    EXPECT_FALSE(events[1].writer.transient_local);
    EXPECT_EQ(recorder.writers().size(), 2U);
  }
  ASSERT_TRUE(wait_for_events(3));
  EXPECT_FALSE(events[2].appeared);
  EXPECT_EQ(events[2].writer.guid, events[1].writer.guid);
  EXPECT_EQ(recorder.writers().size(), 1U);
  own.reset();
  ASSERT_TRUE(wait_for_events(4));
  EXPECT_FALSE(events[3].appeared);
  EXPECT_TRUE(recorder.writers().empty());
}

// A process that is killed says no goodbye: its liveliness lapses, then its lease.
TEST(Participant, KilledPeerIsNoticed) {
  Participant receiver(loopback(kDomain, "receiver"));
  Subscription subscription(receiver, topics::kStep,
                            [](const vpdr_msgs::msg::Step&, const SampleInfo&) {});
  std::string program = std::string(VPDR_TEST_BIN_DIR) + "/dds_silent_peer";
  std::string domain = std::to_string(kDomain);
  char* arguments[] = {program.data(), domain.data(), nullptr};
  pid_t child = 0;
  ASSERT_EQ(posix_spawn(&child, program.c_str(), nullptr, nullptr, arguments, environ), 0);
  const bool heard =
      subscription.wait_for([](const ReaderCounts& c) { return c.received == 1; }, kPatience);
  EXPECT_EQ(receiver.take_writer_events(kPatience).size(), 1U);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  ASSERT_TRUE(heard);
  EXPECT_TRUE(subscription.wait_for([](const ReaderCounts& c) { return c.liveliness_lost == 1; },
                                    kPatience));
  EXPECT_EQ(subscription.alive_count(), 0U);
  EXPECT_TRUE(subscription.wait_for_unmatched(kPatience));
  const auto events = receiver.take_writer_events(kPatience);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_FALSE(events[0].appeared);
  EXPECT_TRUE(receiver.writers().empty());
}

TEST(UserData, RoundTripAndUnknownKeys) {
  const auto text = detail::to_user_data({"ab", -5, "pdr", "ann"});
  EXPECT_EQ(text, "vpdr;idl=ab;start=-5;service=pdr;walker=ann");
  const auto identity = detail::parse_user_data(text + ";later=1;odd");
  ASSERT_TRUE(identity.has_value());
  EXPECT_EQ(identity->idl_hash, "ab");
  EXPECT_EQ(identity->start_ns, -5);
  EXPECT_EQ(identity->service, "pdr");
  EXPECT_EQ(identity->walker, "ann");
  EXPECT_FALSE(detail::parse_user_data("").has_value());
  EXPECT_FALSE(detail::parse_user_data("other;idl=ab").has_value());
}

}  // namespace
}  // namespace vpdr::dds::test
