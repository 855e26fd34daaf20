// The resources of descriptors during an execution.
#pragma once

#include <cstddef>

#include "rainref/recorder.h"
#include "rainref/texture.h"

namespace rainref::spirv {

struct BoundBuffer {
  std::byte* bytes = nullptr;
  std::size_t size = 0;
  bool is_writable = false;
};

/// An image with the sampling rules that its pack declares (docs/packs.md).
struct SampledImage {
  Texture texture;
  bool is_linear = false;
  Filter mip_filter = Filter::none;
};

/// An image that the shader writes texel by texel.
template <class N>
class StorageImage {
 public:
  StorageImage(int width, int height) : width_(width), height_(height) {}
  virtual ~StorageImage() = default;
  int width() const { return width_; }
  int height() const { return height_; }
  /// Stores the first `count` channels (1 to 4) of a texel inside the image.
  virtual void write(int x, int y, const N* texel, int count) = 0;
  /// Reads the four channels of a texel inside the image, as stored; channels that the format lacks are those of (0, 0, 0, 1).
  virtual void read(int x, int y, N* texel) const = 0;

 private:
  int width_, height_;
};

/// One of the three, or nothing; the caller that binds it owns it.
template <class N>
struct Resource {
  const BoundBuffer* buffer = nullptr;
  const SampledImage* image = nullptr;
  StorageImage<N>* storage = nullptr;
};

}  // namespace rainref::spirv
