// rainy_glass.bake_raindrops, as-published. The raindrop map: normals, time offsets and heights of droplets on a tile.
// Once, before frame 0.
#version 450
#extension GL_GOOGLE_include_directive : enable
const bool CORRECTED = false;
#include "bake_raindrops.glsl"
