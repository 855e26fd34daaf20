// Reads the seeded bugs, makes their edits, and compiles the shaders.
#include "ports/mutant_sources.h"

#include <stdlib.h>

#include <cstdlib>

#include "ports/runner/json_file.h"

namespace port_runner {
namespace {

std::string text_of(const fs::path& file) {
  const std::vector<std::uint8_t> bytes = read_file(file);
  return {bytes.begin(), bytes.end()};
}
std::size_t occurrences(const std::string& text, const std::string& of) {
  std::size_t count = 0;
  for (std::size_t at = text.find(of); at != std::string::npos; at = text.find(of, at + 1)) ++count;
  return count;
}

}  // namespace

std::vector<Mutant> read_mutants(const fs::path& file) {
  const nlohmann::json all = parse_json(file);
  std::vector<Mutant> mutants;
  try {
    const std::string effect = all.at("effect");
    for (const nlohmann::json& m : all.at("mutants")) {
      Mutant mutant{m.at("id"), effect, m.at("pass"), m.at("variant"), m.at("wrong"), m.at("expected"), "", {}};
      mutant.pack = m.value("pack", effect + "-" + mutant.variant);
      for (const nlohmann::json& e : m.at("edits")) mutant.edits.push_back({e.at("file"), e.at("find"), e.at("replace")});
      if (mutant.edits.empty()) throw FileError(file.string() + ": mutant " + std::to_string(mutant.id) + " has no edits");
      mutants.push_back(std::move(mutant));
    }
  } catch (const nlohmann::json::exception& e) {
    throw FileError(file.string() + ": mutant " + std::to_string(mutants.size()) + " of the list: " + reason(e));
  }
  return mutants;
}

std::map<std::string, std::string> edited_files(const Mutant& mutant, const fs::path& ports) {
  std::map<std::string, std::string> files;
  for (const Edit& edit : mutant.edits) {
    std::string& text = files[edit.file];
    if (text.empty()) text = text_of(ports / edit.file);
    const std::size_t count = edit.find.empty() ? 0 : occurrences(text, edit.find);
    if (count != 1) {
      throw FileError((ports / edit.file).string() + ": mutant " + std::to_string(mutant.id) + ": expected '" + edit.find +
                      "' once, found it " + std::to_string(count) + " times");
    }
    text.replace(text.find(edit.find), edit.find.size(), edit.replace);
  }
  return files;
}

Compiler::Compiler(std::string glslang, fs::path ports) : glslang_(std::move(glslang)), ports_(std::move(ports)) {
  std::string name = (fs::temp_directory_path() / "port_mutants-XXXXXX").string();
  if (!::mkdtemp(name.data())) throw Error(name + ": cannot be made");
  folder_ = name;
}
Compiler::~Compiler() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

fs::path Compiler::compile(const std::string& shader, const Mutant& mutant, const std::string& name) const {
  // An include is looked for beside the file that names it first, so a whole copy of the folder stands around the edited files.
  const fs::path folder = folder_ / name, effect = fs::path(shader).parent_path();
  for (const fs::path& part : {effect, fs::path("common")}) {
    fs::create_directories(folder / part);
    for (const auto& source : fs::directory_iterator(ports_ / part)) {
      if (source.path().extension() == ".glsl") fs::copy_file(source.path(), folder / part / source.path().filename());
    }
  }
  fs::copy_file(ports_ / shader, folder / shader);
  for (const auto& [file, text] : edited_files(mutant, ports_)) write_file(folder / file, text);
  const fs::path spirv = folder / "program.spv", log = folder / "log";
  const std::string command = "'" + glslang_ + "' -V --target-env vulkan1.1 --quiet '-I" + (folder / "common").string() + "' '" +
                              (folder / shader).string() + "' -o '" + spirv.string() + "' >'" + log.string() + "' 2>&1";
  if (std::system(command.c_str()) != 0) throw Error(name + ": " + shader + " does not compile:\n" + text_of(log));
  return spirv;
}

}  // namespace port_runner
