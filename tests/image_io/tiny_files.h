// Small image files put together byte by byte, so that reading is not judged by the library that reads.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "base/error_of.h"
#include "base/temporary_folder.h"
#include "image/images.h"
#include "rainref/image.h"

namespace rainref::image_io {

inline std::string big(std::uint32_t value, int bytes = 4) {
  std::string out;
  for (int i = bytes - 1; i >= 0; --i) out += static_cast<char>(value >> (8 * i));
  return out;
}

inline std::string little(std::uint32_t value, int bytes = 4) {
  std::string out;
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i));
  return out;
}

/// One value's bytes as they lie in memory (little endian).
template <class T>
std::string raw(T value) {
  std::string out(sizeof value, '\0');
  std::memcpy(out.data(), &value, sizeof value);
  return out;
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
  std::uint32_t crc = ~0u;
  for (const char c : type + data) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
  }
  return big(static_cast<std::uint32_t>(data.size())) + type + data + big(~crc);
}

/// A PNG whose rows are given as raw bytes, stored without compression in one block (under 65 536 bytes of rows).
/// colour: 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA. `extra` is chunks to stand before the data.
inline std::string png(int width, int height, int depth, int colour, const std::vector<std::string>& rows, const std::string& extra = {}) {
  std::string lines;
  for (const std::string& row : rows) lines += '\0' + row;  // filter 0
  std::uint32_t a = 1, b = 0;
  for (const char c : lines) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const auto size = static_cast<std::uint32_t>(lines.size());
  const std::string stream = "\x78\x01\x01" + little(size, 2) + little(~size, 2) + lines + big(b << 16 | a);
  const std::string header = big(width) + big(height) + static_cast<char>(depth) + static_cast<char>(colour) + std::string(3, '\0');
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + extra + png_chunk("IDAT", stream) + png_chunk("IEND", "");
}

enum class ExrType : std::uint8_t { uint = 0, half = 1, float32 = 2 };
struct ExrChannel {
  std::string name;
  ExrType type;
  std::function<std::string(int x, int y)> sample;  ///< the bytes of one sample
};
struct ExrWindow {
  int x, y, width, height;
};

/// An uncompressed scan-line EXR. Channels must come in alphabetical order, as the format wants.
inline std::string exr(ExrWindow data, const std::vector<ExrChannel>& channels, std::optional<ExrWindow> display = {}) {
  const auto attribute = [](const std::string& name, const std::string& type, const std::string& value) {
    return name + '\0' + type + '\0' + little(static_cast<std::uint32_t>(value.size())) + value;
  };
  const auto box = [](const ExrWindow& w) { return little(w.x) + little(w.y) + little(w.x + w.width - 1) + little(w.y + w.height - 1); };
  std::string list;
  for (const ExrChannel& c : channels) {
    list += c.name + '\0' + little(static_cast<std::uint32_t>(c.type)) + std::string(4, '\0') + little(1) + little(1);
  }
  std::string out = "\x76\x2f\x31\x01" + little(2);
  out += attribute("channels", "chlist", list + '\0');
  out += attribute("compression", "compression", std::string(1, '\0'));
  out += attribute("dataWindow", "box2i", box(data));
  out += attribute("displayWindow", "box2i", box(display.value_or(data)));
  out += attribute("lineOrder", "lineOrder", std::string(1, '\0'));
  out += attribute("pixelAspectRatio", "float", raw(1.0f));
  out += attribute("screenWindowCenter", "v2f", raw(0.0f) + raw(0.0f));
  out += attribute("screenWindowWidth", "float", raw(1.0f));
  out += '\0';
  std::vector<std::string> lines;
  for (int y = 0; y < data.height; ++y) {
    std::string line;
    for (const ExrChannel& c : channels) {
      for (int x = 0; x < data.width; ++x) line += c.sample(x, y);
    }
    lines.push_back(little(data.y + y) + little(static_cast<std::uint32_t>(line.size())) + line);
  }
  std::size_t offset = out.size() + 8 * lines.size();
  for (const std::string& line : lines) {
    out += raw(static_cast<std::uint64_t>(offset));
    offset += line.size();
  }
  for (const std::string& line : lines) out += line;
  return out;
}

/// A Radiance file with plain RGBE texels. `orientation` names the axes as the format does; `lines` are more of the header.
inline std::string hdr(int width, int height, const std::vector<std::array<int, 4>>& texels,
                       const std::string& orientation = "-Y {h} +X {w}", const std::string& lines = {}) {
  std::string size = orientation;
  size.replace(size.find("{h}"), 3, std::to_string(height));
  size.replace(size.find("{w}"), 3, std::to_string(width));
  std::string out = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n" + lines + "\n" + size + "\n";
  for (const auto& texel : texels) {
    for (const int byte : texel) out += static_cast<char>(byte);
  }
  return out;
}

/// A grey baseline JPEG of columns x 2 blocks of 8x8 texels; block i (row by row) has the value 129 + i throughout.
inline std::string jpeg(int columns) {
  const auto segment = [](int marker, const std::string& data) {
    return std::string("\xff") + static_cast<char>(marker) + big(static_cast<std::uint32_t>(data.size() + 2), 2) + data;
  };
  std::string out = "\xff\xd8";
  std::string steps(65, 8);  // every step is 8
  steps[0] = 0;
  out += segment(0xdb, steps);
  out += segment(0xc0, std::string("\x08") + big(16, 2) + big(8 * columns, 2) + std::string("\1\1\x11\0", 4));  // 8 bits, one channel
  // DC codes: 0 "no change", 10 "one bit follows". AC codes: 0 "end of block".
  out += segment(0xc4, std::string("\0\1\1", 3) + std::string(14, '\0') + std::string("\0\1", 2));
  out += segment(0xc4, std::string("\x10\1", 2) + std::string(15, '\0') + std::string("\0", 1));
  out += segment(0xda, std::string("\1\1\0\0\x3f\0", 6));
  out += std::string(columns, '\xaa');  // a block is 10 1 0: one step up
  return out + "\xff\xd9";
}

/// The storage bytes of one texel, as numbers of type T.
template <class T>
std::array<T, 4> texel(const Image& image, int x, int y) {
  std::array<T, 4> out;
  std::memcpy(out.data(), image.row_bytes(y) + x * sizeof out, sizeof out);
  return out;
}

}  // namespace rainref::image_io
