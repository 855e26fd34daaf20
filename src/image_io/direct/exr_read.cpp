#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfEnvmap.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTiledInputPart.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "image_io/direct/exr_channels.h"
#include "image_io/direct/formats.h"
#include "image_io/exr_header.h"

namespace rainref::image_io::direct {
namespace {

constexpr int no_threads = 0;

/// The bytes of the file as OpenEXR reads them. Damaged tables send it anywhere.
class Bytes : public Imf::IStream {
 public:
  explicit Bytes(std::span<const std::byte> bytes) : IStream("picture"), bytes_(bytes) {}

  bool read(char to[], int count) override {
    const auto wanted = static_cast<std::size_t>(count);
    if (at_ > bytes_.size() || wanted > bytes_.size() - at_) throw Iex::IoExc("Unexpected end of file.");
    std::memcpy(to, bytes_.data() + at_, wanted);
    at_ += wanted;
    return true;
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override { at_ = at; }

 private:
  std::span<const std::byte> bytes_;
  std::uint64_t at_ = 0;
};

std::string lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

/// Calls f; what OpenEXR throws becomes std::runtime_error with this beginning.
template <class F>
auto worded(const char* beginning, F&& f) try {
  return f();
} catch (const std::exception& error) {
  throw std::runtime_error(std::string(beginning) + error.what());
}

class ExrReader : public PictureReader {
 public:
  explicit ExrReader(std::span<const std::byte> bytes) : stream_(bytes) {
    worded("OpenEXR exception: ", [&] { file_ = std::make_unique<Imf::MultiPartInputFile>(stream_, no_threads); });
    const Imf::Header& header = file_->header(0);
    picture_.channels = exr_channels(header.channels());
    describe(header);
  }

  const StoredPicture& picture() const override { return picture_; }

  void read(std::size_t first, std::size_t end, std::byte* texels) override {
    const Imath::Box2i window = file_->header(0).dataWindow();
    const std::size_t texel_bytes = picture_.texel_bytes(first, end);
    Imf::FrameBuffer target;
    for (std::size_t c = first; c < end; ++c)
      target.insert(picture_.channels[c].name,
                    Imf::Slice::Make(pixel_type(picture_.channels[c]), texels + picture_.texel_bytes(first, c), window, texel_bytes,
                                     texel_bytes * static_cast<std::size_t>(picture_.width)));
    // OpenEXR takes memory for rows or tiles here; who asked for the picture has checked its size, and that it is not deep.
    if (is_tiled_) {
      auto tiles = worded("OpenEXR exception: ", [&] { return Imf::TiledInputPart(*file_, 0); });
      worded("Failed OpenEXR read: ", [&] {
        tiles.setFrameBuffer(target);
        tiles.readTiles(0, tiles.numXTiles() - 1, 0, tiles.numYTiles() - 1);
      });
    } else {
      auto rows = worded("OpenEXR exception: ", [&] { return Imf::InputPart(*file_, 0); });
      worded("Failed OpenEXR read: ", [&] {
        rows.setFrameBuffer(target);
        rows.readPixels(window.min.y, window.max.y);
      });
    }
  }

 private:
  void describe(const Imf::Header& header) {
    const Imath::Box2i data = header.dataWindow(), display = header.displayWindow();
    picture_.x = data.min.x;
    picture_.y = data.min.y;
    picture_.width = data.max.x - data.min.x + 1;
    picture_.height = data.max.y - data.min.y + 1;
    picture_.full_x = display.min.x;
    picture_.full_y = display.min.y;
    picture_.full_width = display.max.x - display.min.x + 1;
    picture_.full_height = display.max.y - display.min.y + 1;
    picture_.deep = header.type() == Imf::DEEPSCANLINE || header.type() == Imf::DEEPTILE;
    is_tiled_ = header.type() == Imf::TILEDIMAGE && header.hasTileDescription();
    const bool has_levels = is_tiled_ && header.tileDescription().mode != Imf::ONE_LEVEL;
    // Of the faces of a cube one is a picture; OpenImageIO says so by this size.
    if (has_levels && Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE)
      picture_.full_width = picture_.full_height = picture_.width;
    picture_.compression = exr_compression_name(header.compression());
    picture_.colour_space = "Linear";
    for (auto a = header.begin(); a != header.end(); ++a) {
      const auto* number = dynamic_cast<const Imf::IntAttribute*>(&a.attribute());
      if (number && lower(a.name()) == "orientation") picture_.orientation = number->value();
    }
  }

  Bytes stream_;  // outlives its reader
  std::unique_ptr<Imf::MultiPartInputFile> file_;
  bool is_tiled_ = false;
  StoredPicture picture_;
};

}  // namespace

std::unique_ptr<PictureReader> open_exr(std::span<const std::byte> bytes) { return std::make_unique<ExrReader>(bytes); }

}  // namespace rainref::image_io::direct
