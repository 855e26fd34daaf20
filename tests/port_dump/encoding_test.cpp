// Buffers that a port keeps in its own way, told in port.json: what is written there, and where the bits come from. conversion_test.cpp
// has the numbers.
#include "port_dump/encoding.h"

#include "math/half.h"
#include "port_dump/support.h"

namespace rainref::port_dump {
namespace {

using ::testing::HasSubstr;
using Form = ChannelSource::Form;

std::string halves(std::initializer_list<float> values) {
  std::string out;
  for (const float v : values) out += raw(to_half(v).bits);
  return out;
}
/// A folder whose port.json has these encodings, read as out.b.
struct Encoded {
  Dump dump;
  explicit Encoded(const std::string& encodings) { dump.file("port.json", R"({"encodings": )" + encodings + "}"); }
  Encoded& npy(const std::string& name, const std::string& type, const std::string& shape, const std::string& data) {
    dump.file(name + ".npy", rainref::npy(type, shape, data));
    return *this;
  }
  std::string level(const capture::Array& expected, std::size_t l = 0) const {
    ReadNotes notes;
    try {
      const capture::Array got = read_port_buffer(dump.path(), "out.b", expected, read_port_info(dump.path()), notes);
      const std::vector<std::byte>& bytes = got.levels.at(l);
      return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    } catch (const Error& error) {
      return fmt::format("{} {}", static_cast<int>(error.code()), error.what());
    }
  }
};

TEST(Encoding, SourcesAreParsed) {
  const auto of = [](const char* text) {
    ChannelSource s;
    if (!parse_source(text, s)) return std::string("no");
    std::string out;
    for (const ChannelTerm& t : s.terms) out += fmt::format("{}{}*{}/{}", out.empty() ? "" : " + ", t.scale, t.file, t.channel);
    return fmt::format("{} + {}: {}", out, s.bias, static_cast<int>(s.form));
  };
  EXPECT_EQ(of("x"), "1*/0 + 0: 0");
  EXPECT_EQ(of("a"), "1*/3 + 0: 0");
  EXPECT_EQ(of("-y"), "-1*/1 + 0: 1");
  EXPECT_EQ(of("1-g"), "-1*/1 + 1: 2");
  EXPECT_EQ(of("newest.x"), "1*newest/0 + 0: 0");
  EXPECT_EQ(of("-flow_2.w"), "-1*flow_2/3 + 0: 1");
  EXPECT_EQ(of("0.5*x+0.5"), "0.5*/0 + 0.5: 3");
  EXPECT_EQ(of("1*x"), "1*/0 + 0: 3");
  EXPECT_EQ(of("2-x"), "-1*/0 + 2: 3");
  EXPECT_EQ(of("x - y"), "1*/0 + -1*/1 + 0: 3");
  EXPECT_EQ(of(" -1e-3 * state.z + 2.5e1 "), "-0.001*state/2 + 25: 3");
  EXPECT_EQ(of("-0.25+x-0.02*flow.y+z"), "1*/0 + -0.02*flow/1 + 1*/2 + -0.25: 3");
  for (const char* bad : {"",    "-",     "1-",  "q",  "xy",  "--x",   ".x",      "../secret.x", "a/b.x", "newest.", "0*x",     "1",
                          "1+2", "x+1+2", "x*2", "2x", "x y", "inf*x", "1e999*x", "x+y+z+w+x",   "+x",    "0x2*x",   "1.2.3*x", "1e*x"})
    EXPECT_EQ(of(bad), "no") << bad;
}

TEST(Encoding, ItsFilesAreKnown) {
  const PortInfo port = parse_port_info(R"({"encodings": {"b": ["newest.x", "y", "newest.z"]}})", "'p'");
  EXPECT_EQ(stems_of("out.b", port), (std::vector<std::string>{"out.newest", "out.b"}));
  EXPECT_EQ(stems_of("in.b.L2", port), (std::vector<std::string>{"in.newest.L2", "in.b.L2"}));
  EXPECT_EQ(stems_of("out.c", port), std::vector<std::string>{"out.c"});
}

// Green inverted and channels exchanged, in codes and in halves.
TEST(Encoding, ChannelsSignsAndComplements) {
  EXPECT_EQ(
      Encoded(R"({"b": ["z", "1-y", "x", "w"]})").npy("out.b", "'|u1'", "(1, 1, 4)", "\x03\x04\x05\x06").level(image(Format::rgba8, 1, 1)),
      "\x05\xfb\x03\x06");
  EXPECT_EQ(Encoded(R"({"b": ["-x", "y"]})").npy("out.b", "'<f2'", "(1, 2, 2)", halves({1.5f, 2, 0, -3})).level(image(Format::rg16f, 2, 1)),
            halves({-1.5f, 2, 0, -3}));
  EXPECT_EQ(Encoded(R"({"b": ["-x"]})").npy("out.b", "'<f4'", "(1, 1)", raw(-0.0f)).level(image(Format::r32f, 1, 1)), raw(0.0f));
}
// Twice is nothing: every code comes back.
TEST(Encoding, ASignIsExactForEveryHalf) {
  std::string all, turned;
  for (int i = 0; i < 65536; ++i) {
    all += raw(static_cast<std::uint16_t>(i));
    turned += raw(static_cast<std::uint16_t>((i & 0x7fff) == 0 ? 0 : i ^ 0x8000));
  }
  EXPECT_EQ(Encoded(R"({"b": ["-x"]})").npy("out.b", "'<f2'", "(256, 256)", all).level(image(Format::r16f, 256, 256)), turned);
}
// The newest and the previous height in two files, the first with channels that are not read.
TEST(Encoding, ABufferOfTwoFiles) {
  Encoded port(R"({"b": ["newest.y", "previous.x"]})");
  port.npy("out.newest", "'<f2'", "(1, 2, 4)", halves({9, 1, 9, 9, 9, 2, 9, 9})).npy("out.previous", "'<f2'", "(1, 2)", halves({3, 4}));
  EXPECT_EQ(port.level(image(Format::rg16f, 2, 1)), halves({1, 3, 2, 4}));
}
TEST(Encoding, EachMipLevelIsReadSo) {
  Encoded port(R"({"b": ["y", "x"]})");
  port.npy("out.b", "'<f2'", "(1, 2, 2)", halves({1, 2, 3, 4})).npy("out.b.L1", "'<f2'", "(1, 1, 2)", halves({5, 6}));
  EXPECT_EQ(port.level(image(Format::rg16f, 2, 1, 2), 0), halves({2, 1, 4, 3}));
  EXPECT_EQ(port.level(image(Format::rg16f, 2, 1, 2), 1), halves({6, 5}));
}

TEST(Encoding, Refusals) {
  const std::string two = halves({1, 2});
  EXPECT_THAT(Encoded(R"({"b": ["x"]})").npy("out.b", "'<f2'", "(1, 1, 2)", two).level(image(Format::rg16f, 1, 1)),
              HasSubstr("encodings.b: expected 2 channels of rg16f, found 1"));
  EXPECT_THAT(Encoded(R"({"b": ["2*x"]})").npy("out.b", "'<u4'", "(1, 1)", raw(7u)).level(image(Format::r32ui, 1, 1)),
              HasSubstr("encodings.b: expected a channel without a number, as r32ui needs, found a sum"));
  EXPECT_THAT(Encoded(R"({"b": ["2*x"]})").npy("out.b", "'<u4'", "(1, 1)", raw(7u)).level(image(Format::r16f, 1, 1)),
              HasSubstr("expected halves, floats or 8-bit codes in out.b, found 32-bit unsigned integers"));
  EXPECT_THAT(Encoded(R"({"b": ["x", "x-y"]})").npy("out.b", "'|u1'", "(1, 1, 2)", "ab").level(image(Format::rg16f, 1, 1)),
              HasSubstr("expected rg16f as halves, found 8-bit codes"));
  EXPECT_THAT(Encoded(R"({"b": ["-x"]})").npy("out.b", "'|u1'", "(1, 1)", "a").level(image(Format::r8, 1, 1)), HasSubstr("r8 has no sign"));
  EXPECT_THAT(Encoded(R"({"b": ["x", "z"]})").npy("out.b", "'<f2'", "(1, 1, 2)", two).level(image(Format::rg16f, 1, 1)),
              HasSubstr("expected 4 channels of rgba16f, found 2"));
  EXPECT_THAT(Encoded(R"({"b": ["old.x", "x"]})").npy("out.b", "'<f2'", "(1, 1, 2)", two).level(image(Format::rg16f, 1, 1)),
              HasSubstr("'out.old'"));
  EXPECT_THAT(Encoded(R"({"b": ["x"]})").level(drops()), HasSubstr("a list has no channels"));
  EXPECT_THAT(Encoded(R"({"b": {"members": ["x"]}})").level(image(Format::r8, 1, 1)), HasSubstr("an image has no members"));
  for (const auto& [text, why] :
       {std::pair{R"({"b": "x"})", "expected an array"},
        {R"({"b": []})", "expected 1 to 4 channels, found 0"},
        {R"({"b": ["x", "q"]})", "encodings.b: expected a channel such as x, -y, 1-g, newest.x, 0.5*x+0.5 or x-y, found 'q'"},
        {R"({"b": ["../a.x"]})", "found '../a.x'"},
        {R"({"b": {"member": ["x"]}})", "unknown key 'member'; did you mean 'members'?"},
        {R"({"b": {"members": []}})", "expected the members that the port's records have, found none"},
        {R"({"b": {}})", "encodings.b: 'members' is missing"},
        {R"(["x"])", "expected an object"}})
    EXPECT_THAT(Encoded(text).level(image(Format::r8, 1, 1)), HasSubstr(why)) << text;
}

}  // namespace
}  // namespace rainref::port_dump
