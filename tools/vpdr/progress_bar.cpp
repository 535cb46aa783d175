#include "vpdr/progress_bar.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace vpdr::tool {
namespace {
constexpr int kWidth = 40;
}

ProgressBar::ProgressBar(std::string title)
    : title_(std::move(title)), on_terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (drawn_percent_ >= 0) std::fputs("\r\033[K", stderr);
}

void ProgressBar::say(const std::string& line) {
  const char* const wipe = drawn_percent_ >= 0 ? "\r\033[K" : "";
  std::fprintf(stderr, "%s%s\n", wipe, line.c_str());
  drawn_percent_ = -1;
}

void ProgressBar::update(double share) {
  const int percent = static_cast<int>(100.0 * std::clamp(share, 0.0, 1.0));
  if (!on_terminal_ || percent == drawn_percent_) return;
  drawn_percent_ = percent;
  const int filled = kWidth * percent / 100;
  const std::string bar = std::string(filled, '#') + std::string(kWidth - filled, '.');
  std::fprintf(stderr, "\r%s [%s] %3d %%", title_.c_str(), bar.c_str(), percent);
  std::fflush(stderr);
}

}  // namespace vpdr::tool
