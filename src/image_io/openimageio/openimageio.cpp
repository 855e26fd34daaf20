// The library behind Codec: the only file that uses OpenImageIO.
#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "image_io/codec.h"
#include "image_io/openimageio/quiet_png.h"

namespace rainref::image_io {

namespace {

/// OpenImageIO 2.4 accepts an offset of -1, as in damaged tables of EXRs, and reads before the bytes.
class Memory : public OIIO::Filesystem::IOMemReader {
 public:
  using IOMemReader::IOMemReader;
  std::size_t pread(void* to, std::size_t bytes, std::int64_t offset) override {
    return offset < 0 ? 0 : IOMemReader::pread(to, bytes, offset);
  }
};

/// OpenImageIO's reason, and libpng's, which OpenImageIO does not pass on.
[[noreturn]] void fail(std::string reason) {
  const std::string png = take_png_refusal();
  if (!png.empty() && reason.find(png) == std::string::npos) reason += (reason.empty() ? "" : ": ") + png;
  throw std::runtime_error(reason);
}

class Reader : public PictureReader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : memory_(bytes.data(), bytes.size()) {}

  /// Returns false if this OpenImageIO cannot read the format.
  bool open(const char* format) {
    input_ = OIIO::ImageInput::create(format);
    if (!input_ || !input_->set_ioproxy(&memory_)) return false;
    OIIO::ImageSpec config, spec;
    config.attribute("oiio:UnassociatedAlpha", 1);  // colour not multiplied by alpha
    config.attribute("oiio:RawColor", 1);           // no change of colour model
    // The bytes come from memory; OpenImageIO needs a name only for its messages.
    take_png_refusal();  // of an earlier picture
    if (!input_->open("picture", spec, config)) fail(input_->geterror());
    take(spec);
    return true;
  }

  const StoredPicture& picture() const override { return picture_; }

  void read(std::size_t first, std::size_t end, std::byte* texels) override {
    // The unknown type asks for the file's own types, each channel in its own.
    const bool whole = input_->read_image(0, 0, static_cast<int>(first), static_cast<int>(end), OIIO::TypeUnknown, texels);
    // Some readers return success with partial data, and only leave a message.
    if (!whole || input_->has_error()) fail(input_->geterror());
  }

 private:
  void take(const OIIO::ImageSpec& spec) {
    StoredPicture& p = picture_;
    p.width = spec.width;
    p.height = spec.height;
    p.depth = spec.depth;
    p.x = spec.x;
    p.y = spec.y;
    p.full_x = spec.full_x;
    p.full_y = spec.full_y;
    p.full_width = spec.full_width;
    p.full_height = spec.full_height;
    p.deep = spec.deep;
    p.orientation = spec.get_int_attribute("Orientation", 1);
    p.compression = std::string(spec.get_string_attribute("compression", "none"));
    p.colour_space = std::string(spec.get_string_attribute("oiio:ColorSpace"));
    for (int c = 0; c < spec.nchannels; ++c) {
      const OIIO::TypeDesc type = spec.channelformat(c);
      p.channels.push_back({spec.channelnames[static_cast<std::size_t>(c)], type.c_str(), type.size()});
    }
  }

  Memory memory_;  // outlives its reader
  std::unique_ptr<OIIO::ImageInput> input_;
  StoredPicture picture_;
};

std::unique_ptr<PictureReader> open(const char* format, std::span<const std::byte> bytes) {
  auto reader = std::make_unique<Reader>(bytes);
  if (!reader->open(format)) return nullptr;
  return reader;
}

OIIO::ImageSpec spec_of(const StoredPicture& picture) {
  const OIIO::TypeDesc first(picture.channels.front().type);
  OIIO::ImageSpec spec(picture.width, picture.height, 0, first);
  spec.nchannels = static_cast<int>(picture.channels.size());
  for (const StoredChannel& channel : picture.channels) {
    spec.channelnames.push_back(channel.name);
    spec.channelformats.emplace_back(channel.type);
  }
  // A list is for channels of several types.
  if (std::ranges::all_of(spec.channelformats, [&](OIIO::TypeDesc type) { return type == first; })) spec.channelformats.clear();
  if (!picture.compression.empty()) spec.attribute("compression", picture.compression);
  spec.attribute("oiio:UnassociatedAlpha", 1);  // colour is stored as it is
  // An empty date, because otherwise OpenImageIO stores the time of day in an EXR, and no two files would be equal.
  spec.attribute("DateTime", "");
  for (const Note& note : picture.notes) spec.attribute(note.key, note.value);
  return spec;
}

/// In memory, because OpenImageIO would open the final name, and its errors do not say why a disk refused.
std::optional<std::vector<std::byte>> encode_exr(const std::string& name, const StoredPicture& picture, const std::byte* texels) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);  // outlives its writer
  const auto output = OIIO::ImageOutput::create("openexr");
  if (!output || !output->set_ioproxy(&memory)) return std::nullopt;
  const OIIO::ImageSpec spec = spec_of(picture);
  // The texels are in the file's own types: name it if there is one type, leave it unknown for several.
  const OIIO::TypeDesc type = spec.channelformats.empty() ? spec.format : OIIO::TypeUnknown;
  const bool whole = output->open(name, spec) && output->write_image(type, texels) && output->close();
  if (!whole || output->has_error()) fail(output->geterror());
  const auto written = std::as_bytes(std::span(bytes));
  return std::vector<std::byte>(written.begin(), written.end());
}

}  // namespace

/// The function that codec() loads. Sets the state that OpenImageIO keeps for the whole process to what determinism needs: one thread for
/// OpenImageIO and none for OpenEXR's pool, so that decoding happens on the caller's thread; no filling in of missing pixels; OpenEXR's C++
/// reader. Overrides the environment (OPENIMAGEIO_OPTIONS).
extern "C" __attribute__((visibility("default"))) const Codec* rainref_openimageio() {
  OIIO::attribute("threads", 1);
  // -1: decode in the calling thread. 0 would mean as many threads as cores, 1 a pool of one extra thread.
  OIIO::attribute("exr_threads", -1);
  OIIO::attribute("missingcolor", "");
  OIIO::attribute("openexr:core", 0);
  OIIO::attribute("try_all_readers", 0);
  static constexpr Codec functions{open, encode_exr};
  return &functions;
}

}  // namespace rainref::image_io
