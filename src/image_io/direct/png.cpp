#include <png.h>

#include <csetjmp>
#include <cstring>
#include <stdexcept>

#include "image_io/direct/formats.h"
#include "image_io/direct/orientation.h"
#include "image_io/direct/samples.h"

namespace rainref::image_io::direct {
namespace {

class PngReader : public PictureReader {
 public:
  explicit PngReader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  ~PngReader() override { ::png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  /// Reads the header and what stands before the texels. Not in the constructor: what that leaves by an exception is not destroyed.
  void start() {
    png_ = ::png_create_read_struct(PNG_LIBPNG_VER_STRING, this, refuse, [](png_structp, png_const_charp) {});
    if (!png_) throw std::runtime_error("Could not create PNG read structure");
    info_ = ::png_create_info_struct(png_);
    if (!info_) throw std::runtime_error("Could not create PNG info structure");
    attempt("Could not read info from file", [&] {
      ::png_set_read_fn(png_, this, give);
      ::png_read_info(png_, info_);
      ::png_set_expand(png_);
      ::png_set_swap(png_);  // of two bytes the first is the higher one in the file, not in memory
      ::png_read_update_info(png_, info_);
    });
    describe();
  }

  const StoredPicture& picture() const override { return picture_; }

  void read(std::size_t first, std::size_t end, std::byte* texels) override {
    const std::size_t row_bytes = picture_.texel_bytes() * static_cast<std::size_t>(picture_.width);
    const std::size_t out_bytes = picture_.texel_bytes(first, end) * static_cast<std::size_t>(picture_.width);
    const bool is_interlaced = ::png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE;
    if (is_interlaced) {
      read_interlaced(first, end, row_bytes, texels);
      return;
    }
    std::vector<std::byte> row(row_bytes);
    for (int y = 0; y < picture_.height; ++y, texels += out_bytes) {
      attempt("PNG library error", [&] { ::png_read_row(png_, reinterpret_cast<png_bytep>(row.data()), nullptr); });
      copy_channels(picture_, first, end, row.data(), texels);
    }
  }

 private:
  /// A picture in passes, which must be held as a whole.
  void read_interlaced(std::size_t first, std::size_t end, std::size_t row_bytes, std::byte* texels) {
    const auto height = static_cast<std::size_t>(picture_.height);
    const std::size_t out_bytes = picture_.texel_bytes(first, end) * static_cast<std::size_t>(picture_.width);
    const bool whole = out_bytes == row_bytes;
    std::vector<std::byte> held(whole ? 0 : row_bytes * height);
    std::vector<png_bytep> rows(height);
    for (std::size_t y = 0; y < height; ++y) rows[y] = reinterpret_cast<png_bytep>((whole ? texels : held.data()) + y * row_bytes);
    attempt("PNG library error", [&] {
      ::png_read_image(png_, rows.data());
      ::png_read_end(png_, nullptr);
    });
    for (std::size_t y = 0; !whole && y < height; ++y)
      copy_channels(picture_, first, end, held.data() + y * row_bytes, texels + y * out_bytes);
  }

  void describe() {
    picture_ = {};
    picture_.width = picture_.full_width = static_cast<int>(::png_get_image_width(png_, info_));
    picture_.height = picture_.full_height = static_cast<int>(::png_get_image_height(png_, info_));
    picture_.x = ::png_get_x_offset_pixels(png_, info_);
    picture_.y = ::png_get_y_offset_pixels(png_, info_);
    const bool wide = ::png_get_bit_depth(png_, info_) == 16;
    picture_.channels = plain_channels(::png_get_channels(png_, info_), wide ? "uint16" : "uint8", wide ? 2 : 1);
    if (picture_.channels.size() == 2) {
      picture_.channels[0].name = "Y";
      picture_.channels[1].name = "A";
    }
    picture_.compression = "none";
    picture_.colour_space = "sRGB";
    int intent = 0;
    double gamma = 0;
    if (!::png_get_sRGB(png_, info_, &intent) && ::png_get_gAMA(png_, info_, &gamma) && gamma > 0)
      picture_.colour_space = gamma_name(1 / gamma);
    picture_.orientation = orientation();
  }

  /// Of EXIF in a text, as most programs store it, of XMP, or of the chunk for EXIF.
  int orientation() {
    std::optional<int> found;
    png_textp texts = nullptr;
    const int count = ::png_get_text(png_, info_, &texts, nullptr);
    for (int i = 0; i < count; ++i) {
      const std::string_view key = texts[i].key, text = texts[i].text;
      if (key == "Raw profile type exif" && !found) found = exif_orientation(exif_of_text(text));
      if (key == "XML:com.adobe.xmp" && !found) found = xmp_orientation(text);
    }
    png_bytep exif = nullptr;
    png_uint_32 size = 0;
    if (!found && ::png_get_eXIf_1(png_, info_, &size, &exif)) found = exif_orientation(std::as_bytes(std::span(exif, size)));
    return found.value_or(upright);
  }

  /// Calls f, which calls libpng and has no object with a destructor, because an error of libpng's leaves it by a jump.
  template <class F>
  void attempt(const char* what, F&& f) {
    if (!returns(f)) throw std::runtime_error(std::string(what) + ": " + refusal_);
  }
  template <class F>
  bool returns(F& f) {
    if (setjmp(png_jmpbuf(png_))) return false;
    f();
    return true;
  }

  [[noreturn]] static void refuse(png_structp png, png_const_charp why) {
    char* const refusal = static_cast<PngReader*>(::png_get_error_ptr(png))->refusal_;
    std::strncpy(refusal, why, sizeof refusal_ - 1);
    ::png_longjmp(png, 1);
  }
  static void give(png_structp png, png_bytep to, std::size_t count) {
    auto& self = *static_cast<PngReader*>(::png_get_io_ptr(png));
    if (count > self.bytes_.size() - self.at_) ::png_chunk_error(png, "Read error: hit end of file");
    std::memcpy(to, self.bytes_.data() + self.at_, count);
    self.at_ += count;
  }

  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  char refusal_[256] = {};  // libpng's reason; no string, which allocates
  StoredPicture picture_;
};

}  // namespace

std::unique_ptr<PictureReader> open_png(std::span<const std::byte> bytes) {
  auto reader = std::make_unique<PngReader>(bytes);
  reader->start();
  return reader;
}

}  // namespace rainref::image_io::direct
