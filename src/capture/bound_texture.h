// Captured images, decoded to floats for passes.
#pragma once

#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

#include "capture/pass_case.h"
#include "rainref/texture.h"

namespace rainref::capture {

/// Decodes a level, row-major, channels interleaved: halves and floats exactly; unorm8 as code / 255 and srgb8 as linear, both correctly
/// rounded; uint32 rounded to float.
std::vector<float> decoded(const Array& image, int level = 0);

/// Throws Error(usage) if the values of an input are known only as intervals, because the pass does not load them at its own texel.
void require_certain(const CaseInput& input);

/// Decodes level 0. Copies of a large image share the values: a search for causes binds one case hundreds of times.
std::shared_ptr<const std::vector<float>> shared_decoded(const Array& image);

/// A Texture of the decoded values of an input, with all levels, address rules and border. Has `count` channels from `first` on, or all
/// (0). Copies share large images like shared_decoded().
class BoundTexture {
 public:
  BoundTexture() = default;
  explicit BoundTexture(const CaseInput& input, int first = 0, int count = 0);
  Texture view() const;

 private:
  std::shared_ptr<const std::vector<float>> texels_;
  Texture view_;
};

/// The input of this name; throws Error(port_files) if the case lacks it, or if it is not an image (or not records).
const CaseInput& image_input(const PassCase& c, std::string_view name);
const CaseInput& record_input(const PassCase& c, std::string_view name);

/// Copies the case's uniform block to its struct; throws Error(port_files) if the size differs.
void copy_uniforms(const PassCase& c, void* to, std::size_t bytes);
template <class Uniforms>
Uniforms uniforms_of(const PassCase& c) {
  Uniforms u;
  copy_uniforms(c, &u, sizeof u);
  return u;
}
/// Copies records to their structs; throws like copy_uniforms.
template <class Record>
std::vector<Record> records_of(const CaseInput& input);
const std::byte* record_bytes(const CaseInput& input, std::size_t record_size);
template <class Record>
std::vector<Record> records_of(const CaseInput& input) {
  std::vector<Record> out(static_cast<std::size_t>(input.array.width));
  const std::byte* from = record_bytes(input, sizeof(Record));
  if (!out.empty()) std::memcpy(out.data(), from, out.size() * sizeof(Record));
  return out;
}

}  // namespace rainref::capture
