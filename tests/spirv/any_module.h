// Executes a module on buffers and images that are made up for it: for modules without a pack, and for the fuzzer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "spirv/group.h"
#include "spirv/stored_image.h"

namespace rainref::spirv {

/// What a descriptor gets: a buffer of these bytes, or an image of 2 x 2 texels 0, 1/16, 2/16, ... of four channels, or an output of 4 x 4.
class MadeUp {
 public:
  explicit MadeUp(const Module& module, std::vector<std::byte> buffer = std::vector<std::byte>(256)) {
    for (int i = 0; i < 16; ++i) texels_.push_back(static_cast<float>(i) / 16);
    image_.texture = {texels_.data(), 4, 1, {2}, {2}, {0}};
    image_.is_linear = true;
    for (const Descriptor& d : module.descriptors) {
      buffers_.push_back(std::make_unique<Buffer>());
      Buffer& b = *buffers_.back();
      b.bytes = buffer;
      b.bound = {b.bytes.data(), b.bytes.size(), d.bound == Bound::storage_buffer};
      Resource<Float> r;
      if (d.bound == Bound::storage_image) {
        capture::CaseOutput output;
        output.array.format = Format::rgba16f;
        output.array.width = output.array.height = 4;
        outputs_.push_back(std::make_unique<StoredImage>(output));
        r.storage = outputs_.back().get();
      } else if (d.bound == Bound::sampled_image) {
        r.image = &image_;
      } else {
        r.buffer = &b.bound;
      }
      resources_.push_back(r);
    }
  }
  std::span<const Resource<Float>> resources() const { return resources_; }
  /// The words of the buffer that descriptor i leads to.
  std::vector<std::uint32_t> words(std::size_t i) const {
    std::vector<std::uint32_t> out(buffers_[i]->bytes.size() / 4);
    std::memcpy(out.data(), buffers_[i]->bytes.data(), 4 * out.size());
    return out;
  }

 private:
  struct Buffer {
    std::vector<std::byte> bytes;
    BoundBuffer bound;
  };
  std::vector<float> texels_;
  SampledImage image_;
  std::vector<std::unique_ptr<Buffer>> buffers_;
  std::vector<std::unique_ptr<StoredImage>> outputs_;
  std::vector<Resource<Float>> resources_;
};

/// One workgroup of it, in few steps and little memory.
inline void execute_any(std::span<const std::byte> bytes) {
  const Module module(bytes, "'a.spv'");
  const MadeUp bound(module);
  Machine<Float> machine(module, bound.resources(), {20000, 1 << 20});
  dispatch(machine, {1, 1, 1});
}

}  // namespace rainref::spirv
