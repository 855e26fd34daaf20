#include "pass/model.h"

#include <fmt/format.h>

#include "rainref/error.h"

namespace rainref::pass {

void require_image(const capture::PassCase& c, const capture::CaseInput& image, Format format, bool is_loaded, bool has_size) {
  const FormatInfo &expected = info(format), &found = info(image.array.format);
  const capture::Array& like = c.outputs.front().array;
  // What is looked up by coordinates may have been captured decoded.
  const bool is_code = expected.kind == FormatInfo::unorm8,
             fits = expected.channels == found.channels && (!is_loaded || is_code == (found.kind == FormatInfo::unorm8));
  if (fits && (!has_size || (image.array.width == like.width && image.array.height == like.height))) return;
  const auto size = [&](const capture::Array& a) { return has_size ? fmt::format(" {}x{}", a.width, a.height) : ""; };
  throw Error(ExitCode::port_files, fmt::format("{}: in.{}: expected {}{}, found {}{}", c.folder(), image.name, expected.name, size(like),
                                                found.name, size(image.array)));
}

}  // namespace rainref::pass
