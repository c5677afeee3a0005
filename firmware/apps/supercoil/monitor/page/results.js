// How identify and calibrate ended, in the server's words.

import { words } from "./format.js";

let meanings = {};
let notes = [];

/** by_name, by_bit: results and notes of /api/about. */
export function take_results(by_name, by_bit) {
  meanings = by_name ?? {};
  notes = by_bit ?? [];
}

// identify_notes has no bit left for it; it is in Status.
const FRICTION = "friction";

/** "poor fit: the muscle did not …; θ2 is uncertain"; "" if none has ended. by: what interrupted it; bits: identify_notes. */
export function result_words(result, by, bits, friction) {
  if (!(result in meanings) || result === "none" || result === "running") return "";
  const shown = notes.filter(({ name }, bit) => name !== result && (name === FRICTION ? friction : (bits >> bit) & 1));
  return [by ? words(result) + by : `${words(result)}: ${meanings[result]}`, ...shown.map((note) => note.words)].join("; ");
}
