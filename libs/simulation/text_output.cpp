#include "simulation/text_output.hpp"

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/errors.hpp"

namespace vpdr::simulation {

void cannot_write(const std::filesystem::path& file, const std::string& reason) {
  throw FileFault(file.string() + ": cannot be written: " + reason +
                  "; free some space or choose another folder");
}

TextOutput::TextOutput(const std::filesystem::path& file)
    : path_(file), file_(std::fopen(file.c_str(), "wb")) {
  if (file_ == nullptr) cannot_write(path_, std::strerror(errno));
}

TextOutput::~TextOutput() {
  if (file_ != nullptr) std::fclose(file_);
}

void TextOutput::print(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  // NOLINTNEXTLINE(clang-analyzer-valist.Uninitialized): clang 14 overlooks va_start above
  const int written = std::vfprintf(file_, format, arguments);
  va_end(arguments);
  if (written < 0) cannot_write(path_, std::strerror(errno));
}

void TextOutput::finish() {
  std::FILE* file = std::exchange(file_, nullptr);
  if (std::fclose(file) != 0) cannot_write(path_, std::strerror(errno));
}

}  // namespace vpdr::simulation
