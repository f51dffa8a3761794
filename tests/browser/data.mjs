// Where real maps and recordings are: as for the tests in Rust (crates/test-data).

import { existsSync } from 'node:fs';
import path from 'node:path';

/** Their folder; null if this machine has none of them and need not have them. */
export function dataFolder(home) {
  const named = process.env.LANEWEAVE_DATA;
  if (named === 'none') return null;
  const folder = path.resolve(named || path.join(home, '../shared/data'));
  if (existsSync(folder)) return folder;
  if (!named && process.env.CI !== 'true') return null;
  throw new Error(`${folder} is not a folder; set LANEWEAVE_DATA to the folder of the data, or to none`);
}
