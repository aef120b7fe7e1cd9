// The volume as matter: a ray for every pixel, from the near side of the box of samples to what is opaque. As compositing.ts, with light.
export const VERTEX = `
out vec2 screen;
void main() {
  screen = position.xy;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;

export const FRAGMENT = `
precision highp float;
precision highp sampler3D;
uniform sampler3D values;
uniform sampler2D transfer;   // integrals of extinction x colour, extinction
uniform sampler2D depths;     // of what is opaque
uniform mat4 toWorld;         // from the screen, -1 to 1
uniform mat4 toTexture;       // from the world to the texture of values
uniform vec3 low, high;       // the box of samples in the texture
uniform vec4 cut;             // what stays: dot(cut.xyz, place) + cut.w >= 0
uniform float step_;          // physical
uniform float density;
uniform vec3 lamp;            // towards the light
uniform float seed;
in vec2 screen;
out vec4 colour;

const float PLACES = 1024.0;
const int MOST_STEPS = 4096;

vec4 integralTo(float place) {
  float i = min(floor(place), PLACES - 1.0);
  vec4 first = texelFetch(transfer, ivec2(int(i), 0), 0);
  return mix(first, texelFetch(transfer, ivec2(int(i) + 1, 0), 0), place - i);
}

vec4 meanBetween(float a, float b) {
  float middle = 0.5 * (a + b), half_ = 0.5 * max(abs(b - a), 0.5);
  float from = clamp(middle - half_, 0.0, PLACES - 0.5), to = max(min(middle + half_, PLACES), from + 0.5);
  return (integralTo(to) - integralTo(from)) / (to - from);
}

vec3 world(float depth) {
  vec4 place = toWorld * vec4(screen, depth, 1.0);
  return place.xyz / place.w;
}

/** Less light on what is turned away; even light where values hardly change. */
float shade(vec3 place) {
  vec3 texel = 1.0 / vec3(textureSize(values, 0));
  vec3 rise = vec3(
    texture(values, place + vec3(texel.x, 0, 0)).r - texture(values, place - vec3(texel.x, 0, 0)).r,
    texture(values, place + vec3(0, texel.y, 0)).r - texture(values, place - vec3(0, texel.y, 0)).r,
    texture(values, place + vec3(0, 0, texel.z)).r - texture(values, place - vec3(0, 0, texel.z)).r);
  vec3 normal = transpose(mat3(toTexture)) * (rise / texel);
  float slope = length(normal);
  if (slope == 0.0) return 0.85;
  float turned = abs(dot(normal / slope, lamp));
  return mix(0.85, 0.3 + 0.75 * turned, clamp(8.0 * length(rise), 0.0, 1.0));
}

void main() {
  vec3 near = world(-1.0), far = world(1.0);
  float whole = distance(near, far);
  vec3 way = (far - near) / whole;
  float end = min(whole, dot(world(2.0 * texture(depths, 0.5 * screen + 0.5).r - 1.0) - near, way));
  float begin = 0.0;
  vec3 first = (toTexture * vec4(near, 1.0)).xyz, along = mat3(toTexture) * way;
  vec3 a = (low - first) / along, b = (high - first) / along;
  begin = max(begin, max(max(min(a.x, b.x), min(a.y, b.y)), min(a.z, b.z)));
  end = min(end, min(min(max(a.x, b.x), max(a.y, b.y)), max(a.z, b.z)));
  float start = dot(cut.xyz, near) + cut.w, rise = dot(cut.xyz, way);
  if (rise > 0.0) begin = max(begin, -start / rise);
  else if (rise < 0.0) end = min(end, -start / rise);
  else if (start < 0.0) end = begin;
  colour = vec4(0);
  float jitter = fract(sin(dot(gl_FragCoord.xy + seed, vec2(12.9898, 78.233))) * 43758.5453);
  float t = begin, next = begin + jitter * step_, before = PLACES * texture(values, first + begin * along).r;
  for (int i = 0; i < MOST_STEPS && t < end && colour.a < 0.995; ++i) {
    next = min(next, end);
    float place = PLACES * texture(values, first + next * along).r;
    vec4 matter = meanBetween(before, place);
    if (matter.a > 0.0) {
      float more = (1.0 - colour.a) * (1.0 - exp(-density * matter.a * (next - t)));
      if (more > 0.0005) colour.rgb += more * matter.rgb / matter.a * shade(first + 0.5 * (t + next) * along);
      colour.a += more;
    }
    before = place;
    t = next;
    next += step_;
  }
}`;

/** Brings it into the picture: linear light becomes what the screen shows. */
export const OVERLAY = `
precision highp float;
uniform sampler2D matter;
in vec2 screen;
out vec4 colour;
void main() {
  vec4 light = texture(matter, 0.5 * screen + 0.5);
  if (light.a <= 0.0) discard;
  vec3 pure = min(light.rgb / light.a, 1.0);
  vec3 shown = mix(12.92 * pure, 1.055 * pow(pure, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, pure));
  colour = vec4(shown * light.a, light.a);
}`;
