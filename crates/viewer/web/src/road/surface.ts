import { DataTexture, GLSL3, Mesh, NearestFilter, ShaderMaterial } from 'three';
import type { Scene } from '../protocol/scene.ts';
import { rgb, type Rgb } from '../colour/palette.ts';
import { atmosphere, LIGHT_CHUNK } from '../stage/atmosphere.ts';
import { shown, SHOWN_CHUNK } from '../vehicles/shown.ts';
import { MeshBuilder } from './mesh_builder.ts';
import { pairs, stations } from './ribbon.ts';

const TEXTURE_WIDTH = 1024;
/** Asphalt beside the lanes. */
export const SHOULDER_M = 0.7;
export const SHOULDER_DROP_M = 0.03;
const NO_LANE = -1;
/** Opacities of the colours of lanes; above `CLOSED_FROM` a lane is hatched. */
const TINT_OPACITY = 190;
const MARKED_OPACITY = 110;
const CLOSED_OPACITY = 255;
/** Lanes for some vehicles only, such as buses. */
const RESTRICTED = rgb('#b0503c');
const RESTRICTED_OPACITY = 90;
/** The same where the twin does not have it. */
const CLOSED_IN_TRAFFIC_OPACITY = 245;

const VERTEX = /* glsl */ `
${SHOWN_CHUNK}
uniform sampler2D laneColours;
in float lane;
out vec2 place;
out float depth;
flat out vec4 tint;
flat out float isShoulder;
void main() {
  int index = int(lane + 0.5);
  isShoulder = lane < 0.0 ? 1.0 : 0.0;
  tint = lane < 0.0 ? vec4(0.0) : texelFetch(laneColours, ivec2(index % ${TEXTURE_WIDTH}, index / ${TEXTURE_WIDTH}), 0);
  int opacity = int(tint.a * 255.0 + 0.5);
  bool isOfTraffic = opacity == ${TINT_OPACITY} || opacity == ${CLOSED_IN_TRAFFIC_OPACITY};
  if (isOfTraffic && isLeftOut(false)) tint.a = 0.0;
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  place = position.xy;
  depth = -seen.z;
  gl_Position = projectionMatrix * seen;
}
`;

const FRAGMENT = /* glsl */ `
${LIGHT_CHUNK}
in vec2 place;
in float depth;
flat in vec4 tint;
flat in float isShoulder;
out vec4 colour;

float speckle(vec2 at) {
  return fract(sin(dot(floor(at), vec2(12.9898, 78.233))) * 43758.5453);
}

void main() {
  vec3 asphalt = mix(vec3(0.375, 0.39, 0.415), vec3(0.235, 0.25, 0.28), night) * (1.0 - 0.06 * isShoulder);
  float near = 1.0 - smoothstep(20.0, 90.0, depth);
  asphalt *= 1.0 + near * 0.05 * (speckle(mod(place, 512.0) * 5.0) - 0.5);
  float stripes = smoothstep(0.45, 0.55, abs(fract((place.x + place.y) / 4.0) - 0.5) * 2.0);
  float isClosed = step(0.9, tint.a);
  float share = mix(tint.a, stripes * 0.8, isClosed);
  vec3 tone = lit(mix(asphalt, tint.rgb, share), vec3(0.0, 0.0, 1.0));
  colour = vec4(fogged(tone, depth), 1.0);
}
`;

type Builder = MeshBuilder<'position' | 'lane'>;

/** The surface of all lanes in one mesh. Each lane can be tinted, for heat maps and for what is selected or closed. */
export class RoadSurface {
  readonly mesh: Mesh;
  private readonly pixels: Uint8Array;
  private readonly texture: DataTexture;

  constructor(private readonly scene: Scene) {
    const count = Math.max(scene.lanelets.length, 1);
    const rows = Math.ceil(count / TEXTURE_WIDTH);
    this.pixels = new Uint8Array(TEXTURE_WIDTH * rows * 4);
    this.texture = new DataTexture(this.pixels, TEXTURE_WIDTH, rows);
    this.texture.minFilter = NearestFilter;
    this.texture.magFilter = NearestFilter;
    this.texture.needsUpdate = true;
    const material = new ShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: { ...atmosphere, ...shown, laneColours: { value: this.texture } },
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 4,
    });
    this.mesh = new Mesh(surfaceGeometry(scene), material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = -4;
    this.clear();
  }

  clear(): void {
    this.pixels.fill(0);
    this.texture.needsUpdate = true;
    this.scene.lanelets.forEach(({ only_for }, index) => {
      if (only_for !== null) this.write(index, RESTRICTED, RESTRICTED_OPACITY);
    });
  }

  tint(lanelet: number, colour: Rgb): void {
    this.write(lanelet, colour, TINT_OPACITY);
  }

  mark(lanelet: number, colour: Rgb): void {
    this.write(lanelet, colour, MARKED_OPACITY);
  }

  close(lanelet: number, colour: Rgb, isClosedInTwin: boolean): void {
    this.write(lanelet, colour, isClosedInTwin ? CLOSED_OPACITY : CLOSED_IN_TRAFFIC_OPACITY);
  }

  private write(lanelet: number, colour: Rgb, opacity: number): void {
    for (let part = 0; part < 3; part += 1) this.pixels[lanelet * 4 + part] = Math.round(colour[part] * 255);
    this.pixels[lanelet * 4 + 3] = opacity;
    this.texture.needsUpdate = true;
  }
}

function surfaceGeometry(scene: Scene) {
  const builder: Builder = new MeshBuilder({ position: 3, lane: 1 });
  const strips = scene.lanelets.map((lanelet) => pairs(stations(lanelet.left), stations(lanelet.right)));
  for (const strip of strips) addStrip(builder, strip, NO_LANE, SHOULDER_M, SHOULDER_DROP_M);
  strips.forEach((strip, index) => addStrip(builder, strip, index, 0, 0));
  return builder.geometry();
}

function addStrip(builder: Builder, strip: ReturnType<typeof pairs>, lane: number, wider: number, lower: number): void {
  let before: [number, number] | null = null;
  for (const [left, right] of strip) {
    const width = Math.max(Math.hypot(left.x - right.x, left.y - right.y), 1e-3);
    const outX = ((left.x - right.x) / width) * wider;
    const outY = ((left.y - right.y) / width) * wider;
    const here: [number, number] = [
      builder.vertex({ position: [left.x + outX, left.y + outY, left.z - lower], lane: [lane] }),
      builder.vertex({ position: [right.x - outX, right.y - outY, right.z - lower], lane: [lane] }),
    ];
    if (before) builder.quad(before[0], before[1], here[1], here[0]);
    before = here;
  }
}
