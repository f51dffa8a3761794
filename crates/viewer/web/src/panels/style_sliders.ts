import type { Parameter, Style } from '../protocol/messages.ts';
import { element } from './dom.ts';
import type { SettingSliders } from './setting_sliders.ts';

interface Table {
  name: string;
  parameters: Parameter[];
}

/** The table of a key, which is all before its last dot. */
const tableOf = (key: string): string => key.slice(0, Math.max(key.lastIndexOf('.'), 0));

const isIncentive = ({ key }: Parameter): boolean => key.endsWith('.weight');

/** The tables of a style, in the order of their first keys. */
function tables(parameters: Parameter[]): Table[] {
  const found = new Map<string, Parameter[]>();
  for (const parameter of parameters) {
    const name = tableOf(parameter.key);
    const table = found.get(name);
    if (table) table.push(parameter);
    else found.set(name, [parameter]);
  }
  return [...found].map(([name, inside]) => ({ name, parameters: inside }));
}

/** Sliders for all numbers of a style: the weights of its incentives, then the other tables, folded. */
export function styleSliders(style: Style, sliders: SettingSliders): HTMLElement {
  const slider = ({ key, unit, value, minimum, maximum }: Parameter, label: string): Node => {
    const marks = { 'data-style': style.name, 'data-key': key };
    const set = (chosen: number) => ({ set_parameter: { style: style.name, parameter: key, value: chosen } });
    return sliders.add({ label, unit, value, minimum, maximum, marks }, set);
  };
  const weights = style.parameters.filter(isIncentive);
  const others = tables(style.parameters.filter((parameter) => !isIncentive(parameter)));
  const folded = others.map(({ name, parameters }) =>
    element(
      'details',
      {},
      element('summary', {}, name === '' ? 'general' : name),
      ...parameters.map((parameter) => slider(parameter, parameter.key.slice(parameter.key.lastIndexOf('.') + 1).replaceAll('_', ' '))),
    ),
  );
  return element(
    'div',
    { class: 'sliders' },
    element('p', { class: 'soft' }, style.description),
    weights.length > 0 ? element('h4', {}, 'Weights of the incentives') : null,
    ...weights.map((parameter) => slider(parameter, tableOf(parameter.key).split('.').at(-1) ?? parameter.key)),
    ...folded,
  );
}
