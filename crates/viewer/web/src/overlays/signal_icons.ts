import { Float32BufferAttribute, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, ShaderMaterial } from 'three';
import { LIGHT_STATES_CHUNK, type LightStates } from '../road/light_states.ts';
import type { SignalPlace } from '../road/signal_places.ts';
import { atmosphere } from '../stage/atmosphere.ts';

const VERTEX = /* glsl */ `
${LIGHT_STATES_CHUNK}
uniform float pixel;
in vec3 spot;
in float light;
out vec2 place;
out vec3 shownColour;
flat out float litLamp;
flat out float strength;
void main() {
  vec4 shown = lightShown(light);
  shownColour = shown.rgb;
  litLamp = lampOf(shown);
  vec4 seen = modelViewMatrix * vec4(spot, 1.0);
  float away = -seen.z;
  float small = 11.0 * pixel * away;
  float height = max(small, 0.8);
  // Near by, one sees the lamps of the signal itself, unless from above; far away, signs would cover the map.
  float fromAbove = smoothstep(0.65, 0.85, viewMatrix[2].z);
  strength = max(smoothstep(0.5, 0.8, small), fromAbove) * (1.0 - smoothstep(7.0, 10.0, small));
  // In front of the signal itself.
  seen.xyz *= 1.0 - 0.6 / away;
  seen.xy += position.xy * vec2(0.5, 1.0) * height + vec2(0.0, height * 0.4);
  place = position.xy;
  gl_Position = strength > 0.0 ? projectionMatrix * seen : vec4(2.0, 2.0, 2.0, 1.0);
}
`;

const FRAGMENT = /* glsl */ `
in vec2 place;
in vec3 shownColour;
flat in float litLamp;
flat in float strength;
out vec4 colour;
void main() {
  vec2 at = place * vec2(0.5, 1.0);
  vec2 out_ = abs(at) - vec2(0.28, 0.78);
  float body = 0.2 - length(max(out_, 0.0));
  if (body < 0.0) discard;
  vec3 tone = vec3(0.1, 0.11, 0.13);
  for (int lamp = 0; lamp < 3; lamp += 1) {
    float reach = length(at - vec2(0.0, 0.6 - 0.6 * float(lamp)));
    vec3 lampTone = float(lamp) == litLamp ? shownColour : vec3(0.24, 0.25, 0.27);
    tone = mix(tone, lampTone, 1.0 - smoothstep(0.24, 0.3, reach));
  }
  colour = vec4(tone, strength);
}
`;

/** Small signs above the signals, so that one sees from afar which lamp is lit. */
export function signalIcons(signals: SignalPlace[], lights: LightStates): Mesh {
  const geometry = new InstancedBufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  geometry.setAttribute('spot', new InstancedBufferAttribute(new Float32Array(signals.flatMap(({ head }) => head)), 3));
  geometry.setAttribute('light', new InstancedBufferAttribute(new Float32Array(signals.map(({ light }) => light)), 1));
  geometry.instanceCount = signals.length;
  const material = new ShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { ...atmosphere, lightStates: { value: lights.texture } },
    transparent: true,
    depthWrite: false,
  });
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.renderOrder = 3;
  mesh.visible = signals.length > 0;
  return mesh;
}
