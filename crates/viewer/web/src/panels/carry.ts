import type { VehicleClass } from '../protocol/messages.ts';
import type { State } from '../state.ts';
import type { TrafficView } from '../traffic_view.ts';
import { element, say } from './dom.ts';
import type { VehicleActions } from './vehicle_actions.ts';

/** A vehicle that is dragged from its button onto the road. Where it is dropped the server puts it, and the user drives it. */
export class Carry {
  readonly root = element('div', { class: 'carried', 'aria-hidden': 'true' });

  constructor(
    private readonly state: State,
    actions: VehicleActions,
    private readonly view: () => TrafficView | null,
  ) {
    this.root.hidden = true;
    state.put.listen((vehicle) => {
      state.select(vehicle, false);
      actions.take(vehicle);
    });
    window.addEventListener('pointermove', (event) => this.move(event.clientX, event.clientY));
    window.addEventListener('pointerup', (event) => this.drop(event));
    window.addEventListener('pointercancel', () => state.carried.set(null));
    state.carried.watch((form) => {
      this.root.hidden = true;
      say(this.root, form ?? '');
    });
  }

  /** Puts a vehicle on the road at a place of the window. */
  put(form: VehicleClass, x: number, y: number): void {
    const view = this.view();
    const point = view?.ground(x, y);
    if (!view || !point) return;
    const [ox, oy] = view.scene.origin;
    this.state.say({ hand: { put: { x: point.x + ox, y: point.y + oy, class: form } } });
  }

  private move(x: number, y: number): void {
    if (this.state.carried.value === null) return;
    this.root.hidden = false;
    this.root.style.transform = `translate(${x}px, ${y}px)`;
  }

  private drop(event: PointerEvent): void {
    const { value: form } = this.state.carried;
    if (form === null) return;
    this.state.carried.set(null);
    const isOnRoad = document.elementFromPoint(event.clientX, event.clientY)?.tagName === 'CANVAS';
    if (isOnRoad) this.put(form, event.clientX, event.clientY);
  }
}
