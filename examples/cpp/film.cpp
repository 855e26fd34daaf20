// The smallest program: ten frames of an effect, and a picture of the last.
#include "rainref/simulation.h"

int main() {
  rainref::parallel::Executor threads;
  rainref::Simulation rain({.set = {"effect=edge_splash", "run.size=[640, 360]"}}, threads);  // or read_scene("x.toml")
  for (int frame = 0; frame < 10; ++frame) rain.next_frame();
  rain.write_png("splashes.png");
}
