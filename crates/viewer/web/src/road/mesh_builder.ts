import { BufferAttribute, BufferGeometry } from 'three';

/** Collects vertices and triangles of one mesh. Each attribute has a fixed number of values for each vertex. */
export class MeshBuilder<Name extends string> {
  private readonly values: Record<Name, number[]>;
  private readonly indices: number[] = [];
  private count = 0;

  constructor(private readonly widths: Record<Name, number>) {
    this.values = Object.fromEntries(Object.keys(widths).map((name) => [name, []])) as unknown as Record<Name, number[]>;
  }

  /** Adds a vertex, and returns its number. */
  vertex(values: Record<Name, readonly number[]>): number {
    for (const name in this.widths) this.values[name].push(...values[name]);
    this.count += 1;
    return this.count - 1;
  }

  triangle(a: number, b: number, c: number): void {
    this.indices.push(a, b, c);
  }

  /** Adds two triangles; the corners run counter-clockwise. */
  quad(a: number, b: number, c: number, d: number): void {
    this.indices.push(a, b, c, a, c, d);
  }

  get vertexCount(): number {
    return this.count;
  }

  geometry(): BufferGeometry {
    const geometry = new BufferGeometry();
    for (const name in this.widths) {
      geometry.setAttribute(name, new BufferAttribute(new Float32Array(this.values[name]), this.widths[name]));
    }
    geometry.setIndex(this.indices);
    return geometry;
  }
}
