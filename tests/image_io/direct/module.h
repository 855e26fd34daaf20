// The module of direct_codec: pictures through the libraries of their formats, and pictures that these libraries write.
#pragma once

#include <string>
#include <vector>

#include "image_io/codec.h"

namespace rainref::image_io {

/// A file in memory. `name` says how it was made; its format is OpenImageIO's name.
struct MadePicture {
  std::string name, format, bytes;
};
using MadePictures = std::vector<MadePicture>;

/// Of each format all that its library can write and a reader might take otherwise.
MadePictures made_pngs();
MadePictures made_exrs();
MadePictures made_jpegs();

struct DirectModule {
  const Codec* codec;
  MadePictures (*pictures)();
};
inline constexpr const char* direct_module_name = "rainref_direct_module";

/// Bytes without a pattern, the same at every run.
class Noise {
 public:
  explicit Noise(unsigned seed) : state_(seed * 2654435761u + 1) {}
  unsigned next() { return (state_ = state_ * 1664525u + 1013904223u) >> 8; }
  unsigned char byte() { return static_cast<unsigned char>(next() >> 8); }

 private:
  unsigned state_;
};

}  // namespace rainref::image_io
