// Ray casting: a ray per pixel, from the front of the box of samples to the opaque depth; compositing.ts plus shading.
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
uniform sampler2D depths;     // of opaque surfaces
uniform mat4 toWorld;         // from normalized device coordinates
uniform mat4 toTexture;       // from world to texture coordinates
uniform vec3 low, high;       // the box of samples, in texture coordinates
uniform vec4 cut;             // kept half-space: dot(cut.xyz, place) + cut.w >= 0
uniform float step_;          // physical
uniform float density;
uniform vec3 lightDirection;  // towards the light
uniform float seed;
in vec2 screen;
out vec4 colour;

const float PLACES = 1024.0;
const int MAX_STEPS = 4096;

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

/** Headlight shading by the gradient; constant where values hardly change. */
float shade(vec3 place) {
  vec3 texel = 1.0 / vec3(textureSize(values, 0));
  vec3 rise = vec3(
    texture(values, place + vec3(texel.x, 0, 0)).r - texture(values, place - vec3(texel.x, 0, 0)).r,
    texture(values, place + vec3(0, texel.y, 0)).r - texture(values, place - vec3(0, texel.y, 0)).r,
    texture(values, place + vec3(0, 0, texel.z)).r - texture(values, place - vec3(0, 0, texel.z)).r);
  vec3 normal = transpose(mat3(toTexture)) * (rise / texel);
  float slope = length(normal);
  if (slope == 0.0) return 0.85;
  float turned = abs(dot(normal / slope, lightDirection));
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
  for (int i = 0; i < MAX_STEPS && t < end && colour.a < 0.995; ++i) {
    next = min(next, end);
    float place = PLACES * texture(values, first + next * along).r;
    vec4 medium = meanBetween(before, place);
    if (medium.a > 0.0) {
      float more = (1.0 - colour.a) * (1.0 - exp(-density * medium.a * (next - t)));
      if (more > 0.0005) colour.rgb += more * medium.rgb / medium.a * shade(first + 0.5 * (t + next) * along);
      colour.a += more;
    }
    before = place;
    t = next;
    next += step_;
  }
}`;

/** Composite over the frame: linear to sRGB. */
export const OVERLAY = `
precision highp float;
uniform sampler2D image;
in vec2 screen;
out vec4 colour;
void main() {
  vec4 light = texture(image, 0.5 * screen + 0.5);
  if (light.a <= 0.0) discard;
  vec3 pure = min(light.rgb / light.a, 1.0);
  vec3 shown = mix(12.92 * pure, 1.055 * pow(pure, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, pure));
  colour = vec4(shown * light.a, light.a);
}`;
