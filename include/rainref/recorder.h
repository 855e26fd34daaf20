// What an effect tells about each pass it runs: the hook of hashing, timing and capture.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <variant>

#include "rainref/image.h"

namespace rainref {

/// An array of records of one layout, as stored: count * record_bytes bytes.
struct RecordView {
  const void* data;
  std::size_t count, record_bytes;
  std::span<const std::byte> bytes() const { return {static_cast<const std::byte*>(data), count * record_bytes}; }
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
};

class Recorder {
 public:
  virtual ~Recorder() = default;
  /// Called after each pass, from the thread that runs the effect. Buffers may change after it returns.
  virtual void pass(const PassCall& call) = 0;
};

}  // namespace rainref
