/** A rectangle of the window in its pixels, from its left upper corner. */
export interface Rectangle {
  x: number;
  y: number;
  width: number;
  height: number;
}

/** One of two pictures: what it fills, and the part of it that no panel covers. */
export interface Half {
  picture: Rectangle;
  free: Rectangle;
}

/** What panels cover at the edges of the window, in pixels. */
export interface Covered {
  top: number;
  right: number;
  bottom: number;
}

const LEAST = 40;

/** Halves what panels leave free: side by side in a wide window, one above the other in a narrow one. Both free parts are equally large. */
export function halves(width: number, height: number, covered: Covered): [Half, Half] {
  const free = {
    x: 0,
    y: covered.top,
    width: Math.max(width - covered.right, 2 * LEAST),
    height: Math.max(height - covered.top - covered.bottom, 2 * LEAST),
  };
  if (free.width >= free.height) {
    const middle = Math.round(free.width / 2);
    const part = { ...free, width: free.width / 2 };
    return [
      { picture: { x: 0, y: 0, width: middle, height }, free: part },
      { picture: { x: middle, y: 0, width: width - middle, height }, free: { ...part, x: part.width } },
    ];
  }
  const middle = Math.round(free.y + free.height / 2);
  const part = { ...free, height: free.height / 2 };
  return [
    { picture: { x: 0, y: 0, width, height: middle }, free: part },
    { picture: { x: 0, y: middle, width, height: height - middle }, free: { ...part, y: part.y + part.height } },
  ];
}

export const holds = ({ x, y, width, height }: Rectangle, px: number, py: number): boolean =>
  px >= x && px < x + width && py >= y && py < y + height;
