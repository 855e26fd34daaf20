#include "image_io/png_write.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "image_io/deflate.h"
#include "image_io/png_chunks.h"

namespace rainref::image_io {
namespace {

using Bytes = std::vector<std::byte>;

void put_word(Bytes& out, std::uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::byte>(word >> shift));
}
void put_chunk(Bytes& out, std::string_view name, std::span<const std::byte> content) {
  put_word(out, static_cast<std::uint32_t>(content.size()));
  const std::size_t begin = out.size();
  for (const char c : name) out.push_back(static_cast<std::byte>(c));
  out.insert(out.end(), content.begin(), content.end());
  put_word(out, png_checksum(std::span(out).subspan(begin)));
}

/// A row less what the filter foretells from the texel to its left and the row above: 0 nothing, 1 the left, 2 the above.
Bytes filtered(int filter, std::span<const std::byte> row, std::span<const std::byte> above, std::size_t texel) {
  Bytes out{static_cast<std::byte>(filter)};
  for (std::size_t k = 0; k < row.size(); ++k) {
    const std::byte foretold = filter == 1 ? (k < texel ? std::byte{0} : row[k - texel]) : filter == 2 ? above[k] : std::byte{0};
    out.push_back(static_cast<std::byte>(std::to_integer<int>(row[k]) - std::to_integer<int>(foretold)));
  }
  return out;
}
/// How much is left of a row, as signed numbers: what compresses well has little.
int rest(const Bytes& row) {
  int sum = 0;
  for (std::size_t k = 1; k < row.size(); ++k) sum += std::abs(static_cast<int>(static_cast<std::int8_t>(row[k])));
  return sum;
}

}  // namespace

std::vector<std::byte> png_file(std::size_t width, std::size_t height, std::size_t channels, std::span<const std::byte> texels,
                                bool is_srgb) {
  constexpr std::array<int, 5> colour_types{0, 0, 4, 2, 6};
  Bytes out;
  for (const int byte : {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a}) out.push_back(static_cast<std::byte>(byte));
  Bytes header;
  put_word(header, static_cast<std::uint32_t>(width));
  put_word(header, static_cast<std::uint32_t>(height));
  for (const int byte : {8, colour_types.at(channels), 0, 0, 0}) header.push_back(static_cast<std::byte>(byte));
  put_chunk(out, "IHDR", header);
  if (is_srgb) put_chunk(out, "sRGB", Bytes{std::byte{0}});
  const std::size_t bytes = width * channels;
  const Bytes nothing(bytes);
  Bytes rows;
  for (std::size_t y = 0; y < height; ++y) {
    const auto row = texels.subspan(y * bytes, bytes),
               above = y == 0 ? std::span<const std::byte>(nothing) : texels.subspan((y - 1) * bytes, bytes);
    Bytes best = filtered(0, row, above, channels);
    for (const int filter : {1, 2})
      if (Bytes other = filtered(filter, row, above, channels); rest(other) < rest(best)) best = std::move(other);
    rows.insert(rows.end(), best.begin(), best.end());
  }
  put_chunk(out, "IDAT", zlib_bytes(rows));
  put_chunk(out, "IEND", {});
  return out;
}

std::vector<std::byte> with_png_text(std::span<const std::byte> file, const Notes& notes) {
  Bytes chunks;
  for (const Note& note : notes) {
    const bool is_ascii = std::all_of(note.value.begin(), note.value.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
    // Latin-1 and UTF-8 agree in ASCII. Behind iTXt's keyword: not compressed (two bytes), no language, no translated keyword.
    std::string content = note.key + '\0';
    if (!is_ascii) content.append(4, '\0');
    content += note.value;
    put_chunk(chunks, is_ascii ? "tEXt" : "iTXt", std::as_bytes(std::span(content)));
  }
  const std::size_t place = png_place_of_text(file);
  Bytes out(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(place));
  out.insert(out.end(), chunks.begin(), chunks.end());
  out.insert(out.end(), file.begin() + static_cast<std::ptrdiff_t>(place), file.end());
  return out;
}

}  // namespace rainref::image_io
