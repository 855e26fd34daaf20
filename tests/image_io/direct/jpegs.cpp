#include <cstdio>  // jpeglib.h takes FILE from its includer

#include <jpeglib.h>

#include <cstdlib>
#include <functional>

#include <fmt/format.h>

#include "image_io/direct/module.h"

namespace rainref::image_io {
namespace {

struct Form {
  const char* name;
  int components;
  J_COLOR_SPACE in, stored;
  std::function<void(jpeg_compress_struct&)> change;
};

/// Smooth noise, so that every coefficient is used.
std::string jpeg(int width, int height, const Form& form, const std::function<void(jpeg_compress_struct&)>& markers = nullptr) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = ::jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  ::jpeg_mem_dest(&jpeg, &bytes, &size);
  jpeg.image_width = static_cast<JDIMENSION>(width);
  jpeg.image_height = static_cast<JDIMENSION>(height);
  jpeg.input_components = form.components;
  jpeg.in_color_space = form.in;
  ::jpeg_set_defaults(&jpeg);
  ::jpeg_set_colorspace(&jpeg, form.stored);
  ::jpeg_set_quality(&jpeg, 85, TRUE);
  if (form.change) form.change(jpeg);
  ::jpeg_start_compress(&jpeg, TRUE);
  if (markers) markers(jpeg);
  Noise noise(7);
  std::vector<unsigned char> row(static_cast<std::size_t>(width * form.components));
  for (int y = 0; y < height; ++y) {
    for (std::size_t i = 0; i < row.size(); ++i)
      row[i] = static_cast<unsigned char>(noise.byte() / 4 + (i * 5 + static_cast<std::size_t>(y) * 3) % 192);
    JSAMPROW rows[] = {row.data()};
    ::jpeg_write_scanlines(&jpeg, rows, 1);
  }
  ::jpeg_finish_compress(&jpeg);
  ::jpeg_destroy_compress(&jpeg);
  std::string out(reinterpret_cast<const char*>(bytes), size);
  std::free(bytes);
  return out;
}

std::function<void(jpeg_compress_struct&)> sampled(int horizontal, int vertical) {
  return [=](jpeg_compress_struct& j) {
    j.comp_info[0].h_samp_factor = horizontal;
    j.comp_info[0].v_samp_factor = vertical;
  };
}

/// An EXIF segment with this orientation in a number of this type (1 byte, 3 two bytes, 4 four bytes).
std::string exif(bool little, int type, int orientation) {
  const auto number = [&](int value, int bytes) {
    std::string out;
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> 8 * (little ? i : bytes - 1 - i));
    return out;
  };
  const int bytes = type == 3 ? 2 : type;
  return std::string("Exif\0\0", 6) + (little ? "II" : "MM") + number(42, 2) + number(8, 4) + number(2, 2) + number(0x0106, 2) +
         number(3, 2) + number(1, 4) + number(2, 2) + number(0, 2) + number(0x0112, 2) + number(type, 2) + number(1, 4) +
         number(orientation, bytes) + std::string(static_cast<std::size_t>(4 - bytes), '\0') + number(0, 4);
}
std::function<void(jpeg_compress_struct&)> marker(int number, const std::string& data) {
  return [=](jpeg_compress_struct& j) {
    ::jpeg_write_marker(&j, number, reinterpret_cast<const JOCTET*>(data.data()), static_cast<unsigned>(data.size()));
  };
}

}  // namespace

MadePictures made_jpegs() {
  MadePictures out;
  const Form colour{"", 3, JCS_RGB, JCS_YCbCr, nullptr};
  const Form forms[] = {
      {"grey", 1, JCS_GRAYSCALE, JCS_GRAYSCALE, nullptr},
      {"4:2:0", 3, JCS_RGB, JCS_YCbCr, nullptr},
      {"4:4:4", 3, JCS_RGB, JCS_YCbCr, sampled(1, 1)},
      {"4:2:2", 3, JCS_RGB, JCS_YCbCr, sampled(2, 1)},
      {"4:4:0", 3, JCS_RGB, JCS_YCbCr, sampled(1, 2)},
      {"4:1:1", 3, JCS_RGB, JCS_YCbCr, sampled(4, 1)},
      {"RGB", 3, JCS_RGB, JCS_RGB, nullptr},
      {"CMYK", 4, JCS_CMYK, JCS_CMYK, nullptr},
      {"YCCK", 4, JCS_CMYK, JCS_YCCK, nullptr},
      {"two components", 2, JCS_UNKNOWN, JCS_UNKNOWN, nullptr},
      {"progressive", 3, JCS_RGB, JCS_YCbCr, [](jpeg_compress_struct& j) { ::jpeg_simple_progression(&j); }},
      {"progressive grey", 1, JCS_GRAYSCALE, JCS_GRAYSCALE, [](jpeg_compress_struct& j) { ::jpeg_simple_progression(&j); }},
      {"arithmetic", 3, JCS_RGB, JCS_YCbCr, [](jpeg_compress_struct& j) { j.arith_code = TRUE; }},
      {"restarts", 3, JCS_RGB, JCS_YCbCr, [](jpeg_compress_struct& j) { j.restart_interval = 1; }},
      {"optimized", 3, JCS_RGB, JCS_YCbCr, [](jpeg_compress_struct& j) { j.optimize_coding = TRUE; }},
      {"coarse", 3, JCS_RGB, JCS_YCbCr, [](jpeg_compress_struct& j) { ::jpeg_set_quality(&j, 5, FALSE); }},
      {"fine", 3, JCS_RGB, JCS_YCbCr, [](jpeg_compress_struct& j) { ::jpeg_set_quality(&j, 100, TRUE); }},
      {"density", 3, JCS_RGB, JCS_YCbCr, [](jpeg_compress_struct& j) {
         j.density_unit = 1;
         j.X_density = 72;
         j.Y_density = 144;
       }}};
  for (const Form& form : forms) {
    for (const auto& [width, height] : {std::pair(45, 29), std::pair(16, 16), std::pair(1, 1)})
      out.push_back({fmt::format("JPEG {} {}x{}", form.name, width, height), "jpeg", jpeg(width, height, form)});
  }
  for (const bool little : {false, true}) {
    for (int orientation = 1; orientation <= 8; ++orientation)
      out.push_back({fmt::format("JPEG orientation {} {}", orientation, little ? "II" : "MM"), "jpeg",
                     jpeg(9, 5, colour, marker(JPEG_APP0 + 1, exif(little, 3, orientation)))});
    for (const int type : {1, 4})
      out.push_back({fmt::format("JPEG orientation 6 of type {} {}", type, little ? "II" : "MM"), "jpeg",
                     jpeg(9, 5, colour, marker(JPEG_APP0 + 1, exif(little, type, 6)))});
  }
  const std::string xmp = std::string("http://ns.adobe.com/xap/1.0/\0", 29) +
                          "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">";
  const std::string xmp_end = "</rdf:RDF></x:xmpmeta>", tiff = "xmlns:tiff=\"http://ns.adobe.com/tiff/1.0/\"";
  out.push_back({"JPEG turned by an attribute of XMP", "jpeg",
                 jpeg(9, 5, colour,
                      marker(JPEG_APP0 + 1, xmp + "<rdf:Description " + tiff + " tiff:Orientation=\"8\"></rdf:Description>" + xmp_end))});
  out.push_back({"JPEG turned by an element of XMP", "jpeg",
                 jpeg(9, 5, colour,
                      marker(JPEG_APP0 + 1,
                             xmp + "<rdf:Description " + tiff + "><tiff:Orientation>6</tiff:Orientation></rdf:Description>" + xmp_end))});
  out.push_back({"JPEG with a comment", "jpeg", jpeg(9, 5, colour, marker(JPEG_COM, "a comment"))});
  out.push_back({"JPEG with an odd Exif", "jpeg", jpeg(9, 5, colour, marker(JPEG_APP0 + 1, std::string("Exif\0\0XX", 8)))});
  return out;
}

}  // namespace rainref::image_io
