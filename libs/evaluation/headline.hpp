#pragma once
// The figures at the head of the report.
#include <string>
#include <vector>

#include "evaluation/evaluation.hpp"

namespace vpdr::evaluation {

/// One number with its name: "steps", "198", "", "true 200, error 1.0 %".
struct Headline {
  std::string name;
  std::string value;
  std::string unit;
  std::string more;
};

/// What there is to say of a run, most important first.
std::vector<Headline> headlines(const Evaluation& evaluation, const RunInfo& info);

}  // namespace vpdr::evaluation
