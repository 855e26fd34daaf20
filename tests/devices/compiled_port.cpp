// A port of every pass that has a definition, made by the compiler that this file is given to, with whatever flags: usage
//   compiled_port PACK OUT
// The passes' texts are rainref's, the arithmetic is the compiler's (compiled.h). What they store is judged by the program.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "capture/npy_write.h"
#include "capture/pack_read.h"
#include "devices/compiled.h"
#include "devices/defined_passes.h"
#include "drops/motion/scalar.h"
#include "drops/records.h"
#include "judge/slots.h"
#include "rainref/error.h"

namespace rainref::devices {
namespace {

using capture::Array;
using capture::PassCase;

bool run(const PassCase& c, std::vector<Array>& out) {
  return with_defined_pass(c, [&](const auto& pass) {
    const std::vector<judge::Slot> slots = judge::slots_of(c);
    std::vector<Compiled> values(static_cast<std::size_t>(pass.values));
    for (int y = 0; y < pass.height; ++y)
      for (int x = 0; x < pass.width; ++x) {
        pass(x, y, values.data());
        for (std::size_t v = 0; v < slots.size(); ++v)
          store_value(slots[v], values[v].v, slots[v].store_rounding,
                      out[static_cast<std::size_t>(slots[v].output)].levels[0].data() + slots[v].offset(x, y));
      }
  });
}

bool integrate_as_published(const PassCase& c, std::vector<Array>& out) {
  if (c.corrected() || c.pass != "integrate") return false;
  const auto u = capture::uniforms_of<drops::IntegrateUniforms>(c);
  const auto glass = capture::records_of<drops::GlassFrame>(capture::record_input(c, "glass_frame")).front();
  std::vector<drops::Drop> moved;
  for (drops::Drop d : capture::records_of<drops::Drop>(capture::record_input(c, "drops"))) {
    drops::scalar::DropState<Compiled> s = drops::state_of<Compiled>(d);
    s = drops::scalar::integrate_as_published<Compiled>(u, glass, s);
    if (!(s.life.v > 0)) continue;
    d.position[0] = s.u.v;
    d.position[1] = s.v.v;
    d.velocity[0] = s.velocity_u.v;
    d.velocity[1] = s.velocity_v.v;
    d.life = s.life.v;
    moved.push_back(d);
  }
  const auto* bytes = reinterpret_cast<const std::byte*>(moved.data());
  out[0].width = static_cast<int>(moved.size());
  out[0].levels = {{bytes, bytes + moved.size() * sizeof(drops::Drop)}};
  return true;
}

void put(const std::filesystem::path& path, const Array& array, int level) {
  const auto bytes = capture::npy_bytes(array, level);
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

int port(const char* pack_folder, const char* out_folder) {
  const capture::Pack pack(pack_folder);
  int computed = 0, differing = 0;
  for (const capture::PackCase& entry : pack.cases) {
    const PassCase c = pack.read(entry);
    std::vector<Array> out;
    for (const capture::CaseOutput& o : c.outputs) out.push_back(o.array);
    if (run(c, out) || integrate_as_published(c, out)) {
      ++computed;
      for (std::size_t o = 0; o < out.size(); ++o) differing += out[o].levels != c.outputs[o].array.levels;
    }
    const std::filesystem::path folder = std::filesystem::path(out_folder) / c.folder();
    std::filesystem::create_directories(folder);
    for (std::size_t o = 0; o < out.size(); ++o)
      for (std::size_t l = 0; l < out[o].levels.size(); ++l)
        put(folder / ("out." + c.outputs[o].name + (l == 0 ? "" : ".L" + std::to_string(l)) + ".npy"), out[o], static_cast<int>(l));
  }
  std::printf("%d runs computed, %d outputs differ from the reference's bits\n", computed, differing);
  return 0;
}

}  // namespace
}  // namespace rainref::devices

int main(int count, char** arguments) {
  if (count != 3) {
    std::fprintf(stderr, "usage: compiled_port PACK OUT\n");
    return 2;
  }
  try {
    return rainref::devices::port(arguments[1], arguments[2]);
  } catch (const rainref::Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
