// Films for C. WebAssembly, where no ffmpeg can be started, leaves this file out.
#include "base/path_text.h"
#include "c_library/call.h"
#include "c_library/handles.h"

using namespace rainref;
using c_library::call;
using c_library::required;

int rr_film(rr_simulation* simulation, const char* path, int32_t frames, int32_t every, rr_progress progress, void* user) {
  return call([&] {
    required(simulation, "simulation")
        .running.film(utf8_path(&required(path, "path")),
                      {frames, every, c_library::progress_of(progress, user, "rr_film.progress", "frames")});
  });
}
