#include "pass/model.h"

namespace rainref::pass {

const capture::Array* first_image(const capture::PassCase& c) {
  const auto at = std::find_if(c.outputs.begin(), c.outputs.end(), [](const capture::CaseOutput& o) { return !o.array.is_records; });
  return at == c.outputs.end() ? nullptr : &at->array;
}

void require_image(const capture::PassCase& c, const capture::CaseInput& image, std::span<const Format> formats, bool is_loaded,
                   bool has_size) {
  const FormatInfo &expected = info(formats.front()), &found = info(image.array.format);
  const capture::Array* const like = first_image(c);
  has_size = has_size && like;
  // An input that is looked up by coordinates may have been captured in decoded form.
  const auto is_code = [](const FormatInfo& f) { return f.kind == FormatInfo::unorm8; };
  const bool fits = std::any_of(formats.begin(), formats.end(), [&](Format f) {
    return info(f).channels == found.channels && (!is_loaded || is_code(info(f)) == is_code(found));
  });
  if (fits && (!has_size || (image.array.width == like->width && image.array.height == like->height))) return;
  const auto size = [&](const capture::Array& a) { return has_size ? fmt::format(" {}x{}", a.width, a.height) : ""; };
  throw Error(ExitCode::port_files, fmt::format("{}: in.{}: expected {}{}, found {}{}", c.folder(), image.name, expected.name,
                                                like ? size(*like) : "", found.name, size(image.array)));
}

}  // namespace rainref::pass
