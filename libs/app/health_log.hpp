#pragma once
// What of a service's health is worth a line in its log: each trouble once while it lasts, and its
// end. Pure.
#include <optional>
#include <string>

#include "app/health.hpp"

namespace vpdr::app {

/// A line for the log.
struct HealthLine {
  bool warning = false;
  std::string text;
};

class HealthLog {
 public:
  /// The latest report; what to log, if anything. Numbers that change make no new trouble.
  std::optional<HealthLine> see(const Health& health);

 private:
  std::string trouble_;  ///< its letters, since numbers change; empty: none
};

}  // namespace vpdr::app
