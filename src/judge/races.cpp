#include "judge/races.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "base/path_text.h"
#include "judge/check_pack.h"
#include "judge/conclude.h"

namespace rainref::judge {
namespace {

using capture::Array;

/// Marks each element of b that differs from a's.
void mark_differences(const Array& a, const Array& b, std::size_t size, std::vector<bool>& differs) {
  const std::vector<std::byte>&first = a.levels[0], &second = b.levels[0];
  for (std::size_t i = 0; i < differs.size(); ++i) {
    const bool both = (i + 1) * size <= first.size() && (i + 1) * size <= second.size();
    if (!both || std::memcmp(first.data() + i * size, second.data() + i * size, size) != 0) differs[i] = true;
  }
}

}  // namespace

std::string Race::text() const {
  const std::string place = records ? fmt::format("record {}", x) : fmt::format("({}, {}).{}", x, y, "xyzw"[channel & 3]);
  return fmt::format("race: {}/out.{} differs between runs 1 and {} on the same inputs, first at {}, {} of {} {}", id, output, run, place,
                     differing, of, records ? "records" : "elements");
}

Races find_races(const capture::Pack& pack, const std::vector<std::filesystem::path>& runs, const std::vector<std::string>& passes,
                 const std::shared_ptr<ReadBuffers>& buffers) {
  std::vector<PortFiles> ports;
  for (const std::filesystem::path& folder : runs) ports.emplace_back(folder, pack.effect, pack.variant, ports.empty() ? buffers : nullptr);
  std::vector<Race> races;
  FileFaults first_run, later_runs;
  for (const capture::PackCase& entry : pack.cases) {
    if (std::find(passes.begin(), passes.end(), entry.pass) == passes.end()) continue;
    for (const capture::PackOutput& output : entry.outputs) {
      if (output.rules.judge == capture::Judge::input_only) continue;
      Array shape = output.shape;
      shape.levels.resize(output.levels.size());
      const auto own = ports.front().info().encodings.find(output.name);
      if (own != ports.front().info().encodings.end() && !own->second.members.empty())
        shape = read_case(pack, entry).output(output.name)->array;  // gives the members that the port does not have
      std::vector<Array> found;
      for (PortFiles& port : ports) {
        FileFaults& faults = &port == &ports.front() ? first_run : later_runs;
        const std::string stem = "out." + output.name;
        if (!faults.attempt(entry.pass, entry.id, stem, [&] { found.push_back(port.read(utf8_path(entry.id), stem, shape)); }) &&
            found.empty())
          break;
      }
      if (found.size() < ports.size()) continue;
      const std::size_t size = shape.is_records ? shape.element_bytes() : static_cast<std::size_t>(info(shape.format).channel_bytes);
      std::size_t elements = 0;
      for (const Array& a : found) elements = std::max(elements, a.levels[0].size() / size);
      std::vector<bool> differs(elements);
      Race race{entry.pass, entry.id, output.name};
      for (std::size_t r = 1; r < found.size(); ++r) {
        if (found[r].levels == found[0].levels) continue;
        if (race.run == 0) race.run = static_cast<int>(r) + 1;
        mark_differences(found[0], found[r], size, differs);
      }
      if (race.run == 0) continue;
      race.records = shape.is_records;
      race.of = static_cast<std::int64_t>(elements);
      race.differing = std::count(differs.begin(), differs.end(), true);
      const auto first = static_cast<int>(std::find(differs.begin(), differs.end(), true) - differs.begin());
      const int channels = shape.is_records ? 1 : info(shape.format).channels,
                width = shape.is_records ? static_cast<int>(elements) : shape.width;
      race.x = first / channels % width;
      race.y = first / channels / width;
      race.channel = first % channels;
      races.push_back(race);
    }
  }
  return {races, later_runs.all()};
}

void add_races(const std::vector<Race>& races, PortJudgement& judgement) {
  for (PassJudgement& pass : judgement.passes) {
    std::vector<const Race*> own;
    for (const Race& r : races)
      if (r.pass == pass.pass) own.push_back(&r);
    if (own.empty()) continue;
    pass.status = Status::fail;
    pass.reason = own.front()->text();
    if (own.size() > 1) pass.reason += fmt::format(" (and {} more outputs of this pass)", own.size() - 1);
    for (CaseJudgement& c : pass.cases) {
      const auto found = std::find_if(own.begin(), own.end(), [&](const Race* r) { return r->id == c.id; });
      if (found == own.end()) continue;
      c.status = Status::fail;
      c.reason = (*found)->text();
      c.broken = true;
    }
  }
  judgement.first_bad_pass.clear();
  conclude(judgement);
}

}  // namespace rainref::judge
