// Numbers, composites, matrices and the functions of GLSL.std.450.
#include <algorithm>

#include <fmt/format.h>

#include "spirv/parser.h"

namespace rainref::spirv {
void Parser::copy(const Raw& raw, Place to, Place from, std::uint32_t n) {
  Code& code = emit(raw, Op::CopyObject);
  code.to = to;
  code.in[0] = from;
  code.n = n;
}

void Parser::translate_copy(const Raw& raw) {
  const std::uint32_t n = type_of(value(raw, 1)).slots;
  if (type_of(value(raw, 2)).slots != n) refuse_shape(raw);
  copy(raw, value(raw, 1).place, value(raw, 2).place, n);
}
// sub: true if the result is a float.
void Parser::translate_bitcast(const Raw& raw) {
  const Kind from = module_.types.component_kind(value(raw, 2).type), to = module_.types.component_kind(value(raw, 1).type);
  const auto is_number = [](Kind k) { return k == Kind::integer || k == Kind::floating; };
  if (!is_number(from) || !is_number(to)) refuse_shape(raw);
  const Place in = components(raw, 2, from, type_of(value(raw, 1)).slots);
  Code& code = emit(raw, from == to ? Op::CopyObject : Op::Bitcast);
  code.in[0] = in;
  code.sub = to == Kind::floating;
}
void Parser::translate_each(const Raw& raw) {
  const EachForm form = each_form(raw.op);
  const std::uint32_t n = type_of(value(raw, 1)).slots;
  const Place to = components(raw, 1, form.out, n);
  Code& code = emit(raw, raw.op);
  code.to = to;
  for (int i = 0; i < form.operands; ++i)
    code.in[static_cast<std::size_t>(i)] = components(raw, static_cast<std::size_t>(2 + i), form.in, n);
}
// in: condition, value if true, value if false; sub: one condition for all slots.
void Parser::translate_select(const Raw& raw) {
  const std::uint32_t n = type_of(value(raw, 1)).slots, conditions = type_of(value(raw, 2)).slots;
  if ((conditions != 1 && conditions != n) || type_of(value(raw, 3)).slots != n || type_of(value(raw, 4)).slots != n) refuse_shape(raw);
  Code& code = emit(raw, raw.op);
  code.in = {components(raw, 2, Kind::boolean, conditions), value(raw, 3).place, value(raw, 4).place, 0};
  code.sub = conditions == 1;
}
// in: base, inserted bits (for an extraction the base again), offset, count.
void Parser::translate_bits(const Raw& raw) {
  const std::uint32_t n = type_of(value(raw, 1)).slots;
  const std::size_t last = raw.op == Op::BitFieldInsert ? 3 : 2;
  components(raw, 1, Kind::integer, n);
  Code& code = emit(raw, raw.op);
  code.in = {components(raw, 2, Kind::integer, n), components(raw, last, Kind::integer, n), components(raw, last + 1, Kind::integer, 1),
             components(raw, last + 2, Kind::integer, 1)};
}
// The result is a structure of two halves with m components each.
void Parser::translate_wide(const Raw& raw) {
  const Id& result = value(raw, 1);
  const std::uint32_t m = type_of(result).slots / 2;
  if (type_of(result).kind != Kind::structure || type_of(result).slots != 2 * m) refuse_shape(raw);
  Code& code = emit(raw, raw.op);
  code.in[0] = components(raw, 2, Kind::integer, m);
  code.in[1] = components(raw, 3, Kind::integer, m);
  code.m = m;
}

// m: slots of the sum, or rows of the operand of a transposition or of an outer product; sub: columns of the result.
void Parser::translate_product(const Raw& raw) {
  const auto shape = [&](std::size_t i) {
    const Type& t = type_of(value(raw, i));
    const bool is_matrix = t.kind == Kind::matrix;
    struct {
      bool is_matrix;
      std::uint32_t columns, rows, slots;
    } out{is_matrix, is_matrix ? t.count : 1, is_matrix ? module_.types[t.element].slots : t.slots, t.slots};
    return out;
  };
  const bool is_truth = raw.op == Op::Any || raw.op == Op::All, is_unary = is_truth || raw.op == Op::Transpose;
  const auto a = shape(2), b = shape(is_unary ? 2 : 3), result = shape(1);
  std::uint32_t columns = 1, rows = 1, m = a.rows;
  bool fits = true;
  switch (raw.op) {
    case Op::VectorTimesScalar:
    case Op::MatrixTimesScalar:
      fits = b.slots == 1;
      columns = a.columns;
      rows = a.rows;
      break;
    case Op::VectorTimesMatrix:
      fits = !a.is_matrix && b.is_matrix && a.rows == b.rows;
      rows = b.columns;
      break;
    case Op::MatrixTimesVector:
      fits = a.is_matrix && !b.is_matrix && a.columns == b.rows;
      rows = a.rows;
      m = a.columns;
      break;
    case Op::MatrixTimesMatrix:
      fits = a.is_matrix && b.is_matrix && a.columns == b.rows;
      columns = b.columns;
      rows = a.rows;
      m = a.columns;
      break;
    case Op::OuterProduct:
      fits = !a.is_matrix && !b.is_matrix;
      columns = b.rows;
      rows = a.rows;
      break;
    case Op::Transpose:
      fits = a.is_matrix;
      columns = a.rows;
      rows = a.columns;
      break;
    case Op::Dot:
      fits = !a.is_matrix && a.rows == b.rows;
      break;
    default:
      break;
  }
  if (!fits || result.slots != columns * rows) refuse_shape(raw);
  const Kind in = is_truth ? Kind::boolean : Kind::floating;
  components(raw, 1, in, result.slots);
  Code& code = emit(raw, raw.op);
  code.in[0] = components(raw, 2, in, a.slots);
  if (!is_unary) code.in[1] = components(raw, 3, in, b.slots);
  code.m = m;
  code.sub = static_cast<std::uint16_t>(columns);
}

// pool: places and slot counts of the parts.
void Parser::translate_construct(const Raw& raw) {
  const Id& result = value(raw, 1);
  const Kind kind = module_.types.component_kind(result.type);
  const bool is_vector = type_of(result).kind == Kind::vector;
  Code& code = emit(raw, raw.op);
  std::uint64_t slots = 0;
  for (std::size_t i = 2; i < raw.words.size(); ++i) {
    const Id& part = value(raw, i);
    if (is_vector && module_.types.component_kind(part.type) != kind) refuse_shape(raw);
    add_to_pool(code, static_cast<std::uint32_t>(part.place));
    add_to_pool(code, type_of(part).slots);
    slots += type_of(part).slots;
  }
  if (slots != code.n && code.pool_count > 0) refuse_shape(raw);
}
std::uint32_t Parser::slot_of_part(const Raw& raw, TypeIndex whole, std::size_t first, TypeIndex& part) const {
  std::uint32_t slot = 0;
  part = whole;
  for (std::size_t i = first; i < raw.words.size(); ++i) {
    const TypeIndex next = module_.types.part(part, raw.words[i]);
    if (next == none) refuse_shape(raw);
    slot += module_.types.part_slot(part, raw.words[i]);
    part = next;
  }
  return slot;
}
void Parser::translate_part(const Raw& raw) {
  const Id& result = value(raw, 1);
  TypeIndex part = none;
  if (raw.op == Op::CompositeExtract) {
    const Id& whole = value(raw, 2);
    const std::uint32_t slot = slot_of_part(raw, whole.type, 3, part);
    if (module_.types[part].slots != type_of(result).slots || std::uint64_t{slot} + type_of(result).slots > type_of(whole).slots)
      refuse_shape(raw);
    return copy(raw, result.place, shifted(whole.place, slot), type_of(result).slots);
  }
  const Id &object = value(raw, 2), &whole = value(raw, 3);
  const std::uint32_t slot = slot_of_part(raw, result.type, 4, part), slots = type_of(object).slots;
  if (whole.type != result.type || module_.types[part].slots != slots || std::uint64_t{slot} + slots > type_of(result).slots)
    refuse_shape(raw);
  copy(raw, result.place, whole.place, type_of(result).slots);
  copy(raw, shifted(result.place, slot), object.place, slots);
}
// in: vector, index, inserted value; m: components of the vector.
void Parser::translate_dynamic_part(const Raw& raw) {
  const bool inserts = raw.op == Op::VectorInsertDynamic;
  const Id& vector = value(raw, 2);
  const Type& t = type_of(vector);
  if (t.kind != Kind::vector || type_of(value(raw, 1)).slots != (inserts ? t.slots : 1)) refuse_shape(raw);
  Code& code = emit(raw, raw.op);
  code.in[0] = vector.place;
  code.in[1] = components(raw, inserts ? 4 : 3, Kind::integer, 1);
  if (inserts) code.in[2] = components(raw, 3, module_.types.component_kind(vector.type), 1);
  code.m = t.slots;
}
// pool: the place of each component; an undefined one becomes the first.
void Parser::translate_shuffle(const Raw& raw) {
  const Id &result = value(raw, 1), &a = value(raw, 2), &b = value(raw, 3);
  if (type_of(result).kind != Kind::vector || type_of(a).kind != Kind::vector || type_of(b).kind != Kind::vector ||
      raw.words.size() != 4 + type_of(result).slots)
    refuse_shape(raw);
  Code& code = emit(raw, raw.op);
  const std::uint32_t first = type_of(a).slots, all = first + type_of(b).slots;
  for (std::size_t i = 4; i < raw.words.size(); ++i) {
    const std::uint32_t k = raw.words[i] == none ? 0 : raw.words[i];
    if (k >= all) refuse_shape(raw);
    add_to_pool(code, static_cast<std::uint32_t>(k < first ? shifted(a.place, k) : shifted(b.place, k - first)));
  }
}

// sub: the function; m: components of an operand.
void Parser::translate_function(const Raw& raw) {
  if (id(raw, 2).what != What::glsl) refuse(raw, "a function of an unknown set is not executed");
  const std::uint32_t number = word(raw, 3);
  const auto function = static_cast<Glsl>(number > 0xffff ? 0 : number);
  const std::uint32_t n = type_of(value(raw, 1)).slots, m = type_of(value(raw, 4)).slots;
  const EachForm form = glsl_form(function);
  struct Operand {
    Kind kind;
    std::uint32_t slots;
  };
  std::vector<Operand> in;
  Operand out{form.operands > 0 ? form.out : Kind::floating, n};
  if (form.operands > 0) {
    in.assign(static_cast<std::size_t>(form.operands), {form.in, n});
  } else {
    constexpr Kind whole = Kind::integer, real = Kind::floating;
    switch (function) {
      case Glsl::Length:
        in = {{real, m}};
        out = {real, 1};
        break;
      case Glsl::Distance:
        in = {{real, m}, {real, m}};
        out = {real, 1};
        break;
      case Glsl::Normalize:
        in = {{real, n}};
        break;
      case Glsl::Reflect:
        in = {{real, n}, {real, n}};
        break;
      case Glsl::FaceForward:
        in = {{real, n}, {real, n}, {real, n}};
        break;
      case Glsl::Cross:
        in = {{real, 3}, {real, 3}};
        out = {real, 3};
        break;
      case Glsl::Refract:
        in = {{real, n}, {real, n}, {real, 1}};
        break;
      case Glsl::Determinant:
        in = {{real, m}};
        out = {real, 1};
        break;
      case Glsl::MatrixInverse:
        in = {{real, n}};
        break;
      case Glsl::PackHalf2x16:
      case Glsl::PackUnorm4x8:
        in = {{real, function == Glsl::PackHalf2x16 ? 2u : 4u}};
        out = {whole, 1};
        break;
      case Glsl::UnpackHalf2x16:
      case Glsl::UnpackUnorm4x8:
        in = {{whole, 1}};
        out = {real, function == Glsl::UnpackHalf2x16 ? 2u : 4u};
        break;
      default:
        refuse(raw, fmt::format("function {} of GLSL.std.450 is not executed", number));
    }
  }
  components(raw, 1, out.kind, out.slots);
  const bool is_of_matrix = function == Glsl::Determinant || function == Glsl::MatrixInverse;
  const Type& operand = type_of(value(raw, 4));
  if (is_of_matrix ? operand.kind != Kind::matrix || operand.slots != operand.count * operand.count : n > 4 || m > 4) refuse_shape(raw);
  Code& code = emit(raw, raw.op);
  code.sub = static_cast<std::uint16_t>(number);
  code.m = m;
  for (std::size_t i = 0; i < in.size(); ++i) code.in[i] = components(raw, 4 + i, in[i].kind, in[i].slots);
}

}  // namespace rainref::spirv
