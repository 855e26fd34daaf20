// The types of a module, and the layout of their values in slots and in buffers.
//
// A value of any type is a row of slots: a scalar has one, a pointer two, a composite those of its parts in order. In a buffer a value is
// bytes, placed by the decorations Offset, ArrayStride, MatrixStride and RowMajor.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "spirv/opcodes.h"

namespace rainref::spirv {

/// Limits for a module, so that a file of a few bytes cannot use all memory of a machine.
inline constexpr std::uint32_t most_ids = 1u << 20, most_slots = 1u << 20, most_types = 1u << 16, most_operands = 1u << 22;
inline constexpr int most_nesting = 32;  ///< of types, and of calls

using TypeIndex = std::uint32_t;
inline constexpr std::uint32_t none = 0xffffffffu;

struct Member {
  TypeIndex type;
  std::uint32_t slot;           ///< its first slot in the structure
  std::uint32_t offset = none;  ///< in bytes
  std::string name = "";        ///< in the source; may be ""
};
struct Type {
  Kind kind = Kind::nothing;
  std::uint32_t slots = 0;
  TypeIndex element = none;  ///< of a vector, a matrix (its column), an array; pointee of a pointer; result of a function
  std::uint32_t count = 0;   ///< components, columns or elements
  std::uint32_t stride = 0;  ///< bytes from element to element in a buffer; 0: the module does not say
  int nesting = 0;
  bool is_signed = false, is_row_major = false, is_storage_image = false, is_buffer_block = false;
  Storage storage = Storage::function;  ///< of a pointer
  std::vector<Member> members;          ///< of a structure; parameter types of a function
  std::string name = "";                ///< of a structure in the source; may be ""
  std::uint32_t image_format = 0;       ///< of an image: SPIR-V's number of its format; 0: unknown
};

/// One slot of a value in a buffer.
struct Leaf {
  std::uint32_t offset;
  bool is_float;
};

class Types {
 public:
  const Type& operator[](TypeIndex i) const { return all_[i]; }
  TypeIndex add(Type type);
  std::size_t size() const { return all_.size(); }
  /// The same type with a matrix's layout decorations of a member; the matrix may be inside arrays.
  TypeIndex with_matrix_layout(TypeIndex type, std::uint32_t stride, bool is_row_major);

  /// Kind of the components of a scalar, a vector or a matrix; otherwise the type's own kind.
  Kind component_kind(TypeIndex type) const;
  /// Type of element or member i of a composite; none if there is no such part.
  TypeIndex part(TypeIndex type, std::uint32_t i) const;
  /// First slot of that part.
  std::uint32_t part_slot(TypeIndex type, std::uint32_t i) const;
  /// Bytes from the value's beginning to part i; none if the module does not say, or if there are 2^32 or more.
  std::uint32_t part_offset(TypeIndex type, std::uint32_t i) const;
  /// Finds the slots of a value that begins at `offset`. Returns false if the module does not say.
  bool leaves(TypeIndex type, std::uint64_t offset, std::vector<Leaf>& out) const;

 private:
  std::vector<Type> all_;
};

}  // namespace rainref::spirv
