// What an effect tells about each pass it runs: the hook of hashing, timing and capture.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <variant>

#include "rainref/image.h"
#include "rainref/texture.h"

namespace rainref {

/// An array of records of one layout, as stored: count * record_bytes bytes.
struct RecordView {
  const void* data;
  std::size_t count, record_bytes;
  std::span<const std::byte> bytes() const { return {static_cast<const std::byte*>(data), count * record_bytes}; }
};

/// How a pass reads an image: `none` loads by integer texel.
enum class Filter : std::uint8_t { none, nearest, linear };
/// "none", "nearest" or "linear".
constexpr const char* name(Filter filter) {
  constexpr const char* names[] = {"none", "nearest", "linear"};
  return names[static_cast<int>(filter)];
}

/// One input of a pass: an image, records, a texture, which brings its own address rules and border, or the mip levels of one image.
struct PassInput {
  std::string_view name;
  std::variant<BufferView, RecordView, const Texture*, std::span<const Image>> content;
  Filter filter = Filter::none;
  Filter mip_filter = Filter::none;  ///< `none`: level 0 only
  Address address = Address::clamp;  ///< of a BufferView, in u and v
  std::array<float, 4> border{};     ///< of a BufferView
};

/// A run of a pass before it happens.
struct PassStart {
  int frame, step;
  std::string_view pass;
  std::span<const PassInput> inputs;
  std::span<const std::byte> uniforms;  ///< the uniform block, as a GPU takes it
  float time, dt;                       ///< [s] of the frame's start, and that this run advances; each rounded once
  Rounding store_rounding = Rounding::rne;
  int level = -1;  ///< the mip level, where the pass runs once for each
};

/// One output of a pass.
struct PassOutput {
  std::string_view name;
  std::variant<BufferView, RecordView> content;
};

/// One run of a pass. step counts the substeps in a frame.
struct PassCall {
  int frame, step;
  std::string_view pass;
  std::span<const PassOutput> outputs;
  double seconds;  ///< time the pass took
  int level = -1;
};

class Recorder {
 public:
  virtual ~Recorder() = default;
  /// Whether it reads the buffers of this pass in this frame. Where not, an effect may tell it of a list of records as empty: to
  /// list drops costs more than some passes take.
  virtual bool reads(int /*frame*/, std::string_view /*pass*/) const { return true; }
  /// Called before pass() of the same run, while the inputs hold what the pass takes: a pass may overwrite them. From
  /// the thread that runs the effect.
  virtual void before(const PassStart&) {}
  /// Called after each pass, from the thread that runs the effect. Buffers may change after it returns.
  virtual void pass(const PassCall& call) = 0;
};

}  // namespace rainref
