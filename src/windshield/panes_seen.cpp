// The view through the panes and the interior before them, with or without the windshield's drops.
#include "base/floating_point.h"
#include "windshield/picture/interior.pass.h"
#include "windshield/picture/join_panes.pass.h"
#include "windshield/windshield_state.h"

namespace rainref::windshield {

/// composite of each pane in turn, with each one after the first joined to those before. `before`: time already spent on the first [s].
void Windshield::State::show_panes(const pass::Moment& now, bool shows_drops, Image& all, double before) {
  const Rounding rounding = settings.surface.rounding;
  for (std::size_t k = 0; k < panes.size(); ++k) {
    pass::Moment of_pane = now;
    of_pane.step = static_cast<int>(k);
    Image& seen = k == 0 ? all : pane_colour;
    panes[k]->composite(of_pane, *pyramid, levels, scene.depth, lights, shows_drops || k > 0, seen, k == 0 ? before : 0);
    if (settings.smear.on) panes[k]->soften(of_pane, *pyramid, levels, seen);
    if (settings.condensation.on) panes[k]->mist(of_pane, *pyramid, levels, seen);
    if (k == 0) continue;
    pass::HostIo<JoinPanesPass> io;
    io.pane_colour = pane_colour;
    io.colour = all;
    io.joined = all;
    pass::Run<JoinPanesPass> join(panes[k]->view(), corrected, rounding, io);
    join.start(of_pane);
    join.tiles(executor, tile_rows);
    join.finish(of_pane);
  }
}

/// interior, over the view through all panes.
void Windshield::State::sit_inside(const pass::Moment& now, Image& seen) {
  pass::HostIo<InteriorPass> io;
  io.interior = interior;
  io.colour = seen;
  io.seen = seen;
  pass::Run<InteriorPass> run(interior_uniforms(settings.interior), corrected, settings.surface.rounding, io);
  run.start(now);
  run.tiles(executor, tile_rows);
  run.finish(now);
}

Image Windshield::without_drops() const {
  const FloatingPointGuard guard;
  State& s = *state_;
  Image seen(Format::rgba16f, s.settings.picture.width, s.settings.picture.height);
  const pass::Moment unrecorded = s.moment(nullptr, 0, s.frame_time());
  s.show_panes(unrecorded, false, seen, 0);
  if (s.settings.interior.on) s.sit_inside(unrecorded, seen);
  return seen;
}

}  // namespace rainref::windshield
