#pragma once
// A value or the reason why there is none. For refusals off the hot path; start-up faults throw.
#include <string>
#include <utility>
#include <variant>

namespace vpdr {

/// Why something was refused: what happened, where, and the remedy, in one line.
struct Error {
  std::string message;
};

/// Holds a T or an Error. Accessing the wrong one throws std::bad_variant_access.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::move(value)) {}      // NOLINT: implicit on purpose
  Result(Error error) : content_(std::move(error)) {}  // NOLINT: implicit on purpose

  [[nodiscard]] bool has_value() const { return content_.index() == 0; }
  explicit operator bool() const { return has_value(); }
  T& value() { return std::get<0>(content_); }
  const T& value() const { return std::get<0>(content_); }
  const Error& error() const { return std::get<1>(content_); }

 private:
  std::variant<T, Error> content_;
};

/// Nothing to give but that it was done.
struct Done {};

/// Done, or the reason why not.
using Status = Result<Done>;

}  // namespace vpdr
