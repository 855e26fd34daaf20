// Kept images are those that were made, or they are made anew.
#include "cache/kept_images.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

#include <gtest/gtest.h>

#include "base/hash.h"
#include "base/read_file.h"
#include "base/temporary_folder.h"
#include "cache/program.h"
#include "image/flipped.h"
#include "image/images.h"

namespace rainref::cache {
namespace {

namespace fs = std::filesystem;

const std::vector<Shape> shapes{{Format::rgba32f, 33, 7}, {Format::r16f, 33, 7}, {Format::r8, 33, 0}};
std::vector<Image> pattern(int shift) {
  std::vector<Image> all;
  for (const Format format : {Format::rgba32f, Format::r16f, Format::r8}) {
    Image& image = all.emplace_back(format, 33, 7);
    for (int y = 0; y < 7; ++y)
      for (int x = 0; x < 33 * info(format).texel_bytes(); ++x) image.row_bytes(y)[x] = static_cast<std::byte>(x * 5 + y * 3 + shift);
  }
  return all;
}
bool same(const std::vector<Image>& a, const std::vector<Image>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Image& x, const Image& y) { return rainref::same(x, y); });
}

class KeptImages : public testing::Test {
 protected:
  KeptImages() { keep_in(folder / "kept"); }
  ~KeptImages() override { keep_in({}); }
  std::vector<Image> get(double number) {
    return images(Recipe("pattern").add({number}), shapes, [&] {
      ++made;
      return pattern(static_cast<int>(number));
    });
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> all;
    if (fs::exists(folder / "kept"))
      for (const auto& entry : fs::directory_iterator(folder / "kept")) all.push_back(entry.path());
    return all;
  }
  TemporaryFolder folder;
  int made = 0;
};

TEST_F(KeptImages, AreReadWhoeverMakesTheirMemoryReady) {
  get(1);
  std::vector<int> asked;
  const Rows one_by_one = [&](int count, const std::function<void(int, int)>& body) {
    for (int y = count; y-- > 0;) asked.push_back(y), body(y, y + 1);
  };
  const std::vector<Image> read = images(
      Recipe("pattern").add({1.0}), shapes, [&] { return pattern(++made); }, one_by_one);
  EXPECT_TRUE(same(read, pattern(1)));
  EXPECT_EQ(made, 1);
  EXPECT_EQ(asked.size(), 3u * 7u);
}

TEST(Program, ItsHashIsThatOfItsFile) {
  const std::vector<std::byte> file = read_file("/proc/self/exe");
  ASSERT_GT(file.size(), std::size_t{1} << 17);  // several pieces, the last one short
  ASSERT_TRUE(program_hash());
  EXPECT_EQ(*program_hash(), file_hash(file));
}

TEST_F(KeptImages, AreMadeOnceAndReadAfterwards) {
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(same(get(1), pattern(1)));
  EXPECT_EQ(made, 1);
  EXPECT_EQ(files().size(), 1u);
}
TEST_F(KeptImages, AnotherRecipeIsAnotherFile) {
  ASSERT_TRUE(same(get(1), pattern(1)));
  ASSERT_TRUE(same(get(2), pattern(2)));
  ASSERT_TRUE(same(images(Recipe("other").add({1.0}), shapes, [] { return pattern(9); }), pattern(9)));
  // Numbers do not run into the name or into one another.
  EXPECT_NE(Recipe("a").add({1.0, 2.0}).text(), Recipe("a").add({2.0, 1.0}).text());
  EXPECT_NE(Recipe("ab").text(), Recipe("a").text() + "b");
  EXPECT_EQ(made, 2);
  EXPECT_EQ(files().size(), 3u);
}
TEST_F(KeptImages, NowhereUnlessAFolderIsSaid) {
  keep_in({});
  ASSERT_TRUE(same(get(1), pattern(1)));
  ASSERT_TRUE(same(get(1), pattern(1)));
  EXPECT_EQ(made, 2);
  EXPECT_TRUE(files().empty());
}
TEST_F(KeptImages, ADamagedFileIsMadeAnew) {
  get(1);
  const fs::path file = files().at(0);
  std::string whole(fs::file_size(file), '\0');
  std::ifstream(file, std::ios::binary).read(whole.data(), static_cast<std::streamsize>(whole.size()));
  const auto expect_anew = [&](const std::string& text, const std::string& what) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
    const int before = made;
    ASSERT_TRUE(same(get(1), pattern(1))) << what;
    ASSERT_EQ(made, before + 1) << what;
    ASSERT_EQ(fs::file_size(file), whole.size()) << what;
  };
  for (std::size_t k = 0; k < whole.size(); k += k < 200 ? 1 : 97) {
    std::string damaged = whole;
    damaged[k] = static_cast<char>(damaged[k] ^ 0x41);
    expect_anew(damaged, "byte " + std::to_string(k));
  }
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{1}, std::size_t{39}, std::size_t{40}, std::size_t{100}, whole.size() - 1})
    expect_anew(whole.substr(0, bytes), std::to_string(bytes) + " bytes");
  expect_anew(whole + "x", "one byte more");
}
// Who may write a file may give it a hash that fits. So only files that this user alone may write count.
TEST_F(KeptImages, OfOthersAreMadeAnew) {
  get(1);
  const fs::path file = files().at(0);
  const auto mode = [&] { return fs::status(file).permissions(); };
  EXPECT_EQ(mode(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(fs::status(folder / "kept").permissions(), fs::perms::owner_all);
  for (const fs::perms others : {fs::perms::group_write, fs::perms::others_write}) {
    fs::permissions(file, others, fs::perm_options::add);
    const int before = made;
    ASSERT_TRUE(same(get(1), pattern(1)));
    EXPECT_EQ(made, before + 1);
    EXPECT_EQ(mode(), fs::perms::owner_read | fs::perms::owner_write) << "made anew";
  }
  fs::rename(file, folder / "elsewhere");
  fs::create_symlink(folder / "elsewhere", file);
  get(1);
  EXPECT_EQ(made, 4);
  get(1);
  EXPECT_EQ(made, 4);
  if (::geteuid() != 0) return;  // who else may give files away
  ASSERT_EQ(::chown(file.c_str(), 65534, 65534), 0);
  ASSERT_TRUE(same(get(1), pattern(1)));
  EXPECT_EQ(made, 5);
}
// A file of this program and recipe whose hash is right, and that holds other images than the caller goes on with.
TEST_F(KeptImages, OfAnotherCountFormatOrSizeAreMadeAnew) {
  get(1);
  const fs::path file = files().at(0);
  std::string whole(fs::file_size(file), '\0');
  std::ifstream(file, std::ios::binary).read(whole.data(), static_cast<std::streamsize>(whole.size()));
  std::uint32_t recipe_bytes = 0;
  std::memcpy(&recipe_bytes, &whole[32], sizeof recipe_bytes);
  const std::string recipe = whole.substr(40, recipe_bytes);
  const auto forge = [&](std::vector<Image> all) {
    std::string body = recipe;
    const auto put = [&](const void* from, std::size_t bytes) { body.append(static_cast<const char*>(from), bytes); };
    for (const Image& i : all) {
      const std::uint32_t head[3] = {static_cast<std::uint32_t>(i.format()), static_cast<std::uint32_t>(i.width()),
                                     static_cast<std::uint32_t>(i.height())};
      put(head, sizeof head);
    }
    for (const Image& i : all)
      for (int y = 0; y < i.height(); ++y) put(i.row_bytes(y), static_cast<std::size_t>(i.width()) * info(i.format()).texel_bytes());
    const Hash128 hash = file_hash(std::as_bytes(std::span(body)));
    const auto count = static_cast<std::uint32_t>(all.size());
    std::string head = whole.substr(0, 40);
    std::memcpy(&head[16], &hash.high, 8);
    std::memcpy(&head[24], &hash.low, 8);
    std::memcpy(&head[36], &count, 4);
    std::ofstream(file, std::ios::binary | std::ios::trunc) << head << body;
  };
  forge(pattern(2));
  EXPECT_TRUE(same(get(1), pattern(2))) << "forged as they should be they are taken";
  EXPECT_EQ(made, 1);
  const auto expect_anew = [&](std::vector<Image> all) {
    forge(std::move(all));
    const int before = made;
    ASSERT_TRUE(same(get(1), pattern(1)));
    EXPECT_EQ(made, before + 1);
  };
  expect_anew({});
  for (std::size_t count : {1, 2, 4}) {
    std::vector<Image> all = pattern(1);
    all.resize(std::min(count, all.size()));
    if (count == 4) all.push_back(copy_of(all[0]));
    expect_anew(std::move(all));
  }
  const auto with_second = [](Format format, int width, int height) {
    std::vector<Image> all = pattern(1);
    all[1] = Image(format, width, height);
    return all;
  };
  expect_anew(with_second(Format::r16f, 1, 1));
  expect_anew(with_second(Format::r16f, 7, 33));
  expect_anew(with_second(Format::r16f, 33, 8));
  expect_anew(with_second(Format::r8, 33, 7));
}
TEST_F(KeptImages, ThoseUsedLongestAgoGiveWay) {
  get(1);
  const std::uintmax_t bytes = fs::file_size(files().at(0));
  keep_in(folder / "kept", 2 * bytes + 1);
  const auto age = [&] {  // file times may be coarse
    for (const fs::path& file : files()) fs::last_write_time(file, fs::last_write_time(file) - std::chrono::hours(1));
  };
  age();
  get(2);
  age();
  get(1);  // used again
  get(3);
  EXPECT_EQ(files().size(), 2u);
  made = 0;
  get(1);
  get(3);
  EXPECT_EQ(made, 0);
  get(2);
  EXPECT_EQ(made, 1);
}
TEST_F(KeptImages, AreMadeWhereNothingCanBeKept) {
  std::ofstream(folder / "file") << "in the way";
  keep_in(folder / "file" / "below");
  ASSERT_TRUE(same(get(1), pattern(1)));
  ASSERT_TRUE(same(get(1), pattern(1)));
  EXPECT_EQ(made, 2);
  if (::geteuid() == 0) return;  // nothing keeps root out
  fs::create_directory(folder / "read_only");
  fs::permissions(folder / "read_only", fs::perms::owner_read | fs::perms::owner_exec);
  keep_in(folder / "read_only");
  ASSERT_TRUE(same(get(1), pattern(1)));
}
TEST_F(KeptImages, ManyAtOnceLeaveWholeFiles) {
  std::vector<pid_t> children;
  for (int k = 0; k < 6; ++k) {
    const pid_t child = ::fork();
    if (child == 0) {
      bool right = true;
      for (int round = 0; round < 40; ++round) right = right && same(get(round % 5), pattern(round % 5));
      ::_exit(right ? 0 : 1);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(files().size(), 5u);
  for (int k = 0; k < 5; ++k) ASSERT_TRUE(same(get(k), pattern(k)));
  EXPECT_EQ(made, 0);
}
TEST_F(KeptImages, TheFolderOfTheUserIsAsTheSpecificationSays) {
  const char* const cache = std::getenv("XDG_CACHE_HOME");
  const std::string before = cache ? cache : "";
  ::setenv("XDG_CACHE_HOME", "/some/where", 1);
  EXPECT_EQ(folder_of_user(), "/some/where/rainref");
  ::setenv("XDG_CACHE_HOME", "relative", 1);  // "invalid and ... ignored"
  ::setenv("HOME", "/home/of", 1);
  EXPECT_EQ(folder_of_user(), "/home/of/.cache/rainref");
  ::unsetenv("HOME");
  EXPECT_EQ(folder_of_user(), "");
  ::setenv("XDG_CACHE_HOME", before.c_str(), 1);
}

}  // namespace
}  // namespace rainref::cache
