#include "mcap/source.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace vpdr::mcap {
namespace {

bool inside(std::uint64_t size, std::uint64_t offset, std::uint64_t count) {
  return offset <= size && count <= size - offset;
}

class FileSource : public Source {
 public:
  FileSource(int descriptor, std::uint64_t size) : descriptor_(descriptor), size_(size) {}
  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;
  ~FileSource() override { ::close(descriptor_); }

  [[nodiscard]] std::uint64_t size() const override { return size_; }

  [[nodiscard]] bool read(std::uint64_t offset, std::span<std::byte> out) const override {
    if (!inside(size_, offset, out.size())) return false;
    std::size_t done = 0;
    while (done < out.size()) {
      const ssize_t count = ::pread(descriptor_, out.data() + done, out.size() - done,
                                    static_cast<off_t>(offset + done));
      if (count == 0 || (count < 0 && errno != EINTR)) return false;
      if (count > 0) done += static_cast<std::size_t>(count);
    }
    return true;
  }

 private:
  int descriptor_;
  std::uint64_t size_;
};

class MemorySource : public Source {
 public:
  explicit MemorySource(std::span<const std::byte> bytes) : bytes_(bytes) {}

  [[nodiscard]] std::uint64_t size() const override { return bytes_.size(); }

  [[nodiscard]] bool read(std::uint64_t offset, std::span<std::byte> out) const override {
    if (!inside(bytes_.size(), offset, out.size())) return false;
    const auto part = bytes_.subspan(static_cast<std::size_t>(offset), out.size());
    std::copy(part.begin(), part.end(), out.begin());
    return true;
  }

 private:
  std::span<const std::byte> bytes_;
};

Error failure(const std::filesystem::path& path, const std::string& reason) {
  return Error{path.string() + ": cannot open: " + reason};
}

}  // namespace

Result<std::unique_ptr<Source>> open_file(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return failure(path, std::generic_category().message(errno));
  struct stat status {};
  const bool regular = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  if (!regular) {
    ::close(descriptor);
    return failure(path, "not a regular file");
  }
  return std::unique_ptr<Source>(
      std::make_unique<FileSource>(descriptor, static_cast<std::uint64_t>(status.st_size)));
}

std::unique_ptr<Source> open_bytes(std::span<const std::byte> bytes) {
  return std::make_unique<MemorySource>(bytes);
}

}  // namespace vpdr::mcap
