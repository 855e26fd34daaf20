// windshield.spawn, corrected. New drops in free slots.
#version 450
#extension GL_GOOGLE_include_directive : enable
#define DROPS_OUT 4
#include "spawn.glsl"
layout(std430, binding = 2) readonly buffer CountThresholdBuffer { uint thresholds[]; };

uint above(uint word) {
  uint n = 0u;
  for (int i = 0; i < u.threshold_count; ++i) {
    if (word >= thresholds[i]) ++n;
  }
  return n;
}
