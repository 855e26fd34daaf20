// Numbers and names of the SPIR-V specification that modules of compute shaders need.
#pragma once

#include <cstdint>
#include <string>

namespace rainref::spirv {

enum class Op : std::uint16_t {
#define RAINREF_SPIRV_GLOBAL(name, number, handler) name = number,
#define RAINREF_SPIRV_OP(name, number, result, handler) name = number,
#define RAINREF_SPIRV_WORDS(name, number, operands, in, out, value) name = number,
#define RAINREF_SPIRV_NUMBERS(name, number, operands, in, out, value) name = number,
#define RAINREF_SPIRV_NAME(name, number) name = number,
#include "spirv/opcodes.inc"
};

/// Kinds of types. An opaque type (image, sampler) is identified by its descriptor.
enum class Kind : std::uint8_t {
  nothing,
  boolean,
  integer,
  floating,
  vector,
  matrix,
  array,
  runtime_array,
  structure,
  image,
  sampler,
  sampled_image,
  pointer,
  function
};

/// Form of a componentwise instruction; operands is 0 for every other one.
struct EachForm {
  int operands = 0;
  Kind in = Kind::nothing, out = Kind::nothing;
};
EachForm each_form(Op op);
/// True if it occurs in functions and is executed; and whether it then has a result.
bool is_executed(Op op);
bool has_result(Op op);
/// "OpFAdd", or "instruction 4321" if it has no name here.
std::string op_name(Op op);

/// The functions of GLSL.std.450 with their numbers.
enum class Glsl : std::uint16_t {
#define RAINREF_GLSL_OTHER(name, number) name = number,
#define RAINREF_GLSL_WORDS(name, number, operands, value) name = number,
#define RAINREF_GLSL_NUMBERS(name, number, operands, value) name = number,
#include "spirv/glsl.inc"
};
/// Operands of a componentwise function and their kinds; 0 operands for others.
EachForm glsl_form(Glsl function);

/// Storage class of a variable.
enum class Storage : std::uint32_t {
  uniform_constant = 0,
  input = 1,
  uniform = 2,
  output = 3,
  workgroup = 4,
  private_ = 6,
  function = 7,
  push_constant = 9,
  storage_buffer = 12
};
/// True if pointers of this class count bytes of a buffer; others count slots of memory.
inline bool is_buffer(Storage s) { return s == Storage::uniform || s == Storage::storage_buffer; }

enum class Decoration : std::uint32_t {
  relaxed_precision = 0,
  spec_id = 1,
  block = 2,
  buffer_block = 3,
  row_major = 4,
  array_stride = 6,
  matrix_stride = 7,
  built_in = 11,
  non_writable = 24,
  binding = 33,
  descriptor_set = 34,
  offset = 35
};

enum class BuiltIn : std::uint32_t {
  num_workgroups = 24,
  workgroup_size = 25,
  workgroup_id = 26,
  local_invocation_id = 27,
  global_invocation_id = 28,
  local_invocation_index = 29
};

}  // namespace rainref::spirv
