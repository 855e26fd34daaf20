// Fogged glass, pass fog: fog grows back on a cold pane, and sliding drops wipe it. Row 0 is the upper edge of the pane.
[[vk::binding(0)]] cbuffer Fog {
  float dt;             //   0  [s] Time since the last run.
  float regrow_time;    //   4  [s] After this time a wiped place lacks 1/e of its fog.
  float rim;            //   8  [texel] Width of the soft rim of what a drop wipes.
  int drop_count;       //  12  [1] Drops in the list.
  float fog_at_top;     //  16  [1] Share of the pane that is fogged at last, at its upper edge.
  float fog_at_bottom;  //  20  [1] The same at its lower edge.
  float trail;          //  24  [1] Radius of a trail where it begins, in radii of its drop.
  float padding_0;      //  28  padding
};
struct Drop {
  float2 position;  //   0  [texel] Centre; texel centres lie at k + 1/2.
  float2 velocity;  //   8  [texel/s] Of the slide that led here.
  float radius;     //  16  [texel] 0: there is no drop.
  float strength;   //  20  [1] Share of the fog that the drop takes.
};
[[vk::binding(1)]] Texture2D<float> fog;
[[vk::binding(2)]] StructuredBuffer<Drop> drops;
[[vk::binding(3)]] [[spv::format_r32f]] RWTexture2D<float> next_fog;

// Share of the fog at a place that a drop leaves, which slid here in a straight line since the last run.
float left_by(Drop drop, float2 here) {
  if (drop.radius <= 0.0) return 1.0;
  float2 way = drop.velocity * dt;
  float2 from_start = here - (drop.position - way);
  float way_sq = dot(way, way);
  float along = 1.0;
  if (way_sq > 0.0) along = saturate(dot(from_start, way) / way_sq);
  float away = length(from_start - along * way);
  float edge = drop.radius * lerp(trail, 1.0, along);
  float outside = smoothstep(edge - rim, edge, away);
  return 1.0 - drop.strength * (1.0 - outside);
}

[numthreads(8, 8, 1)]
void main(uint3 id : SV_DispatchThreadID) {
  uint columns, rows;
  next_fog.GetDimensions(columns, rows);
  if (id.x >= columns || id.y >= rows) return;

  float2 here = float2(id.xy) + 0.5;
  float full = lerp(fog_at_top, fog_at_bottom, smoothstep(0.0, 1.0, here.y / float(rows)));
  float kept = exp(-dt / regrow_time);
  float share = lerp(full, fog.Load(int3(id.xy, 0)), kept);
  for (int i = 0; i < drop_count; ++i) share *= left_by(drops[i], here);
  next_fog[id.xy] = share;
}
