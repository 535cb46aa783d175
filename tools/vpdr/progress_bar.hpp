#pragma once
// A progress bar on a terminal; silent where standard error is none.
#include <string>

namespace vpdr::tool {

class ProgressBar {
 public:
  /// `title` stands before the bar.
  explicit ProgressBar(std::string title);
  /// Wipes the bar.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `share` of the work is done, 0 to 1. Draws only when the bar changes.
  void update(double share);
  /// A line on standard error, above the bar.
  void say(const std::string& line);

 private:
  std::string title_;
  bool on_terminal_;
  int drawn_percent_ = -1;
};

}  // namespace vpdr::tool
