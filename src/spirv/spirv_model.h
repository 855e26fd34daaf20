// A port's program as the model of a pass: evaluates its SPIR-V on a case with every number type that our own passes are judged with.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "capture/traced_program.h"
#include "spirv/bindings.h"

namespace rainref::spirv {

/// The model of a program with one invocation for each texel of its outputs. values() are the channels of the images that are judged by
/// envelope, output after output, and 0 where the program writes none. The case must outlive it. Throws like execute(), and also Refusal if
/// invocations cooperate or write a list: only float can execute these. An evaluation throws Refusal for what cannot be executed.
std::unique_ptr<capture::TracedProgram> spirv_model(const capture::PassCase& c, const Program& program, std::span<const std::byte> spirv,
                                                    const std::string& name, const Limits& limits = {});

/// A program that writes lists; `c` is a case of its pass. Throws like execute().
std::unique_ptr<capture::TracedListProgram> spirv_list(const capture::PassCase& c, const Program& program, std::span<const std::byte> spirv,
                                                       const std::string& name, const Limits& limits = {});

}  // namespace rainref::spirv
