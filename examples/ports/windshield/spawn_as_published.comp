// windshield.spawn, as-published. New drops in free slots.
#version 450
#extension GL_GOOGLE_include_directive : enable
#define DROPS_OUT 3
#include "spawn.glsl"

uint above(uint word) { return 0u; }
