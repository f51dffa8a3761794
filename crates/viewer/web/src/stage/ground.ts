import { GLSL3, Mesh, PlaneGeometry, ShaderMaterial, Vector3 } from 'three';
import { atmosphere, LIGHT_CHUNK } from './atmosphere.ts';

const VERTEX = /* glsl */ `
uniform vec3 centre;
out vec2 place;
out float depth;
void main() {
  vec4 seen = viewMatrix * vec4(position + centre, 1.0);
  place = position.xy + centre.xy;
  depth = -seen.z;
  gl_Position = projectionMatrix * seen;
}
`;

const FRAGMENT = /* glsl */ `
${LIGHT_CHUNK}
in vec2 place;
in float depth;
out vec4 colour;

float grid(float spacing) {
  vec2 at = place / spacing;
  vec2 width = fwidth(at);
  vec2 line = 1.0 - smoothstep(vec2(0.0), width * 1.2, abs(fract(at - 0.5) - 0.5));
  float fade = 1.0 - smoothstep(0.05, 0.3, max(width.x, width.y));
  return max(line.x, line.y) * fade;
}

float chance(vec2 at) {
  return fract(sin(dot(at, vec2(127.1, 311.7))) * 43758.5453);
}

/** Soft blotches of about the size 1. */
float blotch(vec2 at) {
  vec2 cell = floor(at);
  vec2 inside = fract(at);
  inside = inside * inside * (3.0 - 2.0 * inside);
  float low = mix(chance(cell), chance(cell + vec2(1.0, 0.0)), inside.x);
  float high = mix(chance(cell + vec2(0.0, 1.0)), chance(cell + vec2(1.0, 1.0)), inside.x);
  return mix(low, high, inside.y);
}

void main() {
  float patches = 0.5 * blotch(place / 90.0) + 0.3 * blotch(place / 31.0) + 0.2 * blotch(place / 370.0);
  float seen = 1.0 - smoothstep(300.0, 3000.0, depth);
  vec3 day = mix(vec3(0.80, 0.845, 0.735), vec3(0.845, 0.865, 0.79), mix(0.5, patches, seen));
  vec3 base = mix(day, vec3(0.29, 0.33, 0.35) * (0.94 + 0.12 * mix(0.5, patches, seen)), night);
  vec3 tone = lit(base, vec3(0.0, 0.0, 1.0));
  tone *= 1.0 - 0.05 * grid(100.0) - 0.05 * grid(1000.0);
  colour = vec4(fogged(tone, depth), 1.0);
}
`;

const HALF_SIZE_M = 60_000;

/** The ground around the roads, with lines every 100 m and every kilometre. It moves along with the camera. */
export class Ground {
  readonly mesh: Mesh;
  private readonly centre = new Vector3();

  constructor(private readonly height: number) {
    const material = new ShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: { ...atmosphere, centre: { value: this.centre } },
      polygonOffset: true,
      polygonOffsetFactor: 2,
      polygonOffsetUnits: 8,
    });
    this.mesh = new Mesh(new PlaneGeometry(HALF_SIZE_M * 2, HALF_SIZE_M * 2, 32, 32), material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = -5;
  }

  update(x: number, y: number): void {
    this.centre.set(Math.round(x / 1000) * 1000, Math.round(y / 1000) * 1000, this.height);
  }
}
