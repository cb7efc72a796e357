#pragma once
// GLSL for OpenGL 3.3 and WebGL 2 alike; only the first lines differ.

namespace substep::glsl {

#ifdef __EMSCRIPTEN__
inline constexpr const char* kHeader =
    "#version 300 es\nprecision highp float;\nprecision highp sampler2DShadow;\n";
#else
inline constexpr const char* kHeader = "#version 330 core\n";
#endif

/// Between the header and a fragment shader: leaves out noise, soft transitions and reflections,
/// for software renderers.
inline constexpr const char* kRough = "#define ROUGH\n";

/// Boxes with rounded edges and balls. A corner of the unit box is moved in by the rounding and out
/// again along the vertex normal, so that edges stay equally round however long the box is.
inline constexpr const char* kBodyVertex = R"(
layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 position_rounding;
layout(location = 3) in vec4 orientation;
layout(location = 4) in vec4 half_extents_pattern;
layout(location = 5) in vec4 color;
uniform mat4 view_projection;
uniform mat4 world_to_shadow;
uniform float rounded;  // 0: edges are sharp
out vec3 v_position;
out vec3 v_normal;
out vec3 v_local;
out vec4 v_shadow;
out vec4 v_color;
out float v_pattern;
vec3 rotate(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
void main() {
  vec3 half_extents = half_extents_pattern.xyz;
  float rounding = position_rounding.w * rounded;
  vec3 local = corner * (half_extents - rounding) + normal * rounding;
  v_position = position_rounding.xyz + rotate(orientation, local);
  v_normal = rotate(orientation, normal);
  v_local = local / half_extents;
  v_color = vec4(color.rgb * color.rgb, color.a);  // to linear light
  v_pattern = half_extents_pattern.w;
  v_shadow = world_to_shadow * vec4(v_position + 0.02 * v_normal, 1.0);
  gl_Position = view_projection * vec4(v_position, 1.0);
}
)";

/// Shared by surfaces that receive shadows: the fraction of light, averaged over four samples, or
/// one at low quality, with hardware filtering on top.
inline constexpr const char* kShadowFunction = R"(
uniform sampler2DShadow shadow_map;
uniform float shadow_texel;
uniform float shadow_taps;
float lit(vec4 p, float softness) {
  vec3 q = p.xyz * 0.5 + 0.5;
  if (any(greaterThan(abs(q - 0.5), vec3(0.498)))) return 1.0;
#ifdef ROUGH
  return texture(shadow_map, q);
#else
  vec2 edge = smoothstep(vec2(0.5), vec2(0.4), abs(q.xy - 0.5));
  if (shadow_taps < 2.0) return mix(1.0, texture(shadow_map, q), edge.x * edge.y);
  vec2 d = vec2(0.5, 1.0) * shadow_texel * softness;
  float sum = texture(shadow_map, vec3(q.xy + d, q.z)) +
              texture(shadow_map, vec3(q.xy - d, q.z)) +
              texture(shadow_map, vec3(q.xy + vec2(d.y, -d.x), q.z)) +
              texture(shadow_map, vec3(q.xy - vec2(d.y, -d.x), q.z));
  return mix(1.0, 0.25 * sum, edge.x * edge.y);
#endif
}
)";

inline constexpr const char* kBodyFragment = R"(
in vec3 v_position;
in vec3 v_normal;
in vec3 v_local;
in vec4 v_shadow;
in vec4 v_color;
in float v_pattern;
uniform vec3 eye;
uniform vec3 to_light;
uniform float ambient;
uniform vec3 sky;
uniform vec3 floor_light;
uniform vec4 floor_plane;  // unit normal; height of a point p is dot(normal, p) + w
uniform float floor_reach;
uniform float floor_hides;
out vec4 out_color;
// Products and roots, no powers: those cost a processor that must draw far more.
float square(float x) { return x * x; }
void main() {
  vec3 n = normalize(v_normal);
  vec3 base = v_color.rgb;
  if (v_pattern > 0.5) {
    vec2 width = fwidth(v_local.xy) + 1e-5;
    vec2 side = clamp(v_local.xy / width, -1.0, 1.0);
    base *= mix(0.52, 1.0, 0.5 + 0.5 * side.x * side.y);
  }
  float facing = max(0.0, dot(n, to_light));
  float light = facing > 0.0 ? facing * lit(v_shadow, 1.2) : 0.0;
  // The floor hides the sky, most from surfaces close to it that face it.
  float height = max(0.0, dot(floor_plane.xyz, v_position) + floor_plane.w) / floor_reach;
  float hidden = floor_hides * (0.6 - 0.4 * dot(n, floor_plane.xyz)) / (1.0 + height * height);
  vec3 around = mix(floor_light, sky, 0.5 + 0.5 * n.y) * (ambient * (1.0 - hidden));
  vec3 c = base * (around + vec3(1.0, 0.97, 0.92) * light);
#ifndef ROUGH
  vec3 to_eye = normalize(eye - v_position);
  vec3 half_way = normalize(to_light + to_eye);
  float s2 = square(max(0.0, dot(n, half_way)));
  float s16 = square(square(square(s2)));
  float shine = s16 * square(s16) * 0.22 * light;  // to the 48th
  float rim = square(square(1.0 - max(0.0, dot(n, to_eye)))) * 0.18;
  c += shine + rim * sky * ambient;
#endif
  out_color = vec4(sqrt(c / (1.0 + 0.12 * c)), 1.0) * v_color.a;
}
)";

inline constexpr const char* kShadowFragment = R"(
void main() {}
)";

inline constexpr const char* kBackgroundVertex = R"(
out float v_height;
void main() {
  vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  v_height = 0.5 + 0.5 * p.y;
  gl_Position = vec4(p, 1.0, 1.0);
}
)";

/// A gradient, with noise below one level so that it shows no bands.
inline constexpr const char* kBackgroundFragment = R"(
in float v_height;
uniform vec3 top;
uniform vec3 bottom;
out vec4 out_color;
void main() {
  vec3 c = mix(bottom, top, smoothstep(0.0, 1.0, v_height));
#ifndef ROUGH
  c += (fract(52.98 * fract(dot(gl_FragCoord.xy, vec2(0.0671, 0.00584)))) - 0.5) / 255.0;
#endif
  out_color = vec4(c, 1.0);
}
)";

inline constexpr const char* kGroundVertex = R"(
uniform mat4 view_projection;
uniform mat4 world_to_shadow;
uniform vec3 origin;
uniform vec3 axis_u;
uniform vec3 axis_v;
uniform float fade;
out vec2 v_uv;
out vec4 v_shadow;
void main() {
  vec2 corner = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID >> 1) * 2 - 1);
  v_uv = corner * fade;
  vec3 p = origin + v_uv.x * axis_u + v_uv.y * axis_v;
  v_shadow = world_to_shadow * vec4(p, 1.0);
  gl_Position = view_projection * vec4(p, 1.0);
}
)";

/// A matte floor that fades into the background, shadows on it, and lines one pixel wide at every
/// cell and stronger ones at every fifth; each kind fades out before it gets denser than the
/// pixels.
inline constexpr const char* kGroundFragment = R"(
in vec2 v_uv;
in vec4 v_shadow;
uniform vec2 offset;
uniform float cell;
uniform float fade;
uniform vec4 grid;
uniform float shadow;
uniform vec4 surface;  // colour; coverage at the centre
uniform vec3 shade;
out vec4 out_color;
float lines(vec2 p, vec2 w) {
  vec2 d = abs(fract(p - 0.5) - 0.5) / max(w, vec2(1e-6));
#ifdef ROUGH
  vec2 line = clamp(1.5 - d, 0.0, 1.0) * clamp(1.45 - 3.0 * w, 0.0, 1.0);
#else
  vec2 line = 1.0 - smoothstep(0.5, 1.5, d);
  line *= 1.0 - smoothstep(0.15, 0.5, w);
#endif
  return max(line.x, line.y);
}
void main() {
  float far = 1.0 - dot(v_uv, v_uv) / (fade * fade);
  if (far <= 0.0) discard;
  far *= far;
  vec2 p = (v_uv + offset) / cell;
  vec2 w = fwidth(p);
  float strength = max(0.45 * lines(p, w), lines(0.2 * p, 0.2 * w));
  float dark = (1.0 - lit(v_shadow, 2.2)) * shadow;
  float line = strength * grid.a * (1.0 - 0.6 * dark);
  // Line over shadow over surface, as one premultiplied colour; with noise below one level.
  vec4 c = mix(vec4(surface.rgb, 1.0) * surface.a, vec4(shade, 1.0), dark);
  c = mix(c, vec4(grid.rgb, 1.0), line) * far;
#ifndef ROUGH
  c.rgb += (fract(52.98 * fract(dot(gl_FragCoord.xy, vec2(0.0671, 0.00584)))) - 0.5) / 255.0;
#endif
  out_color = c;
}
)";

/// Soft shadows on the floor, one instance each.
inline constexpr const char* kContactVertex = R"(
layout(location = 0) in vec4 centre_strength;
layout(location = 1) in vec4 along_round;
layout(location = 2) in vec4 extents;  // half u, half v, softness
uniform mat4 view_projection;
uniform vec3 normal;
out vec2 v_at;
flat out vec4 v_extents;
flat out float v_strength;
void main() {
  vec2 corner = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID >> 1) * 2 - 1);
  v_at = corner * (extents.xy + extents.z);
  v_extents = vec4(extents.xyz, along_round.w);
  v_strength = centre_strength.w;
  vec3 along = along_round.xyz;
  vec3 p = centre_strength.xyz + v_at.x * along + v_at.y * cross(normal, along);
  gl_Position = view_projection * vec4(p, 1.0);
}
)";

/// The shadow of a rectangle, blurred along both sides; of a disc, along its radius.
inline constexpr const char* kContactFragment = R"(
in vec2 v_at;
flat in vec4 v_extents;
flat in float v_strength;
uniform vec4 shade;  // colour; darkness
out vec4 out_color;
vec2 edge(vec2 t) { t = clamp(0.5 + 0.5 * t, 0.0, 1.0); return t * t * (3.0 - 2.0 * t); }
void main() {
  vec2 at = v_extents.w > 0.5 ? vec2(length(v_at), 0.0) : v_at;
  vec2 s = edge((v_extents.xy - at) / v_extents.z) + edge((v_extents.xy + at) / v_extents.z) - 1.0;
  out_color = vec4(shade.rgb, 1.0) * (shade.a * v_strength * max(0.0, s.x * s.y));
}
)";

inline constexpr const char* kRibbonVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;
uniform mat4 view_projection;
out vec4 v_color;
void main() {
  v_color = color;
  gl_Position = view_projection * vec4(position, 1.0);
}
)";

inline constexpr const char* kRibbonFragment = R"(
in vec4 v_color;
out vec4 out_color;
void main() { out_color = vec4(v_color.rgb * v_color.a, v_color.a); }
)";

/// A texture over the whole viewport.
inline constexpr const char* kTextureVertex = R"(
out vec2 v_uv;
void main() {
  v_uv = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
  gl_Position = vec4(2.0 * v_uv - 1.0, 0.0, 1.0);
}
)";

inline constexpr const char* kTextureFragment = R"(
in vec2 v_uv;
uniform sampler2D picture;
out vec4 out_color;
void main() { out_color = texture(picture, v_uv); }
)";

}  // namespace substep::glsl
