// Dumps put together byte by byte, and what reading them says.
#pragma once

#include <array>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "base/npy.h"
#include "base/temporary_folder.h"
#include "image_io/tiny_files.h"
#include "port_dump/read_buffer.h"
#include "rainref/error.h"

namespace rainref::port_dump {

using image_io::little;
using image_io::raw;

/// An expected image with its mip levels; only its shape matters.
inline capture::Array image(Format format, int width, int height, int levels = 1) {
  capture::Array out;
  out.format = format;
  out.width = width;
  out.height = height;
  out.levels.resize(levels);
  return out;
}

/// struct Drop { float x, y; float velocity[2]; uint id; int kind; } in 32 bytes, the last 8 of them padding.
inline capture::Array drops() {
  using scene::Scalar;
  capture::Array out;
  out.is_records = true;
  out.record = {"Drop",
                32,
                {{"x", Scalar::float32, 1, 0, "m", "."},
                 {"y", Scalar::float32, 1, 4, "m", "."},
                 {"velocity", Scalar::float32, 2, 8, "m/s", "."},
                 {"id", Scalar::uint32, 1, 16, "1", "."},
                 {"kind", Scalar::int32, 1, 20, "1", "."}}};
  out.width = 2;
  out.height = 1;
  out.levels.resize(1);
  return out;
}

/// Values of one type, one behind the other.
template <class T>
std::string values(const std::vector<T>& all) {
  std::string out;
  for (const T& v : all) out += raw(v);
  return out;
}

/// A DDS file. With `dxgi`, a DX10 header; else the pixel format of code, bits and masks.
struct DdsFile {
  std::uint32_t width = 1, height = 1, levels = 1;
  std::uint32_t dxgi = 0, dimension = 3, misc = 0, array_size = 1;
  std::uint32_t pixel_flags = 4, code = 0x30315844, bits = 0;
  std::array<std::uint32_t, 4> masks{};
  std::uint32_t flags = 0x1007 | 0x20000, pitch = 0, caps2 = 0;

  std::string with(const std::string& data) const {
    std::string out = "DDS " + little(124) + little(flags) + little(height) + little(width) + little(pitch) + little(0) + little(levels);
    out += std::string(44, '\0') + little(32) + little(pixel_flags) + little(code) + little(bits);
    for (const std::uint32_t mask : masks) out += little(mask);
    out += little(0x1000) + little(caps2) + std::string(12, '\0');
    if (dxgi) out += little(dxgi) + little(dimension) + little(misc) + little(array_size) + little(0);
    return out + data;
  }
};

/// A folder of a dump: files in, a buffer or a refusal out.
class Dump {
 public:
  Dump& file(const std::string& name, const std::string& bytes) {
    put(folder_ / name, bytes);
    return *this;
  }
  capture::Array read(const capture::Array& expected, const PortInfo& port = {}) {
    return read_port_buffer(folder_.path(), "out.b", expected, port, notes_);
  }
  /// The bytes of a level as text.
  std::string level(const capture::Array& expected, const PortInfo& port = {}, int l = 0) {
    const capture::Array array = read(expected, port);
    const std::vector<std::byte>& bytes = array.levels.at(l);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  /// Level 0 of a buffer whose fourth channel is the constant 1.
  std::string opaque(const capture::Array& expected) {
    const capture::Array array = read_port_buffer(folder_.path(), "out.b", expected, {}, notes_, Alpha::one);
    return {reinterpret_cast<const char*>(array.levels[0].data()), array.levels[0].size()};
  }
  std::string refusal(const capture::Array& expected, const PortInfo& port = {}) {
    const std::string error = error_of([&] { read(expected, port); });
    if (error == "none") return "accepted";
    EXPECT_THAT(error, testing::StartsWith("3 "));
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    return error.substr(2);
  }
  const std::vector<std::string>& notes() const { return notes_.lines; }
  /// What the form of the buffer leaves open that was read last.
  const KeptForm& kept() const { return notes_.kept; }
  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
  ReadNotes notes_;
};

}  // namespace rainref::port_dump
