// Variables, pointers, atomics and images.
#include <algorithm>

#include <fmt/format.h>

#include "spirv/parser.h"

namespace rainref::spirv {

// A separate sampler is ignored: the image's binding defines the sampling.
void Parser::translate_image(const Raw& raw) {
  const Kind kind = type_of(value(raw, 2)).kind;
  if ((kind != Kind::image && kind != Kind::sampled_image) || type_of(value(raw, 1)).slots != 1) refuse_shape(raw);
  copy(raw, value(raw, 1).place, value(raw, 2).place, 1);
}
const Parser::Id& Parser::pointer(const Raw& raw, std::size_t i) const {
  const Id& found = value(raw, i);
  if (type_of(found).kind != Kind::pointer || found.pointee == none)
    refuse(raw, fmt::format("id {} of {} is no pointer", raw.words[i], op_name(raw.op)));
  return found;
}

// in: initial value; sub: true if there is one; m: first slot of its memory in the frame; n: number of slots.
void Parser::translate_variable(const Raw& raw) {
  const Id& result = pointer(raw, 1);
  if (type_of(result).storage != Storage::function) refuse_shape(raw);
  const std::uint32_t slots = module_.types[result.pointee].slots;
  Code& code = emit(raw, raw.op);
  code.n = slots;
  code.m = static_cast<std::uint32_t>(result.place) + type_of(result).slots;
  if (raw.words.size() <= 3) return;
  if (type_of(value(raw, 3)).slots != slots) refuse_shape(raw);
  code.in[0] = value(raw, 3).place;
  code.sub = 1;
}

// in: the pointer; m: constant offset; pool: places of indices, the stride of each, and its bound.
void Parser::translate_chain(const Raw& raw) {
  const Id& base = pointer(raw, 2);
  const Storage storage = type_of(base).storage;
  const bool counts_bytes = is_buffer(storage);
  Code& code = emit(raw, Op::AccessChain);
  code.in[0] = base.place;
  std::uint64_t fixed = 0;
  TypeIndex at = base.pointee;
  for (std::size_t i = 3; i < raw.words.size(); ++i) {
    const Type& t = module_.types[at];
    const std::uint32_t* known = constant(raw, i);
    const TypeIndex part = module_.types.part(at, known ? *known : 0);
    if (part == none || (t.kind == Kind::structure && known == nullptr)) refuse_shape(raw);
    if (counts_bytes && t.kind != Kind::structure && t.stride == 0) refuse(raw, "an array in a buffer has no ArrayStride or MatrixStride");
    if (known) {
      const std::uint32_t offset = counts_bytes ? module_.types.part_offset(at, *known) : module_.types.part_slot(at, *known);
      if (offset == none) refuse(raw, "a member of a buffer has no Offset");
      fixed += offset;
    } else {
      add_to_pool(code, static_cast<std::uint32_t>(components(raw, i, Kind::integer, 1)));
      add_to_pool(code, counts_bytes ? t.stride : module_.types[t.element].slots);
      add_to_pool(code, t.kind == Kind::runtime_array ? none : t.count);
    }
    at = part;
  }
  if (fixed >= none || type_of(value(raw, 1)).kind != Kind::pointer || type_of(value(raw, 1)).storage != storage) refuse_shape(raw);
  code.m = static_cast<std::uint32_t>(fixed);
  ids_[raw.words[1]].pointee = at;
}

// sub: the memory. For a buffer m: bytes from the pointer to the value's end; pool: twice the offset of each slot, plus one for a float.
void Parser::access(const Raw& raw, Code& code, const Id& to, TypeIndex given) {
  const Storage storage = type_of(to).storage;
  const std::uint32_t slots = module_.types[given].slots;
  if (module_.types[to.pointee].slots != slots || slots == 0) refuse_shape(raw);
  code.n = slots;
  code.sub = static_cast<std::uint16_t>(is_buffer(storage)              ? Memory::buffer
                                        : storage == Storage::workgroup ? Memory::shared
                                                                        : Memory::invocation);
  if (!is_buffer(storage)) return;
  std::vector<Leaf> leaves;
  if (!module_.types.leaves(to.pointee, 0, leaves))
    refuse(raw, "a value in a buffer has parts without Offset, ArrayStride or MatrixStride");
  for (const Leaf& leaf : leaves) {
    if (leaf.offset >= 1u << 30) refuse_shape(raw);
    code.m = std::max(code.m, leaf.offset + 4);
    add_to_pool(code, 2 * leaf.offset + leaf.is_float);
  }
}
void Parser::translate_load(const Raw& raw) {
  const Id& from = pointer(raw, 2);
  const Kind kind = module_.types[from.pointee].kind;
  if (kind == Kind::image || kind == Kind::sampled_image || kind == Kind::sampler) {
    if (module_.types[value(raw, 1).type].kind != kind) refuse_shape(raw);
    return copy(raw, value(raw, 1).place, from.place, 1);
  }
  Code& code = emit(raw, raw.op);
  code.in[0] = from.place;
  access(raw, code, from, value(raw, 1).type);
}
// in: pointer, value.
void Parser::translate_store(const Raw& raw) {
  const Id &to = pointer(raw, 0), &object = value(raw, 1);
  if (type_of(to).storage == Storage::input || type_of(to).storage == Storage::uniform_constant) refuse_shape(raw);
  Code& code = emit(raw, raw.op);
  code.in = {to.place, object.place, 0, 0};
  access(raw, code, to, object.type);
}
// in: the pointer to the block; m: offset of the array; pool: bytes of an element.
void Parser::translate_array_length(const Raw& raw) {
  const Id& block = pointer(raw, 2);
  const TypeIndex array = module_.types.part(block.pointee, word(raw, 3));
  if (array == none || module_.types[array].kind != Kind::runtime_array || !is_buffer(type_of(block).storage)) refuse_shape(raw);
  const std::uint32_t offset = module_.types.part_offset(block.pointee, raw.words[3]), stride = module_.types[array].stride;
  if (offset == none || stride == 0) refuse(raw, "an array in a buffer has no Offset or ArrayStride");
  components(raw, 1, Kind::integer, 1);
  Code& code = emit(raw, raw.op);
  code.in[0] = block.place;
  code.m = offset;
  add_to_pool(code, stride);
}

// in: pointer, value, comparator; sub: the memory.
void Parser::translate_atomic(const Raw& raw) {
  const bool stores = raw.op == Op::AtomicStore;
  const std::size_t at = stores ? 0 : 2;
  const Id& to = pointer(raw, at);
  if (module_.types[to.pointee].kind != Kind::integer || type_of(to).storage == Storage::input)
    refuse(raw, "atomics of anything but integers are not executed");
  if (!stores) components(raw, 1, Kind::integer, 1);
  Code& code = emit(raw, raw.op);
  code.in[0] = to.place;
  access(raw, code, to, to.pointee);
  switch (raw.op) {
    case Op::AtomicLoad:
    case Op::AtomicIIncrement:
    case Op::AtomicIDecrement:
      break;
    case Op::AtomicCompareExchange:
      code.in[1] = components(raw, at + 4, Kind::integer, 1);
      code.in[2] = components(raw, at + 5, Kind::integer, 1);
      break;
    default:
      code.in[1] = components(raw, at + 3, Kind::integer, 1);
  }
}

namespace {

// The supported image operands; others would change the result.
constexpr std::uint32_t lod_operand = 2, constant_offset_operand = 8, offset_operand = 16;

}  // namespace

// in: image, coordinates, mip level, offset; sub: 1 with an offset.
void Parser::translate_sample(const Raw& raw) {
  if (raw.op == Op::ImageSampleImplicitLod)
    refuse(raw, "OpImageSampleImplicitLod takes its mip level from neighbouring pixels, which a compute shader has not");
  const std::uint32_t mask = word(raw, 4), offset = mask & (constant_offset_operand | offset_operand);
  if ((mask & ~(constant_offset_operand | offset_operand)) != lod_operand || offset == (constant_offset_operand | offset_operand))
    refuse(raw, fmt::format("image operands {:#x} of OpImageSampleExplicitLod are not executed", mask));
  const std::uint32_t coordinates = type_of(value(raw, 3)).slots;
  if (type_of(value(raw, 2)).kind != Kind::sampled_image || coordinates < 2) refuse_shape(raw);
  components(raw, 1, Kind::floating, 4);
  Code& code = emit(raw, raw.op);
  code.in = {value(raw, 2).place, components(raw, 3, Kind::floating, coordinates), components(raw, 5, Kind::floating, 1), 0};
  code.sub = offset != 0;
  if (offset != 0) code.in[3] = components(raw, 6, Kind::integer, 2);
}

// in: image, coordinates, texel or mip level, offset; sub: 1 with a mip level, 2 with an offset; m: components of the written texel.
void Parser::translate_texel(const Raw& raw) {
  const bool writes = raw.op == Op::ImageWrite, fetches = raw.op == Op::ImageFetch;
  const std::size_t at = writes ? 0 : 2;
  const std::uint32_t coordinates = type_of(value(raw, at + 1)).slots;
  if (type_of(value(raw, at)).kind != Kind::image || coordinates < 2) refuse_shape(raw);
  std::uint32_t texel = 4;
  if (writes) texel = type_of(value(raw, 2)).slots;
  components(raw, writes ? 2 : 1, Kind::floating, texel);
  if (texel > 4) refuse_shape(raw);
  const std::uint32_t mask = raw.words.size() > at + (writes ? 3 : 2) ? raw.words[at + (writes ? 3 : 2)] : 0;
  const std::uint32_t known = fetches ? lod_operand | constant_offset_operand : 0;
  if ((mask & ~known) != 0) refuse(raw, fmt::format("image operands {:#x} of {} are not executed", mask, op_name(raw.op)));
  Code& code = emit(raw, raw.op);
  code.n = texel;
  code.m = texel;
  code.in[0] = value(raw, at).place;
  code.in[1] = components(raw, at + 1, Kind::integer, coordinates);
  if (writes) code.in[2] = value(raw, 2).place;
  if (mask & lod_operand) code.in[2] = components(raw, 5, Kind::integer, 1);
  if (mask & constant_offset_operand) code.in[3] = components(raw, mask & lod_operand ? 6 : 5, Kind::integer, 2);
  code.sub = static_cast<std::uint16_t>((mask & lod_operand ? 1 : 0) | (mask & constant_offset_operand ? 2 : 0));
}
// in: image, mip level.
void Parser::translate_query(const Raw& raw) {
  const Kind kind = type_of(value(raw, 2)).kind;
  if (kind != Kind::image && kind != Kind::sampled_image) refuse_shape(raw);
  components(raw, 1, Kind::integer, raw.op == Op::ImageQueryLevels ? 1 : 2);
  Code& code = emit(raw, raw.op);
  code.in[0] = value(raw, 2).place;
  if (raw.op == Op::ImageQuerySizeLod) code.in[1] = components(raw, 3, Kind::integer, 1);
}

}  // namespace rainref::spirv
