import { Vector2, Vector3 } from 'three';
import { rgb } from '../colour/palette.ts';

/** What all shaders share: light, fog, and how large a pixel is. Colours are as they are shown, without a linear step. */
export const atmosphere = {
  sunDirection: { value: new Vector3(-0.45, -0.55, 0.7).normalize() },
  sunColour: { value: new Vector3() },
  skyColour: { value: new Vector3() },
  bounceColour: { value: new Vector3() },
  fogColour: { value: new Vector3() },
  zenithColour: { value: new Vector3() },
  fogRange: { value: new Vector2(1000, 4000) },
  /** 0 by day, 1 by night. */
  night: { value: 0 },
  /** Metres that a point covers at a distance of one metre: a pixel, or more on large screens. */
  pixel: { value: 0.001 },
  /** 1 while indicators are lit. */
  blink: { value: 0 },
};

interface Mood {
  sun: string;
  sky: string;
  bounce: string;
  fog: string;
  zenith: string;
}

const DAY: Mood = { sun: '#4d463a', sky: '#c4ccd4', bounce: '#8b8a85', fog: '#dfe8ee', zenith: '#86b3dc' };
const NIGHT: Mood = { sun: '#1d2430', sky: '#5f6c84', bounce: '#333a48', fog: '#141b28', zenith: '#05070d' };

/** Changes the light of everything. */
export function setNight(isNight: boolean): void {
  const mood = isNight ? NIGHT : DAY;
  atmosphere.sunColour.value.set(...rgb(mood.sun));
  atmosphere.skyColour.value.set(...rgb(mood.sky));
  atmosphere.bounceColour.value.set(...rgb(mood.bounce));
  atmosphere.fogColour.value.set(...rgb(mood.fog));
  atmosphere.zenithColour.value.set(...rgb(mood.zenith));
  atmosphere.night.value = isNight ? 1 : 0;
}

/** Functions for fragment shaders: `lit` and `fogged`. */
export const LIGHT_CHUNK = /* glsl */ `
uniform vec3 sunDirection, sunColour, skyColour, bounceColour, fogColour, zenithColour;
uniform vec2 fogRange;
uniform float night;

vec3 lit(vec3 colour, vec3 normal) {
  vec3 around = mix(bounceColour, skyColour, normal.z * 0.5 + 0.5);
  return colour * (around + sunColour * max(dot(normal, sunDirection), 0.0));
}

vec3 fogged(vec3 colour, float depth) {
  float share = clamp((depth - fogRange.x) / (fogRange.y - fogRange.x), 0.0, 1.0);
  return mix(colour, fogColour, share * share * (3.0 - 2.0 * share));
}
`;
