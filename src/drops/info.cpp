#include "drops/info.h"

#include "drops/drops.h"
#include "drops/records.h"
#include "drops/uniforms.h"

namespace rainref::drops {
namespace {

using namespace rainref::scene;
using namespace rainref::capture;

constexpr const char *published = "as-published", *correct = "corrected";

UniformBlock spawn_block() {
  return uniform_block<SpawnUniforms>(
      "SpawnUniforms",
      {member<&SpawnUniforms::seed>("seed", "1", any_word, "Low and high word of the seed."),
       member<&SpawnUniforms::step>("step", "1", any_word, "Steps made before this one, modulo 2^32."),
       member<&SpawnUniforms::parts>("parts", "1", {0, 4096}, "Draws that add up to the count."),
       member<&SpawnUniforms::first_count>("first_count", "1", {0, 1 << 26}, "Drops of a draw whose word is below every threshold."),
       member<&SpawnUniforms::threshold_count>("threshold_count", "1", {0, 16000},
                                               "Thresholds in the list; 0: each draw gives first_count."),
       member<&SpawnUniforms::first_id>("first_id", "1", any_word, "Id of the first arrival; the others follow."),
       member<&SpawnUniforms::room>("room", "1", {0, DropArrays::most_slots}, "Free slots: arrivals beyond are lost."),
       member<&SpawnUniforms::life>("life", "s", {0, 4096}, "Life of a new drop.")});
}
UniformBlock integrate_block() {
  return uniform_block<IntegrateUniforms>(
      "IntegrateUniforms",
      {member<&IntegrateUniforms::frame>("frame", "m", {-1e4, 1e4},
                                         "corrected: x = frame.x u + frame.y v and y = frame.z v in the plane of the glass."),
       member<&IntegrateUniforms::dt>("dt", "s", {0, 1}, "The step."),
       member<&IntegrateUniforms::inertia_coupling>("inertia_coupling", "1", {0, 100},
                                                    "as-published: share of the vehicle's acceleration."),
       member<&IntegrateUniforms::wind_coupling>("wind_coupling", "1/s", {0, 100}, "as-published: acceleration by a unit of wind."),
       member<&IntegrateUniforms::drag>("drag", "1/s", {0, 1e9}, "as-published: rate of slowing down; corrected: that times mass^(2/3)."),
       member<&IntegrateUniforms::wind_push>("wind_push", "1/m", {0, 1e9},
                                             "corrected: acceleration over wind speed squared, times mass^(1/3)."),
       member<&IntegrateUniforms::hold>("hold", "m/s^2", {0, 1e9}, "corrected: acceleration that hysteresis holds, times mass^(2/3)."),
       member<&IntegrateUniforms::evaporation>("evaporation", "1/s", {0, 1e9}, "corrected: mass units lost in a second over mass^(1/3)."),
       member<&IntegrateUniforms::margin>("margin", "1", share, "corrected: how far outside the glass a drop lives."),
       member<&IntegrateUniforms::rest_speed>("rest_speed", "m/s", share, "corrected: a held drop below this speed rests."),
       member<&IntegrateUniforms::phase_rate>("phase_rate", "1", {0, 1e7}, "corrected: turns in 64 s of the phase that rounds losses.")});
}
UniformBlock merge_block() {
  return uniform_block<MergeUniforms>(
      "MergeUniforms",
      {member<&MergeUniforms::frame>("frame", "m", {-1e4, 1e4}, "As in IntegrateUniforms."),
       member<&MergeUniforms::radius>("radius", "m", share, "Base radius over mass^(1/3)."),
       member<&MergeUniforms::trail>("trail", "1/m^2", {0, 1e12}, "Mass units left over base radius and way."),
       member<&MergeUniforms::dt>("dt", "s", {0, 1}, "The step."),
       member<&MergeUniforms::film>("film", "texel", {1, 65536}, "Columns and rows of the film."),
       member<&MergeUniforms::drying>("drying", "1", {0, most_mass}, "Mass units that each texel of the film loses in this step.")});
}

}  // namespace

std::vector<UniformBlock> records() {
  return {
      record<Drop>("Drop", {member<&Drop::position>("position", "1", "Glass coordinates u, v."),
                            member<&Drop::velocity>("velocity", "1/s", "Change of the position."),
                            member<&Drop::mass>(
                                "mass", "1", "as-published: 1 is an ordinary drop; corrected: whole mass units of 2e-11 kg, at most 2^24."),
                            member<&Drop::life>("life", "s", "What remains; not above 0: no drop."),
                            member<&Drop::id>("id", "1", "Its own for ever, ascending in the order of birth.")}),
      record<GlassFrame>("GlassFrame",
                         {member<&GlassFrame::gravity>(
                              "gravity", "1/s^2", "as-published: gravity; corrected: specific force at (0, 0), the car's motion included."),
                          member<&GlassFrame::wind>("wind", "1/s", "Apparent wind."),
                          member<&GlassFrame::acceleration>("acceleration", "1/s^2", "as-published: of the vehicle; corrected: 0."),
                          member<&GlassFrame::id>("id", "1", "0."),
                          member<&GlassFrame::spin>("spin", "1/s^2", "corrected: specific force per glass coordinate, rows u and v."),
                          member<&GlassFrame::coriolis>("coriolis", "1/s", "corrected: specific force per velocity, rows u and v.")}),
      record<SpawnMass>("SpawnMass", {member<&SpawnMass::mass>("mass", "1", "Mass of a size class of arrivals, as in Drop.")}),
      record<CountThreshold>("CountThreshold", {member<&CountThreshold::threshold>(
                                                   "threshold", "1", "A word not below k thresholds draws first_count + k drops.")})};
}

std::vector<BufferInfo> buffers() {
  return {
      {"drops", "records", "The live drops, in slot order.", "1", {-100, 100}, "none", "none", "none", "", "Drop", published},
      {"drops", "records", "The live drops, in slot order.", "1", {0, most_mass}, "none", "none", "none", "", "Drop", correct},
      {"glass_frame", "records", "What moves drops, in glass coordinates.", "1", {-1000, 1000}, "none", "none", "none", "", "GlassFrame"},
      {"count_thresholds",
       "records",
       "Thresholds of the number of drops in a draw, ascending.",
       "1",
       {0, 4294967295.0},
       "none",
       "none",
       "none",
       "",
       "CountThreshold",
       correct},
      {"spawn_masses",
       "records",
       "Masses of the 1024 size classes of arrivals, lightest first.",
       "1",
       {0, most_mass},
       "none",
       "none",
       "none",
       "",
       "SpawnMass"},
      {"film",
       "r32f",
       "Water on the glass that is no drop: whole mass units of 2e-11 kg in a texel.",
       "1",
       {0, most_mass},
       "none",
       "none",
       "none",
       "",
       "",
       correct}};
}

PassInfo spawn_info(const std::array<std::string, 2>& last_writers) {
  return {"spawn",
          "New drops in free slots.",
          {{published, 1, Judge::keyed, "SpawnUniforms"}, {correct, 1, Judge::keyed, "SpawnUniforms"}},
          {{"drops", last_writers[0], true, published},
           {"drops", last_writers[1], true, correct},
           {"count_thresholds", "", false, correct},
           {"spawn_masses"}},
          {"drops"},
          {spawn_block()}};
}
PassInfo integrate_info(const std::string& before, const std::string& glass_frame_pass) {
  return {"integrate",
          "Forces, motion, evaporation and age of every drop.",
          {{published, 1, Judge::keyed, "IntegrateUniforms"}, {correct, 1, Judge::keyed, "IntegrateUniforms"}},
          {{"drops", before}, {"glass_frame", glass_frame_pass}},
          {"drops"},
          {integrate_block()},
          "gather",
          {"the forces", "length"}};
}
PassInfo merge_info(const std::string& before, const std::string& film_from) {
  return {"merge",
          "Drops that touch become one; sliding drops leave trails on the film.",
          {{correct, 1, Judge::keyed, "MergeUniforms"}},
          {{"drops", before, false, correct}, per_texel({"film", film_from, film_from == "merge", correct})},
          {"drops", "film"},
          {merge_block()},
          "ordered_scatter",
          {"length"}};
}

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
