// Types, constants and variables of a module.
#include <algorithm>
#include <bit>

#include <fmt/format.h>

#include "spirv/integers.h"
#include "spirv/parser.h"

namespace rainref::spirv {

void Parser::add_type(const Raw& raw) {
  const auto refuse_kind = [&](const std::string& what) { refuse(raw, what + " are not executed"); };
  Type t;
  const auto take_element = [&](std::size_t i) -> const Type& {
    t.element = type(raw, i);
    const Type& element = module_.types[t.element];
    t.nesting = element.nesting + 1;
    return element;
  };
  std::uint64_t slots = 0;
  switch (raw.op) {
    case Op::TypeVoid:
      break;
    case Op::TypeBool:
      t.kind = Kind::boolean;
      slots = 1;
      break;
    case Op::TypeInt:
      t.kind = Kind::integer;
      if (word(raw, 1) != 32) refuse_kind(fmt::format("integers of {} bits", raw.words[1]));
      t.is_signed = word(raw, 2) != 0;
      slots = 1;
      break;
    case Op::TypeFloat:
      t.kind = Kind::floating;
      if (word(raw, 1) != 32) refuse_kind(fmt::format("floats of {} bits", raw.words[1]));
      slots = 1;
      break;
    case Op::TypeVector:
    case Op::TypeMatrix: {
      const Type& element = take_element(1);
      const bool is_vector = raw.op == Op::TypeVector;
      t.kind = is_vector ? Kind::vector : Kind::matrix;
      t.count = word(raw, 2);
      t.stride = is_vector ? 4 : 0;
      const Kind component = module_.types.component_kind(t.element);
      if (element.kind != (is_vector ? component : Kind::vector) || component == Kind::nothing || component > Kind::floating ||
          (!is_vector && component != Kind::floating) || t.count < 2 || t.count > 4)
        refuse_shape(raw);
      slots = t.count * element.slots;
      break;
    }
    case Op::TypeImage: {
      t.kind = Kind::image;
      constexpr std::uint32_t two_dimensions = 1, storage = 2;
      if (module_.types[type(raw, 1)].kind != Kind::floating) refuse_kind("images of integers");
      if (word(raw, 2) != two_dimensions || word(raw, 4) != 0 || word(raw, 5) != 0)
        refuse_kind("images that have layers, samples or not two dimensions");
      t.is_storage_image = word(raw, 6) == storage;
      t.image_format = word(raw, 7);
      slots = 1;
      break;
    }
    case Op::TypeSampler:
      t.kind = Kind::sampler;
      slots = 1;
      break;
    case Op::TypeSampledImage:
      if (take_element(1).kind != Kind::image) refuse_shape(raw);
      t.kind = Kind::sampled_image;
      slots = 1;
      break;
    case Op::TypeArray:
    case Op::TypeRuntimeArray: {
      const Type& element = take_element(1);
      t.kind = raw.op == Op::TypeArray ? Kind::array : Kind::runtime_array;
      t.count = raw.op == Op::TypeArray ? constant_word(raw, 2) : 0;
      t.stride = decoration(word(raw, 0), Decoration::array_stride, 0);
      if (element.slots == 0) refuse_kind("arrays of what has no size");
      slots = std::uint64_t{t.count} * element.slots;
      break;
    }
    case Op::TypeStruct:
      t.kind = Kind::structure;
      t.is_buffer_block = decoration(word(raw, 0), Decoration::buffer_block, 0) != 0;
      add_structure(raw, t);
      slots = t.slots;
      break;
    case Op::TypePointer:
      t.kind = Kind::pointer;
      t.storage = static_cast<Storage>(word(raw, 1));
      take_element(2);
      slots = 2;
      break;
    default:  // a function's result; its parameters are the function's
      t.kind = Kind::function;
      take_element(1);
      break;
  }
  if (slots > most_slots) refuse(raw, fmt::format("a type of {} numbers is not executed, at most {}", slots, most_slots));
  if (module_.types.size() > most_types) refuse(raw, fmt::format("more than {} types are not executed", most_types));
  if (t.nesting > most_nesting) refuse(raw, fmt::format("types more than {} deep are not executed", most_nesting));
  t.slots = static_cast<std::uint32_t>(slots);
  Id& defined = define(raw, 0, What::type);
  defined.type = module_.types.add(std::move(t));
}

void Parser::add_structure(const Raw& raw, Type& t) {
  std::uint64_t slots = 0;
  if (const auto found = names_.find(word(raw, 0)); found != names_.end()) t.name = found->second;
  for (std::size_t i = 1; i < raw.words.size(); ++i) {
    Member member{type(raw, i), static_cast<std::uint32_t>(slots)};
    const auto named = member_names_.find({raw.words[0], static_cast<std::uint32_t>(i - 1)});
    if (named != member_names_.end()) member.name = named->second;
    const auto of = member_decorations_.find({raw.words[0], static_cast<std::uint32_t>(i - 1)});
    if (of != member_decorations_.end()) {
      const auto at = [&](Decoration d, std::uint32_t otherwise) {
        const auto found = of->second.find(d);
        return found == of->second.end() ? otherwise : found->second;
      };
      member.offset = at(Decoration::offset, none);
      const std::uint32_t stride = at(Decoration::matrix_stride, 0);
      if (stride != 0) member.type = module_.types.with_matrix_layout(member.type, stride, at(Decoration::row_major, 0) != 0);
    }
    const Type& type_there = module_.types[member.type];
    if (type_there.kind == Kind::runtime_array && i + 1 != raw.words.size()) refuse_shape(raw);
    slots += type_there.slots;
    if (slots > most_slots) refuse(raw, fmt::format("a structure of more than {} numbers is not executed", most_slots));
    t.nesting = std::max(t.nesting, type_there.nesting + 1);
    if (module_.types.size() > most_types) refuse(raw, fmt::format("more than {} types are not executed", most_types));
    t.members.push_back(member);
  }
  // A type without parts has a slot too, so that the work to visit all parts of a value is bounded by its number of slots.
  t.slots = std::max<std::uint32_t>(static_cast<std::uint32_t>(slots), 1);
}

Place Parser::add_cells(const Raw& raw, const std::vector<Cell>& cells) {
  const std::size_t first = module_.globals.size();
  if (first + cells.size() > most_slots)
    refuse(raw, fmt::format("constants and variables of more than {} numbers are not executed", most_slots));
  module_.globals.insert(module_.globals.end(), cells.begin(), cells.end());
  return ~static_cast<Place>(first);
}

std::uint32_t Parser::specialized(const Raw& raw, std::uint32_t value) const {
  const std::uint32_t id_of = decoration(word(raw, 1), Decoration::spec_id, none);
  const auto found = specialization_.find(id_of);
  return id_of == none || found == specialization_.end() ? value : found->second;
}

void Parser::add_constant(const Raw& raw) {
  const TypeIndex of = type(raw, 0);
  const Type& t = module_.types[of];
  std::vector<Cell> cells;
  switch (raw.op) {
    case Op::ConstantTrue:
    case Op::ConstantFalse:
      cells = {{raw.op == Op::ConstantTrue, false}};
      break;
    case Op::SpecConstantTrue:
    case Op::SpecConstantFalse:
      cells = {{specialized(raw, raw.op == Op::SpecConstantTrue) != 0, false}};
      break;
    case Op::Constant:
      cells = {{word(raw, 2), t.kind == Kind::floating}};
      break;
    case Op::SpecConstant:
      cells = {{specialized(raw, word(raw, 2)), t.kind == Kind::floating}};
      break;
    case Op::ConstantComposite:
    case Op::SpecConstantComposite:
      for (std::size_t i = 2; i < raw.words.size(); ++i) {
        const Id& part = value(raw, i);
        if (!part.is_constant || part.type == none || cells.size() + type_of(part).slots > t.slots) refuse_shape(raw);
        const auto first = module_.globals.begin() + ~part.place;
        cells.insert(cells.end(), first, first + type_of(part).slots);
      }
      if (t.kind == Kind::structure && t.members.empty()) cells.resize(1);
      break;
    case Op::SpecConstantOp:
      cells = operation_on_constants(raw, of);
      break;
    default:  // null, undefined
      cells.resize(t.slots);
  }
  if (cells.size() != t.slots || t.kind == Kind::nothing) refuse_shape(raw);
  const Place place = add_cells(raw, cells);
  Id& constant = define(raw, 1, What::value);
  constant.type = of;
  constant.place = place;
  constant.is_constant = true;
  if (is_group_decorated_ && group_ids_.size() == 1 && group_ids_[0] == raw.words[1]) {
    if (cells.size() != 3) refuse_shape(raw);
    for (std::size_t k = 0; k < 3; ++k) module_.group[k] = cells[k].word;
    group_ids_.clear();
  }
}

std::vector<Cell> Parser::operation_on_constants(const Raw& raw, TypeIndex of) {
  const Type& t = module_.types[of];
  const auto op = static_cast<Op>(word(raw, 2));
  const auto cell = [&](std::size_t i, std::uint32_t k) -> const Cell& {
    const Id& operand = value(raw, i);
    if (!operand.is_constant || k >= type_of(operand).slots) refuse_shape(raw);
    return module_.globals[static_cast<std::size_t>(~operand.place) + k];
  };
  std::vector<Cell> cells;
  if (op == Op::CompositeExtract) {
    TypeIndex part = none;
    const std::uint32_t slot = slot_of_part(raw, value(raw, 3).type, 4, part);
    for (std::uint32_t k = 0; k < t.slots; ++k) cells.push_back(cell(3, slot + k));
  } else if (op == Op::Select) {
    for (std::uint32_t k = 0; k < t.slots; ++k)
      cells.push_back(cell(3, type_of(value(raw, 3)).slots == 1 ? 0 : k).word != 0 ? cell(4, k) : cell(5, k));
  } else if (word_operation(op, 0, 0)) {
    const std::size_t second = each_form(op).operands == 2 ? 4 : 3;
    for (std::uint32_t k = 0; k < t.slots; ++k) cells.push_back({*word_operation(op, cell(3, k).word, cell(second, k).word), false});
  } else {
    refuse(raw, op_name(op) + " of specialization constants is not executed");
  }
  return cells;
}

void Parser::add_variable(const Raw& raw) {
  const TypeIndex of = type(raw, 0);
  const Type& pointer_type = module_.types[of];
  if (pointer_type.kind != Kind::pointer || static_cast<Storage>(word(raw, 2)) != pointer_type.storage) refuse_shape(raw);
  const TypeIndex pointee = pointer_type.element;
  const Type& t = module_.types[pointee];
  Id made;
  made.what = What::value;
  made.type = of;
  made.pointee = pointee;
  std::vector<Cell> memory(t.slots);
  switch (pointer_type.storage) {
    case Storage::uniform:
    case Storage::storage_buffer:
    case Storage::uniform_constant:
      add_descriptor(raw, made, pointer_type.storage, pointee);
      break;
    case Storage::workgroup:
      made.place = add_cells(raw, {{0, false}, {module_.shared_slots, false}});
      if (t.slots > most_slots - module_.shared_slots)
        refuse(raw, fmt::format("shared memory of more than {} numbers is not executed", most_slots));
      module_.shared_slots += t.slots;
      module_.is_cooperative = true;
      break;
    case Storage::input:
    case Storage::private_: {
      if (pointer_type.storage == Storage::input) {
        const auto what = static_cast<BuiltIn>(decoration(word(raw, 1), Decoration::built_in, none));
        const bool is_scalar = what == BuiltIn::local_invocation_index;
        if (!is_scalar && (what < BuiltIn::num_workgroups || what > BuiltIn::global_invocation_id))
          refuse(raw, "an input that is no number of the invocation is not executed");
        if (t.slots != (is_scalar ? 1 : 3) || module_.types.component_kind(pointee) != Kind::integer) refuse_shape(raw);
        module_.built_ins.push_back({what, static_cast<std::uint32_t>(module_.globals.size()), t.slots});
      } else if (raw.words.size() > 3) {
        const Id& initial = value(raw, 3);
        if (!initial.is_constant || type_of(initial).slots != t.slots) refuse_shape(raw);
        const auto first = module_.globals.begin() + ~initial.place;
        std::copy_n(first, t.slots, memory.begin());
      }
      const auto at = static_cast<std::uint32_t>(~add_cells(raw, memory));
      made.place = add_cells(raw, {{0, false}, {at, false}});
      break;
    }
    default:
      refuse(raw, "a variable that is no block, buffer, image, built-in or shared memory (a push constant?) is not executed");
  }
  define(raw, 1, What::value) = made;
}

void Parser::add_descriptor(const Raw& raw, Id& made, Storage storage, TypeIndex pointee) {
  const Type& t = module_.types[pointee];
  Descriptor d;
  d.set = decoration(word(raw, 1), Decoration::descriptor_set, 0);
  d.binding = decoration(raw.words[1], Decoration::binding, none);
  if (const auto found = names_.find(raw.words[1]); found != names_.end()) d.name = found->second;
  if (storage == Storage::uniform_constant) {
    if (t.kind != Kind::image && t.kind != Kind::sampled_image && t.kind != Kind::sampler) refuse(raw, "arrays of images are not executed");
    d.bound = t.kind == Kind::sampler ? Bound::sampler : t.is_storage_image ? Bound::storage_image : Bound::sampled_image;
  } else {
    if (t.kind != Kind::structure) refuse(raw, "arrays of blocks are not executed");
    d.bound = storage == Storage::storage_buffer || t.is_buffer_block ? Bound::storage_buffer : Bound::uniform_buffer;
  }
  d.type = pointee;
  made.number = static_cast<std::uint32_t>(module_.descriptors.size());
  made.place = add_cells(raw, {{made.number, false}, {0, false}});
  module_.descriptors.push_back(std::move(d));
}

}  // namespace rainref::spirv
