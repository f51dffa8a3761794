import { DataTexture, GLSL3, LinearFilter, LinearMipmapLinearFilter, Mesh, RepeatWrapping, ShaderMaterial, type BufferGeometry } from 'three';
import { MeshBuilder } from '../road/mesh_builder.ts';
import type { Terrain } from '../road/terrain.ts';
import { atmosphere, LIGHT_CHUNK } from './atmosphere.ts';

const VERTEX = /* glsl */ `
out vec2 place;
out vec3 spot;
out float depth;
void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  place = position.xy;
  spot = position;
  depth = -seen.z;
  gl_Position = projectionMatrix * seen;
}
`;

const FRAGMENT = /* glsl */ `
${LIGHT_CHUNK}
uniform sampler2D noise;
in vec2 place;
in vec3 spot;
in float depth;
out vec4 colour;

float grid(float spacing) {
  vec2 at = place / spacing;
  vec2 width = fwidth(at);
  vec2 line = 1.0 - smoothstep(vec2(0.0), width * 1.2, abs(fract(at - 0.5) - 0.5));
  float fade = 1.0 - smoothstep(0.05, 0.3, max(width.x, width.y));
  return max(line.x, line.y) * fade;
}

void main() {
  float patches = 0.6 * texture(noise, place / 2900.0).r + 0.4 * texture(noise, place / 830.0).r;
  float seen = 1.0 - smoothstep(300.0, 3000.0, depth);
  vec3 day = mix(vec3(0.80, 0.845, 0.735), vec3(0.845, 0.865, 0.79), mix(0.5, patches, seen));
  vec3 base = mix(day, vec3(0.29, 0.33, 0.35) * (0.94 + 0.12 * mix(0.5, patches, seen)), night);
  vec3 slope = normalize(cross(dFdx(spot), dFdy(spot)));
  vec3 tone = lit(base, slope.z < 0.0 ? -slope : slope);
  tone *= 1.0 - 0.05 * grid(100.0) - 0.05 * grid(1000.0);
  colour = vec4(fogged(tone, depth), 1.0);
}
`;

const NOISE_SIZE = 32;
/** How far the ground goes on beyond the grid, in rings of growing width. */
const RINGS_M = [2000, 6000, 15_000, 30_000, 60_000];

/** The ground around the roads, with lines every 100 m and every kilometre. */
export function groundMesh(terrain: Terrain): Mesh {
  const material = new ShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { ...atmosphere, noise: { value: noiseTexture() } },
    polygonOffset: true,
    polygonOffsetFactor: 2,
    polygonOffsetUnits: 8,
  });
  const mesh = new Mesh(groundGeometry(terrain), material);
  mesh.frustumCulled = false;
  mesh.renderOrder = -5;
  return mesh;
}

/** Grey values by chance, always the same ones. */
function noiseTexture(): DataTexture {
  const bytes = new Uint8Array(NOISE_SIZE * NOISE_SIZE * 4);
  let state = 1;
  for (let at = 0; at < bytes.length; at += 4) {
    state = (state * 16_807) % 2_147_483_647;
    bytes.fill(state & 255, at, at + 4);
  }
  const texture = new DataTexture(bytes, NOISE_SIZE, NOISE_SIZE);
  texture.wrapS = RepeatWrapping;
  texture.wrapT = RepeatWrapping;
  texture.magFilter = LinearFilter;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.generateMipmaps = true;
  texture.needsUpdate = true;
  return texture;
}

/** The grid, and around it rings with the heights of its rim. */
function groundGeometry({ xs, ys, heights }: Terrain): BufferGeometry {
  const builder = new MeshBuilder({ position: 3 });
  const wideXs = withRings(xs);
  const wideYs = withRings(ys);
  wideYs.forEach((y, j) => {
    const row = Math.min(Math.max(j - RINGS_M.length, 0), ys.length - 1);
    wideXs.forEach((x, i) => {
      const column = Math.min(Math.max(i - RINGS_M.length, 0), xs.length - 1);
      builder.vertex({ position: [x, y, heights[row * xs.length + column]] });
    });
  });
  const columns = wideXs.length;
  for (let j = 0; j + 1 < wideYs.length; j += 1) {
    for (let i = 0; i + 1 < columns; i += 1) {
      const corner = j * columns + i;
      builder.quad(corner, corner + 1, corner + columns + 1, corner + columns);
    }
  }
  return builder.geometry();
}

const withRings = (axis: number[]): number[] => [
  ...RINGS_M.toReversed().map((way) => axis[0] - way),
  ...axis,
  ...RINGS_M.map((way) => axis[axis.length - 1] + way),
];
