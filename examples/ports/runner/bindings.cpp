#include "ports/runner/bindings.h"

#include <algorithm>

#include "ports/runner/json_file.h"
#include "ports/runner/programs_json.h"

namespace port_runner {

std::map<std::string, Program> read_programs(const fs::path& folder) { return programs_of(parse_json(folder / "bindings.json"), folder); }

void check_program(const fs::path& folder, const Program& program, const Case& of) {
  const std::string where = (folder / "bindings.json").string() + ": programs / " + of.formula + " / ";
  if (!fs::is_regular_file(program.spirv)) throw FileError(where + "spirv: no such file: " + program.spirv.string());
  const auto check = [&](const char* key, const std::vector<std::string>& bound, const std::vector<std::string>& known) {
    for (const std::string& name : bound) {
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      throw FileError(where + key + ": expected what the pass " + (key[0] == 'i' ? "reads" : "writes") + ", " + joined(known) +
                      ", found '" + name + "'" + did_you_mean(name, known));
    }
  };
  check("inputs", program.inputs, of.reads);
  check("outputs", program.outputs, of.writes);
  const auto is_records = [&](const std::string& name) {
    return std::any_of(of.outputs.begin(), of.outputs.end(), [&](const Buffer& b) { return b.name == name && b.is_records; });
  };
  for (const std::string& name : program.outputs) {
    if (is_records(name) && program.capacity == 0)
      throw FileError(where + "capacity: expected a number of records for the output " + name + ", found none");
  }
  if (!program.one_group && is_records(program.outputs[0]))
    throw FileError(where + "one_group: expected true, because the first output, " + program.outputs[0] + ", is no image");
}

std::int32_t value(const Fact& fact, const Case& of) {
  const auto input = std::find_if(of.inputs.begin(), of.inputs.end(), [&](const Buffer& b) { return b.name == fact.input; });
  if (fact.key == "present") return input == of.inputs.end() ? 0 : 1;
  if (input == of.inputs.end()) throw Error(of.id + ": no input " + fact.input + " to take " + fact.key + " from");
  const std::string& address = fact.key == "address_u" ? input->address_u : input->address_v;
  const std::int32_t number = address_number(address);
  if (number < 0) throw Error(of.id + ": input " + fact.input + ": " + fact.key + " " + address + " is no constant");
  return number;
}

}  // namespace port_runner
