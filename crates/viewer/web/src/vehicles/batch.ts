import {
  DynamicDrawUsage,
  InstancedBufferGeometry,
  InstancedInterleavedBuffer,
  InterleavedBufferAttribute,
  Mesh,
  type BufferGeometry,
  type ShaderMaterial,
} from 'three';

/** The two records of a vehicle, and its size. */
export const INSTANCE_WORDS = 9;

/** Vehicles of one form, drawn by one call. */
export class Batch {
  readonly mesh: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  count = 0;
  private words: Uint32Array<ArrayBuffer>;
  private buffer: InstancedInterleavedBuffer;

  constructor(form: BufferGeometry, material: ShaderMaterial) {
    const geometry = new InstancedBufferGeometry();
    geometry.index = form.index;
    for (const name of Object.keys(form.attributes)) geometry.setAttribute(name, form.attributes[name]);
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.words = new Uint32Array(64 * INSTANCE_WORDS);
    this.buffer = this.attach();
  }

  clear(): void {
    this.count = 0;
  }

  /** Adds a vehicle; `earlier` and `later` are where its records begin. */
  add(before: Uint32Array, earlier: number, after: Uint32Array, later: number, size: number): void {
    if ((this.count + 1) * INSTANCE_WORDS > this.words.length) this.grow();
    const words = this.words;
    const at = this.count * INSTANCE_WORDS;
    words[at] = before[earlier];
    words[at + 1] = before[earlier + 1];
    words[at + 2] = before[earlier + 2];
    words[at + 3] = before[earlier + 3];
    words[at + 4] = after[later];
    words[at + 5] = after[later + 1];
    words[at + 6] = after[later + 2];
    words[at + 7] = after[later + 3];
    words[at + 8] = size;
    this.count += 1;
  }

  /** Sends what was added to the graphics card. */
  send(): void {
    this.mesh.visible = this.count > 0;
    this.mesh.geometry.instanceCount = this.count;
    this.buffer.clearUpdateRanges();
    this.buffer.addUpdateRange(0, this.count * INSTANCE_WORDS);
    this.buffer.needsUpdate = true;
  }

  private grow(): void {
    const grown = new Uint32Array(this.words.length * 2);
    grown.set(this.words);
    this.words = grown;
    this.mesh.geometry.dispose();
    this.buffer = this.attach();
  }

  private attach(): InstancedInterleavedBuffer {
    const buffer = new InstancedInterleavedBuffer(this.words, INSTANCE_WORDS, 1);
    buffer.setUsage(DynamicDrawUsage);
    const { geometry } = this.mesh;
    geometry.setAttribute('before', new InterleavedBufferAttribute(buffer, 4, 0));
    geometry.setAttribute('after', new InterleavedBufferAttribute(buffer, 4, 4));
    geometry.setAttribute('size', new InterleavedBufferAttribute(buffer, 1, 8));
    return buffer;
  }
}
