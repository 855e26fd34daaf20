// bindings.json: which program computes each pass, and what is bound to it. examples/ports/README.md lists the keys. rainref reads it with
// this file, too.
//
// Binding convention, the same for every pass. Descriptor set 0; binding 0 is the uniform block (std140), then the
// inputs and the outputs in the order of the program's lists:
//   input image     combined image sampler, with the manifest's addresses, border and filters ("none": nearest)
//   input records   std430 storage buffer: an array of the records
//   output image    storage image in the buffer's format
//   output records  std430 storage buffer: the count in the first of four words, the records from byte 16
// An input that the case does not have is bound as one texel of zeros, one of `lists` as 256 bytes of zeros.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "ports/runner/npy.h"

namespace port_runner {

/// A specialization constant taken from the manifest: an address rule (clamp 0, repeat 1, border 2, mirror 3), or
/// whether the case has the input (0, 1).
struct Fact {
  std::uint32_t id;
  std::string key, input;  ///< key: address_u, address_v or present
};
struct Program {
  fs::path spirv;
  std::vector<std::string> inputs, outputs;
  std::vector<std::string> lists;  ///< those inputs that a case may lack and that are records
  std::vector<Fact> constants;
  bool one_group = false;  ///< one workgroup; otherwise one invocation for each texel of the first output
  std::uint32_t group[2] = {8, 8};
  std::uint32_t capacity = 0;  ///< room for records in an output of them
};

/// The number that a constant has for an address rule: "clamp" 0, "repeat" 1, "border" 2, "mirror" 3; -1 for none of them.
std::int32_t address_number(const std::string& address);

/// "; did you mean 'wave'?" where one of the names is near to the text, else nothing.
std::string did_you_mean(const std::string& text, const std::vector<std::string>& names);
std::string joined(const std::vector<std::string>& names);

}  // namespace port_runner
