import { DoubleSide, Group, Mesh, MeshBasicMaterial, RingGeometry } from 'three';
import { atmosphere } from '../stage/atmosphere.ts';
import type { Placed } from '../traffic/traffic.ts';

const COLOURS = [0x2f86ff, 0xe0338f];
const LEAST_PIXELS = 13;

/** A ring around each selected vehicle: the first one is whole, the second one has gaps. */
export class Selection {
  readonly group = new Group();
  private readonly rings: Mesh[];

  constructor() {
    this.rings = COLOURS.map((color, index) => {
      const parts = index === 0 ? Math.PI * 2 : Math.PI * 1.6;
      const material = new MeshBasicMaterial({ color, side: DoubleSide, depthTest: false, transparent: true, opacity: 0.95 });
      const ring = new Mesh(new RingGeometry(0.86, 1, 48, 1, 0, parts), material);
      ring.renderOrder = 5;
      ring.visible = false;
      this.group.add(ring);
      return ring;
    });
  }

  update(vehicles: (Placed | null)[], distance: number): void {
    this.rings.forEach((ring, index) => {
      const vehicle = vehicles[index];
      ring.visible = Boolean(vehicle);
      if (!vehicle) return;
      ring.position.set(vehicle.x, vehicle.y, vehicle.z + 0.1);
      ring.rotation.z = vehicle.heading + 0.6;
      ring.scale.setScalar(Math.max(vehicle.length * 0.5 + 1.4, LEAST_PIXELS * atmosphere.pixel.value * distance));
    });
  }
}
