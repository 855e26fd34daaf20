// A picture that is missing, cut or damaged is an error with its reason, and never a crash.
#include <sys/stat.h>

#include <gmock/gmock.h>

#include "image_io/read.h"
#include "image_io/tiny_files.h"
#include "image_io/write.h"

namespace rainref::image_io {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(ReadErrors, AMissingFileAFolderAndAPipeAreIoErrors) {
  const TemporaryFolder folder;
  put(folder / "file", "x");
  ASSERT_EQ(::mkfifo((folder / "pipe.png").c_str(), 0600), 0);
  const std::pair<std::filesystem::path, const char*> cases[] = {{folder / "none.exr", "No such file or directory"},
                                                                 {folder.path(), "Is a directory"},
                                                                 {folder / "file/a.exr", "Not a directory"},
                                                                 {folder / "pipe.png", "not a regular file"}};
  for (const auto& [path, reason] : cases) {
    EXPECT_EQ(error_of([&, &at = path] { read(at); }), "4 cannot read '" + path.string() + "': " + reason);
  }
}

TEST(ReadErrors, WhatIsNoPictureIsAUsageError) {
  const TemporaryFolder folder;
  const std::pair<std::string, const char*> cases[] = {
      {"", "empty file"},
      {"not a picture\n", "not an EXR, PNG, Radiance HDR or JPEG file"},
      {std::string("II*\0\x08\0\0\0", 8), "not an EXR, PNG, Radiance HDR or JPEG file"},  // TIFF
      {"#?RADIANCE\n", "a.exr"},
      {"\xff\xd8\xff", "a.exr"},
      {"\x76\x2f\x31\x01", "a.exr"},
      {"\x89PNG\r\n\x1a\n", "a.exr"}};
  for (const auto& [bytes, reason] : cases) {
    put(folder / "a.exr", bytes);
    EXPECT_THAT(error_of([&] { read(folder / "a.exr"); }),
                AllOf(StartsWith("2 "), HasSubstr((folder / "a.exr").string()), HasSubstr(reason)));
  }
}

/// Reads every beginning of a file: each must be refused as undecodable, and the whole must not.
void expect_truncation_is_noticed(const std::string& bytes, const char* what) {
  const TemporaryFolder folder;
  put(folder / "a", bytes);
  EXPECT_NO_THROW(read(folder / "a")) << what;
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    put(folder / "a", bytes.substr(0, length));
    ASSERT_THAT(error_of([&] { read(folder / "a"); }), StartsWith("2 ")) << what << ": " << length << " of " << bytes.size() << " bytes";
  }
}

TEST(ReadErrors, ATruncatedPngIsNoticedAtEveryLength) {
  std::vector<std::string> rows;
  for (int y = 0; y < 9; ++y) rows.emplace_back(21, static_cast<char>('a' + y));
  expect_truncation_is_noticed(png(7, 9, 8, 2, rows), "stored");
  const TemporaryFolder folder;
  write_png(folder / "p.png", make_image(Format::rgba8, 13, 7,
                                         [](int x, int y, int c) { return Unorm8{static_cast<std::uint8_t>(x * x * 7 + y * 13 + c)}; }));
  expect_truncation_is_noticed(contents(folder / "p.png"), "compressed");
}

TEST(ReadErrors, ATruncatedExrIsNoticedAtEveryLength) {
  const auto sample = [](int x, int y) { return raw(static_cast<float>(x + 10 * y)); };
  expect_truncation_is_noticed(exr({0, 0, 3, 4}, {{"B", ExrType::float32, sample}, {"R", ExrType::float32, sample}}), "uncompressed");
  const TemporaryFolder folder;
  const Image image = make_image(
      Format::rgba16f, 5, 18, [](int x, int y, int c) { return Half{static_cast<std::uint16_t>((x * 977 + y * 3331 + c * 71) & 0x7bff)}; });
  write_exr(folder / "p.exr", {{"", {"R", "G", "B", "A"}, &image}});
  expect_truncation_is_noticed(contents(folder / "p.exr"), "zip");
}

TEST(ReadErrors, ATruncatedHdrIsNoticedAtEveryLength) {
  std::vector<std::array<int, 4>> texels;
  for (int i = 0; i < 7 * 6; ++i) texels.push_back({i + 1, 2 * i + 1, 3 * i + 1, 130});
  expect_truncation_is_noticed(hdr(7, 6, texels), "flat");
  // Run-length rows: 02 02, the width, then each channel as one literal run.
  std::string rows = hdr(9, 4, {});
  for (int y = 0; y < 4; ++y) {
    rows += std::string("\2\2\0\x09", 4);
    for (int c = 0; c < 4; ++c) {
      rows += '\x05';
      rows += std::string(5, static_cast<char>(100 + 9 * y + c));
      rows += "\x84\x82";
    }
  }
  expect_truncation_is_noticed(rows, "runs");
}

TEST(ReadErrors, ATruncatedJpegIsNoticedAtEveryLength) { expect_truncation_is_noticed(jpeg(13), "jpeg"); }

TEST(ReadErrors, DamagedBytesNeverCrash) {
  const auto sample = [](int x, int y) { return raw(static_cast<float>(x + 10 * y)); };
  const std::string files[] = {
      png(4, 3, 8, 2, {std::string(12, 'a'), std::string(12, 'b'), std::string(12, 'c')}),
      exr({0, 0, 3, 4}, {{"B", ExrType::float32, sample}, {"R", ExrType::half, [](int, int) { return raw(std::uint16_t{7}); }}}),
      hdr(2, 2, {{1, 2, 3, 130}, {4, 5, 6, 130}, {7, 8, 9, 130}, {1, 1, 1, 130}}), jpeg(2)};
  const TemporaryFolder folder;
  ::testing::internal::CaptureStderr();  // libpng says there what it finds
  for (const std::string& file : files) {
    for (std::size_t i = 0; i < file.size(); ++i) {
      for (const int flip : {0x01, 0xff}) {
        std::string bytes = file;
        bytes[i] = static_cast<char>(bytes[i] ^ flip);
        put(folder / "a", bytes);
        EXPECT_THAT(error_of([&] { read(folder / "a"); }), AnyOf("none", StartsWith("2 ")));
      }
    }
  }
  ::testing::internal::GetCapturedStderr();
}

}  // namespace
}  // namespace rainref::image_io
