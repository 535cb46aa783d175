#include "vision/source/image_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <vector>

namespace vpdr::vision {
namespace {

using Bytes = std::vector<std::uint8_t>;

// Writers may pad a file; no more than this lies behind the end mark.
constexpr std::size_t kPadding = 1024;

bool begins_with(const Bytes& bytes, std::initializer_list<std::uint8_t> mark) {
  return bytes.size() >= mark.size() && std::equal(mark.begin(), mark.end(), bytes.begin());
}

bool ends_with(const Bytes& bytes, std::initializer_list<std::uint8_t> mark) {
  const auto from =
      bytes.end() - static_cast<std::ptrdiff_t>(std::min(bytes.size(), kPadding + mark.size()));
  return std::search(from, bytes.end(), mark.begin(), mark.end()) != bytes.end();
}

bool is_torn(const Bytes& bytes) {
  if (begins_with(bytes, {0xFF, 0xD8})) return !ends_with(bytes, {0xFF, 0xD9});
  if (begins_with(bytes, {0x89, 'P', 'N', 'G'})) return !ends_with(bytes, {'I', 'E', 'N', 'D'});
  return false;
}

constexpr const char* kFileRemedy = "take it out of the recording or copy it again";

Error refusal(const std::string& name, const char* what, const char* remedy) {
  return {name + ": " + what + "; " + remedy};
}

}  // namespace

Result<cv::Mat> read_image(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return refusal(file.string(), "image cannot be opened", kFileRemedy);
  const Bytes bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  return decode_image(bytes, file.string(), kFileRemedy);
}

Result<cv::Mat> decode_image(const Bytes& bytes, const std::string& name, const char* remedy) {
  if (bytes.empty()) return refusal(name, "image is empty", remedy);
  if (is_torn(bytes)) return refusal(name, "image is torn, its end is missing", remedy);
  cv::Mat image;
  try {
    image = cv::imdecode(bytes, cv::IMREAD_GRAYSCALE);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.empty()) return refusal(name, "image does not decode", remedy);
  return image;
}

}  // namespace vpdr::vision
