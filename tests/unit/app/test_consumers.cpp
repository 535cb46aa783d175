#include <gtest/gtest.h>

#include <algorithm>

#include "app/consumers.hpp"
#include "dds/topics.hpp"

namespace vpdr::app {
namespace {

TEST(Consumers, TheRecorderReadsEveryTopic) {
  for (const dds::TopicInfo& topic : dds::topics::all()) {
    const auto readers = readers_of(topic.name);
    EXPECT_NE(std::find(readers.begin(), readers.end(), "recorder"), readers.end()) << topic.name;
  }
}

TEST(Consumers, NoServiceReadsItsOwnTopic) {
  for (const dds::TopicInfo& topic : dds::topics::all()) {
    const auto readers = readers_of(topic.name);
    EXPECT_EQ(std::find(readers.begin(), readers.end(), topic.from), readers.end()) << topic.name;
  }
}

}  // namespace
}  // namespace vpdr::app
