export interface GestureTarget {
  /** Moves the ground by pixels. */
  drag(dx: number, dy: number): void;
  turn(dx: number, dy: number): void;
  zoom(factor: number, x: number, y: number): void;
  click(x: number, y: number, isSecond: boolean): void;
}

const CLICK_PIXELS = 5;
const WHEEL_SPEED = 0.0014;

/** Mouse, pen and fingers on the picture: one drags, two zoom and turn, a short touch selects. */
export function listenToGestures(canvas: HTMLElement, target: GestureTarget): void {
  const pointers = new Map<number, { x: number; y: number }>();
  let moved = 0;
  let most = 0;
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    moved = pointers.size > 1 ? Infinity : 0;
    most = pointers.size;
  });
  canvas.addEventListener('pointermove', (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const [dx, dy] = [event.clientX - last.x, event.clientY - last.y];
    if (pointers.size === 1) {
      moved += Math.abs(dx) + Math.abs(dy);
      if (moved > CLICK_PIXELS) {
        const turns = (event.buttons & 6) !== 0 || event.ctrlKey || event.altKey;
        if (turns) target.turn(dx, dy);
        else target.drag(dx, dy);
      }
    } else if (pointers.size === 2) {
      pinch(pointers, event, target);
    }
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  const end = (event: PointerEvent) => {
    if (!pointers.delete(event.pointerId)) return;
    if (event.type === 'pointerup' && moved <= CLICK_PIXELS && most === 1 && event.button === 0) {
      target.click(event.clientX, event.clientY, event.shiftKey);
    }
  };
  canvas.addEventListener('pointerup', end);
  canvas.addEventListener('pointercancel', end);
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      const pixels = event.deltaMode === 1 ? event.deltaY * 30 : event.deltaY;
      target.zoom(Math.exp(pixels * WHEEL_SPEED), event.clientX, event.clientY);
    },
    { passive: false },
  );
}

function pinch(pointers: Map<number, { x: number; y: number }>, event: PointerEvent, target: GestureTarget): void {
  const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
  const last = pointers.get(event.pointerId);
  if (!other || !last) return;
  const before = { x: last.x - other.x, y: last.y - other.y };
  const after = { x: event.clientX - other.x, y: event.clientY - other.y };
  const factor = Math.hypot(before.x, before.y) / Math.max(Math.hypot(after.x, after.y), 1);
  target.zoom(factor, (event.clientX + other.x) / 2, (event.clientY + other.y) / 2);
  const turned = Math.atan2(after.y, after.x) - Math.atan2(before.y, before.x);
  const short = Math.atan2(Math.sin(turned), Math.cos(turned));
  // Two fingers that move up together tilt the view.
  target.turn((-short * 180) / 0.9, (event.clientY - last.y) / 4);
  target.drag((event.clientX - last.x) / 2, 0);
}
