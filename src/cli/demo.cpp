// `rainref demo`: the first verdict of a newcomer, on a port with one mistake and on the right one. rainref executes both shaders itself.
#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/path_text.h"
#include "base/read_file.h"
#include "capture/npy_write.h"
#include "capture/pack_read.h"
#include "cli/commands.h"
#include "cli/terminal.h"
#include "cli/validate_reports.h"
#include "rainref/error.h"
#include "simulation/own_scenes.h"
#include "spirv/bindings.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;

/// What is shipped in share/rainref/demo (examples/ports/demo.cmake), and written to the user's folder.
constexpr const char *scene_file = "puddle.toml", *wrong_port = "wrong", *right_port = "right", *pack_folder = "pack",
                     *page = "report.html";

/// The demo overwrites its own files and deletes none, so its folder may hold nothing else.
void require_own(const fs::path& output) {
  std::error_code error;
  const fs::file_status status = fs::status(output, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status))
    throw Error(ExitCode::usage, fmt::format("--output {}: expected a folder, found a file", path_text(output)));
  const std::set<std::string> own{scene_file, wrong_port, right_port, pack_folder, page};
  for (const auto& entry : fs::directory_iterator(output, error))
    if (const std::string name = path_text(entry.path().filename()); !own.contains(name))
      throw Error(ExitCode::usage,
                  fmt::format("--output {}: expected a new folder, or that of an earlier demo, found '{}' in it", path_text(output), name));
  if (error) throw Error(ExitCode::io, fmt::format("--output {}: {}", path_text(output), error.message()));
}

/// The shipped folder.
fs::path shipped() {
  const fs::path folder = simulation::own_data("demo");
  std::error_code none;
  for (const char* port : {wrong_port, right_port})
    if (folder.empty() || !fs::exists(folder / port / "bindings.json", none))
      throw Error(ExitCode::io,
                  "demo: the ports that it judges are not beside this program, in share/rainref/demo: a build makes them if "
                  "it finds glslangValidator (Debian: glslang-tools)");
  return folder;
}

void write(const fs::path& file, std::span<const std::byte> bytes) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) throw Error(ExitCode::io, fmt::format("cannot make '{}': {}", path_text(file.parent_path()), error.message()));
  write_file(file, bytes);
}
void copy_files(const fs::path& from, const fs::path& to) {
  for (const auto& entry : fs::directory_iterator(from)) write(to / entry.path().filename(), read_file(entry.path()));
}

/// Prints a command as a user types it. Returns it for the report.
std::string show_command(const std::vector<std::string>& words) {
  std::vector<const char*> argv{"rainref"};
  for (const std::string& word : words) argv.push_back(word.c_str());
  const std::string command = command_text(static_cast<int>(argv.size()), argv.data());
  say("$ {}\n", command);
  return command;
}

void make_pack(const fs::path& output) {
  PackOptions options;
  options.scene.scene = output / scene_file;
  options.output = output / pack_folder;
  options.frames = {24};
  options.passes = {"shade"};
  show_command({"pack", path_text(options.scene.scene), "--at", "24", "--passes", "shade", "-o", path_text(options.output)});
  pack(options);
}

/// Does what a port does: runs its shader on each case of the pack, and writes the outputs to the same places.
void run_port(const fs::path& output, const char* port) {
  const fs::path results = output / port / "out";
  const std::map<std::string, spirv::Program> programs = spirv::read_programs(output / port / "shaders");
  const capture::Pack pack(output / pack_folder);
  for (const capture::PackCase& entry : pack.cases) {
    const spirv::Program& program = programs.at(pack.pass(entry.pass).formula);
    const std::vector<capture::Array> stored =
        spirv::execute(pack.read(entry), program, spirv::read_spirv(program), "'" + path_text(program.spirv.filename()) + "'");
    for (std::size_t i = 0; i < stored.size(); ++i)
      write(results / utf8_path(entry.outputs.at(i).levels.at(0).path), capture::npy_bytes(stored[i], 0));
  }
  write_file(results / "port.json", "{\"api\": \"CPU\", \"device\": \"(rainref executed the shader itself)\", \"half_store\": \"rne\"}\n");
}

/// Returns the exit code of `validate`.
int judge(const fs::path& output, const char* port, bool writes_page) {
  ValidateRequest request;
  request.pack = output / pack_folder;
  request.port = output / port / "out";
  request.spirv = output / port / "shaders";
  std::vector<std::string> words{"validate", path_text(request.pack), "--port", path_text(request.port),
                                 "--spirv",  path_text(request.spirv)};
  if (writes_page) {
    request.reports.html = path_text(output / page);
    words.insert(words.end(), {"--html", *request.reports.html});
  }
  request.command = show_command(words);
  return validate(request);
}

}  // namespace

int demo(const fs::path& output) {
  require_own(output);
  const fs::path from = shipped();
  write(output / scene_file, read_file(from / scene_file));
  for (const char* port : {wrong_port, right_port}) copy_files(from / port, output / port / "shaders");

  say("Two ports of one pass, `shade` of the puddle, are judged here. One of them has a mistake in one line.\n"
      "This needs no GPU: rainref itself executes their shaders (SPIR-V) on the CPU. Your port runs where you run it.\n\n"
      "1. A pack holds what the pass takes and what it has to give:\n\n");
  make_pack(output);
  for (const char* port : {wrong_port, right_port}) run_port(output, port);
  say("\n2. The port with the mistake:\n\n");
  const int wrong = judge(output, wrong_port, true);
  say("\n3. The port without it:\n\n");
  const int right = judge(output, right_port, false);
  say("\nThe first verdict with pictures: {}\nThe line that was wrong:         {}\n\n", path_text(output / page),
      path_text(output / wrong_port / "shaders/shade_corrected.comp"));
  say("Next: rainref pack puddle/default.toml --size 320x180 -o out/pack   makes a pack for a port of your own;\n"
      "      docs/porting.md says how to write it and judge it, docs/any_effect.md how to judge an effect of your own.\n");
  if (wrong == static_cast<int>(ExitCode::fail) && right == static_cast<int>(ExitCode::pass)) return static_cast<int>(ExitCode::pass);
  say("These are not the verdicts that were expected, FAIL and PASS.\n");
  return static_cast<int>(ExitCode::fail);
}

}  // namespace rainref::cli
