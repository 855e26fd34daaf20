// Text for a terminal has no control characters and no broken UTF-8.
#include "base/printable.h"

#include <gtest/gtest.h>

namespace rainref {
namespace {

TEST(Printable, TextStaysAsItIs) {
  const std::string text = "a b\tc\n~ \u00a0 \u00e4 \u2192 \U0001f327";
  EXPECT_EQ(printable(text), text);
  EXPECT_EQ(printable(""), "");
}

// ECMA-48: C0 (ESC among them), DEL, and C1 (CSI among them), which UTF-8 codes in two bytes.
TEST(Printable, NoControlCharacterIsLeft) {
  EXPECT_EQ(printable("\x1b]0;title\x07"), "\uFFFD]0;title\uFFFD");
  EXPECT_EQ(printable("\r\b\x7f"), "\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(printable(std::string("\0", 1)), "\uFFFD");
  for (int c = 0; c < 0x20; ++c) EXPECT_EQ(printable(std::string(1, static_cast<char>(c))).size(), c == '\n' || c == '\t' ? 1u : 3u) << c;
  for (int c = 0x80; c < 0xa0; ++c) EXPECT_EQ(printable(std::string{'\xc2', static_cast<char>(c)}), "\uFFFD") << c;
}

// A terminal that is not set to UTF-8 takes a lone 0x9b for CSI.
TEST(Printable, BytesThatAreNoUtf8AreReplacedOneByOne) {
  EXPECT_EQ(printable("\x9b"
                      "31m\xff\xc2"),
            "\uFFFD31m\uFFFD\uFFFD");
  EXPECT_EQ(printable("\xc0\x9b"), "\uFFFD\uFFFD");            // overlong ESC
  EXPECT_EQ(printable("\xe2\x86"), "\uFFFD\uFFFD");            // cut short
  EXPECT_EQ(printable("\xed\xa0\x80"), "\uFFFD\uFFFD\uFFFD");  // a surrogate
}

}  // namespace
}  // namespace rainref
