#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>

#include "image_io/direct/exr_channels.h"
#include "image_io/direct/formats.h"
#include "image_io/exr_header.h"

namespace rainref::image_io::direct {
namespace {

constexpr int no_threads = 0;

/// A file in memory. OpenEXR writes its table of offsets again at the end.
class Memory : public Imf::OStream {
 public:
  explicit Memory(const std::string& name) : OStream(name.c_str()) {}

  void write(const char from[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    bytes_.resize(std::max(bytes_.size(), at_ + size));
    std::memcpy(bytes_.data() + at_, from, size);
    at_ += size;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t at) override { at_ = static_cast<std::size_t>(at); }

  std::vector<std::byte>& bytes() { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
  std::size_t at_ = 0;
};

Imf::Compression compression_of(const std::string& name) {
  for (int c = 0; c < Imf::NUM_COMPRESSION_METHODS; ++c)
    if (exr_compression_name(c) == name) return static_cast<Imf::Compression>(c);
  return Imf::ZIP_COMPRESSION;
}

Imf::Header header_of(const StoredPicture& picture) {
  Imf::Header header(picture.width, picture.height);
  header.compression() = compression_of(picture.compression);
  for (const StoredChannel& channel : picture.channels) header.channels().insert(channel.name, Imf::Channel(pixel_type(channel)));
  Imf::addCapDate(header, "");  // OpenImageIO stores a date; none makes equal files
  for (const Note& note : picture.notes) header.insert(note.key, Imf::StringAttribute(note.value));
  return header;
}

}  // namespace

std::optional<std::vector<std::byte>> encode_exr(const std::string& name, const StoredPicture& picture, const std::byte* texels) try {
  Memory memory(name);
  const Imf::Header header = header_of(picture);
  {
    Imf::OutputFile file(memory, header, no_threads);
    Imf::FrameBuffer source;
    const std::size_t texel_bytes = picture.texel_bytes();
    for (std::size_t c = 0; c < picture.channels.size(); ++c)
      source.insert(picture.channels[c].name,
                    Imf::Slice::Make(pixel_type(picture.channels[c]), texels + picture.texel_bytes(0, c), header.dataWindow(), texel_bytes,
                                     texel_bytes * static_cast<std::size_t>(picture.width)));
    file.setFrameBuffer(source);
    file.writePixels(picture.height);
  }  // writes the table
  return std::move(memory.bytes());
} catch (const std::exception& error) {
  throw std::runtime_error(fmt::format("Failed OpenEXR write: {}", error.what()));
}

}  // namespace rainref::image_io::direct
