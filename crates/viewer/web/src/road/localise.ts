import type { Line, Point, Scene } from '../protocol/scene.ts';

/**
 * The same scene measured from the middle of its bounds, so that numbers of single precision are exact enough everywhere on a large
 * map. Its `origin` is the point of the map at which the page has its zero.
 */
export function localise(scene: Scene): Scene {
  const [x0, y0, x1, y1] = scene.bounds;
  const middle: Point = [(x0 + x1) / 2, (y0 + y1) / 2, 0];
  const point = ([x, y, z]: Point): Point => [x - middle[0], y - middle[1], z];
  const line = (values: Line): Line => values.map((value, index) => value - middle[index % 3]);
  return {
    ...scene,
    origin: [scene.origin[0] + middle[0], scene.origin[1] + middle[1], scene.origin[2]],
    bounds: [x0 - middle[0], y0 - middle[1], x1 - middle[0], y1 - middle[1]],
    lanelets: scene.lanelets.map((lanelet) => ({
      ...lanelet,
      left: line(lanelet.left),
      right: line(lanelet.right),
      centre: line(lanelet.centre),
    })),
    markings: scene.markings.map((marking) => ({ ...marking, line: line(marking.line) })),
    crosswalks: scene.crosswalks.map(line),
    stop_lines: scene.stop_lines.map((stop) => ({ ...stop, line: line(stop.line) })),
    lights: scene.lights.map((light) => ({ ...light, at: light.at.map(point) })),
    entrances: scene.entrances.map((gate) => ({ ...gate, at: point(gate.at) })),
    exits: scene.exits.map((gate) => ({ ...gate, at: point(gate.at) })),
  };
}
