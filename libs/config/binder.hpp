#pragma once
// Strict configuration: one declaration for each key gives parsing, validation, --print-config and
// the README's table. A key is bound to a field that already holds its default:
//
//   StepConfig step;
//   Binder binder("pdr");
//   binder.number("step.min_interval_s", step.min_interval_s, above(0.0), "s",
//                 "shortest time between two steps");
//   binder.load_file("pdr.yaml");                   // throws ConfigurationFault with every mistake
//   binder.assign("pdr.step.min_interval_s=0.3");   // the command line's --set
//
// Unknown, duplicate, mistyped, out-of-range and non-finite values are mistakes, all reported at
// once, as `pdr.yaml:14:5: pdr.step.min_interval_s: must be > 0 (got -1)`. Not thread-safe.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.hpp"

namespace vpdr::config {

/// Interval of allowed numbers. Ends are allowed unless marked open.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool open_min = false;
  bool open_max = false;

  [[nodiscard]] bool contains(double value) const;
  /// For people: "> 0", ">= 0, <= 1", "any number".
  [[nodiscard]] std::string text() const;
};
inline Range any() { return {}; }
inline Range above(double min) { return {.min = min, .open_min = true}; }
inline Range at_least(double min) { return {.min = min}; }
inline Range between(double min, double max) { return {.min = min, .max = max}; }
/// Between the ends, neither of them allowed.
inline Range open(double min, double max) {
  return {.min = min, .max = max, .open_min = true, .open_max = true};
}

/// Binds the keys of one service's YAML file to the fields of its configuration structs.
class Binder {
 public:
  /// `root` is the file's single top-level key, the name of the service.
  explicit Binder(std::string root) : root_(std::move(root)) {}

  void number(const std::string& key, double& field, const Range& range, const std::string& unit,
              const std::string& help);
  template <class Integer>
  void integer(const std::string& key, Integer& field, const Range& range, const std::string& unit,
               const std::string& help);
  void flag(const std::string& key, bool& field, const std::string& help);
  void text(const std::string& key, std::string& field, const std::string& help);
  /// A text that `allows` takes; `rule` says for people which those are.
  void text(const std::string& key, std::string& field, const std::string& rule,
            const std::function<bool(const std::string&)>& allows, const std::string& help);
  void text_list(const std::string& key, std::vector<std::string>& field, const std::string& help);
  /// Fixed number of finite numbers, stored through `data`.
  void numbers(const std::string& key, double* data, std::size_t count, const std::string& unit,
               const std::string& help);
  /// One of the named values of an enumeration.
  template <class Enum>
  void choice(const std::string& key, Enum& field,
              const std::vector<std::pair<std::string, Enum>>& names, const std::string& help);

  /// Reads a file over the defaults. Throws ConfigurationFault naming every mistake in it.
  void load_file(const std::filesystem::path& file);
  /// The same from text; `origin` stands for the file's name in messages.
  void load_text(const std::string& yaml, const std::string& origin);
  /// `root.key=value` or `key=value`. Throws ConfigurationFault.
  void assign(const std::string& assignment);

  /// The present values as YAML with help and units as comments; load_text takes it back.
  [[nodiscard]] std::string print_yaml() const;
  /// Markdown table: key, default as bound, unit, range, meaning.
  [[nodiscard]] std::string markdown_table() const;
  [[nodiscard]] const std::string& root() const { return root_; }

 private:
  /// What the file gave for a key: one scalar, or the items of a sequence.
  struct Given {
    std::vector<std::string> items;
    bool is_sequence = false;
  };
  struct Entry {
    std::string key;
    std::string unit;
    std::string range;
    std::string help;
    std::string default_text;
    /// Stores the value, or says what is wrong with it.
    std::function<std::optional<std::string>(const Given&)> store;
    std::function<std::string()> print;
  };
  using Validate = std::function<std::optional<std::string>(const Given&)>;
  class Loader;

  void add(const std::string& key, const std::string& unit, const std::string& range,
           const std::string& help, Validate store, std::function<std::string()> print);
  void add_integer(const std::string& key, const Range& range, const std::string& unit,
                   const std::string& help, const std::function<void(std::int64_t)>& set,
                   std::function<std::string()> print);
  void add_choice(const std::string& key, const std::vector<std::string>& names,
                  const std::string& help, const std::function<void(std::size_t)>& set,
                  std::function<std::string()> print);
  const Entry* find(const std::string& key) const;
  bool is_section(const std::string& key) const;
  std::string nearest_hint(const std::string& key) const;

  std::string root_;
  std::vector<Entry> entries_;
};

template <class Integer>
void Binder::integer(const std::string& key, Integer& field, const Range& range,
                     const std::string& unit, const std::string& help) {
  Range typed = range;
  typed.min = std::max(typed.min, static_cast<double>(std::numeric_limits<Integer>::min()));
  typed.max = std::min(typed.max, static_cast<double>(std::numeric_limits<Integer>::max()));
  add_integer(
      key, typed, unit, help, [&field](std::int64_t v) { field = static_cast<Integer>(v); },
      [&field] { return std::to_string(field); });
}

template <class Enum>
void Binder::choice(const std::string& key, Enum& field,
                    const std::vector<std::pair<std::string, Enum>>& names,
                    const std::string& help) {
  std::vector<std::string> labels;
  for (const auto& [label, value] : names) labels.push_back(label);
  add_choice(
      key, labels, help, [&field, names](std::size_t i) { field = names[i].second; },
      [&field, names] {
        for (const auto& [label, value] : names) {
          if (value == field) return label;
        }
        return std::string("?");
      });
}

}  // namespace vpdr::config
