// port_mutants: what the seeded bugs of tests/ports/mutants do to the outputs, and what the judge says of each.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <map>
#include <set>
#include <thread>

#include "ports/mutant_sources.h"
#include "ports/runner/dispatch.h"

namespace port_runner {
namespace {

constexpr const char* usage =
    "usage: port_mutants --mutants FILE --ports DIR --spirv DIR --packs DIR [--glslang PROGRAM] [--device N|cpu] [--ids ID,ID...]\n"
    "                    [--rainref PROGRAM --out DIR]\n"
    "Edits the shaders of --ports (examples/ports) as each mutant says, and compares what they give with what those of --spirv\n"
    "give, which are the same without the edits, compiled. Prints for each mutant how many elements it changes and by how many\n"
    "storage codes at most: exit 1 when one that is expected to be equivalent changes a bit, or one below a storage ULP more\n"
    "than a code. With --rainref each is judged, too: exit 1 when a verdict is not the expected one.\n";

/// What a mutant changes against the port as it is meant.
struct Change {
  std::size_t elements = 0, changed = 0;
  std::int64_t largest = 0;  ///< storage codes; of an element that only one of the two has: more than any
};

// Codes of a format in the order of their values; both zeros are 0.
std::int64_t ordered(const std::uint8_t* at, std::size_t bytes, bool is_float) {
  std::uint32_t code = 0;
  std::memcpy(&code, at, bytes);
  const std::uint32_t sign = is_float ? 1u << (8 * bytes - 1) : 0;
  return code & sign ? -static_cast<std::int64_t>(code & (sign - 1)) : code;
}
void compare(const Array& meant, const Array& mutated, Change& change) {
  const bool is_records = meant.type[0] == '[',
             is_float = is_records || meant.type[2] == 'f';  // whole numbers of records keep their order as well
  const std::size_t bytes = is_records || meant.type[3] == '4' ? 4 : meant.type[3] == '2' ? 2 : 1;
  const std::size_t common = std::min(meant.bytes.size(), mutated.bytes.size()), all = std::max(meant.bytes.size(), mutated.bytes.size());
  for (std::size_t at = 0; at < all; at += bytes) {
    ++change.elements;
    const bool is_same = at < common && std::memcmp(&meant.bytes[at], &mutated.bytes[at], bytes) == 0;
    change.changed += !is_same;
    const std::int64_t distance = at < common
                                      ? std::abs(ordered(&meant.bytes[at], bytes, is_float) - ordered(&mutated.bytes[at], bytes, is_float))
                                      : std::int64_t{1} << 32;
    change.largest = std::max(change.largest, distance);
  }
}
/// Whether the outputs are what a mutant's label says of them; the others say what the judge finds.
bool is_true(const std::string& expected, const Change& change) {
  if (expected == "equivalent") return change.changed == 0;
  return expected != "below-storage-ulp" || change.largest <= 1;
}

/// A mutant, the program of its pass as it is meant, and as the edits make it.
struct Made {
  Mutant mutant;
  Program meant, mutated;
};
/// Compiles each mutant, on all cores. Throws the first Error.
std::vector<Made> compile(const std::vector<Mutant>& mutants, const Compiler& compiler, const fs::path& spirv) {
  std::vector<Made> all;
  for (const Mutant& m : mutants) {
    const auto programs = read_programs(spirv / m.effect);
    const std::string formula = m.effect + "." + m.pass + "." + m.variant + "/";
    const auto program = programs.lower_bound(formula);
    if (program == programs.end() || !program->first.starts_with(formula))
      throw Error("mutant " + std::to_string(m.id) + ": no program for " + formula);
    all.push_back({m, program->second, program->second});
  }
  std::atomic<std::size_t> next{0};
  std::vector<std::string> failed(all.size());
  const auto work = [&] {
    for (std::size_t i = next++; i < all.size(); i = next++) {
      try {
        fs::path shader = all[i].meant.spirv.lexically_normal().lexically_relative(spirv.lexically_normal());
        const std::string name = "mutant-" + std::to_string(all[i].mutant.id) + "-" + std::to_string(i);
        all[i].mutated.spirv = compiler.compile(shader.replace_extension("comp").string(), all[i].mutant, name);
      } catch (const std::exception& e) {
        failed[i] = e.what();
      }
    }
  };
  std::vector<std::jthread> workers;
  for (unsigned k = 1; k < std::thread::hardware_concurrency(); ++k) workers.emplace_back(work);
  work();
  workers.clear();
  for (const std::string& error : failed)
    if (!error.empty()) throw Error(error);
  return all;
}

struct Port {
  Pack pack;
  std::map<std::string, std::vector<Array>> meant;  ///< by case: the outputs without a bug
};
class Judge {
 public:
  Judge(std::string program, fs::path out) : program_(std::move(program)), out_(std::move(out)) {}
  bool is_asked() const { return !program_.empty(); }
  /// The verdict on the outputs under out(): the first word of the last line, PASS, WARN, FAIL or UNTESTED; "ERROR" for
  /// anything else, a crash included.
  std::string ask(const fs::path& pack, const std::string& pass, const std::string& profile) const {
    const std::string command = "'" + program_ + "' validate '" + pack.string() + "' --port '" + out_.string() + "' --only " + pass +
                                " --no-causes --profile " + profile + " >'" + (out_ / "verdict.txt").string() + "' 2>&1";
    const int status = std::system(command.c_str());
    const std::vector<std::uint8_t> bytes = read_file(out_ / "verdict.txt");
    std::string text(bytes.begin(), bytes.end());
    while (text.ends_with('\n')) text.pop_back();
    const std::size_t line = text.rfind('\n') + 1, colon = text.find(':', line);
    const std::string word = colon == std::string::npos ? "" : text.substr(line, colon - line);
    const bool is_good = word == "PASS" || word == "WARN", is_bad = word == "FAIL" || word == "UNTESTED";
    return (is_good && status == 0) || (is_bad && status == 1 << 8) ? word : "ERROR";
  }
  const fs::path& out() const { return out_; }

 private:
  std::string program_;
  fs::path out_;
};
// What the judge may say of a mutant: FAIL, or nothing against a change that a conforming device may make as well. A pass
// that the profile cannot bound is UNTESTED whatever the port does.
bool agrees(const std::string& verdict, const std::string& expected) {
  if (expected == "FAIL" || expected == "UNTESTED") return verdict == expected;
  if (expected == "inside-rearrangements") return verdict == "WARN";
  return verdict == "PASS" || verdict == "WARN";
}

int run(const std::map<std::string, std::string>& options) {
  const auto option = [&](const std::string& key) { return options.contains(key) ? options.at(key) : std::string(); };
  if (option("--mutants").empty() || option("--packs").empty() || option("--ports").empty() || option("--spirv").empty())
    throw Error(usage);
  std::vector<Mutant> mutants = read_mutants(option("--mutants"));
  const Device device(option("--device"));
  const Judge judge(option("--rainref"), option("--out"));
  if (judge.is_asked() && judge.out().empty()) throw Error("--out: expected a folder, for the judge\n" + std::string(usage));
  std::set<std::string> wanted;
  for (std::string ids = option("--ids"); !ids.empty();) {
    const std::size_t comma = std::min(ids.find(','), ids.size());
    wanted.insert(ids.substr(0, comma));
    ids.erase(0, comma + 1);
  }
  std::erase_if(mutants, [&](const Mutant& m) { return !wanted.empty() && !wanted.contains(std::to_string(m.id)); });
  const fs::path spirv = option("--spirv");
  const Compiler compiler(option("--glslang").empty() ? "glslangValidator" : option("--glslang"), option("--ports"));

  std::map<std::string, Port> ports;
  int wrong_verdicts = 0, wrong_labels = 0, small = 0, judged = 0;
  std::printf("%4s %-12s %-13s %9s %9s  %s%s\n", "id", "pass", "variant", "changed", "codes", judge.is_asked() ? "verdict   " : "",
              "expected");
  for (const Made& made : compile(mutants, compiler, spirv)) {
    const Mutant& m = made.mutant;
    Port& port = ports.try_emplace(m.pack).first->second;
    if (port.pack.cases.empty()) port.pack = read_pack(fs::path(option("--packs")) / m.pack);
    Change change;
    for (const Case& c : port.pack.cases) {
      if (c.pass != m.pass) continue;
      auto& meant = port.meant[c.id];
      if (meant.empty()) meant = run_case(device, port.pack, c, made.meant, {});
      const std::vector<Array> outputs = run_case(device, port.pack, c, made.mutated, {});
      for (std::size_t i = 0; i < outputs.size(); ++i) {
        compare(meant[i], outputs[i], change);
        if (!judge.is_asked()) continue;
        const std::string& name = made.meant.outputs[i];
        const auto buffer = std::find_if(c.outputs.begin(), c.outputs.end(), [&](const Buffer& b) { return b.name == name; });
        write_npy(judge.out() / buffer->file, outputs[i]);
      }
    }
    if (change.elements == 0) throw Error("mutant " + std::to_string(m.id) + ": the pack has no case of " + m.pass);
    small += change.largest < 8;
    ++judged;
    const bool has_true_label = is_true(m.expected, change);
    wrong_labels += !has_true_label;
    std::string verdict, ieee;
    if (judge.is_asked()) {
      verdict = judge.ask(port.pack.folder, m.pass, "vulkan");
      const bool is_expected = agrees(verdict, m.expected);
      wrong_verdicts += !is_expected;
      verdict += is_expected ? "" : "!";
      verdict.resize(10, ' ');
      // What no conforming device could be blamed for is bits that differ, or none: PASS under ieee means the reference's own.
      if (m.expected != "FAIL") ieee = ", under ieee " + judge.ask(port.pack.folder, m.pass, "ieee");
    }
    const double share = static_cast<double>(change.changed) / static_cast<double>(change.elements);
    std::printf("%4d %-12s %-13s %8.2f%% %9lld  %s%-17s %s\n", m.id, m.pass.c_str(), m.variant.c_str(), 100 * share,
                static_cast<long long>(change.largest), verdict.c_str(), (m.expected + (has_true_label ? "" : "?") + ieee).c_str(),
                m.wrong.c_str());
    std::fflush(stdout);
  }
  std::printf("%d mutants, %d of them change no element by 8 codes or more\n", judged, small);
  if (wrong_verdicts > 0) std::printf("%d verdicts are not the expected ones (!)\n", wrong_verdicts);
  if (wrong_labels > 0) std::printf("%d outputs are not what their label says (?)\n", wrong_labels);
  return wrong_verdicts > 0 || wrong_labels > 0 || judged == 0 ? 1 : 0;
}

}  // namespace
}  // namespace port_runner

int main(int argc, char** argv) try {
  std::map<std::string, std::string> options;
  const std::set<std::string> known{"--mutants", "--ports", "--spirv", "--packs", "--glslang", "--device", "--ids", "--rainref", "--out"};
  for (int i = 1; i < argc; i += 2) {
    if (i + 1 == argc || !known.contains(argv[i]))
      throw port_runner::Error(std::string(argv[i]) + ": unknown, or without its value\n" + port_runner::usage);
    options[argv[i]] = argv[i + 1];
  }
  return port_runner::run(options);
} catch (const port_runner::Error& e) {
  std::fprintf(stderr, "port_mutants: %s\n", e.what());
  return 2;
}
