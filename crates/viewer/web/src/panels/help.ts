import { button, element } from './dom.ts';

type Key = readonly [key: string, what: string];

const GROUPS: readonly (readonly [title: string, keys: readonly Key[]])[] = [
  [
    'View',
    [
      ['Arrows, W A S D', 'move'],
      ['+  −', 'zoom'],
      ['Q  E', 'turn'],
      ['R  T', 'look down more, or less'],
      ['M', 'straight down, or aslant'],
      ['Home', 'the whole map'],
      ['N', 'day or night'],
      ['G', 'the twin of the traffic: as ghosts, side by side, not at all'],
    ],
  ],
  [
    'Time',
    [
      ['Space', 'play or pause'],
      ['.', 'one step'],
      ['[  ]', 'slower, faster'],
      [',  ;', 'to the mark before, to the next mark'],
    ],
  ],
  [
    'Vehicles',
    [
      ['Click', 'select a vehicle, a lane or a signal'],
      ['Enter', 'select what is in the middle'],
      ['Shift and click or Enter', 'compare with a second vehicle'],
      ['/', 'find a vehicle by its id'],
      ['F', 'follow the selected vehicle'],
      ['V', 'see what its driver sees'],
      ['Esc', 'select nothing'],
    ],
  ],
  [
    'By hand',
    [
      ['H', 'open or close the tools'],
      ['↑ ↓ ← →', 'while you drive: speed and lane'],
      ['Ctrl+Z', 'take back'],
    ],
  ],
  [
    'Mouse and fingers',
    [
      ['Drag, one finger', 'move'],
      ['Right button, Ctrl and drag, two fingers', 'turn and tilt'],
      ['Wheel, pinch', 'zoom'],
    ],
  ],
];

/** The list of all keys. */
export class Help {
  readonly root = element('dialog', { class: 'help', 'data-test': 'panel-help', 'aria-label': 'Keys' });

  constructor() {
    const groups = GROUPS.map(([title, keys]) =>
      element(
        'section',
        {},
        element('h3', {}, title),
        element('dl', {}, ...keys.flatMap(([key, what]) => [element('dt', {}, element('kbd', {}, key)), element('dd', {}, what)])),
      ),
    );
    this.root.append(
      element('h2', {}, 'Keys'),
      element('div', { class: 'help-groups' }, ...groups),
      element('div', { class: 'buttons' }, button('close-help', 'Close', 'Close the list of keys (Esc)', () => this.root.close())),
    );
  }

  toggle(): void {
    if (this.root.open) this.root.close();
    else this.root.showModal();
  }
}
