// Arrays of NumPy are read in every version and packing; what is damaged, cut or of another type is refused.
#include "capture/npy_read.h"

#include <gmock/gmock.h>

#include "base/error_of.h"
#include "capture/python_literal.h"
#include "rainref/error.h"

namespace rainref::capture {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// A file as numpy.save lays it out: the header padded by spaces to a multiple of 64, then a line break.
std::string npy(const std::string& dictionary, const std::string& data, int major = 1) {
  const std::size_t length_bytes = major == 1 ? 2 : 4;
  std::string text = dictionary;
  while ((8 + length_bytes + text.size() + 1) % 64 != 0) text += ' ';
  text += '\n';
  std::string out = "\x93NUMPY" + std::string{static_cast<char>(major), '\0'};
  for (std::size_t i = 0; i < length_bytes; ++i) out += static_cast<char>(text.size() >> 8 * i);
  return out + text + data;
}
std::string of(const std::string& descr, const std::string& shape, bool fortran = false) {
  return "{'descr': " + descr + ", 'fortran_order': " + (fortran ? "True" : "False") + ", 'shape': " + shape + ", }";
}
NpyHeader parse(const std::string& bytes) { return parse_npy_header(std::as_bytes(std::span(bytes)), "'a.npy'"); }
std::string refusal(const std::string& bytes) {
  const std::string error = error_of([&] { parse(bytes); });
  EXPECT_THAT(error, StartsWith("3 'a.npy': "));
  return error;
}

TEST(NpyRead, NumbersInEveryVersion) {
  for (const int major : {1, 2, 3}) {
    const std::string bytes = npy(of("'<f4'", "(2, 3)"), std::string(24, 'x'), major);
    const NpyHeader h = parse(bytes);
    EXPECT_EQ(h.type, "<f4");
    EXPECT_TRUE(h.fields.empty());
    EXPECT_EQ(h.record_bytes, 4u);
    EXPECT_THAT(h.shape, ElementsAre(2, 3));
    EXPECT_EQ(h.elements(), 6u);
    EXPECT_EQ(h.data_offset, bytes.size() - 24);
    EXPECT_EQ(h.data_offset % 64, 0u);
  }
  EXPECT_EQ(parse(npy(of("'|u1'", "(5,)"), std::string(5, 'x'))).type, "|u1");
  EXPECT_EQ(parse(npy(of("'<f2'", "(5, 1, 1)"), std::string(10, 'x'))).record_bytes, 2u);
  EXPECT_EQ(parse(npy(of("\"<u4\"", "()"), "four")).elements(), 1u);
  EXPECT_EQ(parse(npy(of("'<u4'", "(0, 7L)"), "")).elements(), 0u);
}

// The bytes that numpy 1.24 writes for np.save('a.npy', np.arange(3, dtype=np.float32)).
TEST(NpyRead, AFileOfNumpys) {
  std::string bytes = "\x93NUMPY";
  bytes += std::string("\x01\x00\x76\x00", 4);
  bytes += "{'descr': '<f4', 'fortran_order': False, 'shape': (3,), }" + std::string(60, ' ') + "\n";
  bytes += std::string("\x00\x00\x00\x00\x00\x00\x80\x3f\x00\x00\x00\x40", 12);
  EXPECT_EQ(parse(bytes).data_offset, 128u);
}

TEST(NpyRead, PackedFields) {
  const NpyHeader h = parse(npy(of("[('x', '<f4'), ('id', '<u4'), ('normal', '<f4', (3,))]", "(2,)"), std::string(40, 'x')));
  EXPECT_EQ(h.type, "");
  EXPECT_EQ(h.record_bytes, 20u);
  ASSERT_EQ(h.fields.size(), 3u);
  EXPECT_EQ(h.fields[1].name, "id");
  EXPECT_EQ(h.fields[1].type, "<u4");
  EXPECT_EQ(h.fields[1].offset, 4u);
  EXPECT_EQ(h.fields[2].offset, 8u);
  EXPECT_EQ(h.fields[2].components, 3u);
  EXPECT_EQ(h.fields[2].bytes(), 12u);
}

TEST(NpyRead, PaddedFields) {
  const NpyHeader list = parse(npy(of("[('x', '<f4'), ('', '|V4'), ('y', '<f4'), ('', '|V20')]", "(1,)"), std::string(32, 'x')));
  ASSERT_EQ(list.fields.size(), 2u);
  EXPECT_EQ(list.fields[1].offset, 8u);
  EXPECT_EQ(list.record_bytes, 32u);
  const NpyHeader table = parse(
      npy(of("{'names': ['y', 'x'], 'formats': ['<f4', ('<f4', (2,))], 'offsets': [8, 0], 'itemsize': 16}", "(2,)"), std::string(32, 'x')));
  ASSERT_EQ(table.fields.size(), 2u);
  EXPECT_EQ(table.fields[0].name, "x");
  EXPECT_EQ(table.fields[0].components, 2u);
  EXPECT_EQ(table.fields[1].offset, 8u);
  EXPECT_EQ(table.record_bytes, 16u);
  EXPECT_EQ(parse(npy(of("{'names': ('a', 'b'), 'formats': ('<f4', '<u4')}", "(1,)"), std::string(8, 'x'))).fields[1].offset, 4u);
}

TEST(NpyRead, OtherTypesAreRefused) {
  EXPECT_THAT(refusal(npy(of("'<f8'", "(1,)"), std::string(8, 'x'))), HasSubstr("expected '|u1', '<f2', '<f4' or '<u4', found '<f8'"));
  EXPECT_THAT(refusal(npy(of("'<i4'", "(1,)"), "four")), HasSubstr("found '<i4'"));
  EXPECT_THAT(refusal(npy(of("'|b1'", "(1,)"), "f")), HasSubstr("found '|b1'"));
  EXPECT_THAT(refusal(npy(of("'|O'", "(1,)"), "four")), HasSubstr("found '|O'"));
  EXPECT_THAT(refusal(npy(of("[('x', '<f8')]", "(1,)"), std::string(8, 'x'))), HasSubstr("field 'x': expected"));
  EXPECT_THAT(refusal(npy(of("'>f4'", "(1,)"), "four")), HasSubstr("'>f4' is big endian"));
  EXPECT_THAT(refusal(npy(of("[('x', '>f4')]", "(1,)"), "four")), HasSubstr("field 'x': '>f4' is big endian"));
}

TEST(NpyRead, FortranOrderIsRefused) { EXPECT_THAT(refusal(npy(of("'<f4'", "(1, 1)", true), "four")), HasSubstr("Fortran order")); }

TEST(NpyRead, SizesMustBeExact) {
  EXPECT_THAT(refusal(npy(of("'<f4'", "(2, 3)"), std::string(23, 'x'))),
              HasSubstr("truncated: shape (2, 3) of 4 bytes each needs 24 bytes of data, found 23"));
  EXPECT_THAT(refusal(npy(of("'<f4'", "(2, 3)"), std::string(27, 'x'))), HasSubstr("3 bytes too many"));
  // 2^32 * 2^32 = 2^64: 0 in 64 bits.
  EXPECT_THAT(refusal(npy(of("'<f4'", "(4294967296, 4294967296)"), "")), HasSubstr("overflows"));
  EXPECT_THAT(refusal(npy(of("'<f4'", "(4611686018427387904,)"), "")), HasSubstr("overflows"));  // 2^62 * 4
  EXPECT_THAT(refusal(npy(of("'<f4'", "(65536, 65536, 4)"), "four")), HasSubstr("truncated"));
  EXPECT_THAT(refusal(npy(of("'<f4'", "(18446744073709551616,)"), "")),
              HasSubstr("no dictionary"));  // 2^64 does not fit
}

TEST(NpyRead, DamagedHeadersAreRefused) {
  EXPECT_THAT(refusal(""), HasSubstr("empty file"));
  EXPECT_THAT(refusal("P6 640 480"), HasSubstr("not a .npy file"));
  EXPECT_THAT(refusal(npy(of("'<f4'", "(1,)"), "four", 4)), HasSubstr("version 4.0"));
  EXPECT_THAT(refusal(npy("{'descr': '<f4', 'fortran_order': False}", "")), HasSubstr("no 'shape'"));
  EXPECT_THAT(refusal(npy("{'descr': '<f4', 'fortran_order': False, 'shap': (1,)}", "four")),
              AllOf(HasSubstr("unknown key 'shap'"), HasSubstr("did you mean 'shape'")));
  EXPECT_THAT(refusal(npy("{'descr': '<f4', 'descr': '<f4'}", "")), HasSubstr("no dictionary"));
  EXPECT_THAT(refusal(npy("__import__('os')", "")), HasSubstr("no dictionary"));
  EXPECT_THAT(refusal(npy(std::string(1000, '('), "")), HasSubstr("no dictionary"));
  EXPECT_THAT(refusal(npy(of("'<f4'", "(-1,)"), "")), HasSubstr("no dictionary"));
  EXPECT_THAT(refusal(npy(of("'<f4'", "(1.5,)"), "")), HasSubstr("no dictionary"));
  EXPECT_THAT(refusal(npy(of("'<f4'", "[1]"), "four")), HasSubstr("shape: expected a tuple"));
  EXPECT_THAT(refusal(npy(of("[]", "(1,)"), "")), HasSubstr("no fields"));
  EXPECT_THAT(refusal(npy(of("[('x', '<f4'), ('x', '<f4')]", "(1,)"), std::string(8, 'x'))), HasSubstr("two fields named 'x'"));
  EXPECT_THAT(refusal(npy(of("{'names': ['a', 'b'], 'formats': ['<f4', '<f4'], 'offsets': [0, 2]}", "(1,)"), std::string(6, 'x'))),
              HasSubstr("'a' and 'b' overlap"));
  EXPECT_THAT(refusal(npy(of("{'names': ['a'], 'formats': ['<f4'], 'offsets': [8], 'itemsize': 8}", "(1,)"), std::string(8, 'x'))),
              HasSubstr("at least 12"));
  EXPECT_THAT(refusal(npy(of("{'names': ['a'], 'formats': ['<f4'], 'offsets': [18446744073709551615]}", "(1,)"), "")),
              HasSubstr("overflows"));
  EXPECT_THAT(refusal(npy(of("[('', '|V18446744073709551615'), ('a', '<f4')]", "(1,)"), "")), HasSubstr("overflow"));
  EXPECT_THAT(refusal("\x93NUMPY" + std::string("\2\0\xff\xff\xff\xff", 6)), HasSubstr("the longest read is"));
}

TEST(NpyRead, EveryTruncationIsRefused) {
  for (const std::string descr : {"'<f4'", "[('x', '<f4'), ('', '|V4'), ('y', '<f4', (2,))]"}) {
    const std::string whole = npy(of(descr, "(3,)"), std::string(descr.front() == '[' ? 48 : 12, 'x'));
    ASSERT_NO_THROW(parse(whole));
    for (std::size_t size = 0; size < whole.size(); ++size) refusal(whole.substr(0, size));
  }
}

TEST(PythonLiteral, BracketsAndTuples) {
  EXPECT_EQ(parse_python_literal(" (3) ")->kind, PythonLiteral::integer);
  EXPECT_EQ(parse_python_literal("(3,)")->kind, PythonLiteral::tuple);
  EXPECT_EQ(parse_python_literal("()")->items.size(), 0u);
  EXPECT_EQ(parse_python_literal("18446744073709551615")->number, ~std::size_t{0});
  EXPECT_EQ(parse_python_literal("{'a': [1, 2], \"b\": True,}")->find("a")->items.size(), 2u);
  for (const char* bad : {"", "(,)", "(1 2)", "[1", "{'a' 1}", "{1: 1}", "'a\\'", "'a", "1 1", "Tru", "18446744073709551616", "None"}) {
    EXPECT_FALSE(parse_python_literal(bad)) << bad;
  }
}

}  // namespace
}  // namespace rainref::capture
