// A SPIR-V module ready to execute: checked, resolved, specialized.
//
// The module is not trusted. Everything that its text determines is checked when it is parsed; what depends on values (addresses, the
// number of steps) is checked when it is executed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "capture/traced_program.h"
#include "spirv/refusal.h"
#include "spirv/types.h"

namespace rainref::spirv {

/// Values of specialization constants by their id: 32 bits each.
using Specialization = std::map<std::uint32_t, std::uint32_t>;

/// A slot of an invocation's memory: relative to the frame of the running function, or, as ~place, absolute.
using Place = std::int32_t;

/// An instruction. The code that makes it (translate*.cpp) and executes it (machine.h) documents the operands.
struct Code {
  Op op = Op::Nop;
  std::uint16_t sub = 0;         ///< a function of GLSL.std.450; or a flag
  std::uint32_t n = 0;           ///< slots of the result, or of the stored value
  std::uint32_t m = 0;           ///< slots of an operand, if they differ
  Place to = 0;                  ///< of the result
  std::array<Place, 4> in{};     ///< of operands; or blocks, or a function
  std::uint32_t pool = 0;        ///< the first of further operands in Module::pool
  std::uint32_t pool_count = 0;  ///< number of further operands
  std::uint32_t file = 0, line = 0;
};

/// The memory that a pointer refers to.
enum class Memory : std::uint16_t { invocation, shared, buffer };

struct Block {
  std::uint32_t first = 0;  ///< index of the first instruction
  std::uint32_t phis = 0;   ///< number of phis at the beginning
};
struct Function {
  std::string name;
  std::uint32_t entry = 0;  ///< entry block
  std::uint32_t slots = 0;  ///< slots of its frame
  std::vector<Place> parameters;
  std::uint32_t stack = 0;  ///< slots of its frame and of all functions that it calls
};

enum class Bound : std::uint8_t { uniform_buffer, storage_buffer, sampled_image, storage_image, sampler };
/// "a uniform block", "a storage buffer", ...
const char* name(Bound bound);
/// A variable that a descriptor is bound to.
struct Descriptor {
  std::string name;  ///< of the variable or of its type; may be ""
  std::uint32_t set = 0, binding = 0;
  Bound bound = Bound::uniform_buffer;
  TypeIndex type = none;
};

/// A slot of the memory that every invocation starts with.
struct Cell {
  std::uint32_t word = 0;
  bool is_float = false;
};
struct BuiltInPlace {
  BuiltIn what;
  std::uint32_t slot, slots;
};

struct Module {
  /// Throws Refusal. `name` starts every message: "'shade.spv'".
  Module(std::span<const std::byte> bytes, std::string module_name, const Specialization& specialization = {});

  std::string name;
  std::vector<std::string> files;    ///< of the shader's source; the first is ""
  std::vector<std::string> sources;  ///< their texts, if the module carries them; may be shorter than `files`
  Types types;
  std::vector<Cell> globals;  ///< constants, pointers to variables, variables of the invocation
  std::vector<BuiltInPlace> built_ins;
  std::vector<Descriptor> descriptors;
  std::uint32_t shared_slots = 0;  ///< of workgroup variables
  std::array<std::uint32_t, 3> group{1, 1, 1};
  std::vector<Function> functions;
  std::uint32_t entry = 0;
  std::vector<Block> blocks;
  std::vector<Code> code;
  std::vector<std::uint32_t> pool;
  bool is_cooperative = false;  ///< invocations of a workgroup wait for each other or share memory

  /// Location of an instruction in the shader's source.
  capture::SourceLine source_line(std::uint32_t instruction) const;
  /// Returns the same text, valid until the program ends.
  static const char* lasting(const std::string& text);
  [[noreturn]] void refuse(std::uint32_t file, std::uint32_t line, const std::string& sentence) const;
  [[noreturn]] void refuse(const Code& at, const std::string& sentence) const { refuse(at.file, at.line, sentence); }
};

}  // namespace rainref::spirv
