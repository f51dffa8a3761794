import { ColorManagement, LinearSRGBColorSpace, Scene as Graph, WebGLRenderer } from 'three';
import { Rig } from '../camera/rig.ts';
import { atmosphere } from './atmosphere.ts';
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

/** The picture: canvas, camera and sky. */
export class Stage {
  readonly graph = new Graph();
  readonly rig = new Rig();
  readonly renderer: WebGLRenderer;
  private readonly sky = new Sky();
  /** Metres that a pixel covers at a distance of one metre. */
  pixel = 0.001;
  /** How much of the window panels cover at the right and at the bottom, as shares of it; `covered` glides towards the goal. */
  private readonly covered = { right: 0, bottom: 0 };
  private readonly coveredGoal = { right: 0, bottom: 0 };

  constructor(readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: 'high-performance' });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.sortObjects = true;
    this.graph.matrixWorldAutoUpdate = true;
    this.graph.add(this.sky.mesh);
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  /** Shows what is looked at in the middle of what panels leave free. */
  leaveFree(right: number, bottom: number): void {
    Object.assign(this.coveredGoal, { right, bottom });
  }

  /** Moves the middle of the picture; it must go before the camera moves. */
  shiftMiddle(elapsed_s: number): void {
    const share = 1 - GLIDE ** elapsed_s;
    const { covered, coveredGoal: goal } = this;
    covered.right += (goal.right - covered.right) * share;
    covered.bottom += (goal.bottom - covered.bottom) * share;
    const { camera } = this.rig;
    camera.setViewOffset(camera.aspect, 1, (covered.right / 2) * camera.aspect, covered.bottom / 2, camera.aspect, 1);
  }

  draw(): void {
    const { camera, now } = this.rig;
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
    const { camera } = this.rig;
    camera.aspect = width / height;
    this.pixel = (2 * Math.tan((camera.fov * Math.PI) / 360)) / height;
    atmosphere.pixel.value = this.pixel * Math.max(height / LARGE_PIXELS, 1);
  }
}
