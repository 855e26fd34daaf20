#include "image_io/direct/module.h"

#include "image_io/direct/formats.h"

namespace rainref::image_io {
namespace {

MadePictures pictures() {
  MadePictures out = made_pngs();
  for (const auto& made : {made_exrs(), made_jpegs()}) out.insert(out.end(), made.begin(), made.end());
  return out;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const DirectModule* rainref_direct_module() {
  static const DirectModule module{&direct::table(), pictures};
  return &module;
}

}  // namespace rainref::image_io
