/** Which vehicles a picture has: all, those of the twin as ghosts; only the traffic; or only the twin, as usual vehicles. */
export type Shown = 'all' | 'traffic' | 'twin';

const NUMBERS: Record<Shown, number> = { all: 0, traffic: 1, twin: 2 };

/** What all shaders with vehicles share. */
export const shown = { shows: { value: NUMBERS.all } };

export function show(which: Shown): void {
  shown.shows.value = NUMBERS[which];
}

/** For vertex shaders: `isLeftOut` says whether a picture has no such vehicle. */
export const SHOWN_CHUNK = /* glsl */ `
uniform int shows;
bool isLeftOut(bool isOfTwin) {
  return shows == (isOfTwin ? ${NUMBERS.traffic} : ${NUMBERS.twin});
}
`;

/** Whether vehicles of the twin are ghosts. */
export const AS_GHOSTS = `shows == ${NUMBERS.all}`;
