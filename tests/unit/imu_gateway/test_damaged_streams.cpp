// One byte in a hundred corrupted, lost or doubled: what a checked protocol lets through is right,
// and the good frames around a damage survive.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "core/samples.hpp"
#include "imu_gateway/core/make_parser.hpp"
#include "tests/support/boards.hpp"

namespace vpdr::imu_gateway {
namespace {

using testing_support::Measurement;

constexpr int kCount = 10000;

/// Every measurement differs from all others in every column.
Measurement measurement(int i) {
  Measurement m;
  m.time_us = 1'000'000 + static_cast<std::uint64_t>(i) * 1000;
  m.acceleration_g = {std::sin(0.37 * i), 2.0 * std::cos(0.11 * i), 1.0 + std::sin(0.05 * i)};
  m.rate_dps = {900.0 * std::sin(0.013 * i), 400.0 * std::cos(0.29 * i), 100.0 * std::sin(0.7 * i)};
  m.field_ut = {50.0 * std::sin(0.017 * i), 40.0 * std::cos(0.023 * i), -45.0};
  return m;
}

struct Board {
  const char* name;
  Protocol protocol;
  std::function<std::string(const Measurement&, int)> bytes;
};

ParserOptions options_of(const Board& board) {
  ParserOptions options;
  options.protocol = board.protocol;
  options.lines.layouts = {LineLayout::parse(testing_support::kTextColumns).value()};
  return options;
}

/// What came through, by comparison with what was sent.
struct Outcome {
  int whole_frames = 0;  ///< measurements none of whose bytes was touched
  int right = 0;
  int wrong = 0;
};

/// Reads each measurement's acceleration as the parser gives it without damage.
std::vector<Eigen::Vector3d> clean_readings(const Board& board) {
  const auto parser = make_parser(options_of(board));
  std::vector<BoardReadings> out;
  for (int i = 0; i < kCount; ++i) parser->feed(board.bytes(measurement(i), i), out);
  std::vector<Eigen::Vector3d> forces;
  for (const auto& readings : out) {
    if (readings.specific_force_mps2) forces.push_back(*readings.specific_force_mps2);
  }
  return forces;
}

Outcome damage(const Board& board, double share, unsigned seed) {
  const auto truth = clean_readings(board);
  EXPECT_EQ(truth.size(), static_cast<std::size_t>(kCount));
  std::mt19937 random(seed);
  const auto parser = make_parser(options_of(board));
  Outcome outcome;
  std::vector<BoardReadings> out;
  std::size_t next = 0;  // the earliest measurement that may come now
  for (int i = 0; i < kCount; ++i) {
    std::string sent;
    bool touched = false;
    for (const char c : board.bytes(measurement(i), i)) {
      const bool hit = static_cast<double>(random() % 1'000'000) < share * 1e6;
      const unsigned kind = hit ? random() % 3 : 3;
      touched = touched || hit;
      if (kind == 0) sent += static_cast<char>(random() % 256);
      if (kind == 2) sent += c;
      if (kind >= 2) sent += c;
    }
    if (!touched) ++outcome.whole_frames;
    out.clear();
    parser->feed(sent, out);
    for (const auto& readings : out) {
      if (!readings.specific_force_mps2) continue;
      // A frame comes at most one later than it was sent; doubled line ends do not repeat it.
      std::size_t at = next;
      while (at <= static_cast<std::size_t>(i) && truth[at] != *readings.specific_force_mps2) ++at;
      const bool right = at <= static_cast<std::size_t>(i);
      outcome.right += right ? 1 : 0;
      outcome.wrong += right ? 0 : 1;
      if (right) next = at + 1;
    }
  }
  return outcome;
}

const Board kVpdr{"vpdr", Protocol::kVpdr, [](const Measurement& m, int i) {
                    return testing_support::vpdr_bytes(m, static_cast<std::uint16_t>(i));
                  }};
const Board kWit{"wit", Protocol::kWit,
                 [](const Measurement& m, int) { return testing_support::wit_bytes(m); }};
const Board kCheckedText{"text", Protocol::kText, [](const Measurement& m, int) {
                           return testing_support::checked_text_bytes(m);
                         }};
const Board kXio{"xio", Protocol::kXio,
                 [](const Measurement& m, int) { return testing_support::xio_bytes(m); }};

TEST(DamagedStreams, NothingWrongPassesSixteenBitsOfCrc) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Outcome outcome = damage(kVpdr, 0.01, seed);
    EXPECT_EQ(outcome.wrong, 0);
    // A damaged zero byte takes the next frame with it: half a percent or so.
    EXPECT_GT(outcome.right, 0.98 * outcome.whole_frames);
  }
}

TEST(DamagedStreams, EightBitsOfSumLetPassWhatChanceAllows) {
  // Two bytes of a set of 44 changed so that the sum still fits: 1 in 256 of (22 * 0.01)^2 / 2.
  int right = 0;
  int wrong = 0;
  int whole = 0;
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Outcome outcome = damage(kWit, 0.01, seed);
    right += outcome.right;
    wrong += outcome.wrong;
    whole += outcome.whole_frames;
  }
  RecordProperty("wrong", wrong);
  RecordProperty("right", right);
  EXPECT_LT(wrong, 1e-4 * right);
  EXPECT_GT(right, whole);  // sets of which only the angle or the field was hit count too
}

TEST(DamagedStreams, ExclusiveOrOfTextLetsPassEqualCharactersLostTwice) {
  // Digits are few: two of the same, both lost or both doubled, cancel out.
  int right = 0;
  int wrong = 0;
  int whole = 0;
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Outcome outcome = damage(kCheckedText, 0.01, seed);
    right += outcome.right;
    wrong += outcome.wrong;
    whole += outcome.whole_frames;
  }
  RecordProperty("wrong", wrong);
  EXPECT_LT(wrong, 5e-3 * right);
  EXPECT_GT(right, 0.97 * whole);
}

TEST(DamagedStreams, GoodLinesAroundADamageSurvive) {
  const Outcome outcome = damage(kXio, 0.01, 1);
  EXPECT_GT(outcome.right, 0.97 * outcome.whole_frames);
}

TEST(DamagedStreams, WithoutDamageEverythingComesThrough) {
  for (const Board* board : {&kVpdr, &kWit, &kCheckedText, &kXio}) {
    const Outcome outcome = damage(*board, 0.0, 1);
    EXPECT_EQ(outcome.right, kCount) << board->name;
    EXPECT_EQ(outcome.wrong, 0) << board->name;
  }
}

}  // namespace
}  // namespace vpdr::imu_gateway
