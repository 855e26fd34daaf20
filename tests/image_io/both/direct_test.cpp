// Pictures through the libraries of their formats (RAINREF_PICTURES=direct) against OpenImageIO, in one process: the same description, the
// same texels, the same refusals.
#include <dlfcn.h>

#include <gmock/gmock.h>

#include <filesystem>
#include <map>
#include <random>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/read_file.h"
#include "image_io/codec.h"
#include "image_io/direct/module.h"
#include "image_io/tiny_files.h"
#include "source_folder.h"

namespace rainref::image_io {
namespace {

namespace fs = std::filesystem;

const DirectModule& module() {
  static const DirectModule* const opened = [] {
    void* const handle = ::dlopen(RAINREF_DIRECT_CODEC, RTLD_NOW | RTLD_LOCAL);
    if (!handle) throw std::runtime_error(::dlerror());
    return reinterpret_cast<const DirectModule* (*)()>(::dlsym(handle, direct_module_name))();
  }();
  return *opened;
}

/// What a reader says of a file.
struct Answer {
  std::string description;  ///< every member of StoredPicture
  std::string texels;       ///< of all channels, then of every channel alone
  std::string refusal;      ///< "" if it was read
};

/// Larger pictures are not read: damaged sizes.
constexpr std::uint64_t most_texels = 1 << 20;

std::string described(const StoredPicture& p) {
  std::string out = fmt::format("{}x{}x{}+{}+{} in {}x{}+{}+{}{} orientation {} {} {}:", p.width, p.height, p.depth, p.x, p.y, p.full_width,
                                p.full_height, p.full_x, p.full_y, p.deep ? " deep" : "", p.orientation, p.compression, p.colour_space);
  for (const StoredChannel& c : p.channels) out += fmt::format(" {} {} {}", c.name, c.type, c.bytes);
  return out;
}

Answer answer_of(const Codec& codec, const std::string& format, const std::string& bytes) {
  Answer out;
  try {
    const auto reader = codec.open(format.c_str(), std::as_bytes(std::span(bytes)));
    const StoredPicture& picture = reader->picture();
    out.description = described(picture);
    if (picture.deep || picture.width < 1 || picture.height < 1) return out;
    const std::uint64_t texels = static_cast<std::uint64_t>(picture.width) * static_cast<std::uint64_t>(picture.height);
    if (texels > most_texels) return out;
    const auto read = [&](std::size_t first, std::size_t end) {
      std::string part(picture.texel_bytes(first, end) * texels, '\0');
      codec.open(format.c_str(), std::as_bytes(std::span(bytes)))->read(first, end, reinterpret_cast<std::byte*>(part.data()));
      out.texels += part;
    };
    read(0, picture.channels.size());
    for (std::size_t c = 0; c < picture.channels.size() && picture.channels.size() > 1; ++c) read(c, c + 1);
  } catch (const std::exception& error) {
    out.refusal = error.what();
    if (out.refusal.empty()) out.refusal = "no reason";
  }
  return out;
}

Answer of_openimageio(const std::string& format, const std::string& bytes) { return answer_of(codec(), format, bytes); }
Answer of_direct(const std::string& format, const std::string& bytes) { return answer_of(*module().codec, format, bytes); }

void expect_same(const std::string& name, const std::string& format, const std::string& bytes) {
  const Answer expected = of_openimageio(format, bytes), found = of_direct(format, bytes);
  EXPECT_EQ(found.description, expected.description) << name;
  EXPECT_EQ(found.refusal, expected.refusal) << name;
  EXPECT_TRUE(found.texels == expected.texels) << name << ": " << found.texels.size() << " and " << expected.texels.size() << " bytes";
}

MadePictures of_hdr() {
  std::vector<std::array<int, 4>> texels;
  Noise noise(1);
  for (int exponent = 0; exponent < 256; ++exponent) {
    // Its table of powers of two is one unit in the last place too low at these three.
    const bool is_wrong = exponent == 40 || exponent == 223 || exponent == 226;
    texels.push_back({noise.byte(), noise.byte(), noise.byte(), is_wrong ? 128 : exponent});
  }
  std::string runs = hdr(9, 4, {});
  for (int y = 0; y < 4; ++y) {
    runs += std::string("\2\2\0\x09", 4);
    for (int c = 0; c < 4; ++c) runs += '\x05' + std::string(5, static_cast<char>(100 + 9 * y + c)) + "\x84\x82";
  }
  MadePictures out{{"HDR flat", "hdr", hdr(16, 16, texels)}, {"HDR narrow", "hdr", hdr(4, 64, texels)}, {"HDR runs", "hdr", runs}};
  for (const char* axes : {"-Y {h} -X {w}", "+Y {h} -X {w}", "+Y {h} +X {w}", "+X {h} -Y {w}", "+X {h} +Y {w}", "-X {h} +Y {w}",
                           "-X {h} -Y {w}", "-Z {h} +X {w}", "-Y  {h}   +X {w} x"})
    out.push_back({std::string("HDR ") + axes, "hdr", hdr(16, 16, texels, axes)});
  for (const char* lines : {"GAMMA=1\n", "GAMMA=2.2\n", "EXPOSURE=2\n", "# a comment\n", "VIEW= -vtv\nPIXASPECT=2\n", "\r\n"})
    out.push_back({std::string("HDR ") + lines, "hdr", hdr(16, 16, texels, "-Y {h} +X {w}", lines)});
  std::string many;
  for (int i = 0; i < 120; ++i) many += "# " + std::to_string(i) + "\n";
  out.push_back({"HDR many lines", "hdr", hdr(16, 16, texels, "-Y {h} +X {w}", many)});
  out.push_back({"HDR long line", "hdr", hdr(16, 16, texels, "-Y {h} +X {w}", "# " + std::string(300, 'x') + "\n")});
  std::string bare = hdr(16, 16, texels);
  out.push_back({"HDR without its format", "hdr", bare.erase(bare.find("FORMAT"), 23)});
  return out;
}

MadePictures made() {
  MadePictures out = module().pictures();
  for (const MadePicture& one : of_hdr()) out.push_back(one);
  return out;
}

TEST(Direct, MadePicturesAreReadAsByOpenImageIO) {
  std::map<std::string, int> read;
  for (const MadePicture& one : made()) {
    expect_same(one.name, one.format, one.bytes);
    read[one.format] += of_direct(one.format, one.bytes).refusal.empty();
  }
  for (const char* format : {"png", "openexr", "jpeg", "hdr"}) EXPECT_GT(read[format], 10) << format;
}

std::string format_of(const std::string& bytes) {
  if (bytes.starts_with("\x76\x2f\x31\x01")) return "openexr";
  if (bytes.starts_with("\x89PNG")) return "png";
  if (bytes.starts_with("\xff\xd8\xff")) return "jpeg";
  return bytes.starts_with("#?") ? "hdr" : "";
}

TEST(Direct, PicturesOfTheCheckoutAreReadAsByOpenImageIO) {
  int count = 0;
  for (const char* folder : {"scenes", "tests", "examples", "docs/gallery"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(test::source_folder()) / folder)) {
      if (!entry.is_regular_file()) continue;
      const std::string extension = entry.path().extension().string();
      if (extension != ".png" && extension != ".exr" && extension != ".hdr" && extension != ".jpg") continue;
      const std::string bytes = contents(entry.path());
      expect_same(entry.path().string(), format_of(bytes), bytes);
      ++count;
    }
  }
  EXPECT_GT(count, 30);
}

/// The first of each format and some of every kind, small enough to be damaged often.
MadePictures to_be_damaged() {
  MadePictures out;
  std::map<std::string, int> count;
  for (const MadePicture& one : made()) {
    if (one.bytes.size() > 6000 || one.name.find("progressive") != std::string::npos) continue;
    if (count[one.format]++ % 7 == 0) out.push_back(one);
  }
  return out;
}

/// A damaged file may be refused for another of its faults, and what libraries leave open in what they accept is no matter here.
void expect_both_refuse_or_none(const std::string& name, const std::string& format, const std::string& bytes) {
  const Answer expected = of_openimageio(format, bytes), found = of_direct(format, bytes);
  EXPECT_EQ(found.refusal.empty(), expected.refusal.empty()) << name << ": " << found.refusal << " | " << expected.refusal;
  if (!found.refusal.empty()) return;
  EXPECT_EQ(found.description, expected.description) << name;
  // A Radiance picture may have got one of the three exponents of of_hdr().
  EXPECT_TRUE(format == "hdr" || found.texels == expected.texels) << name;
}

TEST(Direct, CutPicturesAreRefusedAsByOpenImageIO) {
  for (const MadePicture& one : to_be_damaged()) {
    const std::size_t step = one.bytes.size() / 60 + 1;
    for (std::size_t size = 4; size < one.bytes.size(); size += step)
      expect_both_refuse_or_none(fmt::format("{} cut to {} bytes", one.name, size), one.format, one.bytes.substr(0, size));
    expect_both_refuse_or_none(one.name + " without its last byte", one.format, one.bytes.substr(0, one.bytes.size() - 1));
  }
}

TEST(Direct, DamagedPicturesAreRefusedAsByOpenImageIO) {
  std::minstd_rand random(2026);
  for (const MadePicture& one : to_be_damaged()) {
    for (int i = 0; i < 60; ++i) {
      std::string bytes = one.bytes;
      const std::size_t at = 4 + random() % (bytes.size() - 4);
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
      expect_both_refuse_or_none(fmt::format("{} with byte {} as {}", one.name, at, static_cast<unsigned char>(bytes[at])), one.format,
                                 bytes);
    }
  }
}

StoredPicture to_write(const std::vector<StoredChannel>& channels, Notes notes) {
  StoredPicture picture;
  picture.width = 45;
  picture.height = 37;
  picture.channels = channels;
  picture.compression = "zip";
  picture.notes = std::move(notes);
  return picture;
}

TEST(Direct, ExrsHaveTheSameBytes) {
  const StoredChannel r{"R", "half", 2}, g{"G", "half", 2}, b{"B", "half", 2}, a{"A", "half", 2}, z{"depth.Z", "float", 4},
      id{"id", "uint", 4};
  const Notes notes{{"rainref", "a note"},
                    {"rainref.scene", "[run]\nsize = [1, 2]\n"},
                    {"rainref.text",
                     "Gr\xc3\xbc\xc3\x9f"
                     "e"}};
  for (const auto& channels : std::vector<std::vector<StoredChannel>>{{r, g, b, a}, {r, g, b}, {z}, {a, z, r, id, g}, {id}}) {
    for (const Notes& some : {notes, Notes()}) {
      const StoredPicture picture = to_write(channels, some);
      std::string texels(picture.texel_bytes() * 45 * 37, '\0');
      Noise noise(5);
      for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<char>(i % 3 ? noise.byte() & 0x3f : i / 97);
      const auto* from = reinterpret_cast<const std::byte*>(texels.data());
      const auto expected = codec().encode_exr("a.exr", picture, from), found = module().codec->encode_exr("a.exr", picture, from);
      ASSERT_TRUE(expected && found);
      EXPECT_TRUE(*found == *expected) << described(picture);
    }
  }
}

TEST(Direct, AnUnknownFormatHasNoReader) { EXPECT_EQ(module().codec->open("tiff", {}), nullptr); }

}  // namespace
}  // namespace rainref::image_io
