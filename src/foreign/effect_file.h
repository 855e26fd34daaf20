// An effect that is none of rainref's own, as its author describes it: shaders that are trusted, and what they take and give.
//
// `rainref describe --spirv` writes the first draft of the file; docs/any_effect.md says what must be completed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "capture/pass_case.h"
#include "capture/pass_info.h"
#include "spirv/bindings.h"

namespace rainref::foreign {

inline constexpr const char* file_format = "rainref.effect";
inline constexpr const char* variant = "reference";  ///< the only one of a foreign effect

/// What a pass takes, and where from.
struct Input {
  capture::CaseInput like;  ///< name, rules and shape; of records the layout
  std::size_t levels = 1;
  std::string from;       ///< a pass; "": a file of the run
  bool previous = false;  ///< from that pass's run before this one
};
struct Pass {
  std::string name;
  spirv::Program program;        ///< program.spirv: the file, beside the description or where that says
  std::vector<std::byte> words;  ///< of it
  scene::UniformBlock block;     ///< without members where the shader takes none
  bool has_uniforms = false;
  std::vector<Input> inputs;
  std::vector<capture::CaseOutput> outputs;  ///< without values
  std::string formula() const { return effect + "." + name + "." + variant + "/1"; }
  std::string effect;
};
struct EffectFile {
  capture::EffectInfo info;
  std::vector<Pass> passes;  ///< in the order of execution
};

/// Reads and checks a description, with its shaders. Throws Error(port_files) naming the file, the place in it, what was expected and what
/// was found; where a shader says otherwise (a binding, a format, an offset) what it says; spirv::Refusal for a shader that cannot be a
/// reference: its invocations work together, write records, or do what is not executed.
EffectFile read_effect(const std::filesystem::path& file);

}  // namespace rainref::foreign
