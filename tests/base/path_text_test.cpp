// Texts and paths: UTF-8 with slashes on every system.
#include "base/path_text.h"

#include <gtest/gtest.h>

#include "base/temporary_folder.h"

namespace rainref {
namespace {

TEST(PathText, IsTheTextThatNamedThePath) {
  for (const char* text : {"", "a", "a/b.c", "d\xc3\xbcne \xe9\x9b\xa8/\xf0\x9f\x8c\xa7", ".", "../x", "/a b"})
    EXPECT_EQ(path_text(utf8_path(text)), text);
}

TEST(PathText, HasSlashesWhateverTheSystemHas) {
  const std::filesystem::path path = (utf8_path("a") / "b" / "c").make_preferred();
  EXPECT_EQ(path_text(path), "a/b/c");
  const char separator = static_cast<char>(std::filesystem::path::preferred_separator);
  EXPECT_EQ(system_path_text(path), std::string("a") + separator + "b" + separator + "c");
}

TEST(PathText, NamesFilesByAnyLetters) {
  const TemporaryFolder at;
  const std::string name = "d\xc3\xbcne \xe9\x9b\xa8";
  put(at / name, "x");
  EXPECT_EQ(at.names(), std::vector<std::string>{name});
  EXPECT_EQ(contents(at.path() / utf8_path(name)), "x");
}

}  // namespace
}  // namespace rainref
