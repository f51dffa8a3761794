import type { SideAccount } from '../protocol/messages.ts';
import { drawn } from './dom.ts';
import { short } from './words.ts';

const ROW = 22;
const NAME_WIDTH = 104;
const VALUE_WIDTH = 62;
const WIDTH = 360;
const SUM = 'sum G';

/** The incentives for one side as horizontal bars around zero, with their sum and the threshold. */
export function incentiveChart(account: SideAccount): SVGSVGElement {
  const bars = account.rows.map(({ name, product, weight, yield: earning }) => ({
    name,
    value: product,
    title: `${name}: ${short(weight)} × ${short(earning)} = ${short(product)}`,
  }));
  const { gain, threshold } = account;
  if (gain !== null) bars.push({ name: SUM, value: gain, title: `G = ${short(gain)}` });
  const largest = Math.max(1e-6, ...bars.map(({ value }) => Math.abs(value)), Math.abs(threshold ?? 0) * 1.5);
  const from = NAME_WIDTH;
  const to = WIDTH - VALUE_WIDTH;
  const x = (value: number): number => from + ((value / largest + 1) / 2) * (to - from);
  const height = bars.length * ROW + 20;
  const chart = drawn('svg', {
    viewBox: `0 0 ${WIDTH} ${height}`,
    role: 'img',
    class: 'bars',
    'aria-label': `Incentives to the ${account.side}: ${bars.map(({ title }) => title).join('; ')}`,
  });
  bars.forEach(({ name, value, title }, index) => {
    const y = index * ROW;
    const isSum = name === SUM;
    const kind = isSum ? 'sum' : value < 0 ? 'against' : 'for';
    chart.append(
      drawn(
        'g',
        { 'data-name': name, 'data-side': account.side, 'data-value': value },
        drawn('title', {}, title),
        drawn('text', { x: NAME_WIDTH - 8, y: y + 15, class: isSum ? 'name strong' : 'name' }, name),
        drawn('rect', { x: Math.min(x(0), x(value)), y: y + 4, width: Math.abs(x(value) - x(0)), height: ROW - 8, class: `bar ${kind}` }),
        drawn('text', { x: WIDTH - 4, y: y + 15, class: isSum ? 'value strong' : 'value' }, short(value)),
      ),
    );
  });
  const foot = bars.length * ROW + 2;
  chart.append(drawn('line', { x1: x(0), x2: x(0), y1: 0, y2: foot, class: 'zero' }));
  if (threshold !== null) {
    chart.append(
      drawn('line', { x1: x(threshold), x2: x(threshold), y1: 0, y2: foot, class: 'threshold', 'data-threshold': threshold }),
      drawn('text', { x: x(threshold), y: foot + 14, class: 'threshold-name' }, `θ = ${short(threshold)}`),
    );
  }
  return chart;
}
