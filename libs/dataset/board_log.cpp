#include "dataset/board_log.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "core/rotation.hpp"
#include "core/samples.hpp"
#include "dataset/decimal_time.hpp"
#include "dataset/text_file.hpp"

namespace vpdr::dataset {
namespace {

/// Between two logs that were written at different times.
constexpr TimestampNs kPauseNs = 60 * kNsPerSecond;

enum class Quantity : std::uint8_t { kSkip, kTime, kForce, kRate, kField, kTemperature };

struct Column {
  Quantity quantity = Quantity::kSkip;
  int axis = 0;
  double factor = 1.0;  ///< to SI, microtesla, degrees Celsius; of the time: to seconds
};

struct Unit {
  Quantity quantity;
  std::string_view name;
  double factor;
};
constexpr std::array<Unit, 14> kUnits{{{Quantity::kTime, "s", 1.0},
                                       {Quantity::kTime, "ms", 1e-3},
                                       {Quantity::kTime, "us", 1e-6},
                                       {Quantity::kTime, "ns", 1e-9},
                                       {Quantity::kForce, "g", kGravityMps2},
                                       {Quantity::kForce, "mps2", 1.0},
                                       {Quantity::kForce, "m/s^2", 1.0},
                                       {Quantity::kRate, "dps", kPi / 180.0},
                                       {Quantity::kRate, "deg/s", kPi / 180.0},
                                       {Quantity::kRate, "radps", 1.0},
                                       {Quantity::kRate, "rad/s", 1.0},
                                       {Quantity::kField, "G", 100.0},
                                       {Quantity::kField, "mG", 0.1},
                                       {Quantity::kField, "uT", 1.0}}};

std::optional<double> factor_of(Quantity quantity, std::string_view unit) {
  for (const Unit& known : kUnits) {
    if (known.quantity == quantity && known.name == unit) return known.factor;
  }
  return std::nullopt;
}

std::vector<std::string_view> fields_of(std::string_view line, std::string_view separators) {
  std::vector<std::string_view> fields;
  const bool blanks = separators.find(' ') != std::string_view::npos;
  std::size_t begin = 0;
  while (begin <= line.size()) {
    const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
    std::string_view field = line.substr(begin, end - begin);
    begin = end + 1;
    while (!field.empty() && field.front() == ' ') field.remove_prefix(1);
    while (!field.empty() && (field.back() == ' ' || field.back() == '\r')) field.remove_suffix(1);
    if (!(blanks && field.empty())) fields.push_back(field);
  }
  return fields;
}

std::optional<Column> vector_column(Quantity quantity, char axis, std::string_view unit) {
  const std::optional<double> factor = factor_of(quantity, unit);
  const int index = axis >= 'x' ? axis - 'x' : axis - 'X';
  if (!factor || index < 0 || index > 2) return std::nullopt;
  return Column{quantity, index, *factor};
}

/// "ax_g", "t_ms", "temp_C".
std::optional<Column> board_column(std::string_view name) {
  if (name == "temp_C") return Column{Quantity::kTemperature, 0, 1.0};
  if (name.starts_with("skip") || name.starts_with("p_")) return Column{};
  const auto underscore = name.find('_');
  if (underscore == std::string_view::npos) return std::nullopt;
  const std::string_view unit = name.substr(underscore + 1);
  if (underscore == 1 && name[0] == 't') {
    const std::optional<double> factor = factor_of(Quantity::kTime, unit);
    if (factor) return Column{Quantity::kTime, 0, *factor};
  }
  if (underscore != 2) return std::nullopt;
  if (name[0] == 'a') return vector_column(Quantity::kForce, name[1], unit);
  if (name[0] == 'g') return vector_column(Quantity::kRate, name[1], unit);
  if (name[0] == 'm') return vector_column(Quantity::kField, name[1], unit);
  return std::nullopt;
}

/// "Gyroscope X (deg/s)", "Time (s)".
std::optional<Column> worded_column(std::string_view name) {
  const auto open = name.find(" (");
  if (open == std::string_view::npos || open < 2 || !name.ends_with(')')) return std::nullopt;
  const std::string_view words = name.substr(0, open);
  const std::string_view unit = name.substr(open + 2, name.size() - open - 3);
  if (words == "Time") {
    const std::optional<double> factor = factor_of(Quantity::kTime, unit);
    if (factor) return Column{Quantity::kTime, 0, *factor};
  }
  if (words.starts_with("Accelerometer ")) {
    return vector_column(Quantity::kForce, words.back(), unit);
  }
  if (words.starts_with("Gyroscope ")) return vector_column(Quantity::kRate, words.back(), unit);
  if (words.starts_with("Magnetometer ")) {
    return vector_column(Quantity::kField, words.back(), unit);
  }
  if (words.starts_with("Temperature")) return Column{Quantity::kTemperature, 0, 1.0};
  return std::nullopt;
}

/// Of a log without a header: its sensor by the file's name.
std::vector<Column> columns_by_name(const std::filesystem::path& file) {
  const std::string name = file.stem().string();
  Quantity quantity = Quantity::kSkip;
  if (name.starts_with("acc")) quantity = Quantity::kForce;
  if (name.starts_with("gyr")) quantity = Quantity::kRate;
  if (name.starts_with("mag")) quantity = Quantity::kField;
  if (quantity == Quantity::kSkip) {
    throw fault_at(file, 1, 1, "no header line",
                   "put one first, as t_s,ax_g,ay_g,az_g, or name the file accelerometer, "
                   "gyroscope or magnetometer");
  }
  return {{Quantity::kTime, 0, 1.0}, {quantity, 0, 1.0}, {quantity, 1, 1.0}, {quantity, 2, 1.0}};
}

/// Rows of one log, put into their streams.
class LogReader {
 public:
  LogReader(std::filesystem::path file, std::string_view text) : file_(std::move(file)) {
    std::size_t line_number = 0;
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      const std::string_view line = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      ++line_number;
      if (line.find_first_not_of(" \t\r") != std::string_view::npos) take(line, line_number);
    }
    if (rows_ == log_.refused_rows) {
      throw fault_at(file_, 0, 0, "no row can be read", "expected numbers below a header line");
    }
  }

  BoardLog take_log() { return std::move(log_); }

 private:
  void take(std::string_view line, std::size_t number) {
    if (columns_.empty()) {
      separators_ = line.find_first_of(",;\t") != std::string_view::npos ? ",;\t" : " ";
      const std::string_view digits = "0123456789.-+";
      if (digits.find(line[line.find_first_not_of(' ')]) == std::string_view::npos) {
        return read_header(line, number);
      }
      columns_ = columns_by_name(file_);
    }
    ++rows_;
    if (!read_row(fields_of(line, separators_))) ++log_.refused_rows;
  }

  void read_header(std::string_view line, std::size_t number) {
    if (line.front() == '#') line.remove_prefix(1);
    for (const std::string_view name : fields_of(line, separators_)) {
      std::optional<Column> column = board_column(name);
      if (!column) column = worded_column(name);
      if (!column) {
        throw fault_at(file_, number, 1, "unknown column '" + std::string(name) + "'",
                       "call it skip, or name quantity and unit as in t_ms, ax_g, gx_dps, mx_uT");
      }
      columns_.push_back(*column);
    }
    const bool has_time = std::any_of(columns_.begin(), columns_.end(), [](const Column& c) {
      return c.quantity == Quantity::kTime;
    });
    if (!has_time) {
      throw fault_at(file_, number, 1, "no column of the time", "add one: t_s, t_ms, t_us or t_ns");
    }
  }

  bool read_row(const std::vector<std::string_view>& fields) {
    if (fields.size() < columns_.size()) return false;
    TimestampNs stamp_ns = 0;
    std::array<Eigen::Vector3d, 3> vectors;
    std::array<bool, 3> has{};
    std::optional<double> celsius;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Column& column = columns_[i];
      if (column.quantity == Quantity::kSkip) continue;
      double value = 0.0;
      const std::string_view field = fields[i];
      const auto parsed = std::from_chars(field.data(), field.data() + field.size(), value);
      if (parsed.ec != std::errc{} || parsed.ptr != field.data() + field.size()) return false;
      if (!std::isfinite(value)) return false;
      if (column.quantity == Quantity::kTime) {
        const auto exact = column.factor == 1.0 ? parse_decimal_seconds(field) : std::nullopt;
        stamp_ns = exact.value_or(std::llround(value * column.factor * 1e9));
      } else if (column.quantity == Quantity::kTemperature) {
        celsius = value;
      } else {
        const auto sensor =
            static_cast<std::size_t>(column.quantity) - static_cast<std::size_t>(Quantity::kForce);
        vectors[sensor][column.axis] = value * column.factor;
        has[sensor] = true;
      }
    }
    if (last_ns_ && stamp_ns <= *last_ns_) return false;
    last_ns_ = stamp_ns;
    SensorStreams& out = log_.streams;
    if (has[0]) out.force_mps2.push_back({stamp_ns, vectors[0]});
    if (has[1]) out.rate_radps.push_back({stamp_ns, vectors[1]});
    if (has[2]) out.field_ut.push_back({stamp_ns, vectors[2]});
    if (celsius) out.temperature_c.push_back({stamp_ns, *celsius});
    return true;
  }

  std::filesystem::path file_;
  std::string_view separators_;
  std::vector<Column> columns_;
  std::optional<TimestampNs> last_ns_;
  std::uint64_t rows_ = 0;
  BoardLog log_;
};

template <class Sample>
void append(const std::vector<Sample>& from, TimestampNs shift_ns, std::vector<Sample>& to) {
  for (Sample sample : from) {
    sample.stamp_ns += shift_ns;
    to.push_back(sample);
  }
}

template <class Visit>
void for_each_stream(const SensorStreams& streams, Visit visit) {
  visit(streams.force_mps2);
  visit(streams.rate_radps);
  visit(streams.field_ut);
  visit(streams.temperature_c);
}

bool overlaps(const SensorStreams& session, const SensorStreams& more) {
  return (!session.force_mps2.empty() && !more.force_mps2.empty()) ||
         (!session.rate_radps.empty() && !more.rate_radps.empty()) ||
         (!session.field_ut.empty() && !more.field_ut.empty());
}

}  // namespace

BoardLog read_board_log(const std::filesystem::path& file) {
  const TextFile text = read_text_file(find_plain_or_xz(file).value_or(file));
  return LogReader(file, text.text).take_log();
}

BoardLog read_board_logs(const std::vector<std::filesystem::path>& files) {
  BoardLog out;
  SensorStreams session;  // what the present session holds, on its own clock
  TimestampNs shift_ns = 0;
  TimestampNs latest_ns = 0;
  for (const std::filesystem::path& file : files) {
    const BoardLog log = read_board_log(file);
    if (overlaps(session, log.streams)) {
      session = {};
      TimestampNs first_ns = std::numeric_limits<TimestampNs>::max();
      for_each_stream(log.streams, [&](const auto& stream) {
        if (!stream.empty()) first_ns = std::min(first_ns, stream.front().stamp_ns);
      });
      shift_ns = latest_ns + kPauseNs - first_ns;
    }
    append(log.streams.force_mps2, 0, session.force_mps2);
    append(log.streams.rate_radps, 0, session.rate_radps);
    append(log.streams.field_ut, 0, session.field_ut);
    append(log.streams.force_mps2, shift_ns, out.streams.force_mps2);
    append(log.streams.rate_radps, shift_ns, out.streams.rate_radps);
    append(log.streams.field_ut, shift_ns, out.streams.field_ut);
    append(log.streams.temperature_c, shift_ns, out.streams.temperature_c);
    for_each_stream(log.streams, [&](const auto& stream) {
      if (!stream.empty()) latest_ns = std::max(latest_ns, stream.back().stamp_ns + shift_ns);
    });
    out.refused_rows += log.refused_rows;
  }
  return out;
}

}  // namespace vpdr::dataset
