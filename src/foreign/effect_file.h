// A foreign effect, described by its author: trusted shaders, and their inputs and outputs.
//
// `rainref describe --spirv` writes a first draft of the file; docs/any_effect.md says what must be completed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "capture/pass_case.h"
#include "capture/pass_info.h"
#include "spirv/bindings.h"

namespace rainref::foreign {

inline constexpr const char* file_format = "rainref.effect";
inline constexpr const char* variant = "reference";  ///< the only variant of a foreign effect

/// An input of a pass and its source.
struct Input {
  capture::CaseInput like;  ///< name, rules and shape; layout for records
  std::size_t levels = 1;
  std::string from;       ///< source pass; "": a file of the run
  bool previous = false;  ///< from the source pass's previous run
};
struct Pass {
  std::string name;
  spirv::Program program;        ///< program.spirv: the file, at the path relative to the description
  std::vector<std::byte> words;  ///< of the program
  scene::UniformBlock block;     ///< without members if the shader has no uniforms
  std::vector<Input> inputs;
  std::vector<capture::CaseOutput> outputs;  ///< without values
};
struct EffectFile {
  capture::EffectInfo info;
  std::vector<Pass> passes;  ///< in the order of execution

  /// Null if there is no pass of this name.
  const Pass* find(const std::string& name) const;
};

/// Reads and checks a description and its shaders. Throws Error(port_files) naming the file, the place, and what was expected and found,
/// also if a shader contradicts it (a binding, a format, an offset). Throws spirv::Refusal for a shader that cannot be a reference: its
/// invocations cooperate, it writes records, or it uses something unsupported.
/// `may_read` is called with the path of each shader before it is read, and throws if that is not allowed.
using MayRead = std::function<void(const std::filesystem::path&)>;
EffectFile read_effect(const std::filesystem::path& file, const MayRead& may_read = {});

}  // namespace rainref::foreign
