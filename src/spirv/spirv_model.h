// A port's program as the model of a pass: what its SPIR-V says of a case, with every number that our own passes are judged by.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "capture/traced_program.h"
#include "spirv/bindings.h"

namespace rainref::spirv {

/// The invocations of a program that has one for each texel of its outputs; values() are the channels of the images that are
/// judged by envelope, output after output, and 0 where the program writes none. The case must outlive it. Throws as
/// execute(); Refusal also where invocations work together or a list is written: float alone executes those. Evaluation throws Refusal for
/// what cannot be executed.
std::unique_ptr<capture::TracedProgram> spirv_model(const capture::PassCase& c, const Program& program, std::span<const std::byte> spirv,
                                                    const std::string& name, const Limits& limits = {});

}  // namespace rainref::spirv
