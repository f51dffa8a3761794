import { EVENT_LOOKS } from '../colour/events.ts';
import { PATTERNS, PHASES, styleColour, stylePattern } from '../colour/palette.ts';
import { gradient, HEAT_SCALES, VEHICLE_SCALES, type Scale } from '../colour/scales.ts';
import type { State } from '../state.ts';
import { drawn, element } from './dom.ts';
import { markDrawing } from './marks_panel.ts';

/** What colours, patterns and shapes mean. */
export class Legend {
  readonly root = element('section', { class: 'legend', 'data-test': 'legend', 'aria-label': 'What colours and marks mean' });

  constructor(private readonly state: State) {
    const update = () => this.update();
    state.hello.watch(update);
    state.colour.watch(update);
    state.heat.watch(update);
    state.showsChanges.watch(update);
  }

  private update(): void {
    const blocks = [this.vehicles(), ...this.lanes(), ...this.changes()];
    this.root.replaceChildren(...blocks);
  }

  private vehicles(): HTMLElement {
    const { value: colour } = this.state.colour;
    if (colour === 'style') {
      const names = this.state.hello.value?.styles.map(({ name }) => name) ?? [];
      if (names.length === 0) return list('Vehicles', [[roof(styleColour(0), stylePattern(0)), 'as they were recorded']]);
      return list('Driving style', names.map((name, style) => [roof(styleColour(style), stylePattern(style)), name]));
    }
    if (colour === 'state') {
      return list('State', PHASES.map((phase, index) => [roof(phase.colour, index), phase.name]));
    }
    const titles = { speed: 'Speed', desire: 'Desire of the better side', delay: 'Delay', since_change: 'Time since the last change', difference: 'Distance to its twin' };
    return scaleBlock(titles[colour], VEHICLE_SCALES[colour]);
  }

  private lanes(): HTMLElement[] {
    const { value: heat } = this.state.heat;
    const titles = { changes: 'Lanes: lane changes', speed: 'Lanes: speed', density: 'Lanes: density' };
    return heat === 'none' ? [] : [scaleBlock(titles[heat], HEAT_SCALES[heat])];
  }

  private changes(): HTMLElement[] {
    if (!this.state.showsChanges.value) return [];
    return [list('The last minute', Object.values(EVENT_LOOKS).map((look) => [markDrawing(look), look.name]))];
  }
}

function list(title: string, entries: [picture: Node, name: string][]): HTMLElement {
  const lines = entries.map(([picture, name]) => element('li', {}, picture, name));
  return element('div', { class: 'legend-block' }, element('h2', {}, title), element('ul', {}, ...lines));
}

function scaleBlock(title: string, { colours, labels, unit }: Scale): HTMLElement {
  return element(
    'div',
    { class: 'legend-block' },
    element('h2', {}, title),
    element('div', { class: 'ramp', style: `background: ${gradient(colours)}`, role: 'img', 'aria-label': `${labels.join(', ')} ${unit}` }),
    element('div', { class: 'ramp-labels' }, ...labels.map((label) => element('span', {}, label))),
    element('p', { class: 'soft' }, unit),
  );
}

/** The roof of a vehicle as the shader draws it, 24 by 12. */
function roof(colour: string, pattern: number): SVGSVGElement {
  const ink = isBright(colour) ? '#181a1f' : '#ffffff';
  const marks: Record<(typeof PATTERNS)[number], string> = {
    plain: '',
    stripe: 'M0 4.4H24V7.6H0Z',
    bars: 'M8.1 0H10.5V12H8.1ZM13.5 0H15.9V12H13.5Z',
    dot: 'M15.7 6A3.7 3.7 0 1 1 8.3 6A3.7 3.7 0 1 1 15.7 6Z',
    cross: 'M8 1L6.8 2.2L10.8 6L6.8 9.8L8 11L12 7.2L16 11L17.2 9.8L13.2 6L17.2 2.2L16 1L12 4.8Z',
    'two stripes': 'M0 2.3H24V4.2H0ZM0 7.8H24V9.7H0Z',
    chevron: 'M10.4 .9H13.4L17.5 6L13.4 11.1H10.4L14.5 6Z',
    frame: 'M0 0H24V12H0ZM2 2V10H22V2Z',
  };
  return drawn(
    'svg',
    { viewBox: '0 0 24 12', class: 'roof', 'aria-hidden': 'true' },
    drawn('rect', { width: 24, height: 12, rx: 1.5, fill: colour }),
    drawn('path', { d: marks[PATTERNS[pattern]], fill: ink, 'fill-rule': 'evenodd' }),
  );
}

function isBright(colour: string): boolean {
  const [red, green, blue] = [1, 3, 5].map((at) => Number.parseInt(colour.slice(at, at + 2), 16) / 255);
  return red * 0.3 + green * 0.6 + blue * 0.1 > 0.5;
}
