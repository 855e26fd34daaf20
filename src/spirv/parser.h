// Parses a module, and holds the state that only the parser needs. Only the files of this room include it.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "spirv/module.h"

namespace rainref::spirv {

/// An instruction in the file.
struct Raw {
  Op op;
  std::span<const std::uint32_t> words;  ///< without the first word
  std::uint32_t file = 0, line = 0;
};

class Parser {
 public:
  Parser(Module& module, std::span<const std::byte> bytes, const Specialization& specialization);
  void parse();

 private:
  enum class What : std::uint8_t { unknown, type, value, text, glsl, debug_information, ignored, function };
  /// The meaning of an id.
  struct Id {
    What what = What::unknown;
    bool is_constant = false;
    TypeIndex type = none;        ///< the type itself, or the type of the value
    TypeIndex pointee = none;     ///< of a pointer; with its layout if it points into a buffer
    Place place = 0;              ///< of a value
    std::uint32_t owner = 0;      ///< of a value: the function that it belongs to, counted from 1; 0: all functions
    std::uint32_t number = none;  ///< file of a text; number of a function; descriptor of a variable
  };
  using Decorations = std::map<Decoration, std::uint32_t>;

  // parser.cpp: the whole module
  void read_words(std::span<const std::byte> bytes);
  void declare(const Raw& raw);
  [[noreturn]] void refuse_op(const Raw& raw);
  void check_memory_model(const Raw& raw);
  void add_name(const Raw& raw);
  void add_member_name(const Raw& raw);
  void add_text(const Raw& raw);
  void add_source(const Raw& raw);
  void add_entry(const Raw& raw);
  void add_function(const Raw& raw);
  void set_group(const Raw& raw);
  void add_import(const Raw& raw);
  void add_decoration(const Raw& raw);
  void take_line(const Raw& raw);
  std::string text(const Raw& raw, std::size_t first) const;

  // declarations.cpp: types, constants, variables
  void add_type(const Raw& raw);
  void add_structure(const Raw& raw, Type& type);
  void add_constant(const Raw& raw);
  std::uint32_t specialized(const Raw& raw, std::uint32_t value) const;
  std::vector<Cell> operation_on_constants(const Raw& raw, TypeIndex type);
  void add_variable(const Raw& raw);
  void add_descriptor(const Raw& raw, Id& id, Storage storage, TypeIndex pointee);
  Place add_cells(const Raw& raw, const std::vector<Cell>& cells);

  // translate.cpp: functions, blocks, branches
  struct Body {
    std::vector<Raw> code;
    std::vector<TypeIndex> parameters;
    enum class State : std::uint8_t { untouched, begun, done } state = State::untouched;
  };
  void translate(std::uint32_t function, int depth);
  void place_results(std::uint32_t function);
  void translate_code(const Raw& raw);
  void translate_nothing(const Raw&) {}
  void translate_plain(const Raw& raw);
  void translate_label(const Raw& raw);
  void translate_phi(const Raw& raw);
  void translate_branch(const Raw& raw);
  void translate_switch(const Raw& raw);
  void translate_call(const Raw& raw);
  void translate_return(const Raw& raw);
  std::uint32_t block_of(const Raw& raw, std::size_t i) const;
  bool is_debug(const Raw& raw) const;

  // translate_values.cpp: numbers, composites, matrices, functions of GLSL
  void translate_each(const Raw& raw);
  void translate_copy(const Raw& raw);
  void translate_bitcast(const Raw& raw);
  void translate_select(const Raw& raw);
  void translate_bits(const Raw& raw);
  void translate_wide(const Raw& raw);
  void translate_product(const Raw& raw);
  void translate_construct(const Raw& raw);
  void translate_part(const Raw& raw);
  void translate_dynamic_part(const Raw& raw);
  std::uint32_t slot_of_part(const Raw& raw, TypeIndex whole, std::size_t first, TypeIndex& part) const;
  void translate_shuffle(const Raw& raw);
  void translate_function(const Raw& raw);
  void copy(const Raw& raw, Place to, Place from, std::uint32_t n);
  static Place shifted(Place place, std::uint32_t slots) {
    return place >= 0 ? place + static_cast<Place>(slots) : place - static_cast<Place>(slots);
  }

  // translate_memory.cpp: variables, pointers, atomics, images
  void translate_image(const Raw& raw);
  void translate_variable(const Raw& raw);
  void translate_chain(const Raw& raw);
  void translate_load(const Raw& raw);
  void translate_store(const Raw& raw);
  void translate_array_length(const Raw& raw);
  void translate_atomic(const Raw& raw);
  void translate_sample(const Raw& raw);
  void translate_texel(const Raw& raw);
  void translate_query(const Raw& raw);
  void access(const Raw& raw, Code& code, const Id& pointer, TypeIndex value);
  const Id& pointer(const Raw& raw, std::size_t i) const;

  // parser.cpp: helpers for all parts
  [[noreturn]] void refuse(const Raw& raw, const std::string& sentence) const { module_.refuse(raw.file, raw.line, sentence); }
  [[noreturn]] void refuse_shape(const Raw& raw) const;
  std::uint32_t word(const Raw& raw, std::size_t i) const;
  Id& define(const Raw& raw, std::size_t i, What what);
  const Id& id(const Raw& raw, std::size_t i) const;
  TypeIndex type(const Raw& raw, std::size_t i) const;
  /// Returns a value that this function may use.
  const Id& value(const Raw& raw, std::size_t i) const;
  /// Returns the first of n slots, all of this kind.
  Place components(const Raw& raw, std::size_t i, Kind kind, std::uint32_t n) const;
  const std::uint32_t* constant(const Raw& raw, std::size_t i) const;
  std::uint32_t constant_word(const Raw& raw, std::size_t i) const;
  const Type& type_of(const Id& value) const { return module_.types[value.type]; }
  std::uint32_t decoration(std::uint32_t id, Decoration d, std::uint32_t otherwise) const;
  /// Emits an instruction with result words[1] of type words[0].
  Code& emit(const Raw& raw, Op op);
  void add_to_pool(Code& code, std::uint32_t word);

  Module& module_;
  const Specialization& specialization_;
  std::vector<std::uint32_t> words_;
  std::vector<Id> ids_;
  std::map<std::uint32_t, std::string> names_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> member_names_;
  std::map<std::uint32_t, Decorations> decorations_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Decorations> member_decorations_;
  std::vector<Body> bodies_;
  std::uint32_t entry_id_ = 0, file_ = 0, line_ = 0, source_ = 0;
  bool is_group_decorated_ = false;
  std::vector<std::uint32_t> group_ids_;
  // State of the current function.
  std::uint32_t function_ = 0;
  bool is_open_ = false;
  bool is_in_block_ = false;
  std::map<std::uint32_t, std::uint32_t> labels_;  ///< blocks
  std::uint32_t block_ = 0;
};

}  // namespace rainref::spirv
