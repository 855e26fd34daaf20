#include <cstdio>  // jpeglib.h takes FILE from its includer

#include <jpeglib.h>

#include <algorithm>
#include <csetjmp>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "image_io/direct/formats.h"
#include "image_io/direct/orientation.h"
#include "image_io/direct/samples.h"

namespace rainref::image_io::direct {
namespace {

constexpr int exif_marker = JPEG_APP0 + 1;

/// libjpeg's errors as OpenImageIO words them.
struct Errors {
  jpeg_error_mgr handler;  // first: libjpeg gives a pointer to it
  std::jmp_buf jump;
  // The first warning, after which libjpeg gives no other, and the error that ends reading. No strings, which allocate.
  char texts[2][JMSG_LENGTH_MAX];
  int count;
};

Errors& errors_of(j_common_ptr jpeg) { return *reinterpret_cast<Errors*>(jpeg->err); }
void note(j_common_ptr jpeg) {
  Errors& errors = errors_of(jpeg);
  if (errors.count < 2) errors.handler.format_message(jpeg, errors.texts[errors.count++]);
}
[[noreturn]] void leave(j_common_ptr jpeg) {
  note(jpeg);
  std::longjmp(errors_of(jpeg).jump, 1);
}

/// One texel; JPEGs hold the complements of cyan, magenta, yellow and black. The arithmetic is OpenImageIO's.
void put_rgb(const std::uint8_t* cmyk, std::uint8_t* rgb) {
  constexpr float unit = 1.0f / 255.0f;
  for (int c = 0; c < 3; ++c) {
    const float product = (static_cast<float>(cmyk[c]) * unit) * (static_cast<float>(cmyk[3]) * unit);
    rgb[c] = static_cast<std::uint8_t>(product * 255.0f + 0.5f);
  }
}

class JpegReader : public PictureReader {
 public:
  explicit JpegReader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  ~JpegReader() override { ::jpeg_destroy_decompress(&jpeg_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  /// Reads the headers. Decoding begins with the texels: of a progressive file it needs memory for all of them, and the caller first
  /// checks the size.
  void start() {
    jpeg_.err = ::jpeg_std_error(&errors_.handler);
    errors_.handler.error_exit = leave;
    errors_.handler.output_message = note;
    int result = 0;
    attempt([&] {
      jpeg_create_decompress(&jpeg_);
      ::jpeg_mem_src(&jpeg_, reinterpret_cast<const unsigned char*>(bytes_.data()), bytes_.size());
      ::jpeg_save_markers(&jpeg_, exif_marker, 0xffff);  // XMP stands in the same
      result = ::jpeg_read_header(&jpeg_, FALSE);
    });
    if (result != JPEG_HEADER_OK) throw std::runtime_error("Bad JPEG header for \"picture\"");
    is_cmyk_ = jpeg_.jpeg_color_space == JCS_CMYK || jpeg_.jpeg_color_space == JCS_YCCK;
    if (is_cmyk_) jpeg_.out_color_space = JCS_CMYK;
    describe();
  }

  const StoredPicture& picture() const override { return picture_; }

  void read(std::size_t first, std::size_t end, std::byte* texels) override {
    attempt([&] { ::jpeg_start_decompress(&jpeg_); });
    const auto width = static_cast<std::size_t>(picture_.width);
    if (jpeg_.output_width != width || jpeg_.output_components != (is_cmyk_ ? 4 : static_cast<int>(picture_.channels.size())))
      throw std::runtime_error("its header contradicts itself");
    std::vector<std::uint8_t> row(static_cast<std::size_t>(jpeg_.output_components) * width), rgb(is_cmyk_ ? 3 * width : 0);
    for (int y = 0; y < picture_.height; ++y, texels += picture_.texel_bytes(first, end) * width) {
      JSAMPROW to = row.data();
      attempt([&] { ::jpeg_read_scanlines(&jpeg_, &to, 1); });
      for (std::size_t x = 0; is_cmyk_ && x < width; ++x) put_rgb(&row[4 * x], &rgb[3 * x]);
      copy_channels(picture_, first, end, reinterpret_cast<const std::byte*>((is_cmyk_ ? rgb : row).data()), texels);
    }
    // Damage that libjpeg only warns of.
    if (errors_.count > 0) refuse();
  }

 private:
  void describe() {
    picture_ = {};
    picture_.width = picture_.full_width = static_cast<int>(jpeg_.image_width);
    picture_.height = picture_.full_height = static_cast<int>(jpeg_.image_height);
    picture_.channels = plain_channels(is_cmyk_ ? 3 : jpeg_.num_components, "uint8", 1);
    picture_.compression = "none";
    picture_.colour_space = "sRGB";
    std::optional<int> found;
    for (jpeg_saved_marker_ptr marker = jpeg_.marker_list; marker && !found; marker = marker->next) {
      constexpr std::string_view exif("Exif\0", 5), xmp("http://ns.adobe.com/xap/1.0/\0", 29);
      if (marker->marker != exif_marker) continue;
      const std::string_view text(reinterpret_cast<const char*>(marker->data), marker->data_length);
      if (text.starts_with(exif)) found = exif_orientation(std::as_bytes(std::span(text)).subspan(std::min<std::size_t>(6, text.size())));
      if (text.starts_with(xmp)) found = xmp_orientation(text);
    }
    picture_.orientation = found.value_or(upright);
  }

  /// Calls f, which calls libjpeg and has no object with a destructor, because an error of libjpeg's leaves it by a jump.
  template <class F>
  void attempt(F&& f) {
    if (!returns(f)) refuse();
  }
  template <class F>
  bool returns(F& f) {
    if (setjmp(errors_.jump)) return false;
    f();
    return true;
  }
  [[noreturn]] void refuse() const {
    std::string why;
    for (int i = 0; i < errors_.count; ++i) why += fmt::format("{}JPEG error: {} (\"picture\")", i > 0 ? "\n" : "", errors_.texts[i]);
    throw std::runtime_error(why);
  }

  std::span<const std::byte> bytes_;
  jpeg_decompress_struct jpeg_{};
  Errors errors_{};
  bool is_cmyk_ = false;
  StoredPicture picture_;
};

}  // namespace

std::unique_ptr<PictureReader> open_jpeg(std::span<const std::byte> bytes) {
  auto reader = std::make_unique<JpegReader>(bytes);
  reader->start();
  return reader;
}

}  // namespace rainref::image_io::direct
