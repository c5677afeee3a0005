// Why a board refused, in the server's words.

import { words } from "./format.js";

let reasons = {};

/** by_name: refusals of /api/about. */
export const take_refusals = (by_name) => { reasons = by_name ?? {}; };

/** "wrong state: arm it first, or reset its fault". */
export const refusal_words = (refusal) => words(refusal) + (refusal in reasons ? `: ${reasons[refusal]}` : "");
