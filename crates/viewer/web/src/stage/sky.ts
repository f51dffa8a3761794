import { BufferAttribute, BufferGeometry, GLSL3, Matrix4, Mesh, ShaderMaterial, type PerspectiveCamera } from 'three';
import { atmosphere, LIGHT_CHUNK } from './atmosphere.ts';

const VERTEX = /* glsl */ `
uniform mat4 fromClip;
out vec3 way;
void main() {
  vec4 far = fromClip * vec4(position.xy, 1.0, 1.0);
  way = far.xyz / far.w;
  gl_Position = vec4(position.xy, 1.0, 1.0);
}
`;

const FRAGMENT = /* glsl */ `
${LIGHT_CHUNK}
in vec3 way;
out vec4 colour;
void main() {
  float up = normalize(way).z;
  colour = vec4(mix(fogColour, zenithColour, smoothstep(0.0, 0.6, up)), 1.0);
}
`;

/** The sky: one triangle behind everything. */
export class Sky {
  readonly mesh: Mesh;
  private readonly fromClip = new Matrix4();
  private readonly turn = new Matrix4();

  constructor() {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
    const material = new ShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: { ...atmosphere, fromClip: { value: this.fromClip } },
      depthWrite: false,
    });
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    // Last of all that is opaque, so that it is drawn only where nothing covers it.
    this.mesh.renderOrder = 20;
  }

  update(camera: PerspectiveCamera): void {
    this.turn.extractRotation(camera.matrixWorld);
    this.fromClip.multiplyMatrices(this.turn, camera.projectionMatrixInverse);
  }
}
