#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lzma.h>

#include "dataset/text_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace vpdr::dataset {
namespace {

using ::testing::HasSubstr;

std::string packed(const std::string& text) {
  std::string out(lzma_stream_buffer_bound(text.size()), '\0');
  std::size_t used = 0;
  const lzma_ret state = lzma_easy_buffer_encode(
      6, LZMA_CHECK_CRC64, nullptr, reinterpret_cast<const std::uint8_t*>(text.data()), text.size(),
      reinterpret_cast<std::uint8_t*>(out.data()), &used, out.size());
  EXPECT_EQ(state, LZMA_OK);
  out.resize(used);
  return out;
}

std::string long_text() {
  std::string text;
  for (int i = 0; i < 40000; ++i) text += std::to_string(i * 7919) + "\n";
  return text;
}

TEST(TextFile, LeavesOutAByteOrderMark) {
  const testing::TemporaryFolder folder;
  const std::string marked = "\xEF\xBB\xBF#timestamp [ns],a\n";
  EXPECT_EQ(read_text_file(folder.write("a.csv", marked)).text, "#timestamp [ns],a\n");
  EXPECT_EQ(read_text_file(folder.write("b.csv.xz", packed(marked))).text, "#timestamp [ns],a\n");
  EXPECT_EQ(read_text_file(folder.write("c.csv", "\xEF\xBB")).text, "\xEF\xBB");
}

TEST(TextFile, ReadsPlainAndPackedAlike) {
  const testing::TemporaryFolder folder;
  const std::string text = long_text();
  const auto plain = read_text_file(folder.write("a.csv", text));
  const auto xz = read_text_file(folder.write("b.csv.xz", packed(text)));
  EXPECT_EQ(plain.text, text);
  EXPECT_EQ(xz.text, text);
  EXPECT_FALSE(xz.ends_early);
}

TEST(TextFile, KeepsWhatATornXzStreamStillHolds) {
  const testing::TemporaryFolder folder;
  const std::string whole = packed(long_text());
  const auto torn = read_text_file(folder.write("b.csv.xz", whole.substr(0, whole.size() / 2)));
  EXPECT_TRUE(torn.ends_early);
  EXPECT_GT(torn.text.size(), 1000U);
  EXPECT_TRUE(long_text().starts_with(torn.text));
}

TEST(TextFile, NamesDamagedAndMissingFiles) {
  const testing::TemporaryFolder folder;
  std::string damaged = packed(long_text());
  for (std::size_t i = 40; i < 80; ++i) damaged[i] = static_cast<char>(damaged[i] ^ 0x5a);
  const auto message = [](const std::filesystem::path& file) -> std::string {
    try {
      read_text_file(file);
    } catch (const FileFault& fault) {
      return fault.what();
    }
    return "no fault";
  };
  EXPECT_THAT(message(folder.write("d.csv.xz", damaged)), HasSubstr("the xz data are damaged"));
  EXPECT_THAT(message(folder.write("n.csv.xz", "plain text, not xz")),
              HasSubstr("is not an xz file"));
  EXPECT_THAT(message(folder.path() / "absent.csv"), HasSubstr("absent.csv: cannot open"));
}

TEST(TextFile, FindsTheXzWhereThePlainFileIsAbsent) {
  const testing::TemporaryFolder folder;
  EXPECT_FALSE(find_plain_or_xz(folder.path() / "a.csv"));
  folder.write("a.csv.xz", packed("x"));
  EXPECT_EQ(find_plain_or_xz(folder.path() / "a.csv"), folder.path() / "a.csv.xz");
  folder.write("a.csv", "x");
  EXPECT_EQ(find_plain_or_xz(folder.path() / "a.csv"), folder.path() / "a.csv");
}

}  // namespace
}  // namespace vpdr::dataset
