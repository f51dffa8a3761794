import { GLSL3, Mesh, ShaderMaterial } from 'three';
import type { Scene } from '../protocol/scene.ts';
import { MeshBuilder } from '../road/mesh_builder.ts';
import { stations } from '../road/ribbon.ts';
import { atmosphere, LIGHT_CHUNK } from '../stage/atmosphere.ts';

const EVERY_M = 40;
const LIFT_M = 0.03;
/** An arrow on the road: ahead and to the left, in metres. */
const OUTLINE = [
  [-2, 0.1],
  [-2, -0.1],
  [0.6, -0.1],
  [0.6, 0.1],
  [0.5, 0.5],
  [0.5, -0.5],
  [2, 0],
] as const;

const VERTEX = /* glsl */ `
out float depth;
void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  depth = -seen.z;
  gl_Position = projectionMatrix * seen;
}
`;

const FRAGMENT = /* glsl */ `
${LIGHT_CHUNK}
in float depth;
out vec4 colour;
void main() {
  colour = vec4(fogged(lit(vec3(0.97, 0.98, 0.95), vec3(0.0, 0.0, 1.0)), depth), 0.85);
}
`;

/** Arrows that tell in which direction lanes are driven; where lanes cross one could not read them. */
export function arrowsMesh(scene: Scene): Mesh {
  const builder = new MeshBuilder({ position: 3 });
  for (const { centre, is_conflict } of scene.lanelets) {
    if (is_conflict) continue;
    const points = stations(centre);
    const length = points.at(-1)?.along ?? 0;
    const count = Math.max(Math.round(length / EVERY_M), 1);
    for (let index = 0; index < count; index += 1) {
      const along = (length * (index + 0.5)) / count;
      const after = points.findIndex((point) => point.along >= along);
      if (after < 1) continue;
      const [from, to] = [points[after - 1], points[after]];
      const share = (along - from.along) / (to.along - from.along);
      const [dx, dy] = [(to.x - from.x) / (to.along - from.along), (to.y - from.y) / (to.along - from.along)];
      const [x, y, z] = [from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share, from.z + (to.z - from.z) * share];
      const corners = OUTLINE.map(([ahead, left]) =>
        builder.vertex({ position: [x + dx * ahead - dy * left, y + dy * ahead + dx * left, z + LIFT_M] }),
      );
      builder.quad(corners[0], corners[1], corners[2], corners[3]);
      builder.triangle(corners[4], corners[5], corners[6]);
    }
  }
  const material = new ShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { ...atmosphere },
    transparent: true,
    depthWrite: false,
    side: 2,
    polygonOffset: true,
    polygonOffsetFactor: -2,
    polygonOffsetUnits: -6,
  });
  const mesh = new Mesh(builder.geometry(), material);
  mesh.frustumCulled = false;
  mesh.renderOrder = -2;
  return mesh;
}
