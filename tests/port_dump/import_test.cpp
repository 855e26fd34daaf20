// Files as exporters write them, imported as a buffer. A table of forms by APIs: each file is made by the format's own library (EXR and PNG
// by OpenImageIO, raw bytes as the API copies them), and DDS by Microsoft's layout.
#include "port_dump/import_image.h"

#include <cstdlib>
#include <functional>

#include <fmt/format.h>

#include "image_io/codec.h"
#include "math/half.h"
#include "port_dump/support.h"

namespace rainref::port_dump {
namespace {

using ::testing::HasSubstr;

// ---- what is expected ----------------------------------------------------------------------------------------------
/// A picture whose rows and channels all differ.
capture::Array expected(Format format, int width = 61, int height = 37) {
  capture::Array out = image(format, width, height);
  const FormatInfo& f = info(format);
  std::vector<std::byte> bytes;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < f.channels; ++c) {
        const float value = (static_cast<float>(y) / static_cast<float>(height) + static_cast<float>(c)) / 4 +
                            static_cast<float>(x) / static_cast<float>(8 * width);
        std::uint32_t word = static_cast<std::uint32_t>(255 * value);
        if (f.kind == FormatInfo::float16) word = to_half(value).bits;
        if (f.kind == FormatInfo::float32) word = std::bit_cast<std::uint32_t>(value);
        for (int b = 0; b < f.channel_bytes; ++b) bytes.push_back(static_cast<std::byte>(word >> 8 * b));
      }
  out.levels = {capture::Bytes(std::move(bytes))};
  return out;
}
std::string text_of(const std::vector<std::byte>& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

/// An API: how its read-back of an image lies.
struct Api {
  const char* name;
  bool is_bottom_up = false, is_bgra = false, has_four_channels = false;
  std::size_t row_alignment = 1;
};
/// The texels in the order of the API's rows and channels, without padding.
struct Given {
  std::vector<std::string> rows;
  int channels;
};
Given given(const capture::Array& a, const Api& api) {
  const FormatInfo& f = info(a.format);
  const std::string all = text_of(a.levels[0]);
  const auto bytes = static_cast<std::size_t>(f.channel_bytes), texel = bytes * static_cast<std::size_t>(f.channels);
  const bool is_bgra = api.is_bgra && f.channels >= 3 && bytes == 1;
  Given out{{}, api.has_four_channels || is_bgra ? 4 : f.channels};
  for (int y = 0; y < a.height; ++y) {
    std::string row;
    for (int x = 0; x < a.width; ++x) {
      std::string t = all.substr((static_cast<std::size_t>(y) * a.width + x) * texel, texel);
      t.resize(bytes * static_cast<std::size_t>(out.channels), '\1');
      if (is_bgra) std::swap(t[0], t[2]);
      row += t;
    }
    out.rows.push_back(row);
  }
  if (api.is_bottom_up) std::reverse(out.rows.begin(), out.rows.end());
  return out;
}

// ---- forms ---------------------------------------------------------------------------------------------------------
std::string joined(const Given& g) {
  std::string out;
  for (const std::string& row : g.rows) out += row;
  return out;
}
/// By the layout of Microsoft's "Programming Guide for DDS" (DdsFile).
DdsFile dds_of(const capture::Array& a) {
  DdsFile file;
  file.width = static_cast<std::uint32_t>(a.width);
  file.height = static_cast<std::uint32_t>(a.height);
  return file;
}
std::string dds_dx10(const capture::Array& a, const Api& api) {
  const Given g = given(a, api);
  const FormatInfo& f = info(a.format);
  const std::uint32_t dxgi = f.kind == FormatInfo::float16   ? (g.channels == 4   ? 10
                                                                : g.channels == 2 ? 34
                                                                                  : 54)
                             : f.kind == FormatInfo::float32 ? (g.channels == 4   ? 2
                                                                : g.channels == 2 ? 16
                                                                                  : 41)
                                                             : (g.channels == 4   ? (api.is_bgra ? 87 : 28)
                                                                : g.channels == 2 ? 49
                                                                                  : 61);
  DdsFile file = dds_of(a);
  file.dxgi = dxgi;
  return file.with(joined(g));
}
std::string dds_older(const capture::Array& a, const Api& api) {
  const Given g = given(a, api);
  const FormatInfo& f = info(a.format);
  DdsFile file = dds_of(a);
  file.code = f.kind == FormatInfo::float16 ? (g.channels == 4   ? 113
                                               : g.channels == 2 ? 112
                                                                 : 111)
                                            : (g.channels == 4   ? 116
                                               : g.channels == 2 ? 115
                                                                 : 114);
  if (f.channel_bytes == 1) {
    file.pixel_flags = 0x41;
    file.bits = 32;
    file.masks = {api.is_bgra ? 0xff0000u : 0xffu, 0xff00, api.is_bgra ? 0xffu : 0xff0000u, 0xff000000};
  }
  return file.with(joined(g));
}
/// Channels R G B A of this type, written by OpenImageIO.
std::string exr(const capture::Array& a, const Api& api, bool as_floats) {
  const Given g = given(a, {api.name, api.is_bottom_up, false, api.has_four_channels});
  const bool halves = info(a.format).kind == FormatInfo::float16;
  image_io::StoredPicture picture;
  picture.width = picture.full_width = a.width;
  picture.height = picture.full_height = a.height;
  picture.compression = "zip";
  for (int c = 0; c < g.channels; ++c)
    picture.channels.push_back({std::string(1, "RGBA"[c]), as_floats || !halves ? "float" : "half", as_floats || !halves ? 4u : 2u});
  std::string texels = joined(g);
  if (as_floats && halves) {
    std::string wide;
    for (std::size_t i = 0; i + 1 < texels.size(); i += 2) {
      std::uint16_t bits;
      std::memcpy(&bits, &texels[i], 2);
      wide += raw(to_float(Half{bits}));
    }
    texels = wide;
  }
  const auto bytes = image_io::codec().encode_exr("a test", picture, reinterpret_cast<const std::byte*>(texels.data()));
  return bytes ? text_of(*bytes) : "";
}
/// 8-bit codes, by OpenImageIO's oiiotool from an EXR of floats.
std::string png(const capture::Array& a, const Api& api) {
  capture::Array floats = a;
  floats.format = info(a.format).channels == 4 ? Format::rgba32f : Format::rg32f;
  std::string values;
  for (const char code : text_of(a.levels[0])) values += raw(static_cast<float>(static_cast<unsigned char>(code)) / 255);
  const auto* first = reinterpret_cast<const std::byte*>(values.data());
  floats.levels = {capture::Bytes(first, first + values.size())};
  const TemporaryFolder folder;
  const std::string at = folder.path().string();
  put(folder / "a.exr", exr(floats, {api.name, api.is_bottom_up}, true));
  // A picture's alpha is not multiplied into its colours, and its codes are not converted.
  if (std::system(fmt::format("oiiotool {0}/a.exr --attrib oiio:UnassociatedAlpha 1 -d uint8 -o {0}/a.png >/dev/null 2>&1", at).c_str()) !=
      0)
    return "";
  return contents(folder / "a.png");
}
std::string raw_rows(const capture::Array& a, const Api& api) {
  std::string out;
  for (std::string row : given(a, api).rows) {
    row.resize((row.size() + api.row_alignment - 1) / api.row_alignment * api.row_alignment, '\7');
    out += row;
  }
  return out;
}
/// Without the padding of the last row, as a copy to a buffer of WebGPU or Direct3D 12 needs it.
std::string raw_rows_cut(const capture::Array& a, const Api& api) {
  const std::string whole = raw_rows(a, api);
  const Given g = given(a, api);
  return whole.substr(0, whole.size() - whole.size() / g.rows.size() + g.rows[0].size());
}

struct Form {
  const char* name;
  std::vector<Format> formats;
  std::function<std::string(const capture::Array&, const Api&)> write;
};
const std::vector<Form>& forms() {
  static const std::vector<Format> floats{Format::rg16f, Format::rgba16f, Format::r32f, Format::rg32f, Format::rgba32f},
      all{Format::rg16f, Format::rgba16f, Format::r32f, Format::rgba32f, Format::rgba8};
  static const std::vector<Form> table{
      {"DDS, DX10 header", all, dds_dx10},
      {"DDS, older header", all, dds_older},
      {"EXR, own type", floats, [](const capture::Array& a, const Api& api) { return exr(a, api, false); }},
      {"EXR, floats", {Format::rg16f, Format::rgba16f}, [](const capture::Array& a, const Api& api) { return exr(a, api, true); }},
      {"PNG", {Format::rgba8}, png},
      {"raw, whole rows", all, raw_rows},
      {"raw, last row cut", all, raw_rows_cut},
  };
  return table;
}
const std::vector<Api>& apis_of_table() {
  static const std::vector<Api> table{{"Vulkan", false, false, false, 1},
                                      {"Direct3D 12 and WebGPU", false, true, false, 256},
                                      {"OpenGL", true, false, false, 4},
                                      {"Unity and Godot", true, false, true, 1}};
  return table;
}

TEST(Import, TheTableOfFormsByApis) {
  int imported = 0;
  for (const Form& form : forms())
    for (const Api& api : apis_of_table())
      for (const Format format : form.formats) {
        const std::string what = fmt::format("{}, {}, {}", form.name, api.name, info(format).name);
        const capture::Array wanted = expected(format);
        const std::string file = form.write(wanted, api);
        if (file.empty() && std::string(form.name) == "PNG") continue;  // no oiiotool here (Debian: openimageio-tools)
        ASSERT_FALSE(file.empty()) << what;
        const TemporaryFolder folder;
        put(folder / "file", file);
        std::string said;
        try {
          const ImportedLevel got = import_level(folder / "file", wanted, 0, {});
          said = fmt::format("{}", fmt::join(got.said, "\n"));
          EXPECT_EQ(text_of(got.bytes), text_of(wanted.levels[0])) << what << '\n' << said;
          ++imported;
        } catch (const Error& error) {
          ADD_FAILURE() << what << ": " << error.what();
        }
        EXPECT_THAT(said, HasSubstr(api.is_bottom_up ? "origin bottom-left" : "origin top-left")) << what;
        EXPECT_EQ(said.find("row_pitch ") != std::string::npos, std::string(form.name).starts_with("raw") && api.row_alignment == 256)
            << what;
      }
  EXPECT_GE(imported, 4 * (5 + 5 + 5 + 2 + 5 + 5));
}

// ---- what is not sure, and what cannot be --------------------------------------------------------------------------
std::string said_of(const std::string& bytes, const capture::Array& wanted, const ImportHints& hints = {}) {
  const TemporaryFolder folder;
  put(folder / "file", bytes);
  try {
    return fmt::format("{}", fmt::join(import_level(folder / "file", wanted, 0, hints).said, "\n"));
  } catch (const Error& error) {
    return fmt::format("{} {}", static_cast<int>(error.code()), error.what());
  }
}
TEST(Import, WhatTheValuesDoNotTellIsSaid) {
  const capture::Array wanted = expected(Format::rg16f);
  std::string noise = text_of(wanted.levels[0]);
  for (std::size_t i = 0; i < noise.size(); i += 2) noise.replace(i, 2, raw(to_half(50.0f + static_cast<float>(i % 7)).bits));
  EXPECT_THAT(said_of(noise, wanted),
              HasSubstr("read as format rg16f, origin top-left; the values do not tell it from format rg16f, origin bottom-left"));
  EXPECT_THAT(said_of(noise, wanted, {.origin = Origin::bottom_left}), HasSubstr("read as format rg16f, origin bottom-left"));
}
TEST(Import, HintsAreObeyedAgainstTheValues) {
  const capture::Array wanted = expected(Format::rgba8);
  const std::string tight = text_of(wanted.levels[0]);
  EXPECT_THAT(said_of(tight, wanted), HasSubstr("read as format rgba8, origin top-left: so 9028 of 9028 values are near"));
  EXPECT_THAT(said_of(tight, wanted, {.origin = Origin::bottom_left, .is_bgra = true}),
              HasSubstr("read as format rgba8, channel_order bgra, origin bottom-left"));
  EXPECT_THAT(said_of(tight, wanted, {.row_pitch = 256}), HasSubstr("truncated: expected 37 rows of 256 bytes"));
}
TEST(Import, RefusalsNameSizesAndReasons) {
  const capture::Array wanted = expected(Format::rg16f), codes = expected(Format::rgba8);
  EXPECT_THAT(said_of("abc", wanted),
              ::testing::AllOf(::testing::StartsWith("3 "), HasSubstr("expected 9028 of rg16f, "), HasSubstr("found 3")));
  std::string floats;
  for (int i = 0; i < 4 * 61 * 37; ++i) floats += raw(0.1f + static_cast<float>(i));
  EXPECT_THAT(said_of(floats, wanted), HasSubstr("which no half equals"));
  EXPECT_THAT(said_of(dds_dx10(expected(Format::rg16f, 37, 61), {}), wanted), HasSubstr("width and height are exchanged"));
  EXPECT_THAT(said_of(dds_dx10(wanted, {}).substr(0, 300), wanted), HasSubstr("truncated"));
  EXPECT_THAT(said_of(dds_dx10(codes, {}), codes, {.row_pitch = 256}), HasSubstr("its own header says how its rows and channels lie"));
  EXPECT_THAT(said_of(exr(expected(Format::rgba32f), {}, true), wanted), HasSubstr("which no half equals"));
}

}  // namespace
}  // namespace rainref::port_dump
