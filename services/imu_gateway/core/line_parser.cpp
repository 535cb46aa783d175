#include "imu_gateway/core/line_parser.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace vpdr::imu_gateway {
namespace {

/// A board has a few kinds of line; noise that happens to name columns must not fill the memory.
constexpr std::size_t kMostLayouts = 32;

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// Names of columns begin with a letter, numbers do not, but for "nan" and "inf".
bool looks_like_header(std::string_view line) {
  if (line.starts_with('-')) line.remove_prefix(1);
  if (line.empty() || line.starts_with("nan") || line.starts_with("inf")) return false;
  return is_letter(line.front()) || line.front() == '=';
}

bool has_single_letter_tag(const std::vector<std::string_view>& fields) {
  return fields.size() > 1 && fields.front().size() == 1 && is_letter(fields.front().front());
}

LineLayout known_layout(const std::string& columns) { return LineLayout::parse(columns).value(); }

}  // namespace

LineFormat xio_format(double field_unit_ut) {
  const std::string unit = "_uT*" + std::to_string(field_unit_ut);
  LineFormat format;
  format.layouts = {known_layout("=I,t_us,gx_dps,gy_dps,gz_dps,ax_g,ay_g,az_g"),
                    known_layout("=M,t_us,mx" + unit + ",my" + unit + ",mz" + unit),
                    known_layout("=T,t_us,temp_C")};
  format.separator = Separator::kComma;
  format.ignore_other_tags = true;
  format.checksums = false;
  return format;
}

LineVerdict LineParser::adopt_header(std::string_view line) {
  auto layout = LineLayout::parse(line, format_.separator);
  if (!layout) return LineVerdict::kMalformed;
  std::erase_if(format_.layouts,
                [&layout](const LineLayout& old) { return old.same_shape(layout.value()); });
  if (format_.layouts.size() >= kMostLayouts) return LineVerdict::kMalformed;
  format_.layouts.push_back(std::move(layout.value()));
  return LineVerdict::kHeader;
}

bool LineParser::strip_checksum(std::string_view& line) {
  if (!format_.checksums) return true;
  if (line.starts_with('$')) line.remove_prefix(1);
  const auto star = line.rfind('*');
  if (star == std::string_view::npos || line.size() - star != 3) return !checksums_seen_;
  unsigned given = 0;
  const auto [end, error] = std::from_chars(line.data() + star + 1, line.end(), given, 16);
  if (error != std::errc() || end != line.end()) return !checksums_seen_;
  line = line.substr(0, star);
  unsigned sum = 0;
  for (const char c : line) sum ^= static_cast<unsigned char>(c);
  if (sum != given) return false;
  checksums_seen_ = true;
  return true;
}

LineVerdict LineParser::parse(std::string_view line, BoardReadings& out) {
  const auto first = line.find_first_not_of("# \t");
  if (first == std::string_view::npos) return LineVerdict::kEmpty;
  line.remove_prefix(first);
  if (!strip_checksum(line) || line.empty()) return LineVerdict::kMalformed;
  split_fields(line, format_.separator, fields_);
  bool malformed = false;
  for (const LineLayout& layout : format_.layouts) {
    const LineLayout::Fit fit = layout.read(fields_, out);
    if (fit == LineLayout::Fit::kFits) return LineVerdict::kReadings;
    malformed = malformed || fit == LineLayout::Fit::kMalformed;
  }
  if (format_.ignore_other_tags) {
    const bool other = !malformed && has_single_letter_tag(fields_);
    return other ? LineVerdict::kIgnored : LineVerdict::kMalformed;
  }
  if (looks_like_header(line)) return adopt_header(line);
  const bool numbers = std::all_of(fields_.begin(), fields_.end(), [](std::string_view field) {
    return number_in(field).has_value();
  });
  return malformed || !numbers ? LineVerdict::kMalformed : LineVerdict::kUnknownLayout;
}

void TextParser::feed(std::string_view bytes, std::vector<BoardReadings>& out) {
  splitter_.feed(bytes, [&](std::string_view line) {
    BoardReadings readings;
    const LineVerdict verdict = parser_.parse(line, readings);
    if (verdict == LineVerdict::kReadings) out.push_back(readings);
    if (verdict == LineVerdict::kMalformed) ++counts_.malformed;
    if (verdict == LineVerdict::kUnknownLayout) ++counts_.unknown_layout;
    if (verdict == LineVerdict::kMalformed || verdict == LineVerdict::kUnknownLayout) {
      last_refused_.assign(line.substr(0, kShownLength));
    }
  });
  counts_.overlong = splitter_.overlong_lines();
}

}  // namespace vpdr::imu_gateway
