// A joint of two muscles, as boards tell of it; and the unit in which set points are typed: lengths, or a joint's angles.

/** The joint of a node's muscle, {lever_m, other, other_travel_m}: lever_m < 0 of the antagonist; other is its partner's node, and
    other_travel_m how far that may contract, if it is told. null: it is in none, or the board has not told yet. */
export function joint_of(store, node, now_s) {
  const told = {};
  for (const [number, { value }] of store.round(node, "Muscle", "quantity", now_s)) told[store.word("Muscle", "quantity", number)] = value;
  const { joint_lever_m: lever_m, joint_other_node_offset: offset } = told;
  if (!(Math.abs(lever_m) > 0 && Number.isFinite(offset))) return null;
  const joint = { lever_m, other: node + offset };
  for (const [number, { limit }] of store.round(joint.other, "Limit", "fault", now_s))
    if (store.word("Limit", "fault", number) === "over_travel") joint.other_travel_m = limit;
  return joint;
}

export const DEGREES = 180 / Math.PI;
/** per_m: of the unit; both_ways: set points may be negative; min_m: the least, of a muscle that may travel so far. */
export const LENGTH = { unit: "mm", per_m: 1e3, both_ways: false, min_m: () => 0 };
const angle_at = ({ lever_m, other_travel_m }) =>
  ({ unit: "°", per_m: DEGREES / lever_m, both_ways: true, min_m: (max_m) => -(other_travel_m ?? max_m) });

/** In which a node's positions are commanded; joint: of joint_of(). */
export const measure_of = (joint) => (joint && joint.lever_m > 0 ? angle_at(joint) : LENGTH);
