#include "simulation/random.hpp"

#include <bit>
#include <cmath>
#include <cstddef>

#include "core/rotation.hpp"

namespace vpdr::simulation {

Random::Random(std::uint64_t seed, std::string_view purpose) {
  std::uint64_t x = mix_bits(seed);
  for (const char c : purpose) x = mix_bits(x ^ static_cast<unsigned char>(c));
  for (std::uint64_t& word : state_) word = x = mix_bits(x);
}

std::uint64_t Random::bits() {
  const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
  const std::uint64_t shifted = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

double Random::uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

double Random::uniform(double low, double high) { return low + (high - low) * uniform(); }

std::size_t Random::index(std::size_t count) {
  return static_cast<std::size_t>(uniform() * static_cast<double>(count));
}

bool Random::chance(double probability) { return uniform() < probability; }

double Random::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(2.0 * kPi * uniform());
}

SmoothNoise::SmoothNoise(Random& random, double shortest_period, double longest_period, int terms)
    : amplitude_(std::sqrt(2.0 / terms)) {
  terms_.reserve(static_cast<std::size_t>(terms));
  for (int i = 0; i < terms; ++i) {
    const double period =
        shortest_period * std::pow(longest_period / shortest_period, random.uniform());
    const double phase = random.uniform(0.0, 2.0 * kPi);
    terms_.push_back({2.0 * kPi / period, phase});
  }
}

double SmoothNoise::operator()(double x) const {
  double sum = 0.0;
  for (const Term& term : terms_) sum += std::cos(term.angular_frequency * x + term.phase);
  return amplitude_ * sum;
}

double SmoothNoise::slope(double x) const {
  double sum = 0.0;
  for (const Term& term : terms_) {
    sum -= term.angular_frequency * std::sin(term.angular_frequency * x + term.phase);
  }
  return amplitude_ * sum;
}

}  // namespace vpdr::simulation
