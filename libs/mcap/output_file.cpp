#include "mcap/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace vpdr::mcap {
namespace {

std::string remedy(int code) {
  switch (code) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "; free some space or record to another disk";
    case EEXIST:
      return "; recordings are never overwritten: choose another name or move the old one away";
    case ENOENT:
      return "; create the folder first";
    case EACCES:
    case EROFS:
      return "; choose a folder that this user may write to";
    default:
      return "";
  }
}

// A file's name is on the disk only when its folder is.
void sync_folder_of(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

Result<OutputFile> OutputFile::create(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  OutputFile file(path, descriptor);
  if (descriptor < 0) return file.failure("create", errno);
  sync_folder_of(path);
  return file;
}

OutputFile::OutputFile(std::filesystem::path path, int descriptor)
    : path_(std::move(path)), descriptor_(descriptor) {}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(size_, other.size_);
  return *this;
}

OutputFile::~OutputFile() {
  if (is_open()) ::close(descriptor_);
}

Status OutputFile::append(std::span<const std::byte> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
    if (count > 0) {
      done += static_cast<std::size_t>(count);
    } else if (count == 0 || errno != EINTR) {
      const int code = count == 0 ? ENOSPC : errno;
      // Also when this fails the file is readable: its reader stops at the piece.
      static_cast<void>(shorten(size_));
      return failure("write", code);
    }
  }
  size_ += bytes.size();
  return Done{};
}

Status OutputFile::shorten(std::uint64_t size) {
  const auto offset = static_cast<off_t>(size);
  if (::ftruncate(descriptor_, offset) != 0) return failure("shorten", errno);
  if (::lseek(descriptor_, offset, SEEK_SET) != offset) return failure("seek in", errno);
  size_ = size;
  return Done{};
}

Status OutputFile::sync() {
  if (::fdatasync(descriptor_) == 0) return Done{};
  // Pipes and some virtual file systems have nothing to sync.
  return errno == EINVAL || errno == ENOTSUP ? Status(Done{}) : failure("sync", errno);
}

Status OutputFile::close() {
  if (::close(std::exchange(descriptor_, -1)) != 0) return failure("close", errno);
  return Done{};
}

Error OutputFile::failure(const char* action, int code) const {
  return Error{path_.string() + ": cannot " + action +
               " the recording: " + std::generic_category().message(code) + remedy(code)};
}

}  // namespace vpdr::mcap
