// Packs of a simulation's scene for C.
#include "base/path_text.h"
#include "c_library/call.h"
#include "c_library/handles.h"

using namespace rainref;
using c_library::call;
using c_library::required;
using c_library::sized;

int rr_write_pack(rr_simulation* simulation, const char* folder, const rr_pack_options* options, const char** notes) {
  return call([&] {
    rr_simulation& s = required(simulation, "simulation");
    if (notes) *notes = nullptr;
    PackOptions how;
    if (options) {
      const rr_pack_options& o = sized(options, "rr_pack_options");
      if (o.frame_count > 0) how.frames.assign(&required(o.frames, "rr_pack_options.frames"), o.frames + o.frame_count);
      how.passes = c_library::texts(o.passes, o.pass_count, "rr_pack_options.passes");
      if (o.seed) how.seed = o.seed;
      how.progress = c_library::progress_of(o.progress, o.user, "rr_pack_options.progress", "frames");
    }
    const PackSummary made = write_pack(s.running.scene_text(), utf8_path(&required(folder, "folder")), s.executor, how);
    if (notes) *notes = c_library::joined(made.notes, s.notes);
  });
}
