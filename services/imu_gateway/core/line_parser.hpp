#pragma once
// Text lines of simple boards, such as STM32 or Arduino sketches with MPU6050 and HMC5883L:
//
//   t_s,ax_g,ay_g,az_g,gx_dps,gy_dps,gz_dps,temp_C
//   0.008463,0.052002,-0.182617,-1.01074,10.084,6.98473,-5.32061,24.7653
//
// A board may send several kinds of line, told apart by their number of columns and by texts in
// them, and may announce them by header lines like the first one above. A line may end in "*5A",
// the exclusive or of its characters (after a leading "$") in two hexadecimal digits; once a board
// has sent one right checksum, lines without are refused. Pure; a parser belongs to one thread.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "imu_gateway/core/board_parser.hpp"
#include "imu_gateway/core/line_layout.hpp"

namespace vpdr::imu_gateway {

/// What a line was.
enum class LineVerdict : std::uint8_t {
  kReadings,
  kHeader,
  kEmpty,
  kMalformed,
  kUnknownLayout,
  kIgnored
};

/// How a board's lines are to be read.
struct LineFormat {
  std::vector<LineLayout> layouts;  ///< may be empty where the board announces them by header lines
  Separator separator = Separator::kAuto;
  /// Lines that begin with a single letter and fit no layout are known and of no use here: x-io
  /// boards send quaternions, battery states and so on. Header lines are not looked for then.
  bool ignore_other_tags = false;
  bool checksums = true;  ///< false: "*5A" at the end of a line means nothing
};

/// The messages of x-io boards: "I,t_us,gx,gy,gz,ax,ay,az" in degrees per second and g,
/// "M,t_us,mx,my,mz" in units of `field_unit_ut` microtesla, "T,t_us,temperature".
LineFormat xio_format(double field_unit_ut);

/// Reads single lines and says what each was.
class LineParser {
 public:
  explicit LineParser(LineFormat format) : format_(std::move(format)) {}

  /// `line` without its end of line. Fills `out` and returns kReadings, or says why not.
  LineVerdict parse(std::string_view line, BoardReadings& out);

 private:
  LineVerdict adopt_header(std::string_view line);
  bool strip_checksum(std::string_view& line);

  LineFormat format_;
  std::vector<std::string_view> fields_;
  bool checksums_seen_ = false;
};

/// Splits a byte stream into lines, in bounded memory: an overlong line is dropped and counted.
class LineSplitter {
 public:
  explicit LineSplitter(std::size_t max_line = 512) : max_line_(max_line) {}

  /// Calls `line(std::string_view)` for each whole line in `bytes` and what came before.
  template <class Callback>
  void feed(std::string_view bytes, Callback line) {
    for (char c : bytes) {
      if (c == '\n' || c == '\r') {
        if (!overlong_ && !buffer_.empty()) line(std::string_view(buffer_));
        overlong_ = false;
        buffer_.clear();
      } else if (overlong_ || buffer_.size() == max_line_) {
        if (!overlong_) ++overlong_lines_;
        overlong_ = true;
      } else {
        buffer_ += c;
      }
    }
  }
  /// Forgets a half-read line, as after a reconnection.
  void reset() {
    buffer_.clear();
    overlong_ = false;
  }
  [[nodiscard]] std::uint64_t overlong_lines() const { return overlong_lines_; }

 private:
  std::size_t max_line_;
  std::string buffer_;
  bool overlong_ = false;
  std::uint64_t overlong_lines_ = 0;
};

/// The board that sends lines.
class TextParser : public BoardParser {
 public:
  explicit TextParser(LineFormat format) : parser_(std::move(format)) {
    last_refused_.reserve(kShownLength);
  }

  void feed(std::string_view bytes, std::vector<BoardReadings>& out) override;
  void reset() override {
    splitter_.reset();
    last_refused_.clear();
  }
  [[nodiscard]] std::string_view last_refused() const override { return last_refused_; }

 private:
  static constexpr std::size_t kShownLength = 120;

  LineSplitter splitter_;
  LineParser parser_;
  std::string last_refused_;
};

}  // namespace vpdr::imu_gateway
