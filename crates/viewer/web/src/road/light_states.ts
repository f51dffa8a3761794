import { DataTexture, NearestFilter } from 'three';
import { rgb } from '../colour/palette.ts';

const TEXTURE_WIDTH = 1024;

/** The colours of the lamps, from the top of a signal to its foot. */
export const LAMP_COLOURS = [rgb('#ff3b30'), rgb('#ffb21a'), rgb('#27d07c')] as const;

/**
 * What each light shows, as a picture for shaders: the colour, and in the fourth part 255 for the top lamp, 254 for the middle one,
 * 253 for the lowest one and 0 for none.
 */
export class LightStates {
  readonly texture: DataTexture;
  letters = '';
  private readonly pixels: Uint8Array;

  constructor(count: number) {
    const rows = Math.max(Math.ceil(count / TEXTURE_WIDTH), 1);
    this.pixels = new Uint8Array(TEXTURE_WIDTH * rows * 4);
    this.texture = new DataTexture(this.pixels, TEXTURE_WIDTH, rows);
    this.texture.minFilter = NearestFilter;
    this.texture.magFilter = NearestFilter;
    this.texture.needsUpdate = true;
  }

  show(letters: string): void {
    if (letters === this.letters) return;
    this.letters = letters;
    for (let light = 0; light < letters.length; light += 1) {
      const lamp = 'ryg'.indexOf(letters[light]);
      const colour = lamp < 0 ? [0, 0, 0] : LAMP_COLOURS[lamp];
      for (let part = 0; part < 3; part += 1) this.pixels[light * 4 + part] = Math.round(colour[part] * 255);
      this.pixels[light * 4 + 3] = lamp < 0 ? 0 : 255 - lamp;
    }
    this.texture.needsUpdate = true;
  }
}

/** For shaders: reads the picture of the lights. `lampOf` is -1 where nothing is lit. */
export const LIGHT_STATES_CHUNK = /* glsl */ `
uniform sampler2D lightStates;
vec4 lightShown(float light) {
  int index = int(light + 0.5);
  return light < 0.0 ? vec4(0.0) : texelFetch(lightStates, ivec2(index % ${TEXTURE_WIDTH}, index / ${TEXTURE_WIDTH}), 0);
}
float lampOf(vec4 shown) {
  return shown.a == 0.0 ? -1.0 : round((1.0 - shown.a) * 255.0);
}
`;
