// Binds a case to a port's program, as port_runner binds it on a device (examples/ports/README.md).
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

/// A program of bindings.json, or one whose descriptors have other sets and bindings.
struct Program : port_runner::Program {
  Program() = default;
  Program(port_runner::Program of) : port_runner::Program(std::move(of)) {}
  /// Set and binding of the uniform block, the inputs and the outputs. If empty: set 0, bindings counted from 0.
  std::vector<std::array<std::uint32_t, 2>> at;
};

/// Reads FOLDER/bindings.json: a program for each formula with its revision. Throws Error(port_files), and Error(io) if the file cannot be
/// read.
std::map<std::string, Program> read_programs(const std::filesystem::path& folder);
/// Returns the words of a program. Throws like read_programs().
std::vector<std::byte> read_spirv(const Program& program);

/// Returns the program's constants with the values of this case. Throws Error(port_files).
Specialization specialization_of(const Program& program, const capture::PassCase& c);

/// The resources of a module's descriptors: the case's inputs, and outputs that start as zeros. The case and the module must outlive it.
class CaseBinding {
 public:
  /// Throws Refusal if a descriptor's set is not 0 or the program lacks its binding, and Error(port_files) if the case lacks the output.
  CaseBinding(const capture::PassCase& c, const Program& program, const Module& module);
  ~CaseBinding();
  std::span<const Resource<Float>> resources() const { return resources_; }
  /// Returns the output that a descriptor writes; null if it is not an output.
  const capture::CaseOutput* output(std::size_t descriptor) const;
  /// Returns the name of the image that contains this decoded texel; "" if no image does.
  std::string_view input_of(const float* texel) const;
  /// Number of workgroups: enough to cover the first output.
  Three groups() const;
  /// The written outputs in the order of the program's outputs, in the case's formats. Throws Refusal if a list's count is above its
  /// capacity.
  std::vector<capture::Array> outputs() const;

 private:
  struct Bound;
  void bind_input(const std::string& name);
  void bind_output(const std::string& name);
  /// Index in bound_ of the resource of a descriptor; bound_.size() if there is none.
  std::size_t place_of(const Descriptor& d) const;

  const capture::PassCase& case_;
  Program program_;
  const Module& module_;
  std::vector<std::unique_ptr<Bound>> bound_;  ///< by binding
  std::vector<Resource<Float>> resources_;     ///< by descriptor
};

/// Computes a case's outputs with a SPIR-V program. `name` starts every message about the module. Throws like the functions above.
std::vector<capture::Array> execute(const capture::PassCase& c, const Program& program, std::span<const std::byte> spirv,
                                    const std::string& name, const Limits& limits = {});

}  // namespace rainref::spirv
