// null_dumps PACK OUT: the dumps of ports that compute nothing, each in a folder of OUT. zeros, and copies0, copies1, ...: the null ports
// of the judge (a case with fewer inputs to copy copies the last one, and one without any stores zeros). constant: the middle of each
// output's declared range everywhere. noise: numbers of that range. Records with ids and outputs that are judged by bits get constant or
// random bytes. scripts/full/verdicts judges them: each must fail.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/words.h"
#include "capture/npy_write.h"
#include "capture/pack_read.h"
#include "judge/null_ports.h"
#include "judge/slots.h"

namespace {

using namespace rainref;
using capture::Array;

void put(const std::filesystem::path& run, const capture::PassCase& c, const std::vector<Array>& outputs) {
  std::filesystem::create_directories(run);
  for (std::size_t o = 0; o < outputs.size(); ++o)
    for (std::size_t l = 0; l < outputs[o].levels.size(); ++l) {
      const std::vector<std::byte> bytes = capture::npy_bytes(outputs[o], static_cast<int>(l));
      const std::string level = l == 0 ? "" : ".L" + std::to_string(l);
      std::ofstream file(run / ("out." + c.outputs[o].name + level + ".npy"), std::ios::binary);
      file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
      if (!file.flush()) throw std::runtime_error("cannot write " + run.string());
    }
}

/// What a port stores that draws each number by `share()`, from 0 to 1.
template <class Share>
std::vector<Array> blind(const capture::PassCase& c, const Share& share) {
  std::vector<Array> outputs;
  for (const capture::CaseOutput& o : c.outputs) {
    Array& out = outputs.emplace_back(o.array);
    for (capture::Bytes& level : out.levels)
      for (std::byte& b : level.edit()) b = static_cast<std::byte>(255 * share());
  }
  for (const judge::Slot& s : judge::slots_of(c)) {
    const capture::CaseOutput& o = c.outputs[static_cast<std::size_t>(s.output)];
    std::byte* const bytes = outputs[static_cast<std::size_t>(s.output)].levels[0].edit().data();
    for (int y = 0; y < o.array.height; ++y)
      for (int x = 0; x < o.array.width; ++x)
        judge::store_value(s, static_cast<float>(o.range[0] + share() * (o.range[1] - o.range[0])), s.store_rounding,
                           bytes + s.offset(x, y));
  }
  return outputs;
}

void write_dumps(const std::filesystem::path& folder, const std::filesystem::path& out) {
  const capture::Pack pack(folder);
  std::vector<capture::PassCase> cases;
  std::vector<std::vector<judge::NullPort>> null_ports;
  std::size_t most = 0;
  for (const capture::PackCase& entry : pack.cases) {
    cases.push_back(pack.read(entry));
    null_ports.push_back(judge::null_ports(cases.back()));
    most = std::max(most, null_ports.back().size());
  }
  rainref::test::Words words(1);
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const capture::PassCase& c = cases[k];
    put(out / "zeros" / c.folder(), c, null_ports[k].front().outputs);
    for (std::size_t copy = 1; copy < most; ++copy)
      put(out / ("copies" + std::to_string(copy - 1)) / c.folder(), c, null_ports[k][std::min(copy, null_ports[k].size() - 1)].outputs);
    put(out / "constant" / c.folder(), c, blind(c, [] { return 0.5; }));
    put(out / "noise" / c.folder(), c, blind(c, [&] { return static_cast<double>(words() >> 11) * 0x1p-53; }));
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) {
    std::fprintf(stderr, "usage: null_dumps PACK OUT\n");
    return 2;
  }
  try {
    write_dumps(arguments[1], arguments[2]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "null_dumps: %s\n", e.what());
    return 3;
  }
  return 0;
}
