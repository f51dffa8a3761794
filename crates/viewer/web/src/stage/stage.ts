import { ColorManagement, LinearSRGBColorSpace, Scene as Graph, WebGLRenderer } from 'three';
import { Rig } from '../camera/rig.ts';
import type { Shown } from '../vehicles/shown.ts';
import { atmosphere } from './atmosphere.ts';
import { halves, holds, type Covered, type Half, type Rectangle } from './halves.ts';
import { Sky } from './sky.ts';

const MOST_PIXELS_PER_POINT = 2;
/** A window that is higher than this shows small things larger. */
const LARGE_PIXELS = 1000;
/** Share of the way to its goal that is left after a second, for the middle of the picture. */
const GLIDE = 1e-3;
/** A picture with more pixels than this is drawn smaller and stretched. */
const MOST_PIXELS = 9_000_000;

// Shaders get and give colours as they are shown.
ColorManagement.enabled = false;

/** What bars and panels cover, and how much of it is a sheet at the bottom of a narrow window. A whole picture goes on behind the bars. */
export interface CoveredByPanels extends Covered {
  sheet: number;
}

const NOTHING: CoveredByPanels = { top: 0, right: 0, bottom: 0, sheet: 0 };

/** The picture: canvas, camera and sky. */
export class Stage {
  readonly graph = new Graph();
  readonly rig = new Rig();
  readonly renderer: WebGLRenderer;
  private readonly sky = new Sky();
  /** Metres that a pixel covers at a distance of one metre. */
  pixel = 0.001;
  /** What panels cover; `covered` glides towards the goal. */
  private readonly covered = { ...NOTHING };
  private readonly coveredGoal = { ...NOTHING };
  /** The parts of the window for the traffic and its twin, while they are side by side. */
  halves: [Half, Half] | null = null;

  constructor(readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: 'high-performance' });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.sortObjects = true;
    this.renderer.info.autoReset = false;
    this.graph.matrixWorldAutoUpdate = true;
    this.graph.add(this.sky.mesh);
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  /** Shows what is looked at in the middle of what panels leave free. */
  leaveFree(covered: CoveredByPanels): void {
    Object.assign(this.coveredGoal, covered);
  }

  /** Moves the middle of the picture, or of its halves; it must go before the camera moves. */
  lay(elapsed_s: number, isHalved: boolean): void {
    const share = 1 - GLIDE ** elapsed_s;
    const { covered, coveredGoal: goal } = this;
    for (const edge of ['top', 'right', 'bottom', 'sheet'] as const) covered[edge] += (goal[edge] - covered[edge]) * share;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.halves = isHalved ? halves(width, height, covered) : null;
    const [first] = this.halves ?? [];
    this.pixel = (2 * Math.tan((this.rig.camera.fov * Math.PI) / 360)) / (first?.free.height ?? height);
    atmosphere.pixel.value = this.pixel * Math.max(height / LARGE_PIXELS, 1);
    this.aim(first ?? null);
  }

  /** Turns the camera to a half of the window, or to all of it: what is looked at is in the middle of what is free there. */
  aim(half: Half | null): void {
    const { camera } = this.rig;
    if (half) {
      const { picture, free } = half;
      camera.setViewOffset(free.width, free.height, picture.x - free.x, picture.y - free.y, picture.width, picture.height);
      return;
    }
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const { right, sheet } = this.covered;
    camera.setViewOffset(width, height, right / 2, sheet / 2, width, height);
  }

  /** Draws the picture, or its halves. `prepare` is told before what each shows. */
  draw(prepare: (shown: Shown) => void): void {
    this.renderer.info.reset();
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!this.halves) {
      prepare('all');
      this.drawIn({ x: 0, y: 0, width, height }, height);
      return;
    }
    this.halves.forEach((half, index) => {
      prepare(index === 0 ? 'traffic' : 'twin');
      this.aim(half);
      this.drawIn(half.picture, height);
    });
  }

  /** A place of the window as a place of the picture that is there, from -1 to 1, after the camera was turned to it. */
  placeInPicture(x: number, y: number): [across: number, up: number] {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    const half = this.halves?.[this.isInTwin(x, y) ? 1 : 0] ?? null;
    this.aim(half);
    const picture = half?.picture ?? { x: 0, y: 0, width, height };
    return [((x - left - picture.x) / picture.width) * 2 - 1, 1 - ((y - top - picture.y) / picture.height) * 2];
  }

  /** Whether a place of the window is in the picture of the twin. */
  isInTwin(x: number, y: number): boolean {
    const { left, top } = this.canvas.getBoundingClientRect();
    return this.halves !== null && holds(this.halves[1].picture, x - left, y - top);
  }

  /** The results of a look at each picture, after the camera was turned to it. */
  eachPicture<Result>(look: () => Result): Result[] {
    return (this.halves ?? [null]).map((half) => {
      this.aim(half);
      return look();
    });
  }

  /** The middle of the picture of the traffic, in the window. */
  middle(): [x: number, y: number] {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    const free = this.halves?.[0].free ?? { x: 0, y: 0, width, height };
    return [left + free.x + free.width / 2, top + free.y + free.height / 2];
  }

  private drawIn({ x, y, width, height }: Rectangle, whole: number): void {
    const { camera, now } = this.rig;
    const fromBelow = whole - y - height;
    this.renderer.setViewport(x, fromBelow, width, height);
    this.renderer.setScissor(x, fromBelow, width, height);
    this.renderer.setScissorTest(this.halves !== null);
    this.sky.update(camera);
    atmosphere.fogRange.value.set(Math.max(now.distance * 2.2, 900), Math.max(now.distance * 9, 5500));
    this.renderer.render(this.graph, camera);
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    const sharpness = Math.min(devicePixelRatio, MOST_PIXELS_PER_POINT, Math.sqrt(MOST_PIXELS / (width * height)));
    this.renderer.setPixelRatio(sharpness);
    this.renderer.setSize(width, height, false);
    this.rig.camera.aspect = width / height;
  }
}
