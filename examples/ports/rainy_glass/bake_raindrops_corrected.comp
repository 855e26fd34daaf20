// rainy_glass.bake_raindrops, corrected. The raindrop map: normals, time offsets and heights of droplets on a tile.
// Once, before frame 0.
#version 450
#extension GL_GOOGLE_include_directive : enable
const bool CORRECTED = true;
#include "bake_raindrops.glsl"
