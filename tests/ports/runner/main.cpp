// port_runner: runs a port's compute shaders on the cases of a pack and leaves the outputs where `rainref validate`
// looks for them. It knows the pack format and nothing else of rainref.
#include <cstdio>
#include <exception>

#include <nlohmann/json.hpp>

#include "ports/runner/dispatch.h"

namespace port_runner {
namespace {

constexpr const char* usage =
    "usage: port_runner --pack DIR --spirv DIR --out DIR [--only PASS] [--device N|cpu] [--spec ID=VALUE]... [--repeat N]\n"
    "       port_runner --list\n"
    "Runs the shaders of --spirv (with bindings.json) on every case of the pack. --spec sets a specialization constant,\n"
    "--repeat runs each case N times and fails when two runs differ.\n";

struct Options {
  fs::path pack, spirv, out;
  std::string only, device;
  Constants constants;
  int repeat = 1;
  bool list = false;
};
std::int32_t number(const std::string& option, const std::string& text) {
  std::size_t used = 0;
  int value = 0;
  try {
    value = std::stoi(text, &used);
  } catch (const std::exception&) {
  }
  if (used == 0 || used != text.size()) throw Error(option + ": expected a whole number, found '" + text + "'");
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
    if (i + 1 == argc) throw Error(option + ": unknown, or without its value\n" + usage);
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
    } else if (option == "--spec") {
      const std::size_t equals = text.find('=');
      if (equals == std::string::npos) throw Error("--spec: expected ID=VALUE, found '" + text + "'");
      o.constants[static_cast<std::uint32_t>(number(option, text.substr(0, equals)))] = number(option, text.substr(equals + 1));
    } else {
      throw Error(option + ": unknown\n" + usage);
    }
  }
  if (!o.list && (o.pack.empty() || o.spirv.empty() || o.out.empty())) throw Error(usage);
  if (o.repeat < 1) throw Error("--repeat: expected at least 1");
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
  int ran = 0;
  std::string without;
  for (const Case& c : pack.cases) {
    if (!o.only.empty() && c.pass != o.only) continue;
    const auto program = programs.find(c.formula);
    if (program == programs.end()) {
      if (without.find(c.formula) == std::string::npos) without += " " + c.formula;
      continue;
    }
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
    ++ran;
  }
  if (!without.empty()) std::fprintf(stderr, "no program for%s\n", without.c_str());
  if (ran == 0)
    throw Error(o.only.empty() ? "no case of this pack has a program" : "--only " + o.only + ": no case of this pass has a program");
  write_port_json(device, o.out);
  std::printf("%d cases on %s, in %s\n", ran, device.name().c_str(), o.out.c_str());
  return 0;
}

}  // namespace
}  // namespace port_runner

int main(int argc, char** argv) try {
  const port_runner::Options options = port_runner::parse(argc, argv);
  if (!options.list) return port_runner::run(options);
  for (const std::string& line : port_runner::Device::list()) std::printf("%s\n", line.c_str());
  return 0;
} catch (const port_runner::Error& e) {
  std::fprintf(stderr, "port_runner: %s\n", e.what());
  return 1;
}
