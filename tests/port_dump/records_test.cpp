// Lists of ports are matched field by field, as arrays or as raw bytes.
#include "port_dump/support.h"

namespace rainref::port_dump {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A drop of the pack: 24 bytes of members, 8 of padding.
std::string drop(float x, float y, float u, float v, std::uint32_t id, std::int32_t kind) {
  return raw(x) + raw(y) + raw(u) + raw(v) + raw(id) + raw(kind);
}
const std::string first = drop(1, 2, 3, 4, 5, -6), second = drop(7, 8, 9, 10, 11, 12), pad(8, '\0');
const std::string members = "('x', '<f4'), ('y', '<f4'), ('velocity', '<f4', (2,)), ('id', '<u4'), ('kind', '<u4')";

TEST(Records, PackedAndPaddedArrays) {
  Dump dump;
  dump.file("out.b.npy", npy("[" + members + "]", "(2,)", first + second));
  EXPECT_EQ(dump.level(drops()), first + pad + second + pad);
  dump.file("out.b.npy", npy("[" + members + ", ('', '|V8')]", "(2,)", first + "garbage!" + second + "garbage!"));
  EXPECT_EQ(dump.level(drops()), first + pad + second + pad);
  EXPECT_THAT(dump.notes(), IsEmpty());
}

TEST(Records, FieldsAreMatchedByName) {
  Dump dump;
  dump.file("out.b.npy", npy("[('kind', '<u4'), ('id', '<u4'), ('velocity', '<f4', (2,)), ('y', '<f4'), ('x', '<f4'), ('padding_0', "
                             "'<f4'), ('age', '<f4')]",
                             "(1,)", raw(-6) + raw(5u) + raw(3.0f) + raw(4.0f) + raw(2.0f) + raw(1.0f) + raw(0.0f) + raw(9.0f)));
  EXPECT_EQ(dump.level(drops()), first + pad);
  EXPECT_THAT(dump.notes(), ElementsAre(HasSubstr("not declared by the pack, not read: age")));
}

TEST(Records, AnyNumberOfThem) {
  Dump dump;
  for (const int count : {0, 1, 3, 100}) {
    std::string data;
    for (int i = 0; i < count; ++i) data += first;
    dump.file("out.b.npy", npy("[" + members + "]", "(" + std::to_string(count) + ",)", data));
    const capture::Array array = dump.read(drops());
    EXPECT_EQ(array.width, count);
    EXPECT_EQ(array.height, 1);
    EXPECT_EQ(array.levels[0].size(), 32u * count);
  }
}

TEST(Records, RefusedArrays) {
  Dump dump;
  const auto refusal = [&](const std::string& descr, const std::string& shape, std::size_t bytes) {
    dump.file("out.b.npy", npy(descr, shape, std::string(bytes, '\0')));
    return dump.refusal(drops());
  };
  EXPECT_THAT(refusal("'<f4'", "(2, 6)", 48), HasSubstr("expected a structured array of Drop, found '<f4'"));
  EXPECT_THAT(refusal("[" + members + "]", "(1, 1)", 24), HasSubstr("expected a shape of (records,), found (1, 1)"));
  EXPECT_THAT(refusal("[('x', '<f4'), ('y', '<f4'), ('velocity', '<f4', (2,)), ('idd', '<u4'), ('kind', '<u4')]", "(1,)", 24),
              AllOf(HasSubstr("no field 'id'"), HasSubstr("did you mean 'idd'")));
  EXPECT_THAT(refusal("[('x', '<u4'), ('y', '<f4'), ('velocity', '<f4', (2,)), ('id', '<u4'), ('kind', '<u4')]", "(1,)", 24),
              HasSubstr("field 'x': expected 1 of '<f4', found 1 of '<u4'"));
  EXPECT_THAT(refusal("[('x', '<f4'), ('y', '<f4'), ('velocity', '<f4', (3,)), ('id', '<u4'), ('kind', '<u4')]", "(1,)", 28),
              HasSubstr("field 'velocity': expected 2 of '<f4', found 3 of '<f4'"));
}

TEST(Records, RawBytesAsThePackDeclares) {
  Dump dump;
  dump.file("out.b.bin", first + "garbage!" + second + "garbage!");
  dump.file("out.b.json", R"({"format": "records", "width": 2})");
  EXPECT_EQ(dump.level(drops()), first + pad + second + pad);
  dump.file("out.b.bin", first + "garbage!" + second);  // the last one without its padding
  EXPECT_EQ(dump.level(drops()), first + pad + second + pad);
  dump.file("out.b.bin", "");
  dump.file("out.b.json", R"({"format": "records", "width": 0})");
  EXPECT_EQ(dump.level(drops()), "");
}

// std140 and std430 give a vec3 and an array element of it 16 bytes, and align members behind it.
TEST(Records, RawBytesWithALayoutOfTheirOwn) {
  const auto stored = [](const std::string& d) {
    return d.substr(16) + "gap8gap8" + d.substr(8, 8) + d.substr(0, 8) + std::string(16, 'p');
  };
  Dump dump;
  dump.file("out.b.bin", "header" + stored(first) + stored(second));
  dump.file("out.b.json", R"({"format": "records", "width": 2, "height": 1, "offset": 6, "struct_stride": 48,
                              "fields": {"id": 0, "kind": 4, "velocity": 16, "x": 24, "y": 28}})");
  EXPECT_EQ(dump.level(drops()), first + pad + second + pad);
}

TEST(Records, RefusedRawBytes) {
  Dump dump;
  const auto refusal = [&](const std::string& json, std::size_t bytes) {
    dump.file("out.b.bin", std::string(bytes, '\0'));
    dump.file("out.b.json", json);
    return dump.refusal(drops());
  };
  EXPECT_THAT(refusal(R"({"format": "records", "width": 2})", 55), HasSubstr("truncated: 2 records of 32 bytes, found 55 bytes"));
  EXPECT_THAT(refusal(R"({"format": "records", "width": 2})", 65), HasSubstr("bytes too many: expected 2 records of 32 bytes"));
  EXPECT_THAT(refusal(R"({"format": "records", "width": 2})", 96), HasSubstr("bytes too many"));
  EXPECT_THAT(refusal(R"({"format": "records", "width": 18446744073709551615})", 96), HasSubstr("expected fewer than 2^31"));
  EXPECT_THAT(refusal(R"({"format": "records", "width": 2147483647, "struct_stride": 18446744073709551615})", 96), HasSubstr("truncated"));
  EXPECT_THAT(refusal(R"({"format": "records", "width": 2, "struct_stride": 20})", 40),
              HasSubstr("field 'kind': 4 bytes at offset 20 do not fit records of 20 bytes"));
  EXPECT_THAT(refusal(R"({"format": "records", "width": 2, "offset": 200})", 64), HasSubstr("truncated: offset 200 in a file of 64 bytes"));
  EXPECT_THAT(refusal(R"({"format": "records", "width": 1, "fields": {"x": 0, "y": 4, "velocity": 8, "id": 16}})", 32),
              HasSubstr("no field 'kind'"));
  EXPECT_THAT(refusal(R"({"format": "records", "width": 1, "fields": {"x": 0, "y": 4, "velocity": 8, "id": 16, "kind": 16}})", 32),
              HasSubstr("fields 'id' and 'kind' overlap"));
  EXPECT_THAT(
      refusal(R"({"format": "records", "width": 1, "fields": {"x": 18446744073709551615, "y": 4, "velocity": 8, "id": 16, "kind": 20}})",
              32),
      HasSubstr("do not fit"));
  EXPECT_THAT(refusal(R"({"format": "r32f", "width": 2, "height": 2})", 16), HasSubstr("records were expected"));
}

TEST(Records, ComeAsNpyOrRawBytesOnly) {
  Dump dump;
  dump.file("out.b.dds", DdsFile{.dxgi = 41}.with("four"));
  EXPECT_THAT(dump.refusal(drops()), HasSubstr("records are dumped as .npy or as .bin"));
}

}  // namespace
}  // namespace rainref::port_dump
