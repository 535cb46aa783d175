#pragma once
// x^2, for formulas in which x is an expression.

namespace vpdr {

constexpr double square(double x) { return x * x; }

}  // namespace vpdr
