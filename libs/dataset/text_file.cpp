#include "dataset/text_file.hpp"

#include <lzma.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

namespace vpdr::dataset {
namespace {

constexpr std::size_t kChunkBytes = 1 << 16;
constexpr std::size_t kMaxTextBytes = std::size_t{4} << 30;

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using FileHandle = std::unique_ptr<std::FILE, FileCloser>;

FileHandle open_for_reading(const std::filesystem::path& file) {
  FileHandle handle(std::fopen(file.c_str(), "rb"));
  if (!handle) {
    throw fault_at(file, 0, 0, std::string("cannot open: ") + std::strerror(errno),
                   "check the path and its permissions");
  }
  return handle;
}

std::size_t read_chunk(std::FILE* handle, const std::filesystem::path& file, std::uint8_t* into) {
  const std::size_t n = std::fread(into, 1, kChunkBytes, handle);
  if (n == 0 && std::ferror(handle) != 0) {
    throw fault_at(file, 0, 0, std::string("cannot read: ") + std::strerror(errno),
                   "check the disk; is it a file?");
  }
  return n;
}

void append(std::string& text, const std::uint8_t* data, std::size_t n,
            const std::filesystem::path& file) {
  if (text.size() + n > kMaxTextBytes) {
    throw fault_at(file, 0, 0, "holds more than 4 GiB of text", "split the recording");
  }
  text.append(reinterpret_cast<const char*>(data), n);
}

/// An lzma stream that frees itself.
class XzDecoder {
 public:
  explicit XzDecoder(const std::filesystem::path& file) {
    if (lzma_stream_decoder(&stream_, UINT64_MAX, LZMA_CONCATENATED) != LZMA_OK) {
      throw fault_at(file, 0, 0, "cannot start the xz decoder", "free some memory");
    }
  }
  ~XzDecoder() { lzma_end(&stream_); }
  XzDecoder(const XzDecoder&) = delete;
  XzDecoder& operator=(const XzDecoder&) = delete;
  lzma_stream* operator->() { return &stream_; }
  lzma_ret code(lzma_action action) { return lzma_code(&stream_, action); }

 private:
  lzma_stream stream_ = LZMA_STREAM_INIT;
};

void read_xz(std::FILE* handle, TextFile& result) {
  XzDecoder decoder(result.file);
  std::vector<std::uint8_t> input(kChunkBytes);
  std::vector<std::uint8_t> output(kChunkBytes);
  lzma_action action = LZMA_RUN;
  for (;;) {
    if (decoder->avail_in == 0 && action == LZMA_RUN) {
      decoder->next_in = input.data();
      decoder->avail_in = read_chunk(handle, result.file, input.data());
      if (decoder->avail_in == 0) action = LZMA_FINISH;
    }
    decoder->next_out = output.data();
    decoder->avail_out = output.size();
    const lzma_ret state = decoder.code(action);
    append(result.text, output.data(), output.size() - decoder->avail_out, result.file);
    if (state == LZMA_STREAM_END) return;
    if (state == LZMA_BUF_ERROR && action == LZMA_FINISH) {
      result.ends_early = true;
      return;
    }
    if (state != LZMA_OK && state != LZMA_BUF_ERROR) {
      throw fault_at(result.file, 0, 0,
                     state == LZMA_FORMAT_ERROR ? "is not an xz file" : "the xz data are damaged",
                     "check it with 'xz -t' and fetch it again");
    }
  }
}

void read_plain(std::FILE* handle, TextFile& result) {
  std::vector<std::uint8_t> chunk(kChunkBytes);
  while (const std::size_t n = read_chunk(handle, result.file, chunk.data())) {
    append(result.text, chunk.data(), n, result.file);
  }
}

}  // namespace

std::optional<std::filesystem::path> find_plain_or_xz(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) return path;
  std::filesystem::path packed = path;
  packed += ".xz";
  if (std::filesystem::is_regular_file(packed, ignored)) return packed;
  return std::nullopt;
}

TextFile read_text_file(const std::filesystem::path& file) {
  TextFile result{file, {}, false};
  const FileHandle handle = open_for_reading(file);
  if (file.extension() == ".xz") {
    read_xz(handle.get(), result);
  } else {
    read_plain(handle.get(), result);
  }
  // Spreadsheets begin UTF-8 with a mark that no one sees and no reader needs.
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (result.text.starts_with(kByteOrderMark)) result.text.erase(0, kByteOrderMark.size());
  return result;
}

FileFault fault_at(const std::filesystem::path& file, std::uint64_t line, std::uint64_t column,
                   std::string_view what, std::string_view remedy) {
  std::string text = file.string();
  if (line > 0) text += ":" + std::to_string(line);
  if (line > 0 && column > 0) text += ":" + std::to_string(column);
  text += ": ";
  text += what;
  text += "; ";
  text += remedy;
  return FileFault(text);
}

}  // namespace vpdr::dataset
