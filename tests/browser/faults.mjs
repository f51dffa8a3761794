// What can be wrong in the look of a page, found in the page itself: the browser runs these functions.

/** What is common to two boxes is at most this [px]. */
const TOLERANCE = 1;
const LEAST_CONTRAST = 4.5;
/** Of texts in a picture within a page [px]; a picture alone is enlarged by whoever wants to read it. */
const LEAST_SIZE = 8;

const shown = (it) => it.getClientRects().length > 0 && getComputedStyle(it).visibility !== 'hidden';
const words = (it) => it.textContent.trim().replace(/\s+/g, ' ').slice(0, 40);
const meet = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > TOLERANCE
  && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > TOLERANCE;

/** Which of these boxes, each with its text, lie on each other. */
function overlapping(boxes, where) {
  const found = [];
  boxes.sort((a, b) => a.box.top - b.box.top);
  boxes.forEach(({ box, text, of }, index) => {
    for (let next = index + 1; next < boxes.length && boxes[next].box.top < box.bottom - TOLERANCE; next += 1) {
      const other = boxes[next];
      if (other.of === of || !meet(box, other.box)) continue;
      found.push(`“${text}” and “${other.text}” overlap ${where}`);
    }
  });
  return found;
}

const numbers = (colour) => colour.match(/[\d.]+/g).slice(0, 3).map(Number);

function luminance(colour) {
  const parts = colour.map((it) => it / 255);
  const [r, g, b] = parts.map((it) => (it <= 0.04045 ? it / 12.92 : ((it + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

/** The colour behind an element; paper is white. */
function behind(element) {
  for (let it = element; it; it = it.parentElement) {
    const sheet = it.tagName === 'svg' && it.querySelector(':scope > rect');
    if (sheet) return getComputedStyle(sheet).fill;
    const { backgroundColor } = getComputedStyle(it);
    if (backgroundColor !== 'rgba(0, 0, 0, 0)') return backgroundColor;
  }
  return 'rgb(255, 255, 255)';
}

/** A colour as a filter of its picture shows it: inverted by some share, if at all. */
function filtered(element, colour) {
  const { filter } = getComputedStyle(element.closest('svg') ?? element);
  const share = Number(filter.match(/invert\(([\d.]+)\)/)?.[1] ?? 0);
  return numbers(colour).map((it) => it * (1 - 2 * share) + 255 * share);
}

function illegible(element, colour) {
  const both = [filtered(element, colour), numbers(behind(element))];
  const [low, high] = both.map(luminance).sort((a, b) => a - b);
  const contrast = (high + 0.05) / (low + 0.05);
  return contrast < LEAST_CONTRAST ? [`“${words(element)}” has a contrast of ${contrast.toFixed(1)}`] : [];
}

/** What is wrong with the texts of a drawing. */
function drawn(svg, number) {
  const found = [];
  const where = `in drawing ${number + 1}`;
  const around = svg.getBoundingClientRect();
  const texts = [...svg.querySelectorAll('text')].filter(shown);
  const boxes = texts.map((of) => ({ box: of.getBoundingClientRect(), text: words(of), of }));
  for (const { box, text, of } of boxes) {
    const before = Math.max(around.left - box.left, around.top - box.top);
    const over = Math.max(before, box.right - around.right, box.bottom - around.bottom);
    if (over > TOLERANCE) found.push(`“${text}” is cut off by ${over.toFixed(1)} px ${where}`);
    const { c, d } = of.getScreenCTM();
    const size = parseFloat(getComputedStyle(of).fontSize) * Math.hypot(c, d);
    if (document.body && size < LEAST_SIZE) found.push(`“${text}” is ${size.toFixed(1)} px large ${where}`);
    found.push(...illegible(of, getComputedStyle(of).fill));
  }
  return [...found, ...overlapping(boxes, where)];
}

/** What is wrong with the texts outside drawings. */
function written() {
  const found = [];
  const boxes = [];
  const walker = document.createTreeWalker(document.documentElement, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const of = node.parentElement;
    if (node.data.trim() === '' || of.closest('svg, head, script') || !shown(of)) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    for (const box of range.getClientRects()) {
      boxes.push({ box, text: words(of), of });
      const isOutside = box.right > innerWidth + TOLERANCE && !of.closest('.table');
      if (isOutside) found.push(`“${words(of)}” leaves the window`);
    }
    found.push(...illegible(of, getComputedStyle(of).color));
  }
  return [...found, ...overlapping(boxes, 'on the page')];
}

function all() {
  const { scrollWidth } = document.documentElement;
  const wide = scrollWidth > innerWidth ? [`${scrollWidth} px in a window of ${innerWidth}`] : [];
  return [...new Set([...wide, ...[...document.querySelectorAll('svg')].filter(shown).flatMap(drawn), ...written()])];
}

/** Texts that cannot be read, lie on each other or are cut off, as words: what the browser is to evaluate. */
export const faults = `(() => {
  const [TOLERANCE, LEAST_CONTRAST, LEAST_SIZE] = [${[TOLERANCE, LEAST_CONTRAST, LEAST_SIZE]}];
  const [shown, words, meet, numbers] = [${[shown, words, meet, numbers].join(',\n')}];
  ${[overlapping, luminance, behind, filtered, illegible, drawn, written, all].join('\n')}
  return all();
})()`;

/** The figures of a report: their titles, what they draw, and their shapes of colour. The browser runs it. */
export function figures() {
  return [...document.querySelectorAll('figure')].map((figure) => {
    const box = figure.querySelector('svg').getBoundingClientRect();
    const shapes = [...figure.querySelectorAll('svg path')];
    return {
      title: figure.querySelector('figcaption b').textContent.replace(/^Figure \d+\. |\.$/g, ''),
      size: [box.width, box.height],
      roads: shapes.filter((it) => it.closest('.road, .lane') && it.getBoundingClientRect().width > 0).length,
      lanes: shapes.filter((it) => it.closest('.lane')).length,
      marks: shapes.filter((it) => it.matches('.dot') && it.querySelector('title')).length,
      shapes: shapes.length,
    };
  });
}

/** What is wrong with the marks of the figure of this title: too few, or on each other. The browser runs it. */
export function crowded(title) {
  const figure = [...document.querySelectorAll('figure')].find((it) => it.textContent.includes(title));
  const marks = [...figure.querySelectorAll('.dot')].filter((it) => it.querySelector('title'));
  const boxes = marks.map((it) => it.getBBox());
  const common = (a, b, at, size) => Math.min(a[at] + a[size], b[at] + b[size]) - Math.max(a[at], b[at]);
  const meet = (a, b) => common(a, b, 'x', 'width') > 0.2 && common(a, b, 'y', 'height') > 0.2;
  const pairs = boxes.flatMap((a, index) => boxes.slice(index + 1).filter((b) => meet(a, b)));
  const found = pairs.length > 0 ? [`${pairs.length} marks lie on others`] : [];
  return marks.length < 20 ? [`${marks.length} marks`, ...found] : found;
}
