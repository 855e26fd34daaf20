// port_runner: runs a port's compute shaders on the cases of a pack and leaves the outputs where `rainref validate`
// looks for them. It knows the pack format and nothing else of rainref.
#include <algorithm>
#include <cstdio>
#include <exception>

#include <nlohmann/json.hpp>

#include "ports/runner/dispatch.h"

namespace port_runner {
namespace {

constexpr const char* usage =
    "usage: port_runner --pack DIR --spirv DIR --out DIR [--only PASS] [--device N|cpu] [--spec ID=VALUE]... [--repeat N] [--time "
    "SECONDS]\n"
    "       port_runner --list\n";
constexpr const char* help =
    "Runs a port's compute shaders on the cases of a pack, and leaves the outputs where `rainref validate` looks for them.\n"
    "\n"
    "  --pack DIR       the pack, as `rainref pack` writes it\n"
    "  --spirv DIR      the shaders: bindings.json, and the SPIR-V that it names\n"
    "  --out DIR        where the outputs and port.json go\n"
    "  --only PASS      this pass alone\n"
    "  --device N|cpu   a number of --list, or the software device (default: the first GPU, else the software device)\n"
    "  --spec ID=VALUE  sets a specialization constant\n"
    "  --repeat N       runs each case N times and fails when two runs differ\n"
    "  --time SECONDS   also runs each case that gives images for so long, and leaves the seconds of each dispatch in times.json\n"
    "  --list           the devices that can compute\n"
    "  --help           this text\n"
    "\n"
    "Exit codes: 0 every case ran; 1 one did not, or two runs of it differ; 2 a wrong option; 3 bindings.json, a shader or\n"
    "a file of the pack is missing or malformed.\n";

struct Options {
  fs::path pack, spirv, out;
  std::string only, device;
  Constants constants;
  int repeat = 1;
  double time = 0;
  bool list = false, help = false;
};
std::int32_t number(const std::string& option, const std::string& text) {
  std::size_t used = 0;
  int value = 0;
  try {
    value = std::stoi(text, &used);
  } catch (const std::exception&) {
  }
  if (used == 0 || used != text.size()) throw UsageError(option + ": expected a whole number, found '" + text + "'");
  return value;
}
Options parse(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--list") {
      o.list = true;
      continue;
    }
    if (option == "--help" || option == "-h") {
      o.help = true;
      return o;
    }
    const std::vector<std::string> known{"--pack", "--spirv",  "--out",  "--only", "--device",
                                         "--spec", "--repeat", "--time", "--list", "--help"};
    if (std::find(known.begin(), known.end(), option) == known.end())
      throw UsageError(option + ": unknown" + did_you_mean(option, known) + "\n" + usage);
    if (i + 1 == argc) throw UsageError(option + ": expected a value\n" + usage);
    const std::string text = argv[++i];
    if (option == "--pack") {
      o.pack = text;
    } else if (option == "--spirv") {
      o.spirv = text;
    } else if (option == "--out") {
      o.out = text;
    } else if (option == "--only") {
      o.only = text;
    } else if (option == "--device") {
      o.device = text;
    } else if (option == "--repeat") {
      o.repeat = number(option, text);
    } else if (option == "--time") {
      o.time = number(option, text);
      if (o.time < 1) throw UsageError("--time: expected at least 1 second, found '" + text + "'");
    } else {
      const std::size_t equals = text.find('=');
      if (equals == std::string::npos) throw UsageError("--spec: expected ID=VALUE, found '" + text + "'");
      o.constants[static_cast<std::uint32_t>(number(option, text.substr(0, equals)))] = number(option, text.substr(equals + 1));
    }
  }
  if (!o.list && (o.pack.empty() || o.spirv.empty() || o.out.empty()))
    throw UsageError(std::string("expected --pack, --spirv and --out\n") + usage);
  if (o.repeat < 1) throw UsageError("--repeat: expected at least 1");
  return o;
}

void write_port_json(const Device& device, const fs::path& out) {
  // Nothing is claimed of the device's stores and arithmetic; who judges must find out.
  const nlohmann::ordered_json info{{"api", "Vulkan"},
                                    {"device", device.name()},
                                    {"driver", device.driver()},
                                    {"half_store", "unknown"},
                                    {"origin", "top-left"},
                                    {"precise", false},
                                    {"notes", "port_runner; compute shaders compiled by glslang"}};
  write_file(out / "port.json", info.dump(2) + "\n");
}

int run(const Options& o) {
  const Pack pack = read_pack(o.pack);
  const auto programs = read_programs(o.spirv);
  const Device device(o.device);
  nlohmann::ordered_json times = nlohmann::ordered_json::array();
  int ran = 0;
  std::string without;
  for (const Case& c : pack.cases) {
    if (!o.only.empty() && c.pass != o.only) continue;
    const auto program = programs.find(c.formula);
    if (program == programs.end()) {
      if (without.find(c.formula) == std::string::npos) without += " " + c.formula;
      continue;
    }
    check_program(o.spirv, program->second, c);
    const std::vector<Array> outputs = run_case(device, pack, c, program->second, o.constants);
    for (int again = 1; again < o.repeat; ++again) {
      const std::vector<Array> other = run_case(device, pack, c, program->second, o.constants);
      for (std::size_t i = 0; i < outputs.size(); ++i) {
        if (outputs[i].shape == other[i].shape && outputs[i].bytes == other[i].bytes) continue;
        throw Error(c.id + ": run 1 and run " + std::to_string(again + 1) + " differ in " + program->second.outputs[i]);
      }
    }
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      const std::string& name = program->second.outputs[i];
      for (const Buffer& b : c.outputs) {
        if (b.name == name) write_npy(o.out / b.file, outputs[i]);
      }
    }
    const bool gives_images = std::none_of(c.outputs.begin(), c.outputs.end(), [](const Buffer& b) { return b.is_records; });
    if (o.time > 0 && gives_images) {
      const Level& size = c.outputs.at(0).levels.at(0);
      times.push_back({{"case", c.id},
                       {"formula", c.formula},
                       {"width", size.width},
                       {"height", size.height},
                       {"seconds", time_case(device, pack, c, program->second, o.constants, o.time)}});
    }
    ++ran;
  }
  if (!without.empty()) std::fprintf(stderr, "no program for%s\n", without.c_str());
  if (ran == 0 && o.only.empty()) throw FileError((o.spirv / "bindings.json").string() + ": no case of this pack has a program");
  if (ran == 0) {
    std::vector<std::string> passes;
    for (const Case& c : pack.cases) passes.push_back(c.pass);
    throw UsageError("--only " + o.only + ": no case of this pass has a program" + did_you_mean(o.only, passes));
  }
  write_port_json(device, o.out);
  if (o.time > 0) write_file(o.out / "times.json", times.dump(2) + "\n");
  std::printf("%d cases on %s, in %s\n", ran, device.name().c_str(), o.out.c_str());
  return 0;
}

}  // namespace
}  // namespace port_runner

int main(int argc, char** argv) try {
  const port_runner::Options options = port_runner::parse(argc, argv);
  if (options.help) {
    std::printf("%s%s", port_runner::usage, port_runner::help);
    return 0;
  }
  if (!options.list) return port_runner::run(options);
  for (const std::string& line : port_runner::Device::list()) std::printf("%s\n", line.c_str());
  return 0;
} catch (const port_runner::UsageError& e) {
  std::fprintf(stderr, "port_runner: %s\n", e.what());
  return 2;
} catch (const port_runner::FileError& e) {
  std::fprintf(stderr, "port_runner: %s\n", e.what());
  return 3;
} catch (const port_runner::Error& e) {
  std::fprintf(stderr, "port_runner: %s\n", e.what());
  return 1;
}
