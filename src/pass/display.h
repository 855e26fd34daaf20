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
/// colour: in the format of Display; picture: rgba8, alpha 1.
template <class Display = DisplayPass>
Run<Display> display_run(double exposure, Rounding rounding, const Image& colour, Image& picture) {
  HostIo<Display> io;
  io.colour = colour;
  io.picture = picture;
  return Run<Display>(display_uniforms(exposure), true, rounding, io);
}
/// The same by table, for pictures of this size.
CodeTable display_table(int width, int height, double exposure, Rounding rounding);

/// A run that writes the picture's colour, followed by display, whose tiles show(tile) computes. display reads no neighbours, so
/// both run on a tile while it is in the cache. Neither overwrites its inputs, so both starts may be recorded after both have run.
template <class P, class Display, class Show>
void run_and_show(Run<P>& run, Run<Display>& display, const Show& show, const Image& picture, const parallel::Executor& executor,
                  int tile_rows, const Moment& now) {
  executor.for_tiles(picture.width(), picture.height(), picture.width(), tile_rows, [&](const parallel::Tile& t) {
    run.tile(t);
    show(t);
  });
  run.start(now);
  run.finish(now, executor.threads());
  display.start(now);
  display.finish(now, executor.threads());
}
/// The same for a run that writes `colour`: display by table if that holds halves, and by itself if it holds codes.
template <class P>
void run_and_display(Run<P>& run, const CodeTable& table, double exposure, const Image& colour, Image& picture,
                     const parallel::Executor& executor, int tile_rows, const Moment& now) {
  if (colour.format() == Format::rgba8) {
    Run<DisplayOfCodesPass> display = display_run<DisplayOfCodesPass>(exposure, now.rounding, colour, picture);
    run_and_show(
        run, display, [&](const parallel::Tile& t) { display.tile(t); }, picture, executor, tile_rows, now);
    return;
  }
  Run<DisplayPass> display = display_run(exposure, now.rounding, colour, picture);
  const auto by_table = [&](const parallel::Tile& t) { display.tile([&] { table.rows(colour, picture, t.y0, t.y1); }); };
  run_and_show(run, display, by_table, picture, executor, tile_rows, now);
}

/// The pass reads the colour of the pass `from`.
capture::PassInfo display_info(const std::string& from);
/// The picture that it writes.
capture::BufferInfo display_buffer();
std::unique_ptr<capture::PassModel> bind_display(const capture::PassCase& c);

}  // namespace rainref::pass
