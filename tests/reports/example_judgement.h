// A judgement with something of everything, made by hand, and ports made from the small packs.
#pragma once

#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/temporary_folder.h"
#include "capture/pack_read.h"
#include "judge/verdict.h"
#include "shipped_packs.h"

namespace rainref::reports {

inline judge::OutputJudgement example_output(const std::string& name, Format format, int width, int height) {
  judge::OutputJudgement o;
  o.name = name;
  o.format = format;
  o.width = width;
  o.height = height;
  o.elements = static_cast<std::int64_t>(width) * height * info(format).channels;
  o.map.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  return o;
}
inline judge::CaseJudgement example_case(const std::string& id, judge::Status status, judge::OutputJudgement o) {
  judge::CaseJudgement c;
  c.id = id;
  c.status = status;
  c.invocations = static_cast<std::int64_t>(o.map.size());
  c.outputs.push_back(std::move(o));
  return c;
}
inline judge::PassJudgement example_pass(const std::string& name, judge::Status status, std::vector<judge::CaseJudgement> cases) {
  judge::PassJudgement p;
  p.pass = name;
  p.formula = "rain." + name + "/1";
  p.status = status;
  p.cases = std::move(cases);
  return p;
}

/// `wave` passes, `hit` warns, `noise` could not be judged, `shade` fails: an element that is wrong by 3 codes and one
/// that is not a number, four more that are not kept.
inline judge::PortJudgement example_judgement() {
  judge::PortJudgement j;
  j.pack = "pack";
  j.port = "port";
  j.profile = "vulkan";
  j.effect = "rain";
  j.variant = "corrected";
  j.scene = "scene.toml";
  j.api = "Vulkan 1.3";
  j.device = "Test & <Device>";
  j.command = "rainref validate pack --port port";
  j.status = judge::Status::fail;
  j.first_bad_pass = "shade";
  j.passes.push_back(example_pass("wave", judge::Status::pass,
                                  {example_case("rain.wave/0000.0", judge::Status::pass, example_output("height", Format::r16f, 4, 2))}));

  judge::OutputJudgement hit = example_output("hit", Format::r32f, 4, 2);
  hit.atypical = 2;
  hit.differing = 3;
  hit.median_width = 7;
  hit.p99_width = 4e9;
  hit.vacuous = 1;
  hit.loose = 2;
  hit.map = {0, 2, 2, 0, 0, 0, 0, 1};
  judge::CaseJudgement warned = example_case("rain.hit/0000.0", judge::Status::warn, hit);
  warned.reason = "2 elements lie inside the profile but outside what known devices do";
  warned.ambiguous = 4;
  warned.other_branch = 1;
  j.passes.push_back(example_pass("hit", judge::Status::warn, {warned}));
  j.passes.back().reason = warned.reason;

  judge::CaseJudgement open = example_case("rain.noise/0000.0", judge::Status::untested, example_output("noise", Format::r8, 4, 2));
  open.reason = "100 % of the elements have no useful bound";
  open.outputs[0].vacuous = open.outputs[0].elements;
  j.passes.push_back(example_pass("noise", judge::Status::untested, {open}));
  j.passes.back().reason = open.reason;

  judge::OutputJudgement colour = example_output("colour", Format::rgba16f, 4, 2);
  colour.failing = 6;
  colour.differing = 6;
  colour.median_width = 2;
  colour.map = {0, 0, 3, 0, 3, 0, 0, 0};
  judge::Failure nan{2, 0, 1, 0x7e01, 0x3000, 0x3001, 0x3000, ~std::uint64_t{0}, true},
      far{0, 1, 3, 0x3c04, 0x3c00, 0x3c01, 0x3c00, 3, false};
  colour.worst = {nan, far};
  j.passes.push_back(
      example_pass("shade", judge::Status::fail,
                   {example_case("rain.shade/0000.0", judge::Status::fail, colour),
                    example_case("rain.shade/0001.0", judge::Status::pass, example_output("colour", Format::rgba16f, 4, 2))}));
  judge::PassJudgement& shade = j.passes.back();
  shade.cases[0].failing = 2;
  shade.half_mode_voted = true;
  shade.half_mode = judge::HalfMode::rtz;
  shade.half_votes = {8, 2, 2};
  shade.causes.push_back({"upside down", "the buffer is stored from the bottom up", 2, 2, 1, false, true, {{"a.comp", 7, "x = y;"}}});
  shade.where = "only channel y of colour";
  j.notes.push_back("port/x.exr: one note");
  return j;
}

inline std::filesystem::path small_pack(const std::string& name) { return rainref::test::pack_folder(name); }

/// Writes a port's outputs: the pack's own, after `alter` (case, output, array) had its way with each.
inline void write_port(const capture::Pack& pack, const std::filesystem::path& folder,
                       const std::function<void(const capture::PackCase&, const std::string&, capture::Array&)>& alter = nullptr) {
  for (const capture::PackCase& c : pack.cases) {
    std::filesystem::create_directories(folder / c.id);
    for (const capture::PackOutput& o : c.outputs) {
      const std::filesystem::path file = folder / c.id / ("out." + o.name + ".npy");
      if (!alter) {
        std::filesystem::copy_file(pack.folder() / o.levels[0].path, file);
        continue;
      }
      // The header is the pack's: the arrays keep their shape.
      capture::Array a = pack.read(o);
      const std::size_t values = a.levels[0].size();
      alter(c, o.name, a);
      std::string bytes = contents(pack.folder() / o.levels[0].path);
      if (values > 0) std::memcpy(bytes.data() + bytes.size() - values, a.levels[0].data(), values);
      put(file, bytes);
    }
  }
}
inline void flip_rows(capture::Array& a) {
  const std::size_t row = a.levels[0].size() / static_cast<std::size_t>(a.height);
  std::vector<std::byte> out;
  for (int y = a.height - 1; y >= 0; --y) {
    const auto begin = a.levels[0].begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * row);
    out.insert(out.end(), begin, begin + static_cast<std::ptrdiff_t>(row));
  }
  a.levels[0] = out;
}

}  // namespace rainref::reports
