#include "evaluation/output_file.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>

#include "dataset/text_file.hpp"

namespace vpdr::evaluation {

OutputFile::OutputFile(std::filesystem::path path) : path_(std::move(path)) {
  file_ = std::fopen(path_.c_str(), "wb");
  if (file_ == nullptr) fail("cannot create: ");
}

OutputFile::~OutputFile() {
  if (file_ != nullptr) std::fclose(file_);
}

void OutputFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail("cannot write: ");
}

void OutputFile::close() {
  std::FILE* const file = file_;
  file_ = nullptr;
  if (file != nullptr && std::fclose(file) != 0) fail("cannot write: ");
}

void OutputFile::fail(const char* what) const {
  throw dataset::fault_at(path_, 0, 0, what + std::string(std::strerror(errno)),
                          "free some space or choose another folder, then run again");
}

void LineBuffer::begin() {
  if (taken_) line_.clear();
  taken_ = false;
}

LineBuffer& LineBuffer::text(std::string_view text) {
  begin();
  line_ += text;
  return *this;
}

LineBuffer& LineBuffer::integer(std::int64_t value) {
  begin();
  std::array<char, 24> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  line_.append(digits.data(), end);
  return *this;
}

LineBuffer& LineBuffer::fixed(double value, int decimals) {
  begin();
  std::array<char, 400> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                 std::chars_format::fixed, decimals)
                       .ptr;
  line_.append(digits.data(), end);
  return *this;
}

std::string_view LineBuffer::take() {
  begin();
  taken_ = true;
  return line_;
}

}  // namespace vpdr::evaluation
