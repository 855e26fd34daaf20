// Executes a port's own SPIR-V on the pack's inputs, to decide whether the shader or its device is wrong.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "capture/pass_model.h"
#include "faults/diagnose.h"
#include "judge/validate.h"
#include "spirv/bindings.h"
#include "spirv/interface.h"
#include "spirv/spirv_model.h"

namespace rainref::judging {

/// Results at some invocations of a pass.
struct ShaderAnswer {
  int tried = 0;  ///< invocations for which the shader under the profile has bounds and few alternatives
  int said = 0;   ///< of these: the stored values may come from the shader
  int right = 0;  ///< of the others: the reference allows what the shader computes in float
};
/// `stored` holds the port's outputs in the order of c.outputs; `places` are texels. Both models must have the same values.
ShaderAnswer ask_shader(const capture::PassCase& c, const capture::PassModel& reference, const capture::PassModel& shader,
                        const std::vector<capture::Array>& stored, const std::vector<std::array<int, 2>>& places,
                        const enclosed::Profile& profile, judge::HalfMode mode, const port_dump::KeptForms* kept = nullptr);
/// The conclusion for a pass that fails or passes; "" if there is none.
std::string sentence(const ShaderAnswer& answer, bool fails);

using Programs = std::map<std::string, spirv::Program>;
/// Binds a formula's program to a case whose pass is judged by texels; null if there is none that can be executed texel by texel. Throws
/// spirv::Refusal for a program that cannot be executed. The case and the programs must outlive it.
std::unique_ptr<capture::TracedProgram> program_model(const Programs& programs, const std::string& formula, const capture::PassCase& c);

/// Finds the causes of a failing pass, and the lines of the port's programs that contain them.
judge::Explanation explain(const judge::FailedRun& failed, const Programs& programs, const faults::SearchLimit& limit);

/// One sentence if a shader reads its uniforms at other offsets than the pack's, or "". Members are matched by name, because a port may
/// merge two of them; other names are ignored.
std::string block_fault(const scene::UniformBlock& block, const spirv::Module& shader);

/// A run with the port's outputs, in the order of the pass's.
struct StoredRun {
  capture::PassCase c;
  std::vector<capture::Array> stored;
  scene::UniformBlock block;       ///< uniform block of its pass
  port_dump::KeptForms kept = {};  ///< what the forms of `stored` leave open
};
/// Returns the run of this id; nothing if it was not judged.
using LoadStored = std::function<std::optional<StoredRun>(const std::string& id)>;
/// Returns how the reference of a pass is bound.
using BindPass = std::function<judge::Bind(const std::string& pass)>;

/// Adds a note for each pass whose program contributes to the verdict. Executes passes that are judged by texels at up to 32 failing
/// texels, or at some texels if none fails. A program that cannot be read or executed is a note, too.
void ask_shaders(const LoadStored& load, const BindPass& bind, const Programs& programs, judge::PortJudgement& judgement);

}  // namespace rainref::judging
