#version 450
#extension GL_GOOGLE_include_directive : enable
const bool CORRECTED = false;
#include "bake_raindrops.glsl"
