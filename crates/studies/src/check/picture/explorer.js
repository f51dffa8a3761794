"use strict";
const facts = JSON.parse(document.getElementById("facts").textContent);
const lanelets = new Map(facts.lanelets.map((it) => [it.id, it]));
const main = document.getElementById("map");
const svg = main.querySelector("svg");
const areas = new Map([...svg.querySelectorAll("[data-lanelet]")].map((it) => [it.dataset.lanelet, it]));
const found = document.getElementById("found");
const field = document.getElementById("id");
const whole = svg.viewBox.baseVal;
const all = { x: whole.x, y: whole.y, width: whole.width, height: whole.height };
let view = { ...all };

/* The view */

function show(next) {
  const least = all.width / 4000;
  const width = Math.min(Math.max(next.width, least), 1.5 * all.width);
  view = { x: next.x, y: next.y, width, height: (width * next.height) / next.width };
  svg.setAttribute("viewBox", `${view.x} ${view.y} ${view.width} ${view.height}`);
  scaled();
}

/** Tells the style sheet how large a pixel is. */
function scaled() {
  const { width, height } = main.getBoundingClientRect();
  svg.style.setProperty("--units-per-px", Math.max(view.width / width, height > 0 ? view.height / height : 0));
}

function enlarge(factor, at) {
  const middle = at ?? { x: view.x + view.width / 2, y: view.y + view.height / 2 };
  const width = Math.min(Math.max(view.width / factor, all.width / 4000), 1.5 * all.width);
  const share = width / view.width;
  show({
    x: middle.x - share * (middle.x - view.x),
    y: middle.y - share * (middle.y - view.y),
    width,
    height: share * view.height,
  });
}

function move(right, down) {
  show({ ...view, x: view.x + right, y: view.y + down });
}

/** Where the pointer is, in units of the picture. */
function place(event) {
  const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
  return { x: at.x, y: at.y };
}

function bring(id) {
  const box = areas.get(id).getBBox();
  // A lanelet fills at most a quarter of the width, and its surroundings are seen.
  const width = Math.max(4 * Math.max(box.width, (box.height * all.width) / all.height), all.width / 40);
  const height = (width * all.height) / all.width;
  show({ x: box.x + box.width / 2 - width / 2, y: box.y + box.height / 2 - height / 2, width, height });
}

/* What is said */

function button(id) {
  const it = document.createElement("button");
  it.type = "button";
  it.textContent = id;
  it.addEventListener("click", () => choose(id, true));
  return it;
}

function ids(list) {
  const it = document.createElement("span");
  it.className = "ids";
  it.append(...(list.length ? list.map(button) : ["none"]));
  return it;
}

function heading(text) {
  const it = document.createElement("h2");
  it.textContent = text;
  return it;
}

function choose(id, comes) {
  svg.querySelectorAll(".chosen, .near").forEach((it) => it.classList.remove("chosen", "near"));
  const lanelet = lanelets.get(id);
  const beside = [lanelet.left, lanelet.right].filter((it) => it !== null);
  const near = [...lanelet.next, ...lanelet.before, ...beside];
  near.forEach((it) => areas.get(it)?.classList.add("near"));
  areas.get(id).classList.add("chosen");
  const rows = [
    ["length", `${lanelet.length_m} m`],
    ["speed limit", `${lanelet.limit_kmh} km/h`],
    ["continues as", ids(lanelet.next)],
    ["comes from", ids(lanelet.before)],
    ["change left to", ids(lanelet.left === null ? [] : [lanelet.left])],
    ["change right to", ids(lanelet.right === null ? [] : [lanelet.right])],
  ];
  if (lanelet.closed.length) rows.push(["beside, no change", ids(lanelet.closed)]);
  if (lanelet.entrance !== null) rows.push(["entrance", `named ${lanelet.entrance} in a scenario`]);
  if (lanelet.exit !== null) rows.push(["exit", `named ${lanelet.exit} in a scenario`]);
  const table = document.createElement("dl");
  for (const [name, value] of rows) {
    const [term, text] = ["dt", "dd"].map((it) => document.createElement(it));
    term.textContent = name;
    text.append(value);
    table.append(term, text);
  }
  const wrong = facts.problems.filter((it) => it.id === id).map(problem);
  const chosen = document.getElementById("chosen");
  chosen.replaceChildren(heading(`Lanelet ${id}`), table, ...wrong);
  chosen.hidden = false;
  found.textContent = "";
  field.value = id;
  history.replaceState(null, "", `#${id}`);
  if (comes) bring(id);
}

function problem(it) {
  const text = document.createElement("p");
  text.className = "problem";
  if (it.id !== null) text.append(button(it.id), " ");
  text.append(`${it.id === null ? `${it.element}: ` : ""}${it.what}; ${it.remedy}`);
  return text;
}

function find(text) {
  const asked = text.trim();
  if (lanelets.has(asked)) {
    choose(asked, true);
    return;
  }
  const like = asked === "" ? [] : [...lanelets.keys()].filter((it) => it.includes(asked));
  found.textContent = like.length ? `No lanelet ${asked}. ${like.length} contain it: ` : "No lanelet has this id.";
  found.append(...like.slice(0, 12).flatMap((it) => [button(it), " "]));
}

const MOST = 200;
const lists = document.getElementById("lists");
lists.append(heading("Entrances"), ids(facts.entrances), heading("Exits"), ids(facts.exits));
lists.append(heading(`Problems (${facts.problems.length})`), ...facts.problems.slice(0, MOST).map(problem));
if (facts.problems.length === 0) lists.append("none");
if (facts.problems.length > MOST) lists.append(`and ${facts.problems.length - MOST} more`);

/* Hands */

new ResizeObserver(scaled).observe(main);

document.getElementById("search").addEventListener("submit", (event) => {
  event.preventDefault();
  find(field.value);
});
main.addEventListener(
  "wheel",
  (event) => {
    event.preventDefault();
    enlarge(Math.exp(-event.deltaY / 500), place(event));
  },
  { passive: false },
);
let held = null;
main.addEventListener("pointerdown", (event) => {
  if (event.button === 0) held = { at: place(event), x: event.clientX, y: event.clientY, moved: false };
});
main.addEventListener("pointermove", (event) => {
  if (!held) return;
  // A click that trembles is a click.
  held.moved ||= Math.hypot(event.clientX - held.x, event.clientY - held.y) > 4;
  if (!held.moved) return;
  main.setPointerCapture(event.pointerId);
  const now = place(event);
  move(held.at.x - now.x, held.at.y - now.y);
});
main.addEventListener("pointerup", (event) => {
  const area = event.target.closest?.("[data-lanelet]");
  if (held && !held.moved && area) choose(area.dataset.lanelet, false);
  held = null;
});
main.addEventListener("pointercancel", () => (held = null));
document.addEventListener("keydown", (event) => {
  if (event.target === field) {
    if (event.key === "Escape") main.focus();
    return;
  }
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const step = view.width / 10;
  const act = {
    "/": () => field.select(),
    "+": () => enlarge(1.5),
    "=": () => enlarge(1.5),
    "-": () => enlarge(1 / 1.5),
    "0": () => show(all),
    ArrowLeft: () => move(-step, 0),
    ArrowRight: () => move(step, 0),
    ArrowUp: () => move(0, -step),
    ArrowDown: () => move(0, step),
  }[event.key];
  if (!act) return;
  event.preventDefault();
  act();
});
if (lanelets.has(location.hash.slice(1))) choose(location.hash.slice(1), true);
