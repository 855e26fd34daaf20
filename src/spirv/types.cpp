#include "spirv/types.h"

namespace rainref::spirv {

TypeIndex Types::add(Type type) {
  all_.push_back(std::move(type));
  return static_cast<TypeIndex>(all_.size() - 1);
}

TypeIndex Types::with_matrix_layout(TypeIndex index, std::uint32_t stride, bool is_row_major) {
  const Kind kind = all_[index].kind;
  if (kind != Kind::array && kind != Kind::runtime_array && kind != Kind::matrix) return index;
  Type type = all_[index];
  if (kind != Kind::matrix) {
    type.element = with_matrix_layout(type.element, stride, is_row_major);
  } else {
    // In a row-major matrix, the components of a column are one stride apart, and columns are adjacent.
    Type column = all_[type.element];
    column.stride = is_row_major ? stride : 4;
    type.element = add(column);
    type.stride = is_row_major ? 4 : stride;
    type.is_row_major = is_row_major;
  }
  return add(type);
}

Kind Types::component_kind(TypeIndex index) const {
  const Type& type = all_[index];
  return type.kind == Kind::vector || type.kind == Kind::matrix ? component_kind(type.element) : type.kind;
}

TypeIndex Types::part(TypeIndex index, std::uint32_t i) const {
  const Type& type = all_[index];
  switch (type.kind) {
    case Kind::vector:
    case Kind::matrix:
    case Kind::array:
      return i < type.count ? type.element : none;
    case Kind::runtime_array:
      return type.element;
    case Kind::structure:
      return i < type.members.size() ? type.members[i].type : none;
    default:
      return none;
  }
}
std::uint32_t Types::part_slot(TypeIndex index, std::uint32_t i) const {
  const Type& type = all_[index];
  return type.kind == Kind::structure ? type.members[i].slot : i * all_[type.element].slots;
}
std::uint32_t Types::part_offset(TypeIndex index, std::uint32_t i) const {
  const Type& type = all_[index];
  if (type.kind == Kind::structure) return type.members[i].offset;
  const std::uint64_t offset = std::uint64_t{i} * type.stride;
  return type.stride == 0 || offset >= none ? none : static_cast<std::uint32_t>(offset);
}

bool Types::leaves(TypeIndex index, std::uint64_t offset, std::vector<Leaf>& out) const {
  const Type& type = all_[index];
  switch (type.kind) {
    case Kind::integer:
    case Kind::floating:
      if (offset >= none) return false;
      out.push_back({static_cast<std::uint32_t>(offset), type.kind == Kind::floating});
      return true;
    case Kind::vector:
    case Kind::matrix:
    case Kind::array:
    case Kind::structure: {
      const auto parts = type.kind == Kind::structure ? static_cast<std::uint32_t>(type.members.size()) : type.count;
      for (std::uint32_t i = 0; i < parts; ++i) {
        const std::uint32_t at = part_offset(index, i);
        if (at == none || !leaves(part(index, i), offset + at, out)) return false;
      }
      return true;
    }
    default:
      return false;
  }
}

}  // namespace rainref::spirv
