#version 450
#extension GL_GOOGLE_include_directive : enable
const bool CORRECTED = true;
#include "bake_raindrops.glsl"
