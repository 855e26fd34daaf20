#include "spirv/parser.h"

#include <cstring>
#include <mutex>
#include <set>
#include <sstream>

#include <fmt/format.h>

namespace rainref::spirv {
namespace {

constexpr std::uint32_t magic = 0x07230203, most_words = 1u << 20, most_invocations = 1024;

}  // namespace

Module::Module(std::span<const std::byte> bytes, std::string module_name, const Specialization& specialization)
    : name(std::move(module_name)), files{""} {
  Parser(*this, bytes, specialization).parse();
}
capture::SourceLine Module::source_line(std::uint32_t instruction) const {
  const Code& at = code[instruction];
  capture::SourceLine out{files[at.file], at.line};
  if (at.line == 0 || at.file >= sources.size()) return out;
  // A compiler may put lines of its own before the source and then begin anew: `#line 1`. The last line of this number is meant.
  std::istringstream text(sources[at.file]);
  std::uint32_t number = 1;
  for (std::string line; std::getline(text, line);) {
    std::uint32_t anew = 0;
    if (line.starts_with("#line ")) std::istringstream(line.substr(6)) >> anew;
    if (anew > 0)
      number = anew;
    else if (number++ == at.line)
      out.text = line;
  }
  const std::size_t begin = out.text.find_first_not_of(" \t"), end = out.text.find_last_not_of(" \t\r");
  out.text = begin == std::string::npos ? "" : out.text.substr(begin, end - begin + 1);
  return out;
}
const char* Module::lasting(const std::string& text) {
  static std::mutex mutex;
  static std::set<std::string> texts;
  const std::lock_guard lock(mutex);
  return texts.insert(text).first->c_str();
}
void Module::refuse(std::uint32_t file, std::uint32_t line, const std::string& sentence) const {
  throw Refusal(name, {files[file], static_cast<int>(line)}, sentence);
}
const char* name(Bound bound) {
  constexpr const char* names[] = {"a uniform block", "a storage buffer", "a sampled image", "a storage image", "a sampler"};
  return names[static_cast<int>(bound)];
}

Parser::Parser(Module& module, std::span<const std::byte> bytes, const Specialization& specialization)
    : module_(module), specialization_(specialization) {
  read_words(bytes);
}

void Parser::read_words(std::span<const std::byte> bytes) {
  const auto wrong = [&](const std::string& what) { module_.refuse(0, 0, what); };
  if (bytes.size() % 4 != 0 || bytes.size() < 20) wrong(fmt::format("expected SPIR-V, found {} bytes", bytes.size()));
  if (bytes.size() / 4 > most_words) wrong(fmt::format("SPIR-V of more than {} words is not read", most_words));
  words_.resize(bytes.size() / 4);
  std::memcpy(words_.data(), bytes.data(), bytes.size());
  if (words_[0] != magic) wrong("expected SPIR-V, found no magic number of it");
  if (words_[3] > most_ids) wrong(fmt::format("a bound of {} ids is not read, at most {}", words_[3], most_ids));
  ids_.resize(words_[3]);
}

void Parser::parse() {
  for (std::size_t at = 5; at < words_.size();) {
    const std::uint32_t count = words_[at] >> 16;
    Raw raw{static_cast<Op>(words_[at] & 0xffffu), {}, file_, line_};
    if (count == 0 || count > words_.size() - at) refuse(raw, fmt::format("{} is cut off at word {}", op_name(raw.op), at));
    raw.words = std::span<const std::uint32_t>(words_).subspan(at + 1, count - 1);
    at += count;
    take_line(raw);
    raw.file = file_;
    raw.line = line_;
    if (is_open_ && raw.op != Op::Function) {
      bodies_.back().code.push_back(raw);
      if (raw.op != Op::FunctionEnd) continue;
      is_open_ = false;
      file_ = line_ = 0;
    } else {
      declare(raw);
    }
  }
  const Raw end{Op::FunctionEnd, {}};
  if (is_open_) refuse(end, "the last function has no end");
  if (entry_id_ == 0) refuse(end, "it has no entry point of a compute shader");
  for (std::size_t k = 0; k < group_ids_.size(); ++k) module_.group[k] = constant_word({Op::ExecutionModeId, group_ids_}, k);
  std::uint64_t invocations = 1;
  for (const std::uint32_t side : module_.group) invocations *= std::min(side, 2 * most_invocations);
  if (invocations == 0 || invocations > most_invocations)
    refuse(end, fmt::format("a workgroup of {} x {} x {} is not executed", module_.group[0], module_.group[1], module_.group[2]));
  if (entry_id_ >= ids_.size() || ids_[entry_id_].what != What::function) refuse(end, "its entry point is no function");
  module_.entry = ids_[entry_id_].number;
  translate(module_.entry, 0);
}

void Parser::declare(const Raw& raw) {
  switch (raw.op) {
#define RAINREF_SPIRV_GLOBAL(name, number, handler) \
  case Op::name:                                    \
    return handler(raw);
#include "spirv/opcodes.inc"
    case Op::Variable:
      return add_variable(raw);
    case Op::Undef:
      return add_constant(raw);
    default:
      return;  // capabilities, extensions, sources: unsupported features are rejected where they are used
  }
}

void Parser::refuse_op(const Raw& raw) { refuse(raw, op_name(raw.op) + " is not executed"); }
void Parser::check_memory_model(const Raw& raw) {
  if (word(raw, 0) != 0) refuse(raw, "physical addresses are not executed");
}
void Parser::add_function(const Raw& raw) {
  if (is_open_) refuse(raw, "a function begins inside another one");
  Id& function = define(raw, 1, What::function);
  function.type = type(raw, 0);
  function.number = static_cast<std::uint32_t>(bodies_.size());
  const auto name_of = names_.find(raw.words[1]);
  bodies_.emplace_back().code.push_back(raw);
  module_.functions.push_back({name_of == names_.end() ? "" : name_of->second, 0, 0, {}, 0});
  is_open_ = true;
}
void Parser::add_text(const Raw& raw) {
  Id& made = define(raw, 0, What::text);
  made.number = static_cast<std::uint32_t>(module_.files.size());
  module_.files.push_back(text(raw, 1));
}
// Adds the text of a file, in one or several pieces.
void Parser::add_source(const Raw& raw) {
  const bool goes_on = raw.op == Op::SourceContinued;
  if (!goes_on) source_ = raw.words.size() > 3 && id(raw, 2).what == What::text ? id(raw, 2).number : 0;
  if (source_ == 0) return;
  module_.sources.resize(module_.files.size());
  module_.sources[source_] += text(raw, goes_on ? 0 : 3);
}
void Parser::add_name(const Raw& raw) { names_[word(raw, 0)] = text(raw, 1); }
void Parser::add_member_name(const Raw& raw) { member_names_[{word(raw, 0), word(raw, 1)}] = text(raw, 2); }
void Parser::add_import(const Raw& raw) {
  const std::string set = text(raw, 1);
  Id& import = define(raw, 0, What::ignored);
  if (set == "GLSL.std.450") import.what = What::glsl;
  if (set == "NonSemantic.Shader.DebugInfo.100") import.what = What::debug_information;
  if (import.what == What::ignored && !set.starts_with("NonSemantic.") && set.find("DebugInfo") == std::string::npos)
    refuse(raw, "functions of " + set + " are not executed");
}
void Parser::add_entry(const Raw& raw) {
  constexpr std::uint32_t compute = 5;
  if (word(raw, 0) != compute || (entry_id_ != 0 && text(raw, 2) != "main")) return;
  entry_id_ = word(raw, 1);
}
void Parser::set_group(const Raw& raw) {
  const bool by_ids = raw.op == Op::ExecutionModeId;
  constexpr std::uint32_t local_size = 17, local_size_id = 38;
  if (word(raw, 0) != entry_id_ || word(raw, 1) != (by_ids ? local_size_id : local_size) || is_group_decorated_) return;
  for (std::size_t k = 0; k < 3; ++k) module_.group[k] = word(raw, 2 + k);
  if (by_ids) group_ids_.assign(raw.words.begin() + 2, raw.words.begin() + 5);
}
void Parser::add_decoration(const Raw& raw) {
  const std::size_t at = raw.op == Op::Decorate ? 1 : 2;
  const auto decoration = static_cast<Decoration>(word(raw, at));
  const std::uint32_t value = raw.words.size() > at + 1 ? raw.words[at + 1] : 1, target = raw.words[0];
  if (decoration == Decoration::relaxed_precision) {
    const auto found = names_.find(target);
    refuse(raw, fmt::format("{} has RelaxedPrecision (mediump, min16float): a device may compute it with 16 bits, so it is not executed",
                            found == names_.end() ? fmt::format("id {}", target) : "'" + found->second + "'"));
  }
  if (at == 1) {
    decorations_[target][decoration] = value;
  } else {
    member_decorations_[{target, raw.words[1]}][decoration] = value;
  }
  // A constant with this decoration overrides the execution mode's size.
  if (at == 1 && decoration == Decoration::built_in && value == static_cast<std::uint32_t>(BuiltIn::workgroup_size)) {
    is_group_decorated_ = true;
    group_ids_ = {target};
  }
}

// A line applies until the next one, also across blocks: compilers write it only if it changes.
void Parser::take_line(const Raw& raw) {
  constexpr std::uint32_t debug_source = 35, debug_line = 103, debug_no_line = 104;
  if (raw.op == Op::Line) {
    const Id& file = id(raw, 0);
    file_ = file.what == What::text ? file.number : 0;
    line_ = word(raw, 1);
  } else if (raw.op == Op::NoLine) {
    file_ = line_ = 0;
  } else if (raw.op == Op::ExtInst && id(raw, 2).what == What::debug_information) {
    switch (word(raw, 3)) {
      case debug_source: {
        const std::uint32_t number = id(raw, 4).number;
        if (id(raw, 4).what == What::text) {
          Id& source = define(raw, 1, What::text);
          source.number = number;
          // The text is a string like file names, so the module lists it among these.
          module_.sources.resize(module_.files.size());
          if (raw.words.size() > 5 && id(raw, 5).what == What::text) module_.sources[number] = module_.files[id(raw, 5).number];
        }
        return;
      }
      case debug_line: {
        file_ = id(raw, 4).what == What::text ? id(raw, 4).number : 0;
        line_ = constant_word(raw, 5);
        return;
      }
      case debug_no_line:
        file_ = line_ = 0;
    }
  }
}

std::string Parser::text(const Raw& raw, std::size_t first) const {
  std::string out;
  for (std::size_t i = first; i < raw.words.size(); ++i) {
    for (int shift = 0; shift < 32; shift += 8) {
      const char c = static_cast<char>(raw.words[i] >> shift & 0xffu);
      if (c == '\0') return out;
      out += c;
    }
  }
  refuse(raw, "the text of " + op_name(raw.op) + " has no end");
}

void Parser::refuse_shape(const Raw& raw) const { refuse(raw, "the operands of " + op_name(raw.op) + " do not fit together"); }
std::uint32_t Parser::word(const Raw& raw, std::size_t i) const {
  if (i >= raw.words.size()) refuse(raw, op_name(raw.op) + " is cut off");
  return raw.words[i];
}
Parser::Id& Parser::define(const Raw& raw, std::size_t i, What what) {
  const std::uint32_t number = word(raw, i);
  if (number >= ids_.size()) refuse(raw, fmt::format("id {} is not below the bound of {}", number, ids_.size()));
  if (ids_[number].what != What::unknown) refuse(raw, fmt::format("id {} is defined twice", number));
  ids_[number].what = what;
  return ids_[number];
}
const Parser::Id& Parser::id(const Raw& raw, std::size_t i) const {
  const std::uint32_t number = word(raw, i);
  if (number >= ids_.size()) refuse(raw, fmt::format("id {} is not below the bound of {}", number, ids_.size()));
  return ids_[number];
}
TypeIndex Parser::type(const Raw& raw, std::size_t i) const {
  const Id& found = id(raw, i);
  if (found.what != What::type) refuse(raw, fmt::format("id {} of {} is no type", raw.words[i], op_name(raw.op)));
  return found.type;
}
const Parser::Id& Parser::value(const Raw& raw, std::size_t i) const {
  const Id& found = id(raw, i);
  if (found.what != What::value || (found.owner != 0 && found.owner != function_ + 1))
    refuse(raw, fmt::format("id {} of {} is no value there", raw.words[i], op_name(raw.op)));
  return found;
}
Place Parser::components(const Raw& raw, std::size_t i, Kind kind, std::uint32_t n) const {
  const Id& found = value(raw, i);
  if (module_.types.component_kind(found.type) != kind || type_of(found).slots != n) refuse_shape(raw);
  return found.place;
}
const std::uint32_t* Parser::constant(const Raw& raw, std::size_t i) const {
  const Id& found = id(raw, i);
  if (found.what != What::value || !found.is_constant || type_of(found).kind != Kind::integer) return nullptr;
  return &module_.globals[static_cast<std::size_t>(~found.place)].word;
}
std::uint32_t Parser::constant_word(const Raw& raw, std::size_t i) const {
  const std::uint32_t* found = constant(raw, i);
  if (found == nullptr) refuse(raw, fmt::format("id {} of {} is no constant integer", raw.words[i], op_name(raw.op)));
  return *found;
}
std::uint32_t Parser::decoration(std::uint32_t target, Decoration d, std::uint32_t otherwise) const {
  const auto of = decorations_.find(target);
  if (of == decorations_.end()) return otherwise;
  const auto found = of->second.find(d);
  return found == of->second.end() ? otherwise : found->second;
}

Code& Parser::emit(const Raw& raw, Op op) {
  Code& code = module_.code.emplace_back();
  code.op = op;
  code.file = raw.file;
  code.line = raw.line;
  code.pool = static_cast<std::uint32_t>(module_.pool.size());
  if (raw.words.size() > 1 && raw.words[1] < ids_.size() && ids_[raw.words[1]].owner == function_ + 1) {
    const Id& result = ids_[raw.words[1]];
    code.to = result.place;
    code.n = type_of(result).slots;
  }
  return code;
}
void Parser::add_to_pool(Code& code, std::uint32_t word) {
  if (module_.pool.size() >= most_operands) module_.refuse(code, fmt::format("more than {} operands are not executed", most_operands));
  module_.pool.push_back(word);
  ++code.pool_count;
}

}  // namespace rainref::spirv
