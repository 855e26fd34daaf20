#include <png.h>

#include <functional>
#include <stdexcept>

#include <fmt/format.h>

#include "image_io/direct/module.h"

namespace rainref::image_io {
namespace {

using Change = std::function<void(png_structp, png_infop)>;

/// Noise of this colour type and depth. `change` adds chunks.
std::string png(int width, int height, int type, int depth, int interlace, const Change& change) {
  std::string out;
  png_structp png = ::png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = ::png_create_info_struct(png);
  ::png_set_write_fn(
      png, &out,
      [](png_structp p, png_bytep data, std::size_t size) {
        static_cast<std::string*>(::png_get_io_ptr(p))->append(reinterpret_cast<const char*>(data), size);
      },
      [](png_structp) {});
  ::png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), depth, type, interlace,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  Noise noise(static_cast<unsigned>(type * 100 + depth));
  if (type == PNG_COLOR_TYPE_PALETTE) {
    png_color palette[256];
    for (png_color& colour : palette) colour = {noise.byte(), noise.byte(), noise.byte()};
    ::png_set_PLTE(png, info, palette, 1 << depth);
  }
  if (change) change(png, info);
  ::png_write_info(png, info);
  const std::size_t row_bytes = ::png_get_rowbytes(png, info);
  std::vector<std::vector<png_byte>> rows(static_cast<std::size_t>(height), std::vector<png_byte>(row_bytes));
  std::vector<png_bytep> pointers;
  for (auto& row : rows) {
    for (png_byte& byte : row) byte = noise.byte();
    pointers.push_back(row.data());
  }
  ::png_write_image(png, pointers.data());
  ::png_write_end(png, nullptr);
  ::png_destroy_write_struct(&png, &info);
  return out;
}

/// An EXIF block with this orientation, as a text of ImageMagick has it.
std::string exif_text(int orientation) {
  const std::string exif("Exif\0\0MM\0*\0\0\0\x08\0\1\x01\x12\0\3\0\0\0\1\0", 26);
  std::string block = exif + static_cast<char>(orientation) + std::string(6, '\0');
  std::string text = fmt::format("\nexif\n{:8}\n", block.size());
  for (const char c : block) text += fmt::format("{:02x}", static_cast<unsigned char>(c));
  return text + "\n";
}
void set_text(png_structp png, png_infop info, const char* key, std::string value) {
  png_text text{};
  text.compression = PNG_TEXT_COMPRESSION_NONE;
  text.key = const_cast<char*>(key);
  text.text = value.data();
  text.text_length = value.size();
  ::png_set_text(png, info, &text, 1);
}

const std::vector<std::pair<const char*, Change>> changes{
    {"sRGB", [](png_structp p, png_infop i) { ::png_set_sRGB(p, i, PNG_sRGB_INTENT_PERCEPTUAL); }},
    {"gamma 1", [](png_structp p, png_infop i) { ::png_set_gAMA(p, i, 1.0); }},
    {"gamma 1/2.2", [](png_structp p, png_infop i) { ::png_set_gAMA(p, i, 1 / 2.2); }},
    {"gamma .999", [](png_structp p, png_infop i) { ::png_set_gAMA(p, i, .999); }},
    {"gamma 1/1.8", [](png_structp p, png_infop i) { ::png_set_gAMA(p, i, 1 / 1.8); }},
    {"chromaticities",
     [](png_structp p, png_infop i) {
       ::png_set_gAMA(p, i, 1 / 2.2);
       ::png_set_cHRM(p, i, .3127, .329, .64, .33, .3, .6, .15, .06);
     }},
    {"offset and density",
     [](png_structp p, png_infop i) {
       ::png_set_oFFs(p, i, 3, -4, PNG_OFFSET_PIXEL);
       ::png_set_pHYs(p, i, 2835, 5670, PNG_RESOLUTION_METER);
     }},
    {"significant bits",
     [](png_structp p, png_infop i) {
       const png_color_8 bits{4, 5, 4, 5, 4};
       ::png_set_sBIT(p, i, &bits);
     }},
    {"text", [](png_structp p, png_infop i) { set_text(p, i, "rainref", "a note"); }},
    {"turned by a text", [](png_structp p, png_infop i) { set_text(p, i, "Raw profile type exif", exif_text(6)); }},
    {"upright by a text", [](png_structp p, png_infop i) { set_text(p, i, "Raw profile type exif", exif_text(1)); }},
    {"turned by EXIF",
     [](png_structp p, png_infop i) {
       png_byte exif[] = {'I', 'I', '*', 0, 8, 0, 0, 0, 1, 0, 0x12, 1, 3, 0, 1, 0, 0, 0, 8, 0, 0, 0, 0, 0, 0, 0};
       ::png_set_eXIf_1(p, i, sizeof exif, exif);
     }},
    {"turned by XMP", [](png_structp p, png_infop i) {
       set_text(
           p, i, "XML:com.adobe.xmp",
           "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\"><rdf:Description "
           "rdf:about=\"\" xmlns:tiff=\"http://ns.adobe.com/tiff/1.0/\" tiff:Orientation=\"3\"></rdf:Description></rdf:RDF></x:xmpmeta>");
     }}};

}  // namespace

MadePictures made_pngs() {
  MadePictures out;
  struct Kind {
    int type;
    std::vector<int> depths;
  };
  const Kind kinds[] = {{PNG_COLOR_TYPE_GRAY, {1, 2, 4, 8, 16}},
                        {PNG_COLOR_TYPE_RGB, {8, 16}},
                        {PNG_COLOR_TYPE_PALETTE, {1, 2, 4, 8}},
                        {PNG_COLOR_TYPE_GRAY_ALPHA, {8, 16}},
                        {PNG_COLOR_TYPE_RGB_ALPHA, {8, 16}}};
  const Change transparent = [](png_structp p, png_infop i) {
    png_byte alpha[] = {0, 7, 255};
    png_color_16 colour{1, 1, 2, 3, 1};
    ::png_set_tRNS(p, i, alpha, ::png_get_bit_depth(p, i) == 1 ? 2 : 3, &colour);
  };
  for (const Kind& kind : kinds) {
    for (const int depth : kind.depths) {
      for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
        const std::string name = fmt::format("PNG type {} depth {} interlace {}", kind.type, depth, interlace);
        out.push_back({name, "png", png(19, 11, kind.type, depth, interlace, nullptr)});
        if ((kind.type & PNG_COLOR_MASK_ALPHA) == 0)
          out.push_back({name + " transparent", "png", png(19, 11, kind.type, depth, interlace, transparent)});
      }
    }
  }
  for (const auto& [name, change] : changes) {
    out.push_back({std::string("PNG ") + name, "png", png(5, 4, PNG_COLOR_TYPE_RGB, 8, PNG_INTERLACE_NONE, change)});
    out.push_back({std::string("grey PNG ") + name, "png", png(5, 4, PNG_COLOR_TYPE_GRAY, 16, PNG_INTERLACE_ADAM7, change)});
  }
  out.push_back({"PNG 1x1", "png", png(1, 1, PNG_COLOR_TYPE_RGB, 8, PNG_INTERLACE_ADAM7, nullptr)});
  return out;
}

}  // namespace rainref::image_io
