// Who is wrong: the shader, or what ran it. A port's own SPIR-V, on the inputs of the pack, says what its device should have stored.
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

/// What was found at some invocations of a pass.
struct ShaderAnswer {
  int tried = 0;  ///< those that the shader, under the profile, leaves a bound and few alternatives
  int said = 0;   ///< what is stored is what the shader may give there
  int right = 0;  ///< of the others: what the shader gives in float, the reference may give, too
};
/// `stored` holds the port's outputs in the order of c.outputs; `places` are texels. Both models have the same values.
ShaderAnswer ask_shader(const capture::PassCase& c, const capture::PassModel& reference, const capture::PassModel& shader,
                        const std::vector<capture::Array>& stored, const std::vector<std::array<int, 2>>& places,
                        const enclosed::Profile& profile, judge::HalfMode mode);
/// What follows from it, for a pass that fails or passes; "" where there is nothing to say.
std::string sentence(const ShaderAnswer& answer, bool fails);

using Programs = std::map<std::string, spirv::Program>;
/// A formula's program on a case whose pass is judged by texels; null where there is none that texels can be asked of. Throws
/// spirv::Refusal for one that cannot be executed. The case and the programs must outlive it.
std::unique_ptr<capture::TracedProgram> program_model(const Programs& programs, const std::string& formula, const capture::PassCase& c);

/// Why a pass fails, and in which lines of the port's programs that is.
judge::Explanation explain(const judge::FailedRun& failed, const Programs& programs, const faults::SearchLimit& limit);

/// Where a shader takes its uniforms from other places than the pack has them, as a sentence, or "". Members are told by their names, for
/// a port may join two of them; what it calls otherwise is not looked at.
std::string block_fault(const scene::UniformBlock& block, const spirv::Module& shader);

/// A run with what the port stored, in the order of its outputs.
struct StoredRun {
  capture::PassCase c;
  std::vector<capture::Array> stored;
  scene::UniformBlock block;  ///< of its pass
};
/// The run of this id, or nothing where it was not judged.
using LoadStored = std::function<std::optional<StoredRun>(const std::string& id)>;
/// How the reference of a pass is bound.
using BindPass = std::function<judge::Bind(const std::string& pass)>;

/// Adds a note to the judgement for each pass whose program has something to say: passes that are judged by texels, at up to 32 of them
/// that fail, or at some where none fails. A program that cannot be read or executed is a note, too.
void ask_shaders(const LoadStored& load, const BindPass& bind, const Programs& programs, judge::PortJudgement& judgement);

}  // namespace rainref::judging
