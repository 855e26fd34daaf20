// The last pass of every effect but the puddle. The scene key is display.exposure.
#pragma once

#include <memory>
#include <string>

#include "capture/pass_info.h"
#include "capture/pass_model.h"
#include "image/code_table.h"
#include "pass/display.pass.h"
#include "pass/run.h"

namespace rainref::pass {

/// exposure: [EV].
DisplayUniforms display_uniforms(double exposure);
/// colour: rgba16f; picture: rgba8, alpha 1.
Run<DisplayPass> display_run(double exposure, Rounding rounding, const Image& colour, Image& picture);
/// The same by table, for pictures of this size.
CodeTable display_table(int width, int height, double exposure, Rounding rounding);

/// A run that writes `colour`, followed by display by table. display reads no neighbours, so both run on a tile while it is in the cache.
/// Neither overwrites its inputs, so both starts may be recorded after both have run.
template <class P>
void run_and_display(Run<P>& run, const CodeTable& table, double exposure, const Image& colour, Image& picture,
                     const parallel::Executor& executor, int tile_rows, const Moment& now) {
  Run<DisplayPass> display = display_run(exposure, now.rounding, colour, picture);
  executor.for_tiles(picture.width(), picture.height(), picture.width(), tile_rows, [&](const parallel::Tile& t) {
    run.tile(t);
    display.tile([&] { table.rows(colour, picture, t.y0, t.y1); });
  });
  run.start(now);
  run.finish(now, executor.threads());
  display.start(now);
  display.finish(now, executor.threads());
}

/// The pass reads the colour of the pass `from`.
capture::PassInfo display_info(const std::string& from);
/// The picture that it writes.
capture::BufferInfo display_buffer();
std::unique_ptr<capture::PassModel> bind_display(const capture::PassCase& c);

}  // namespace rainref::pass
