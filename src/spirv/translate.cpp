// Functions and blocks of a module, and branches between them.
#include <algorithm>

#include <fmt/format.h>

#include "spirv/parser.h"

namespace rainref::spirv {
// True for an instruction that describes only the source.
bool Parser::is_debug(const Raw& raw) const {
  if (raw.op != Op::ExtInst) return false;
  const What set = id(raw, 2).what;
  return set == What::ignored || set == What::debug_information;
}

void Parser::translate(std::uint32_t function, int depth) {
  using State = Body::State;
  if (bodies_[function].state == State::done) return;
  const std::vector<Raw>& code = bodies_[function].code;
  const Raw& head = code.front();
  const std::string called = module_.functions[function].name.empty() ? "a function" : "'" + module_.functions[function].name + "'";
  if (bodies_[function].state == State::begun) refuse(head, called + " calls itself: recursion is not executed");
  if (depth > most_nesting) refuse(head, fmt::format("calls more than {} deep are not executed", most_nesting));
  bodies_[function].state = State::begun;
  std::uint64_t below = 0;
  for (const Raw& raw : code) {
    if (raw.op != Op::FunctionCall) continue;
    const Id& callee = id(raw, 2);
    if (callee.what != What::function) refuse(raw, fmt::format("id {} of OpFunctionCall is no function", raw.words[2]));
    translate(callee.number, depth + 1);
    below = std::max<std::uint64_t>(below, module_.functions[callee.number].stack);
  }
  function_ = function;
  is_in_block_ = false;
  place_results(function);
  Function& made = module_.functions[function];
  if (labels_.empty()) refuse(head, called + " has no code");
  made.entry = block_;
  for (const Raw& raw : code) translate_code(raw);
  const std::uint64_t stack = made.slots + below;
  if (stack > most_slots) refuse(head, fmt::format("variables of more than {} numbers are not executed", most_slots));
  made.stack = static_cast<std::uint32_t>(stack);
  bodies_[function].state = State::done;
}

// Assigns a place in the frame to each result, and a number to each block: both may be used before their definition.
void Parser::place_results(std::uint32_t function) {
  labels_.clear();
  block_ = static_cast<std::uint32_t>(module_.blocks.size());
  Function& made = module_.functions[function];
  std::uint64_t slots = 0;
  for (const Raw& raw : bodies_[function].code) {
    if (raw.op == Op::Label) {
      if (!labels_.emplace(word(raw, 0), module_.blocks.size()).second) refuse(raw, fmt::format("block {} is there twice", raw.words[0]));
      module_.blocks.emplace_back();
    }
    if (!is_executed(raw.op) && raw.op != Op::Function) refuse_op(raw);
    if (!has_result(raw.op) || is_debug(raw)) continue;
    Id& result = define(raw, 1, What::value);
    result.type = type(raw, 0);
    result.owner = function + 1;
    result.place = static_cast<Place>(slots);
    const Type& t = module_.types[result.type];
    if (t.kind == Kind::pointer) result.pointee = t.element;
    slots += t.slots;
    if (raw.op == Op::Variable && t.kind == Kind::pointer) slots += module_.types[t.element].slots;
    if (slots > most_slots) refuse(raw, fmt::format("variables of more than {} numbers are not executed", most_slots));
    if (raw.op != Op::FunctionParameter) continue;
    made.parameters.push_back(result.place);
    bodies_[function].parameters.push_back(result.type);
  }
  made.slots = static_cast<std::uint32_t>(slots);
}

void Parser::translate_code(const Raw& raw) {
  const bool is_inside = raw.op != Op::Function && raw.op != Op::FunctionParameter && raw.op != Op::Label && raw.op != Op::FunctionEnd &&
                         raw.op != Op::Line && raw.op != Op::NoLine && raw.op != Op::Nop && !is_debug(raw);
  if (is_inside && !is_in_block_) refuse(raw, op_name(raw.op) + " stands in no block");
  if (is_debug(raw)) return;
  switch (raw.op) {
#define RAINREF_SPIRV_OP(name, number, result, handler) \
  case Op::name:                                        \
    return translate_##handler(raw);
#include "spirv/opcodes.inc"
    default:
      if (each_form(raw.op).operands > 0) translate_each(raw);
  }
}

// Undefined values, which are zeros, and barriers.
void Parser::translate_plain(const Raw& raw) {
  emit(raw, raw.op);
  module_.is_cooperative |= raw.op == Op::ControlBarrier;
}
// A block's label, or the end of the function.
void Parser::translate_label(const Raw& raw) {
  if (is_in_block_) refuse(raw, "a block has no end");
  if (raw.op == Op::FunctionEnd) return;
  is_in_block_ = true;
  block_ = labels_.at(raw.words[0]);
  module_.blocks[block_].first = static_cast<std::uint32_t>(module_.code.size());
}
std::uint32_t Parser::block_of(const Raw& raw, std::size_t i) const {
  const auto found = labels_.find(word(raw, i));
  if (found == labels_.end())
    refuse(raw, fmt::format("{} leads to id {}, which is no block of the function", op_name(raw.op), raw.words[i]));
  return found->second;
}

void Parser::translate_phi(const Raw& raw) {
  Block& block = module_.blocks[block_];
  if (block_ == module_.functions[function_].entry || module_.code.size() - block.first != block.phis)
    refuse(raw, "OpPhi stands in the first block, or behind other instructions");
  ++block.phis;
  const Id& result = value(raw, 1);
  Code& code = emit(raw, raw.op);
  for (std::size_t i = 2; i < raw.words.size(); i += 2) {
    const Id& from = value(raw, i);
    if (type_of(from).slots != type_of(result).slots) refuse_shape(raw);
    add_to_pool(code, static_cast<std::uint32_t>(from.place));
    add_to_pool(code, block_of(raw, i + 1));
  }
}

void Parser::translate_branch(const Raw& raw) {
  Code& code = emit(raw, raw.op);
  code.n = 0;
  if (raw.op == Op::Branch) {
    code.in[0] = static_cast<Place>(block_of(raw, 0));
  } else {
    code.in = {components(raw, 0, Kind::boolean, 1), static_cast<Place>(block_of(raw, 1)), static_cast<Place>(block_of(raw, 2)), 0};
  }
  is_in_block_ = false;
}
void Parser::translate_switch(const Raw& raw) {
  Code& code = emit(raw, raw.op);
  code.n = 0;
  code.in[0] = components(raw, 0, Kind::integer, 1);
  code.in[1] = static_cast<Place>(block_of(raw, 1));
  for (std::size_t i = 2; i < raw.words.size(); i += 2) {
    add_to_pool(code, raw.words[i]);
    add_to_pool(code, block_of(raw, i + 1));
  }
  is_in_block_ = false;
}

void Parser::translate_call(const Raw& raw) {
  const Id& callee = id(raw, 2);
  const std::vector<TypeIndex>& parameters = bodies_[callee.number].parameters;
  if (callee.type != type(raw, 0) || raw.words.size() - 3 != parameters.size()) refuse_shape(raw);
  Code& code = emit(raw, raw.op);
  code.in[0] = static_cast<Place>(callee.number);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Id& argument = value(raw, 3 + i);
    if (argument.type != parameters[i]) refuse_shape(raw);
    add_to_pool(code, static_cast<std::uint32_t>(argument.place));
    add_to_pool(code, static_cast<std::uint32_t>(module_.functions[callee.number].parameters[i]));
    add_to_pool(code, type_of(argument).slots);
  }
}
void Parser::translate_return(const Raw& raw) {
  const Id& function = ids_[bodies_[function_].code.front().words[1]];
  const std::uint32_t given = raw.op == Op::ReturnValue ? type_of(value(raw, 0)).slots : 0;
  if (raw.op != Op::Unreachable && given != module_.types[function.type].slots) refuse_shape(raw);
  Code& code = emit(raw, raw.op);
  code.n = given;
  if (raw.op == Op::ReturnValue) code.in[0] = value(raw, 0).place;
  is_in_block_ = false;
}

}  // namespace rainref::spirv
