#include "config/binder.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <regex>
#include <sstream>

#include "config/nearest_name.hpp"

namespace vpdr::config {
namespace {

/// Shortest text that reads back as the same number, with a point or exponent.
std::string number_text(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof(buffer), value).ptr;
  std::string out(buffer, end);
  if (out.find_first_of(".en") == std::string::npos) out += ".0";
  return out;
}

template <class Number>
std::optional<Number> parse(const std::string& text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string got(const std::string& text) { return " (got " + text + ")"; }

std::string yaml_quoted(const std::string& text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string joined(const std::vector<std::string>& words, const std::string& separator) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : separator) + word;
  return out;
}

/// YAML's own spellings of what is no finite number.
bool is_yaml_non_finite(const std::string& text) {
  static const std::regex kPattern(R"(([-+]?\.(inf|Inf|INF))|\.(nan|NaN|NAN))");
  return std::regex_match(text, kPattern);
}

std::optional<std::string> check_number(const std::string& text, const Range& range,
                                        double& value) {
  if (is_yaml_non_finite(text)) return "must be a finite number" + got(text);
  const auto parsed = parse<double>(text);
  if (!parsed) return "must be a number" + got(text);
  if (!std::isfinite(*parsed)) return "must be a finite number" + got(text);
  if (!range.contains(*parsed)) return "must be " + range.text() + got(text);
  value = *parsed;
  return std::nullopt;
}

}  // namespace

bool Range::contains(double value) const {
  return (open_min ? value > min : value >= min) && (open_max ? value < max : value <= max);
}

std::string Range::text() const {
  std::vector<std::string> bounds;
  auto short_text = [](double v) {
    std::ostringstream out;
    out << v;
    return out.str();
  };
  if (std::isfinite(min)) bounds.push_back((open_min ? "> " : ">= ") + short_text(min));
  if (std::isfinite(max)) bounds.push_back((open_max ? "< " : "<= ") + short_text(max));
  return bounds.empty() ? "any number" : joined(bounds, ", ");
}

void Binder::add(const std::string& key, const std::string& unit, const std::string& range,
                 const std::string& help, Validate store, std::function<std::string()> print) {
  const std::string default_text = print();
  entries_.push_back({key, unit, range, help, default_text, std::move(store), std::move(print)});
}

void Binder::number(const std::string& key, double& field, const Range& range,
                    const std::string& unit, const std::string& help) {
  add(
      key, unit, range.text(), help,
      [&field, range](const Given& given) -> std::optional<std::string> {
        if (given.is_sequence) return "must be one number, not a list";
        return check_number(given.items.front(), range, field);
      },
      [&field] { return number_text(field); });
}

void Binder::add_integer(const std::string& key, const Range& range, const std::string& unit,
                         const std::string& help, const std::function<void(std::int64_t)>& set,
                         std::function<std::string()> print) {
  add(
      key, unit, range.text(), help,
      [set, range](const Given& given) -> std::optional<std::string> {
        if (given.is_sequence) return "must be one whole number, not a list";
        const auto parsed = parse<std::int64_t>(given.items.front());
        if (!parsed) return "must be a whole number" + got(given.items.front());
        if (!range.contains(static_cast<double>(*parsed))) {
          return "must be " + range.text() + got(given.items.front());
        }
        set(*parsed);
        return std::nullopt;
      },
      std::move(print));
}

void Binder::flag(const std::string& key, bool& field, const std::string& help) {
  add(
      key, "", "true, false", help,
      [&field](const Given& given) -> std::optional<std::string> {
        const std::string& text = given.items.empty() ? "" : given.items.front();
        if (given.is_sequence || (text != "true" && text != "false")) {
          return "must be true or false" + got(text);
        }
        field = text == "true";
        return std::nullopt;
      },
      [&field] { return std::string(field ? "true" : "false"); });
}

void Binder::text(const std::string& key, std::string& field, const std::string& help) {
  text(
      key, field, "text", [](const std::string&) { return true; }, help);
}

void Binder::text(const std::string& key, std::string& field, const std::string& rule,
                  const std::function<bool(const std::string&)>& allows, const std::string& help) {
  add(
      key, "", rule, help,
      [&field, rule, allows](const Given& given) -> std::optional<std::string> {
        if (given.is_sequence) return "must be one text, not a list";
        if (!allows(given.items.front())) {
          return "must be " + rule + got(yaml_quoted(given.items.front()));
        }
        field = given.items.front();
        return std::nullopt;
      },
      [&field] { return yaml_quoted(field); });
}

void Binder::text_list(const std::string& key, std::vector<std::string>& field,
                       const std::string& help) {
  add(
      key, "", "list of texts", help,
      [&field](const Given& given) -> std::optional<std::string> {
        if (!given.is_sequence) return "must be a list, [a, b]";
        field = given.items;
        return std::nullopt;
      },
      [&field] {
        std::vector<std::string> items;
        for (const std::string& item : field) items.push_back(yaml_quoted(item));
        return "[" + joined(items, ", ") + "]";
      });
}

void Binder::numbers(const std::string& key, double* data, std::size_t count,
                     const std::string& unit, const std::string& help) {
  add(
      key, unit, std::to_string(count) + " numbers", help,
      [data, count](const Given& given) -> std::optional<std::string> {
        if (!given.is_sequence || given.items.size() != count) {
          return "must be a list of " + std::to_string(count) + " numbers" +
                 got(std::to_string(given.items.size()));
        }
        std::vector<double> values(count);
        for (std::size_t i = 0; i < count; ++i) {
          if (auto mistake = check_number(given.items[i], any(), values[i])) return mistake;
        }
        std::copy(values.begin(), values.end(), data);
        return std::nullopt;
      },
      [data, count] {
        std::vector<std::string> items;
        for (std::size_t i = 0; i < count; ++i) items.push_back(number_text(data[i]));
        return "[" + joined(items, ", ") + "]";
      });
}

void Binder::add_choice(const std::string& key, const std::vector<std::string>& names,
                        const std::string& help, const std::function<void(std::size_t)>& set,
                        std::function<std::string()> print) {
  add(
      key, "", joined(names, ", "), help,
      [names, set](const Given& given) -> std::optional<std::string> {
        const std::string text = given.items.empty() ? "" : given.items.front();
        const auto found = std::find(names.begin(), names.end(), text);
        if (given.is_sequence || found == names.end()) {
          const std::string hint = nearest_name(text, names);
          return "must be one of " + joined(names, ", ") + got(text) +
                 (hint.empty() ? "" : "; did you mean " + hint + "?");
        }
        set(static_cast<std::size_t>(found - names.begin()));
        return std::nullopt;
      },
      std::move(print));
}

const Binder::Entry* Binder::find(const std::string& key) const {
  const auto entry = std::find_if(entries_.begin(), entries_.end(),
                                  [&key](const Entry& e) { return e.key == key; });
  return entry == entries_.end() ? nullptr : &*entry;
}

bool Binder::is_section(const std::string& key) const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [&key](const Entry& e) { return e.key.starts_with(key + "."); });
}

std::string Binder::nearest_hint(const std::string& key) const {
  std::vector<std::string> keys;
  for (const Entry& entry : entries_) keys.push_back(entry.key);
  const std::string hint = nearest_name(key, keys);
  return hint.empty() ? "; --print-config lists every key"
                      : "; did you mean " + root_ + "." + hint + "?";
}

}  // namespace vpdr::config
