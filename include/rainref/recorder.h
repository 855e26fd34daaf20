// The hook that an effect calls for each pass, used for hashing, timing and capture.
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

/// How a pass reads an image. `none`: by integer texel.
enum class Filter : std::uint8_t { none, nearest, linear };
/// "none", "nearest" or "linear".
constexpr const char* name(Filter filter) {
  constexpr const char* names[] = {"none", "nearest", "linear"};
  return names[static_cast<int>(filter)];
}

/// One input of a pass: an image, records, a texture with its own address rules and border, or the mip levels of one image.
struct PassInput {
  std::string_view name;
  std::variant<BufferView, RecordView, const Texture*, std::span<const Image>> content;
  Filter filter = Filter::none;
  Filter mip_filter = Filter::none;  ///< `none`: level 0 only
  Address address = Address::clamp;  ///< for a BufferView, in u and v
  std::array<float, 4> border{};     ///< for a BufferView
};

/// Describes a run of a pass before it starts.
struct PassStart {
  int frame, step;
  std::string_view pass;
  std::span<const PassInput> inputs;
  std::span<const std::byte> uniforms;  ///< the uniform block in the layout of a GPU
  float time, dt;                       ///< [s] start of the frame, and time step of this run, each rounded once
  Rounding store_rounding = Rounding::rne;
  int level = -1;  ///< mip level, if the pass runs once for each level; else -1
};

/// One output of a pass.
struct PassOutput {
  std::string_view name;
  std::variant<BufferView, RecordView> content;
};

/// One run of a pass. step counts the substeps of a frame.
struct PassCall {
  int frame, step;
  std::string_view pass;
  std::span<const PassOutput> outputs;
  double seconds;  ///< duration of the pass [s]
  int level = -1;
};

class Recorder {
 public:
  virtual ~Recorder() = default;
  /// Returns true if the recorder reads the buffers of this pass in this frame. If not, an effect may pass an empty list of records,
  /// because a list of drops costs more than some passes.
  virtual bool reads(int /*frame*/, std::string_view /*pass*/) const { return true; }
  /// Called before the run of a pass, which may overwrite its inputs. Runs on the thread of the effect.
  virtual void before(const PassStart&) {}
  /// Called after the run of a pass, on the thread of the effect. Buffers may change after it returns.
  virtual void pass(const PassCall& call) = 0;
};

}  // namespace rainref
