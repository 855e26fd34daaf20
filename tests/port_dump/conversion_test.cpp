// The numbers of a port's own scale and quantities: which value a buffer gets of them, and what the port may have had.
#include "port_dump/conversion.h"

#include <cmath>
#include <cstring>
#include <vector>

#include "math/half.h"
#include "math/unorm.h"
#include "port_dump/support.h"

namespace rainref::port_dump {
namespace {

using ::testing::HasSubstr;
using Kind = FormatInfo::Kind;

std::string bytes_of(Kind kind, double value) {
  if (kind == Kind::float16) return raw(to_half(static_cast<float>(value)).bits);
  if (kind == Kind::float32) return raw(static_cast<float>(value));
  return raw(to_unorm8(static_cast<float>(value)).code);
}
double value_of(Kind kind, const std::string& bytes) {
  if (kind == Kind::float16) {
    Half half;
    std::memcpy(&half, bytes.data(), sizeof half);
    return to_float(half);
  }
  float value;
  if (kind != Kind::float32) return to_float(Unorm8{static_cast<std::uint8_t>(bytes[0])});
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}
Converted of(const char* text, Kind kind, const std::vector<double>& stored, Kind to, std::optional<Rounding> half_store = {}) {
  ChannelSource source;
  EXPECT_TRUE(parse_source(text, source)) << text;
  std::vector<std::string> bytes;
  std::vector<StoredValue> values;
  for (const double v : stored) bytes.push_back(bytes_of(kind, v));
  for (const std::string& b : bytes) values.push_back({kind, reinterpret_cast<const std::byte*>(b.data())});
  return convert(source, values, to, half_store);
}
bool is_exact(const Converted& c, double value) { return c.value == value && c.below == 0 && c.above == 0; }

TEST(Conversion, APowerOfTwoIsExact) {
  for (const float v : {1.0f, -3.14159f, 0x1p-100f, 0.0f}) {
    EXPECT_TRUE(is_exact(of("4*x", Kind::float32, {v}, Kind::float32), 4.0 * v)) << v;
    EXPECT_TRUE(is_exact(of("-0.125*x", Kind::float32, {v}, Kind::float32), -0.125 * v)) << v;
  }
  EXPECT_TRUE(is_exact(of("0.5*x", Kind::float16, {3.0}, Kind::float16), 1.5));
  EXPECT_TRUE(is_exact(of("1*x", Kind::float16, {0x1p-24}, Kind::float16), 0x1p-24));
  // What a half rounds at the lower end, the buffer would not: its steps there are those of twice the value.
  EXPECT_NEAR(of("2*x", Kind::float16, {0x1p-24}, Kind::float16).above, 0x1p-23, 0x1p-40);
  EXPECT_NEAR(of("2*x", Kind::float16, {0.0}, Kind::float16).below, 0x1p-23, 0x1p-40);
  // Half of the least normal half lies between no two halves, of the next one it does.
  EXPECT_GT(of("0.5*x", Kind::float16, {0x1.004p-14}, Kind::float16).below + of("0.5*x", Kind::float16, {0x1.004p-14}, Kind::float16).above,
            0);
}

TEST(Conversion, AHalfStandsForWhatRoundsToIt) {
  const Converted either = of("x+0", Kind::float16, {1.0}, Kind::float32);
  EXPECT_EQ(either.value, 1);
  EXPECT_NEAR(either.below, 0x1p-11, 0x1p-20);
  EXPECT_NEAR(either.above, 0x1p-10, 0x1p-20);
  const Converted nearest = of("x+0", Kind::float16, {1.0}, Kind::float32, Rounding::rne);
  EXPECT_NEAR(nearest.below, 0x1p-12, 0x1p-20);
  EXPECT_NEAR(nearest.above, 0x1p-11, 0x1p-20);
  const Converted cut = of("x+0", Kind::float16, {-1.0}, Kind::float32, Rounding::rtz);
  EXPECT_NEAR(cut.below, 0x1p-10, 0x1p-20);
  EXPECT_LT(cut.above, 0x1p-20);
}

TEST(Conversion, ACodeStandsForPartOfACodeToEachSide) {
  const Converted c = of("2*x-1", Kind::unorm8, {200 / 255.0}, Kind::float16);
  EXPECT_EQ(c.value, to_float(to_half(2 * 200.0f / 255 - 1)));
  EXPECT_NEAR(c.value - c.below, 2 * 199.4 / 255 - 1, 2e-6);
  EXPECT_NEAR(c.value + c.above, 2 * 200.6 / 255 - 1, 2e-6);
}

TEST(Conversion, ADifferenceHasTheWidthsOfBoth) {
  const Converted c = of("x-y", Kind::float16, {1.5, 0.25}, Kind::float16);
  EXPECT_EQ(c.value, 1.25f);
  EXPECT_NEAR(c.below, 0x1p-10 + 0x1p-12, 0x1p-18);
  EXPECT_NEAR(c.above, 0x1p-10 + 0x1p-13, 0x1p-18);
}

TEST(Conversion, WhatIsNoNumberStaysNone) {
  EXPECT_TRUE(std::isnan(of("0.5*x+1", Kind::float32, {NAN}, Kind::float16).value));
  EXPECT_TRUE(std::isnan(of("x-y", Kind::float16, {INFINITY, INFINITY}, Kind::float16).value));
  EXPECT_EQ(of("2*x", Kind::float16, {60000.0}, Kind::float16).value, INFINITY);
}

/// A sequence that fills the interval (0, 1) evenly.
double even(int i) { return std::fmod(0.5 + i * 0.6180339887498949, 1.0); }

// The premise of the wider envelope. A port that computes a value, converts it in floats and stores that by either rounding had a value in
// the interval, whatever the scale, the format and the value.
TEST(Conversion, ThePortsOwnValueLiesInTheInterval) {
  const struct {
    float scale, bias;
  } forms[] = {{0.5f, 0.5f}, {2, -1}, {-2, 1}, {0.3f, 0}, {-7.7f, 0.013f}, {0.04f, -0.02f}, {4, 0}, {0.25f, 0}, {1, 0.125f}};
  int changed = 0;
  for (const auto& form : forms)
    for (const Kind kind : {Kind::float16, Kind::float32, Kind::unorm8})
      for (const Kind to : {Kind::float16, Kind::float32, Kind::unorm8})
        for (int i = 0; i < 2000; ++i) {
          const float t = static_cast<float>(even(i)), wide = static_cast<float>(std::ldexp(even(i) - 0.5, i % 24 - 14));
          // What the port's format can hold, in the buffer's quantity.
          const float had = kind == Kind::unorm8 ? form.scale * t + form.bias : to == Kind::unorm8 ? t : wide;
          if (to == Kind::unorm8 && (had < 0 || had > 1)) continue;
          const float own = (had - form.bias) / form.scale;
          const bool is_cut = i % 2 == 1;
          std::string bytes = kind == Kind::float16 ? raw(to_half(own, is_cut ? Rounding::rtz : Rounding::rne).bits) : bytes_of(kind, own);
          ChannelSource source;
          source.terms[0].scale = form.scale;
          source.bias = form.bias;
          source.form = ChannelSource::Form::computed;
          const StoredValue stored{kind, reinterpret_cast<const std::byte*>(bytes.data())};
          for (const std::optional<Rounding> declared :
               {std::optional<Rounding>(), std::optional(is_cut ? Rounding::rtz : Rounding::rne)}) {
            const Converted c = convert(source, {&stored, 1}, to, declared);
            const bool is_point = c.below == 0 && c.above == 0;
            // An exact form gives what the buffer's own store would; there the interval says nothing of the value before it.
            if (is_point && kind == Kind::float16)
              EXPECT_EQ(c.value, to_float(to_half(had, is_cut ? Rounding::rtz : Rounding::rne)) + 0.0f) << had;
            else
              EXPECT_TRUE(static_cast<double>(c.value) - c.below <= had && had <= static_cast<double>(c.value) + c.above)
                  << form.scale << '*' << value_of(kind, bytes) << '+' << form.bias << ": " << had << " not in " << c.value << " - "
                  << c.below << " + " << c.above << " of " << static_cast<int>(kind) << " to " << static_cast<int>(to);
            changed += !is_point;
          }
        }
  EXPECT_GT(changed, 50000);
}

// A file of which every source is computed may hold other values than the buffer; each level of it the same ones.
TEST(Conversion, FilesOfOtherValuesAreRead) {
  Dump dump;
  dump.file("port.json", R"({"encodings": {"b": ["2*x-1", "-2*y+1"]}})");
  dump.file("out.b.npy", npy("'|u1'", "(1, 2, 3)", std::string("\xff\x00\x09\x33\xcc\x09", 6)));
  const PortInfo port = read_port_info(dump.path());
  const auto half_of = [](float v) { return to_half(v).bits; };
  EXPECT_EQ(dump.level(image(Format::rg16f, 2, 1), port), values<std::uint16_t>({half_of(1), half_of(1), half_of(-0.6f), half_of(-0.6f)}));
  ASSERT_TRUE(dump.kept());
  EXPECT_EQ(dump.kept()->spread.size(), 4u);
  EXPECT_NEAR(dump.kept()->widest, 2 * 0.6 / 255, 1e-3);
  EXPECT_THAT(dump.notes(), ::testing::Contains(HasSubstr("3 channels, the buffer has 2")));
  dump.file("out.b.L1.npy", npy("'<f4'", "(1, 1, 2)", raw(1.0f) + raw(1.0f)));
  EXPECT_THAT(dump.refusal(image(Format::rg16f, 2, 1, 2), port), HasSubstr("expected 8-bit codes as level 0 has, found floats"));
}

/// The expected list of two drops.
capture::Array two_drops(std::uint32_t kind = 0) {
  capture::Array list = drops();
  std::string bytes;
  for (const std::uint32_t id : {7u, 9u})
    bytes += raw(1.0f) + raw(2.0f) + raw(3.0f) + raw(4.0f) + raw(id) + raw(kind) + std::string(8, '\0');
  const auto* at = reinterpret_cast<const std::byte*>(bytes.data());
  list.levels = {capture::Bytes(at, at + bytes.size())};
  return list;
}

TEST(Members, AnIdAndWhatIsZeroMayBeMissing) {
  Dump dump;
  dump.file("port.json", R"({"encodings": {"b": {"members": ["velocity", "x", "y"]}}})");
  dump.file("out.b.json", R"({"format": "records", "width": 2})");
  dump.file("out.b.bin", raw(5.0f) + raw(6.0f) + raw(1.0f) + raw(2.0f) + raw(7.0f) + raw(8.0f) + raw(3.0f) + raw(4.0f));
  const PortInfo port = read_port_info(dump.path());
  EXPECT_EQ(dump.level(two_drops(), port), raw(1.0f) + raw(2.0f) + raw(5.0f) + raw(6.0f) + raw(7u) + raw(0u) + std::string(8, '\0') +
                                               raw(3.0f) + raw(4.0f) + raw(7.0f) + raw(8.0f) + raw(9u) + raw(0u) + std::string(8, '\0'));
  EXPECT_EQ(dump.kept()->from_expected, (std::vector<std::string>{"id", "kind"}));
  EXPECT_THAT(dump.refusal(two_drops(1), port),
              HasSubstr("encodings.b: members: 'kind' is missing; expected every member but an id, and those that are 0 everywhere"));
}
TEST(Members, OfNpyAreFoundByTheirNames) {
  Dump dump;
  dump.file("port.json", R"({"encodings": {"b": {"members": ["x", "y", "velocity", "kind"]}}})");
  dump.file("out.b.npy", npy("[('kind', '<u4'), ('velocity', '<f4', (2,)), ('x', '<f4'), ('y', '<f4')]", "(1,)",
                             raw(3u) + raw(5.0f) + raw(6.0f) + raw(1.0f) + raw(2.0f)));
  EXPECT_EQ(dump.level(two_drops(1), read_port_info(dump.path())),
            raw(1.0f) + raw(2.0f) + raw(5.0f) + raw(6.0f) + raw(7u) + raw(3u) + std::string(8, '\0'));
}
TEST(Members, UnknownAndRepeatedOnesAreRefused) {
  const auto refusal = [](const std::string& members) {
    Dump dump;
    dump.file("port.json", R"({"encodings": {"b": {"members": )" + members + "}}}");
    return dump.refusal(two_drops(), read_port_info(dump.path()));
  };
  EXPECT_THAT(refusal(R"(["x", "y", "velocty"])"),
              HasSubstr("encodings.b: members: expected members of Drop, found 'velocty'; did you mean 'velocity'?"));
  EXPECT_THAT(refusal(R"(["x", "x", "y", "velocity"])"), HasSubstr("members: expected each once, found 'x' twice"));
}

}  // namespace
}  // namespace rainref::port_dump
