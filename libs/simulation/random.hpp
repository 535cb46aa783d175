#pragma once
// Random numbers of the simulator. One seed gives the same walk with every compiler and standard
// library, which std::normal_distribution does not promise. Not thread-safe.
#include <cstdint>
#include <string_view>
#include <vector>

namespace vpdr::simulation {

/// Scrambles 64 bits (SplitMix64's finaliser, Steele, Lea and Flood 2014). Stateless, so that a
/// place or a pixel can have its own random number.
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// A stream of random numbers (xoshiro256++, Blackman and Vigna 2019).
class Random {
 public:
  /// Streams of one seed with different purposes are independent: a change in one part of the
  /// simulator leaves the other parts' numbers as they are.
  Random(std::uint64_t seed, std::string_view purpose);

  std::uint64_t bits();
  double uniform();                         ///< [0, 1)
  double uniform(double low, double high);  ///< [low, high)
  std::size_t index(std::size_t count);     ///< 0 .. count - 1
  bool chance(double probability);          ///< true with this probability
  double normal();                          ///< mean 0, standard deviation 1
  double normal(double standard_deviation) { return standard_deviation * normal(); }

 private:
  std::uint64_t state_[4];
};

/// A smooth random function of one variable: zero mean, unit variance over the ensemble, with
/// periods between two bounds (sum of cosines, log-uniform periods, random phases).
class SmoothNoise {
 public:
  SmoothNoise(Random& random, double shortest_period, double longest_period, int terms = 12);
  [[nodiscard]] double operator()(double x) const;
  /// Its derivative.
  [[nodiscard]] double slope(double x) const;

 private:
  struct Term {
    double angular_frequency;
    double phase;
  };
  std::vector<Term> terms_;
  double amplitude_;
};

}  // namespace vpdr::simulation
