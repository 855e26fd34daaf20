// 8-bit PNG: zlib compresses the rows after Paeth's filter.
#define ZLIB_CONST  // makes zlib treat its input as const
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <span>
#include <string_view>

#include "image_io/png_chunks.h"
#include "image_io/write.h"
#include "rainref/error.h"

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

/// Source: PNG specification, third edition, 11.3.3. Latin-1 and UTF-8 agree in ASCII.
void put_note(Bytes& out, const Note& note) {
  const bool is_ascii = std::all_of(note.value.begin(), note.value.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  std::string content = note.key + '\0';
  // After iTXt's keyword: not compressed (two bytes), no language, no translated keyword.
  if (!is_ascii) content.append(4, '\0');
  content += note.value;
  put_chunk(out, is_ascii ? "tEXt" : "iTXt", std::as_bytes(std::span(content)));
}

/// The compressed rows, in consecutive chunks.
class ImageData {
 public:
  explicit ImageData(Bytes& file) : file_(file), piece_(std::size_t{1} << 15) {
    // After the filter most repetitions are runs of one byte, which zlib's RLE finds without a search.
    if (::deflateInit2(&stream_, 6, Z_DEFLATED, MAX_WBITS, 8, Z_RLE) != Z_OK) throw std::bad_alloc();
    empty_piece();
  }
  ~ImageData() { ::deflateEnd(&stream_); }
  ImageData(const ImageData&) = delete;
  ImageData& operator=(const ImageData&) = delete;

  void add(std::span<const std::byte> row) {
    stream_.next_in = reinterpret_cast<const Bytef*>(row.data());
    stream_.avail_in = static_cast<uInt>(row.size());
    while (stream_.avail_in > 0) {
      ::deflate(&stream_, Z_NO_FLUSH);
      if (stream_.avail_out == 0) put_piece();
    }
  }
  void finish() {
    while (::deflate(&stream_, Z_FINISH) != Z_STREAM_END) put_piece();
    put_piece();
  }

 private:
  void put_piece() {
    put_chunk(file_, "IDAT", std::span(piece_).first(piece_.size() - stream_.avail_out));
    empty_piece();
  }
  void empty_piece() {
    stream_.next_out = reinterpret_cast<Bytef*>(piece_.data());
    stream_.avail_out = static_cast<uInt>(piece_.size());
  }

  Bytes& file_;
  Bytes piece_;
  z_stream stream_{};
};

/// The one of three neighbours that is nearest to left + above - corner. Source: PNG specification, third edition, 9.4.
int nearest(int left, int above, int corner) {
  const int to_left = std::abs(above - corner), to_above = std::abs(left - corner), to_corner = std::abs(left + above - 2 * corner);
  return to_left <= to_above && to_left <= to_corner ? left : to_above <= to_corner ? above : corner;
}

}  // namespace

std::vector<std::byte> png_bytes(const Image& image, PngChannels channels, const Notes& notes) {
  if (image.empty() || (image.format() != Format::rgba8 && image.format() != Format::rgba8_srgb))
    throw Error(ExitCode::internal, "writing a picture: a PNG is made of rgba8");
  const bool has_alpha = channels == PngChannels::rgba;
  const std::size_t texel_bytes = has_alpha ? 4 : 3, row_bytes = texel_bytes * static_cast<std::size_t>(image.width());
  Bytes out, header;
  for (const int byte : {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a}) out.push_back(static_cast<std::byte>(byte));
  put_word(header, static_cast<std::uint32_t>(image.width()));
  put_word(header, static_cast<std::uint32_t>(image.height()));
  for (const int byte : {8, has_alpha ? 6 : 2, 0, 0, 0}) header.push_back(static_cast<std::byte>(byte));
  put_chunk(out, "IHDR", header);
  if (image.format() == Format::rgba8_srgb) put_chunk(out, "sRGB", Bytes(1));
  for (const Note& note : notes) put_note(out, note);

  // A texel of zeros is left of each row, and a row of zeros above the first.
  Bytes row(texel_bytes + row_bytes), above(row.size()), filtered(1 + row_bytes);
  filtered[0] = std::byte{4};  // the filter's number
  ImageData data(out);
  for (int y = 0; y < image.height(); ++y) {
    const std::byte* texel = image.row_bytes(y);
    for (std::size_t at = texel_bytes; at < row.size(); at += texel_bytes, texel += 4) std::copy_n(texel, texel_bytes, &row[at]);
    for (std::size_t k = 0; k < row_bytes; ++k) {
      const int foretold =
          nearest(std::to_integer<int>(row[k]), std::to_integer<int>(above[texel_bytes + k]), std::to_integer<int>(above[k]));
      filtered[1 + k] = static_cast<std::byte>(std::to_integer<int>(row[texel_bytes + k]) - foretold);
    }
    data.add(filtered);
    row.swap(above);
  }
  data.finish();
  put_chunk(out, "IEND", {});
  return out;
}

}  // namespace rainref::image_io
