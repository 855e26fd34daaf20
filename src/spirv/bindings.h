// A pass' case bound to a port's program, as port_runner binds it on a device (examples/ports/README.md).
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "capture/pass_case.h"
#include "ports/runner/programs.h"
#include "spirv/group.h"

namespace rainref::spirv {

/// A program of bindings.json, or one whose descriptors lie elsewhere than there.
struct Program : port_runner::Program {
  Program() = default;
  Program(port_runner::Program of) : port_runner::Program(std::move(of)) {}
  /// Set and binding of the uniform block, the inputs and the outputs; empty: set 0, from binding 0 on.
  std::vector<std::array<std::uint32_t, 2>> at;
};

/// FOLDER/bindings.json: formula with revision to program. Throws Error(port_files), and Error(io) where it cannot be read.
std::map<std::string, Program> read_programs(const std::filesystem::path& folder);
/// The words of a program. Throws like read_programs().
std::vector<std::byte> read_spirv(const Program& program);

/// The program's constants, as this case has them. Throws Error(port_files).
Specialization specialization_of(const Program& program, const capture::PassCase& c);

/// What a module's descriptors lead to: the case's inputs, and outputs to be written, which are 0 before. The case and the
/// module must outlive it.
class CaseBinding {
 public:
  /// Throws Refusal where a descriptor has another set than 0 or a binding that the program has not, and Error(port_files) where the case
  /// has no such output.
  CaseBinding(const capture::PassCase& c, const Program& program, const Module& module);
  ~CaseBinding();
  std::span<const Resource<Float>> resources() const { return resources_; }
  /// What a descriptor is written to; null where it is no output.
  const capture::CaseOutput* output(std::size_t descriptor) const;
  /// The image that this decoded texel is of; "" where it is of none.
  std::string_view input_of(const float* texel) const;
  /// Workgroups: as many as cover the first output.
  Three groups() const;
  /// What was written, in the order of the program's outputs, in the formats of the case. Throws Refusal where a list counts more records
  /// than it has room for.
  std::vector<capture::Array> outputs() const;

 private:
  struct Bound;
  void bind_input(const std::string& name);
  void bind_output(const std::string& name);
  /// The place in bound_ of what is bound to a descriptor; that behind the last where nothing is.
  std::size_t place_of(const Descriptor& d) const;

  const capture::PassCase& case_;
  Program program_;
  const Module& module_;
  std::vector<std::unique_ptr<Bound>> bound_;  ///< by binding
  std::vector<Resource<Float>> resources_;     ///< by descriptor
};

/// A case's outputs by a program in SPIR-V. `name` starts every message about the module. Throws as all of these.
std::vector<capture::Array> execute(const capture::PassCase& c, const Program& program, std::span<const std::byte> spirv,
                                    const std::string& name, const Limits& limits = {});

}  // namespace rainref::spirv
