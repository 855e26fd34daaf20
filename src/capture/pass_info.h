// Descriptions of passes for people, packs and reports. Each effect declares them once.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "capture/pass_case.h"
#include "scene/uniform_block.h"

namespace rainref::capture {

/// A buffer that passes read or write. If its meaning depends on the variant, it has one entry for each variant.
struct BufferInfo {
  std::string name;
  std::string format;    ///< a storage format's name, "records", or the scene key that selects it
  std::string sentence;  ///< meaning of the channels, with units
  std::string unit = "1";
  std::array<double, 2> range{0, 1};  ///< of the stored values; always 0 to 1 for unorm formats
  std::string encoding = "none";      ///< conversion from the stored value to its meaning
  std::string colour_space = "none", alpha = "none";
  std::string orientation = "";  ///< of panoramas and cubes
  std::string record = "";       ///< the layout in EffectInfo::records, if the format is "records"
  std::string variant = "";      ///< "": every one
};

/// An input of a pass and its source.
struct ReadInfo {
  std::string buffer;
  std::string from = "";     ///< the pass that wrote it; "": the host
  bool previous = false;     ///< from the previous run of that pass, in this frame or the one before
  std::string variant = "";  ///< "": every one
  bool per_texel = false;    ///< each invocation loads its own texel: the image has the size of the pass's outputs
};
/// The same input, loaded per texel.
inline ReadInfo per_texel(ReadInfo read) {
  read.per_texel = true;
  return read;
}

/// A pass in one variant.
struct PassVariant {
  std::string name;
  int revision;          ///< increases whenever the order of operations or a constant changes
  Judge judge;           ///< of every output; images beside keyed records: envelope
  std::string uniforms;  ///< name of the block in PassInfo::uniforms
};

struct PassInfo {
  std::string name;
  std::string sentence;
  std::vector<PassVariant> variants;
  std::vector<ReadInfo> reads;
  std::vector<std::string> writes;
  std::vector<scene::UniformBlock> uniforms;
  std::string independence = "gather";            ///< gather, ordered_scatter, unordered_scatter or compaction
  std::vector<std::string> order_free_sums = {};  ///< sums whose terms a port may add in any order

  /// Null if this variant does not run the pass.
  const PassVariant* variant(std::string_view variant_name) const;
  /// The uniform block of a variant that runs the pass.
  const scene::UniformBlock& block(std::string_view variant_name) const;
};

/// An effect's passes in the order of execution, its buffers, and the records among them.
struct EffectInfo {
  std::string name;
  std::vector<PassInfo> passes;
  std::vector<BufferInfo> buffers;
  std::vector<scene::UniformBlock> records;
  std::string up_axis = "y", handedness = "right", depth = "none";

  // Throws Error(internal) for a name that is not declared.
  const PassInfo& pass(std::string_view pass_name) const;
  const BufferInfo& buffer(std::string_view buffer_name, std::string_view variant) const;
  const scene::UniformBlock& record(std::string_view record_name) const;
  /// The outputs of a pass in a variant: those of its `writes` that the variant has.
  std::vector<std::string> writes(const PassInfo& pass, std::string_view variant) const;
  /// Names of the passes that a variant runs, in the order of execution.
  std::vector<std::string> pass_names(std::string_view variant) const;
};

/// "puddle.wave_step.corrected/2": name and revision of the order of operations.
std::string formula(const EffectInfo& effect, const PassInfo& pass, const PassVariant& variant);
/// "envelope", "bits", "keyed" or "input_only".
const char* name(Judge judge);
/// "as-published: input_only; corrected: bits", or one word if both are equal.
std::string judge_text(const PassInfo& pass);

}  // namespace rainref::capture
