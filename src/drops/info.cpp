#include "drops/info.h"

#include "drops/motion/integrate.pass.h"
#include "drops/motion/merge.pass.h"
#include "drops/motion/necks.pass.h"
#include "drops/motion/spawn.pass.h"
#include "drops/splat/splat.pass.h"
#include "pass/info.h"
#include "scene/parameter.h"

namespace rainref::drops {

using namespace rainref::scene;
using namespace rainref::capture;

std::vector<UniformBlock> records() {
  return {Drop::layout(), GlassFrame::layout(), Neck::layout(),
          record<SpawnMass>({member<&SpawnMass::mass>("1", "Mass of a size class of arrivals, as in Drop.")}),
          record<CountThreshold>({member<&CountThreshold::threshold>("1", "A word not below k thresholds draws first_count + k drops.")})};
}

std::vector<BufferInfo> buffers() {
  const auto list = [](const char* name, const char* sentence, std::array<double, 2> range, const char* record, const char* variant) {
    return BufferInfo{.name = name, .format = "records", .sentence = sentence, .range = range, .record = record, .variant = variant};
  };
  std::vector<BufferInfo> all = pass::buffers_of<SpawnPass>();
  all.push_back(list("glass_frame", "What moves drops, in glass coordinates.", {-1000, 1000}, "GlassFrame", ""));
  all.push_back(
      list("count_thresholds", "Thresholds of the number of drops in a draw, ascending.", {0, 4294967295.0}, "CountThreshold", correct));
  all.push_back(list("spawn_masses", "Masses of the 1024 size classes of arrivals, lightest first.", {0, most_mass}, "SpawnMass", ""));
  for (const BufferInfo& necks : pass::buffers_of<NecksPass>()) all.push_back(necks);
  for (const BufferInfo& film : pass::buffers_of<MergePass>()) all.push_back(film);
  return all;
}

PassInfo spawn_info(const std::array<std::string, 2>& last_writers) {
  PassInfo info = pass::info_of<SpawnPass>();
  pass::set_sources(info, "drops", last_writers[0], last_writers[1]);
  return info;
}
PassInfo integrate_info(const std::string& glass_frame_pass) {
  PassInfo info = pass::info_of<IntegratePass>();
  pass::set_source(info, "glass_frame", glass_frame_pass);
  return info;
}
PassInfo merge_info(const std::string& before, const std::string& film_from) {
  PassInfo info = pass::info_of<MergePass>();
  pass::set_source(info, "drops", before);
  pass::set_source(info, "film", film_from);
  info.reads.back().previous = film_from == "merge";
  return info;
}
PassInfo necks_info(const std::string& before) {
  PassInfo info = pass::info_of<NecksPass>();
  pass::set_source(info, "drops", before);
  return info;
}
PassInfo splat_info(const std::array<std::string, 2>& drops_from) {
  PassInfo info = pass::info_of<SplatPass>();
  pass::set_sources(info, "drops", drops_from[0], drops_from[1]);
  return info;
}
std::vector<BufferInfo> splat_buffers() { return pass::buffers_of<SplatPass>(); }

PassInfo corrected_only(PassInfo pass) {
  std::erase_if(pass.variants, [](const PassVariant& v) { return v.name != correct; });
  std::erase_if(pass.reads, [](const ReadInfo& r) { return r.variant == published; });
  for (ReadInfo& r : pass.reads) r.variant = correct;
  return pass;
}
std::vector<BufferInfo> corrected_only(std::vector<BufferInfo> buffers) {
  std::erase_if(buffers, [](const BufferInfo& b) { return b.variant == published; });
  for (BufferInfo& b : buffers) b.variant = correct;
  return buffers;
}

}  // namespace rainref::drops
