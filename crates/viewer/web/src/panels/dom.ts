type Child = Node | string | null;

/** Makes an element with its attributes and children. */
export function element<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  attributes: Record<string, string> = {},
  ...children: Child[]
): HTMLElementTagNameMap[Tag] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  for (const child of children) if (child !== null) made.append(child);
  return made;
}

const SVG = 'http://www.w3.org/2000/svg';

/** Makes an element of a drawing. */
export function drawn<Tag extends keyof SVGElementTagNameMap>(
  tag: Tag,
  attributes: Record<string, string | number> = {},
  ...children: Child[]
): SVGElementTagNameMap[Tag] {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  for (const child of children) if (child !== null) made.append(child);
  return made;
}

export function button(test: string, label: string, title: string, act: () => void): HTMLButtonElement {
  const made = element('button', { type: 'button', 'data-test': test, title, 'aria-label': title }, label);
  made.addEventListener('click', act);
  return made;
}

/** A list to choose from. */
export function choice<Value extends string>(
  test: string,
  title: string,
  options: readonly (readonly [value: Value, label: string])[],
  choose: (value: Value) => void,
): HTMLSelectElement {
  const made = element('select', { 'data-test': test, title, 'aria-label': title });
  for (const [value, label] of options) made.append(element('option', { value }, label));
  made.addEventListener('change', () => choose(made.value as Value));
  return made;
}

/** Sets a text only where it differs, so that nothing is laid out in vain. */
export function say(node: Element, text: string): void {
  if (node.textContent !== text) node.textContent = text;
}
